#include "DeepCells.h"


#include <algorithm>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t none = 0xFFFFFFFFU;

// The open facets around each of their points.
class WallFinder
{
public:
  WallFinder(const Tracing & tracing, const std::vector<std::uint32_t> & used, std::size_t pointCount)
    : m_Start(used.size() + 1, 0)
    , m_Signature(used.size(), 0)
  {
    std::vector<std::uint32_t> number(pointCount, none);
    for (std::size_t i = 0; i < used.size(); ++i)
    {
      number[used[i]] = static_cast<std::uint32_t>(i);
    }
    for (const std::uint32_t facet : tracing.deep)
    {
      for (const std::uint32_t p : tracing.cells.FacetPoints(facet))
      {
        ++m_Start[number[p] + 1];
        m_Signature[number[p]] |= std::uint64_t{ 1 } << (facet & 63U);
      }
    }
    for (std::size_t i = 1; i < m_Start.size(); ++i)
    {
      m_Start[i] += m_Start[i - 1];
    }
    m_Corners.resize(m_Start.back());
    std::vector<std::uint32_t> next(m_Start.begin(), m_Start.end() - 1);
    for (const std::uint32_t facet : tracing.deep) // ascending within each list
    {
      // A polygon runs counter-clockwise seen from outside its first cell, which is where the region is unless that
      // cell is the one that is missing.
      const auto polygon = tracing.cells.FacetPoints(facet);
      const bool turn = tracing.cells.facetCells[facet][0] == kOpen;
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const std::size_t place = turn ? polygon.size() - i : i;
        m_Corners[next[number[polygon[i]]]++] = { facet, static_cast<std::uint32_t>(place) };
      }
    }
  }

  struct Wall
  {
    std::uint32_t facet = none;
    bool          facesRegion = false; ///< the three points run counter-clockwise seen from the region
  };

  // The open facet that holds three points (numbers among the used ones), if any: two facets share at most two.
  Wall
  Find(std::uint32_t a, std::uint32_t b, std::uint32_t c) const
  {
    if ((m_Signature[a] & m_Signature[b] & m_Signature[c]) == 0)
    {
      return {};
    }
    for (std::uint32_t i = m_Start[a], j = m_Start[b], k = m_Start[c]; i < m_Start[a + 1] && j < m_Start[b + 1];)
    {
      if (m_Corners[i].facet != m_Corners[j].facet)
      {
        m_Corners[i].facet < m_Corners[j].facet ? ++i : ++j;
        continue;
      }
      while (k < m_Start[c + 1] && m_Corners[k].facet < m_Corners[i].facet)
      {
        ++k;
      }
      if (k < m_Start[c + 1] && m_Corners[k].facet == m_Corners[i].facet)
      {
        const std::uint32_t p = m_Corners[i].place;
        const std::uint32_t q = m_Corners[j].place;
        const std::uint32_t r = m_Corners[k].place;
        return { m_Corners[i].facet, p < q ? q < r || r < p : q < r && r < p };
      }
      ++i;
      ++j;
    }
    return {};
  }

private:
  struct Corner
  {
    std::uint32_t facet;
    std::uint32_t place; // ascending counter-clockwise, seen from the region
  };

  std::vector<std::uint32_t> m_Start;
  std::vector<std::uint64_t> m_Signature; // one bit for each facet of a point: most triples have none in common
  std::vector<Corner>        m_Corners;
};

} // namespace

void
AddDeepCells(Tracing &                         tracing,
             const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const Meanwhile &                 meanwhile,
             const ProgressCallback &          progress)
{
  std::sort(tracing.deep.begin(), tracing.deep.end());
  std::vector<std::uint8_t> isUsed(points.size(), 0);
  for (const std::uint32_t facet : tracing.deep)
  {
    for (const std::uint32_t point : tracing.cells.FacetPoints(facet))
    {
      isUsed[point] = 1;
    }
  }
  std::vector<std::uint32_t> used;
  std::vector<LatticePoint>  deepPoints;
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    if (isUsed[point])
    {
      used.push_back(static_cast<std::uint32_t>(point));
      deepPoints.push_back(points[point]);
    }
  }
  Tetrahedra tetrahedra = BowyerWatson(deepPoints, weights, meanwhile, progress);

  // Tetrahedra, all of them positive, at the far side of an open facet are in the region, and so is what is reached
  // from them without crossing one.
  std::optional<WallFinder>                 finder(std::in_place, tracing, used, points.size());
  const std::size_t                         count = tetrahedra.corners.size();
  std::vector<std::array<std::uint32_t, 4>> wall(count);
  std::vector<std::uint8_t>                 inside(count, 0);
  std::vector<std::uint32_t>                region;
#pragma omp parallel for schedule(dynamic, 4096) if (count > 10000)
  for (std::size_t t = 0; t < count; ++t)
  {
    const auto & corners = tetrahedra.corners[t];
    wall[t].fill(none);
    // The middle of a tetrahedron of the region lies in the open shape, in one voxel or between some that are all in.
    std::array<std::int64_t, 3> sum{};
    for (const std::uint32_t corner : corners)
    {
      sum[0] += deepPoints[corner].x;
      sum[1] += deepPoints[corner].y;
      sum[2] += deepPoints[corner].z;
    }
    if (!shape.Contains(static_cast<std::int32_t>(sum[0] >> 2),
                        static_cast<std::int32_t>(sum[1] >> 2),
                        static_cast<std::int32_t>(sum[2] >> 2)))
    {
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto &           f = tetrahedronFaces[i];
      const WallFinder::Wall found = finder->Find(corners[f[0]], corners[f[1]], corners[f[2]]);
      wall[t][i] = found.facet;
      // The face runs counter-clockwise seen from outside its tetrahedron.
      if (found.facet != none && !found.facesRegion)
      {
        inside[t] = 1;
      }
    }
  }
  finder.reset();
  for (std::size_t t = 0; t < count; ++t)
  {
    if (inside[t])
    {
      region.push_back(static_cast<std::uint32_t>(t));
    }
  }
  for (std::size_t i = 0; i < region.size(); ++i)
  {
    const std::uint32_t t = region[i];
    for (std::size_t face = 0; face < 4; ++face)
    {
      if (wall[t][face] != none)
      {
        continue;
      }
      const std::uint32_t neighbour = tetrahedra.neighbours[t][face];
      if (neighbour == kOutside)
      {
        throw CertificateError("the deep Delaunay cells do not close; please report this input");
      }
      if (!inside[neighbour])
      {
        inside[neighbour] = 1;
        region.push_back(neighbour);
      }
    }
  }

  region = {};

  // The walls of the region are the open facets themselves: only the cells behind them are new.
  const auto nameWall = [&](std::size_t t, std::size_t face, const std::array<std::uint32_t, 3> &) {
    return std::uint64_t{ wall[t][face] };
  };
  std::vector<std::uint64_t> walls;
  const DelaunayCells deep = MergeTetrahedra(std::move(tetrahedra), inside, deepPoints, weights, nameWall, &walls);
  DelaunayCells &     cells = tracing.cells;
  const auto          shift = static_cast<std::uint32_t>(cells.CellCount());
  for (const auto & t : deep.tetrahedra)
  {
    cells.tetrahedra.push_back({ used[t[0]], used[t[1]], used[t[2]], used[t[3]] });
  }
  std::size_t nextWall = 0;
  for (std::size_t facet = 0; facet < deep.FacetCount(); ++facet)
  {
    const auto & sides = deep.facetCells[facet];
    if (sides[1] == kOutside)
    {
      auto & open = cells.facetCells[walls[nextWall++]];
      open[open[0] == kOpen ? 0 : 1] = sides[0] + shift;
      continue;
    }
    cells.facetCells.push_back({ sides[0] + shift, sides[1] + shift });
    for (const std::uint32_t p : deep.FacetPoints(facet))
    {
      cells.facetPoints.push_back(used[p]);
    }
    cells.facetOffsets.push_back(cells.facetPoints.size());
  }
  for (const std::uint32_t facet : tracing.deep)
  {
    if (cells.facetCells[facet][0] == kOpen || cells.facetCells[facet][1] == kOpen)
    {
      throw CertificateError("the deep Delaunay cells do not close; please report this input");
    }
  }
  tracing.deep.clear();
}

} // namespace voxelcore
