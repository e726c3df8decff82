#pragma once
// Which labels are measured block by block, and in which blocks.

#include "voxelcore/Certified/ThicknessInBlocks.h"
#include "voxelcore/Shape/BoundaryCounts.h"
#include "voxelcore/Thickness/ThicknessJob.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Bytes at the peak of measuring a shape as a whole, by the numbers of its boundary. */
double
ThicknessBytes(const BoundaryCounts & counts, const ThicknessOptions & options);

/** Blocks of a label, each of which is measured with at most so many bytes, as far as blocks can be made small; one
 *  block, the shape's box, where all of it is. */
std::vector<VoxelBox>
PlanThickness(const VoxelShape &       shape,
              const ImageGeometry &    geometry,
              const CertifiedRequest & request,
              const ThicknessOptions & options,
              double                   bytes);

} // namespace voxelcore
