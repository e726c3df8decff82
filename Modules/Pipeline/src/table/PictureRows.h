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
    "Radius|Lambda|ErosionThickness|Label",
    "Radius",
    false,
    kRender,
    "Colour by this length in mm, or by label" },
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
  { "range", "--range", Text, "LO:HI", "", false, kRender, "Ends of the colour bar in mm" },
  { "size", "--size", Text, "WxH", "1600x1200", false, kRender, "Picture size in pixels" },
  { "background", "--background", Choice, "white|dark", "white", false, kRender, "Background colour" },
  { "tubes",
    "--tubes",
    Real,
    "F",
    "0.5",
    false,
    kRender,
    "Draw curves as tubes of F times their radius, above 0, up to 1" },
  { "turntable", "--turntable", Integer, "N", "1", false, kRender, "Draw N pictures of a full turn" },
});

} // namespace voxelcore::table
