#include "Measures.h"

#include "voxelcore/Predicates.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Points of a facet lie on a circle. Its centre is in their hull unless the longest side sees another point under an
// obtuse angle; then that side's midpoint is the nearest point of the hull, and the smallest ball sits there.
double
MeasureFacet(std::span<const std::uint32_t>    polygon,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights)
{
  const std::size_t n = polygon.size();
  std::size_t       longest = 0;
  Int128            length = -1;
  for (std::size_t i = 0; i < n; ++i)
  {
    const Int128 side = SquaredDistance(points[polygon[i]], points[polygon[(i + 1) % n]], weights);
    if (side > length)
    {
      length = side;
      longest = i;
    }
  }
  const LatticePoint & a = points[polygon[longest]];
  const LatticePoint & b = points[polygon[(longest + 1) % n]];
  const LatticePoint & c = points[polygon[(longest + 2) % n]];
  if (AngleSign(c, a, b, weights) <= 0)
  {
    return RatioToDouble(static_cast<UInt128>(length), 4);
  }
  return SquaredCircumradius(a, b, c, weights);
}

} // namespace

CellMeasures
MeasureCells(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  CellMeasures result;
  result.facet.resize(cells.FacetCount());
#pragma omp parallel for schedule(static, 4096) if (cells.FacetCount() > 10000)
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    result.facet[facet] = MeasureFacet(cells.FacetPoints(facet), points, weights);
  }

  // A cell whose sphere's centre lies beyond one of its facets has the nearest point of its hull on the boundary, so
  // its smallest ball is the greatest of its facets' balls; else it is the sphere itself.
  std::vector<double>       greatestFacet(cells.CellCount(), 0.0);
  std::vector<std::uint8_t> centreBeyond(cells.CellCount(), 0);
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto polygon = cells.FacetPoints(facet);
    for (const std::uint32_t cell : cells.facetCells[facet])
    {
      if (cell == kOutside)
      {
        continue;
      }
      greatestFacet[cell] = std::max(greatestFacet[cell], result.facet[facet]);
      if (centreBeyond[cell])
      {
        continue;
      }
      // Any point of the cell off the facet's plane sees the centre; the one of four that is not on the plane will do.
      for (const std::uint32_t corner : cells.tetrahedra[cell])
      {
        const LatticePoint & a = points[polygon[0]];
        const LatticePoint & b = points[polygon[1]];
        const LatticePoint & c = points[polygon[2]];
        const LatticePoint & d = points[corner];
        if (Orientation(a, b, c, d) != 0)
        {
          centreBeyond[cell] = CentreSide(a, b, c, d, weights) < 0;
          break;
        }
      }
    }
  }

  result.sphere.resize(cells.CellCount());
  result.cell.resize(cells.CellCount());
#pragma omp parallel for schedule(static, 4096) if (cells.CellCount() > 10000)
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    const auto & t = cells.tetrahedra[cell];
    result.sphere[cell] =
      SquaredRadius(MakeCircumSphere(points[t[0]], points[t[1]], points[t[2]], points[t[3]], weights), weights);
    result.cell[cell] = centreBeyond[cell] ? greatestFacet[cell] : result.sphere[cell];
  }
  return result;
}

double
ToMillimetres(double squared, const SpacingWeights & weights)
{
  return std::sqrt(squared) * weights.unit;
}

} // namespace voxelcore
