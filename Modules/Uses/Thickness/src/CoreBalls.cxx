#include "CoreBalls.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

/** Of each cell the first of its points: distances to others may be rounded otherwise. */
std::vector<std::uint32_t>
FirstPoints(const DelaunayCells & cells)
{
  std::vector<std::uint32_t> first(cells.CellCount(), kOutside);
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    for (const std::uint32_t cell : cells.facetCells[facet])
    {
      if (cell != kOutside)
      {
        first[cell] = std::min(first[cell], cells.FacetPoints(facet)[0]);
      }
    }
  }
  return first;
}

} // namespace

CoreBalls
FindCoreBalls(std::span<const LatticePoint> points, const DelaunayCells & cells, const SpacingWeights & weights)
{
  CoreBalls balls{ points, cells, {}, 0, weights.unit, std::vector<double>(cells.CellCount()) };
  std::copy(weights.weight.begin(), weights.weight.end(), balls.weights.begin());
  balls.least = *std::min_element(balls.weights.begin(), balls.weights.end());
  const std::vector<std::uint32_t> first = FirstPoints(cells);
  constexpr std::size_t            chunk = 4096;
  RunEach((first.size() + chunk - 1) / chunk, [&](std::size_t i) {
    for (std::size_t cell = i * chunk; cell < std::min((i + 1) * chunk, first.size()); ++cell)
    {
      balls.radius[cell] = balls.ToPoint(first[cell], cells.centres[cell]);
    }
  });
  return balls;
}

int
PiecesOf(double change, double step)
{
  return std::max(1, static_cast<int>(std::ceil(change / step * (1 - 1e-9))));
}

Vector3
Between(const Vector3 & from, const Vector3 & to, double part)
{
  return { from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1]), from[2] + part * (to[2] - from[2]) };
}

} // namespace voxelcore
