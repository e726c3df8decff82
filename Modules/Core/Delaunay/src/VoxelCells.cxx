#include "VoxelCells.h"

#include "voxelcore/Lattice/Predicates.h"

namespace voxelcore
{

namespace
{

LatticePoint
Corner(unsigned c)
{
  return { static_cast<std::int32_t>(c & 1U),
           static_cast<std::int32_t>((c >> 1) & 1U),
           static_cast<std::int32_t>(c >> 2) };
}

VoxelCell
MakeVoxelCell(unsigned mask)
{
  std::vector<LatticePoint> points;
  std::vector<std::uint8_t> names;
  for (unsigned c = 0; c < 8; ++c)
  {
    if ((mask >> c) & 1U)
    {
      points.push_back(Corner(c));
      names.push_back(static_cast<std::uint8_t>(c));
    }
  }
  VoxelCell cell;
  // No three corners are collinear, so the first three span a plane.
  for (std::size_t i = 3; i < points.size() && !cell.spansSpace; ++i)
  {
    if (Orientation(points[0], points[1], points[2], points[i]) != 0)
    {
      cell.spansSpace = true;
      cell.tetrahedron = { names[0], names[1], names[2], names[i] };
    }
  }
  if (!cell.spansSpace)
  {
    return cell;
  }
  const HullFacets hull = ComputeHull(points);
  for (std::size_t i = 0; i < hull.Count(); ++i)
  {
    VoxelCell::Facet & facet = cell.facets[cell.facetCount++];
    unsigned           set = 0;
    for (const std::uint32_t corner : hull.Polygon(i))
    {
      facet.corners[facet.size++] = names[corner];
      set |= 1U << names[corner];
    }
    facet.side = 0;
    while (facet.side < 6 && (set & ~voxelSideMasks[facet.side]) != 0)
    {
      ++facet.side;
    }
  }
  return cell;
}

} // namespace

const std::array<VoxelCell, 256> &
VoxelCells()
{
  static const std::array<VoxelCell, 256> cells = [] {
    std::array<VoxelCell, 256> made;
    for (unsigned mask = 0; mask < 256; ++mask)
    {
      made[mask] = MakeVoxelCell(mask);
    }
    return made;
  }();
  return cells;
}

} // namespace voxelcore
