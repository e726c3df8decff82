#pragma once
// What follows from the axes of a root system alone.

#include "voxelcore/Roots/RootHierarchy.h"

namespace voxelcore
{

/** Laterals of each stem, gathered by where they spring from it; into roots.whorls. */
void
FindWhorls(const SkeletonGraph & graph, const RootRules & rules, RootHierarchy & roots);

/** The number in `line` of the point nearest to a place, the first of equally near ones. */
std::size_t
NearestPoint(const SkeletonGraph & graph, const std::vector<ElementIndex> & line, const Vector3 & place);

/** Puts axes into the order of their levels; parents, stems and rootOf follow. Returns where each is now. */
std::vector<ElementIndex>
SortByLevel(RootHierarchy & roots);

} // namespace voxelcore
