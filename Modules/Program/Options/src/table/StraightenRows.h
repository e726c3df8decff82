#pragma once
// Options of `straighten` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kStraightenRows = std::to_array<Parameter>({
  { "branch",
    "--branch",
    Text,
    "N[,N..]",
    "",
    false,
    kStraighten,
    "Go along this branch, by its branch_id, or along several that follow each other" },
  { "from",
    "--from",
    Text,
    "X,Y,Z",
    "",
    false,
    kStraighten,
    "With --to: go the shortest way along the skeleton, from the place on it nearest to this point (LPS mm)" },
  { "to", "--to", Text, "X,Y,Z", "", false, kStraighten, "The point where the way ends" },
  { "label",
    "--label",
    Text,
    "N[#C]",
    "",
    false,
    kStraighten,
    "The label whose skeleton is meant, and its component C, where the file has several" },
  { "spacing",
    "--spacing",
    Text,
    "H|X,Y,Z",
    "",
    false,
    kStraighten,
    "Voxel size of the result in mm: across, up and along; default: the least of the scan" },
  { "width",
    "--width",
    Text,
    "L",
    "",
    false,
    kStraighten,
    "How far the result reaches to each side of the axis: 10mm, 20vox; default: twice the greatest radius on the way" },
  { "interpolation",
    "--interpolation",
    Choice,
    "auto|linear|nearest",
    "auto",
    false,
    kStraighten,
    "Take values between voxels (linear) or those of the nearest voxel; auto takes the nearest of labels" },
  { "outside", "--outside", Real, "V", "0", false, kStraighten, "Value where there is no scan" },
  { "points",
    "--points",
    Input,
    "POINTS.csv",
    "",
    false,
    kStraighten,
    "Map these points into --mapped: columns x, y, z (scan, LPS mm), or across, up, arc_length (straight volume)" },
});

} // namespace voxelcore::table
