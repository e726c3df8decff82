#include "CellFacets.h"

#include "ExactCentre.h"

#include <array>

namespace voxelcore::verification
{
namespace
{

/** Adds the plane through points i < j < k if it holds a facet of which these are the first three. */
void
TryPlane(std::span<const LatticePoint> points, std::size_t i, std::size_t j, std::size_t k, CellFacets & facets)
{
  const auto difference = [&](std::size_t a, std::size_t b) {
    return std::array<std::int64_t, 3>{ std::int64_t{ points[a].x } - points[b].x,
                                        std::int64_t{ points[a].y } - points[b].y,
                                        std::int64_t{ points[a].z } - points[b].z };
  };
  const auto   u = difference(j, i);
  const auto   v = difference(k, i);
  const Int128 nx = u[1] * v[2] - u[2] * v[1];
  const Int128 ny = u[2] * v[0] - u[0] * v[2];
  const Int128 nz = u[0] * v[1] - u[1] * v[0];
  const auto   start = facets.masks.size();
  facets.masks.resize(start + facets.stride, 0);
  bool above = false;
  bool below = false;
  for (std::size_t l = 0; l < points.size(); ++l)
  {
    const auto   d = difference(l, i);
    const Int128 height = nx * d[0] + ny * d[1] + nz * d[2];
    above |= height > 0;
    below |= height < 0;
    const bool foundBefore = height == 0 && l < k && l != i && l != j;
    if ((above && below) || foundBefore)
    {
      facets.masks.resize(start);
      return;
    }
    if (height == 0)
    {
      facets.masks[start + l / 64] |= std::uint64_t{ 1 } << (l % 64);
    }
  }
}

} // namespace

void
FindFacets(std::span<const LatticePoint> points, CellFacets & facets)
{
  facets.stride = (points.size() + 63) / 64;
  facets.masks.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = i + 1; j < points.size(); ++j)
    {
      for (std::size_t k = j + 1; k < points.size(); ++k)
      {
        TryPlane(points, i, j, k, facets);
      }
    }
  }
}

} // namespace voxelcore::verification
