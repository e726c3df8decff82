#pragma once
// Options of `thickness` and `sheets` alone.

#include "CommandBits.h"

#include <array>

namespace voxelcore::table
{

inline constexpr auto kThicknessRows = std::to_array<Parameter>({
  { "memory",
    "--memory",
    Text,
    "8GB",
    "",
    false,
    kThickness,
    "Measure labels block by block if they need more memory than this; default: the machine's memory",
    "-" },
  { "bounds",
    "--bounds",
    Flag,
    "",
    "",
    false,
    kThickness | kBatch,
    "Write OUT_lower and OUT_upper, too: the largest ball that truly lies in the voxels, and a proven upper bound" },
  { "border",
    "--border",
    Choice,
    "flag|keep|drop",
    "flag",
    false,
    kThickness | kBatch,
    "Voxels whose ball touches the border of the scan: count them and give the numbers without them, too; just count "
    "them; or leave them out" },
  { "separation",
    "--separation",
    Choice,
    "off|box|hull",
    "off",
    false,
    kThickness | kBatch,
    "Measure the background, too, within the box around the labels or their convex hull (Tb.Sp, pore size): "
    "OUT_separation" },
  { "within",
    "--within",
    Text,
    "LABEL|MASK",
    "",
    false,
    kThickness | kBatch,
    "Measure the background, too, within another label of the scan, or a mask of the same voxels: OUT_separation" },
  { "sliver",
    "--sliver",
    Text,
    "L",
    "3vox",
    false,
    kSheets,
    "Join sheets that stand out from their seams by less than L to the sheet they continue: 1.5mm, 3vox, 2.5%" },
});

} // namespace voxelcore::table
