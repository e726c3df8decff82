#include "CheckShare.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Predicates.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

std::string
Text(const LatticePoint & p)
{
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

// The four points are the cell's and fix a sphere, and all its points lie on it. `sides` are sorted, and each point
// begins one.
void
CheckSphere(const BlockShare &                                share,
            std::size_t                                       cell,
            const std::vector<std::array<std::uint32_t, 2>> & sides,
            const SpacingWeights &                            weights)
{
  const auto &         t = share.cells.tetrahedra[cell];
  const LatticePoint & place = share.points[t[0]];
  const CircumSphere   sphere =
    MakeCircumSphere(place, share.points[t[1]], share.points[t[2]], share.points[t[3]], weights);
  const bool own = std::all_of(t.begin(), t.end(), [&sides](std::uint32_t point) {
    const auto at = std::lower_bound(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{ point, 0 });
    return at != sides.end() && (*at)[0] == point;
  });
  if (sphere.det == 0 || !own)
  {
    Misfit(place, "four points do not span a cell there");
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    if ((i == 0 || sides[i][0] != sides[i - 1][0]) && Power(sphere, share.points[sides[i][0]], weights) != 0)
    {
      Misfit(share.points[sides[i][0]], "a cell's points do not lie on one sphere");
    }
  }
}

} // namespace

void
Misfit(const LatticePoint & place, const std::string & what)
{
  throw CertificateError("the blocks do not fit together at the lattice corner " + Text(place) + ": " + what +
                         "; compute all of them again with one version, and report this input if that does not help");
}

void
CheckCells(const BlockShare & share)
{
  const DelaunayCells & cells = share.cells;
  SpacingWeights        weights;
  weights.weight = share.weight;
  std::vector<std::uint64_t> start(cells.CellCount() + 2, 0);
  const auto                 visit = [&cells](auto act) {
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      act(cells.facetCells[facet][0], facet);
      if (cells.facetCells[facet][1] < kOtherBlock)
      {
        act(cells.facetCells[facet][1], facet);
      }
    }
  };
  visit([&start](std::uint32_t cell, std::size_t) { ++start[cell + 2]; });
  for (std::size_t cell = 2; cell < start.size(); ++cell)
  {
    start[cell] += start[cell - 1];
  }
  std::vector<std::uint32_t> facets(start.back());
  visit([&](std::uint32_t cell, std::size_t facet) { facets[start[cell + 1]++] = static_cast<std::uint32_t>(facet); });
  std::vector<std::array<std::uint32_t, 2>> along;
  std::vector<std::array<std::uint32_t, 2>> against;
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    along.clear();
    against.clear();
    for (std::uint64_t i = start[cell]; i < start[cell + 1]; ++i)
    {
      const auto polygon = cells.FacetPoints(facets[i]);
      const bool fromBehind = cells.facetCells[facets[i]][1] == cell;
      for (std::size_t j = 0; j < polygon.size(); ++j)
      {
        const std::uint32_t from = polygon[j];
        const std::uint32_t to = polygon[j + 1 == polygon.size() ? 0 : j + 1];
        (fromBehind ? against : along).push_back({ from, to });
        (fromBehind ? along : against).push_back({ to, from });
      }
    }
    std::sort(along.begin(), along.end());
    std::sort(against.begin(), against.end());
    if (along.empty() || along != against || std::adjacent_find(along.begin(), along.end()) != along.end())
    {
      Misfit(share.points[cells.tetrahedra[cell][0]], "the surface of a cell there is not closed");
    }
    CheckSphere(share, cell, along, weights);
  }
}

} // namespace voxelcore
