#pragma once
// Options of pruning and refinement.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kPruningRows = std::to_array<Parameter>({
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "",
    false,
    kCore,
    "Prune at this threshold instead: 1.5mm, 2.5vox, 2.5%; 0 keeps the whole core; several L write "
    "OUT_lambda-1mm.vtp and so on; with --tolerance, one L is applied first",
    "lambda_" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L[,L..]",
    "",
    false,
    kPrune,
    "Prune at this threshold: 1.5mm, 2.5vox, 2.5%; several L write OUT_lambda-1mm.vtp and so on",
    "lambda_" },
  { "lambda",
    "-l,--lambda",
    Text,
    "L",
    "0",
    false,
    kSkeleton,
    "Prune the core of a scan first, at this threshold: 1.5mm, 2.5vox, 2.5%",
    "lambda_" },
  { "tolerance",
    "--tolerance",
    Text,
    "H[,H..]",
    "",
    false,
    kCore,
    "Prune so that the boundary stays within H of the remaining balls: 1.2diag (voxel diagonals; the default without "
    "--lambda), 2vox, 1.5mm; several H write OUT_tolerance-1.2diag.vtp and so on" },
  { "tolerance",
    "--tolerance",
    Text,
    "H[,H..]",
    "",
    false,
    kPrune,
    "Prune so that the boundary stays within H of the remaining balls: 1.2diag (voxel diagonals), 2vox, 1.5mm; several "
    "H write OUT_tolerance-1.2diag.vtp and so on" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "",
    false,
    kSkeleton,
    "Prune the core of a scan first so that the boundary stays within H of the remaining balls: 1.2diag (voxel "
    "diagonals), 2vox, 1.5mm; tips shorten by about H" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "1.2diag",
    false,
    kThickness,
    "What lies within H of the balls beneath it is noise and takes their thickness: 1.2diag (voxel diagonals), 2vox, "
    "1.5mm" },
  { "tolerance",
    "--tolerance",
    Text,
    "H",
    "1.2diag",
    false,
    kSheets,
    "Prune the surface of a scan first so that the boundary stays within H of the remaining balls: 1.2diag (voxel "
    "diagonals), 2vox, 1.5mm" },
});

inline constexpr auto kRefinementRows = std::to_array<Parameter>({
  { "refine",
    "--refine",
    Choice,
    "off|labels|grey|mesh",
    "off",
    false,
    kCore | kSkeleton,
    "Move surface or skeleton by up to a voxel, to the axis of the smooth shape behind labels, grey values or mesh" },
  { "refine",
    "--refine",
    Choice,
    "off|labels|grey|mesh",
    "labels",
    false,
    kMaps,
    "Measure the smooth shape behind labels, grey values or mesh; off: the voxels as they are, by balls that lie in "
    "them" },
  { "grey",
    "--grey",
    Input,
    "SCAN",
    "",
    false,
    kCore | kSkeleton | kMaps,
    "For --refine grey: the grey scan that the labels were segmented from" },
  { "grey-range",
    "--grey-range",
    Text,
    "LO:HI",
    "",
    false,
    kCore | kSkeleton | kMaps,
    "For --grey: the grey values inside the labels, such as 300:inf",
    "-" },
});

} // namespace voxelcore::table
