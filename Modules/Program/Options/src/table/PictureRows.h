#pragma once
// Options of pictures.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kPictureRows = std::to_array<Parameter>({
  { "color",
    "--color",
    Choice,
    "Radius|Lambda|ErosionThickness|Thickness|Confidence|SheetId|Label",
    "Radius",
    false,
    kRender,
    "Colour by this length, by confidence (of a skeleton made from probabilities), by sheet, or by label" },
  { "view",
    "--view",
    Choice,
    "front|top|iso|auto",
    "auto",
    false,
    kRender,
    "View from anterior, superior, or obliquely; auto shows the largest side" },
  { "panels",
    "--panels",
    Flag,
    "",
    "",
    false,
    kRender,
    "Draw surface, medial surface and curve skeleton side by side" },
  { "range",
    "--range",
    Text,
    "LO:HI",
    "2%:98%",
    false,
    kRender,
    "Ends of the colour bar: in mm (in voxels where the scan has no voxel size), or as shares of the area; 0%:100% is "
    "the full range" },
  { "each-label", "--each-label", Flag, "", "", false, kRender, "Colour each label over its own range" },
  { "size",
    "--size",
    Text,
    "WxH",
    "1600x1200",
    false,
    kRender,
    "Picture size in pixels; without it, at most this and no wide margins" },
  { "background", "--background", Choice, "white|dark", "white", false, kRender, "Background colour" },
  { "tubes",
    "--tubes",
    Real,
    "F",
    "0.3",
    false,
    kRender,
    "Draw curves as tubes of F times their radius, above 0, up to 1" },
  { "turntable", "--turntable", Integer, "N", "1", false, kRender, "Draw N pictures of a full turn" },
});

} // namespace voxelcore::table
