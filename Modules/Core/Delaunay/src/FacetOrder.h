#pragma once
// The canonical order of facets.

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

/** Renumbers the cells of facets by `rank` and puts facets and polygons into the order that DelaunayCells promises;
 *  those with kOutside on both sides are left out. Centres and tetrahedra are not touched. */
void
OrderFacets(DelaunayCells & cells, std::vector<std::uint32_t> rank);

} // namespace voxelcore
