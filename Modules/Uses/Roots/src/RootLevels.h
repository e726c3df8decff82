#pragma once
// Traits of all roots of a level together.

#include "voxelcore/Roots/RootTraits.h"

#include <vector>

namespace voxelcore
{

/** Of each level from 0 on, of all laterals, and of all roots; `roots` by axis. */
std::vector<RootLevelRecord>
SumLevels(const RootHierarchy & hierarchy, const std::vector<RootRecord> & roots);

} // namespace voxelcore
