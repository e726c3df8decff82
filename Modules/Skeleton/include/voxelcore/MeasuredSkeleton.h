#pragma once
// A curve skeleton with its numbers: what is written and drawn.

#include "voxelcore/BranchTable.h"

#include <cstdint>
#include <string>

namespace voxelcore
{

/** The skeleton of one label, or of one component of it; positions in LPS mm. */
struct MeasuredSkeleton
{
  std::int64_t  label = 0;
  std::int64_t  component = 0; ///< from 1 for a label split into its components; 0: the whole label
  std::string   name;
  SkeletonGraph graph;
  BranchTable   table; ///< of this graph
};

} // namespace voxelcore
