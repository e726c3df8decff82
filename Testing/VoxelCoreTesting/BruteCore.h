#pragma once
// The voxel core of a tiny shape straight from its definition, by trying every four boundary vertices: nothing here is
// shared with the modules but the types.

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/ExactNumbers.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

namespace voxelcore::testing
{

using Indices = std::vector<std::uint32_t>;

/** All elements of the core, exactly. Vertices by their centres, edges and faces by their sorted vertices. */
struct BruteCore
{
  std::vector<BigVector>         centres;       ///< lattice coordinates, in ascending order
  std::vector<BigRational>       squaredRadius; ///< of each vertex, in lattice units
  std::vector<BigRational>       squaredMeasure;
  std::map<Indices, BigRational> edges; ///< two vertices -> squared measure
  std::map<Indices, BigRational> faces; ///< sorted corners -> squared measure
};

/** Every maximal set of boundary vertices on an empty sphere that spans space, as sorted indices. Coordinates must
 *  differ by at most 8 and weights be at most 128, so that int64 holds everything. */
inline std::set<Indices>
BruteCospherical(const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  using Vector = std::array<std::int64_t, 3>;
  std::set<Indices> sets;
  const auto        n = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t a = 0; a < n; ++a)
  {
    // Everything seen from point a: differences, and their squared lengths.
    std::vector<Vector>       d(n);
    std::vector<std::int64_t> s(n);
    for (std::uint32_t i = 0; i < n; ++i)
    {
      d[i] = { points[i].x - points[a].x, points[i].y - points[a].y, points[i].z - points[a].z };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        s[i] += d[i][axis] * d[i][axis] * weights.weight[axis] * weights.weight[axis];
      }
    }
    for (std::uint32_t b = a + 1; b < n; ++b)
    {
      for (std::uint32_t c = b + 1; c < n; ++c)
      {
        const Vector bc{ d[b][1] * d[c][2] - d[b][2] * d[c][1],
                         d[b][2] * d[c][0] - d[b][0] * d[c][2],
                         d[b][0] * d[c][1] - d[b][1] * d[c][0] };
        for (std::uint32_t e = c + 1; e < n; ++e)
        {
          const std::int64_t det = bc[0] * d[e][0] + bc[1] * d[e][1] + bc[2] * d[e][2];
          if (det == 0)
          {
            continue;
          }
          // h with d . h = det * s on b, c and e; a point is outside when det s - d . h has the sign of det.
          Vector h{};
          for (std::size_t i = 0; i < 3; ++i)
          {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            h[i] = s[e] * bc[i] + s[b] * (d[c][j] * d[e][k] - d[c][k] * d[e][j]) +
                   s[c] * (d[e][j] * d[b][k] - d[e][k] * d[b][j]);
          }
          Indices on;
          bool    empty = true;
          for (std::uint32_t p = 0; p < n && empty; ++p)
          {
            const std::int64_t power = det * s[p] - (d[p][0] * h[0] + d[p][1] * h[1] + d[p][2] * h[2]);
            empty = power == 0 || (power > 0) == (det > 0);
            if (power == 0)
            {
              on.push_back(p);
            }
          }
          if (empty)
          {
            sets.insert(on);
          }
        }
      }
    }
  }
  return sets;
}

/** Squared radius of the smallest ball that holds all points: the least of the balls on two, three or four of them
 *  that do. */
inline BigRational
BruteSquaredBall(const std::vector<LatticePoint> & points, const SpacingWeights & weights)
{
  BigRational best = -1;
  const auto  consider = [&](const std::vector<LatticePoint> & support) {
    const auto centre = ExactCircumcentre(support, weights);
    if (!centre)
    {
      return;
    }
    const BigRational radius = ExactSquaredDistance(*centre, ToBigVector(support[0]), weights);
    if ((best < 0 || radius < best) && std::all_of(points.begin(), points.end(), [&](const LatticePoint & p) {
          return ExactSquaredDistance(*centre, ToBigVector(p), weights) <= radius;
        }))
    {
      best = radius;
    }
  };
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = i + 1; j < n; ++j)
    {
      consider({ points[i], points[j] });
    }
  }
  if (best >= 0)
  {
    return best; // a ball on two points that holds all is the smallest
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    for (std::size_t j = i + 1; j < n; ++j)
    {
      for (std::size_t k = j + 1; k < n; ++k)
      {
        consider({ points[i], points[j], points[k] });
        for (std::size_t l = k + 1; l < n; ++l)
        {
          consider({ points[i], points[j], points[k], points[l] });
        }
      }
    }
  }
  return best;
}

/** Whether an exact place lies in the open shape. */
inline bool
LiesInOpenShape(const VoxelShape & shape, const BigVector & place)
{
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const BigInteger p = numerator(place[axis]);
    const BigInteger q = denominator(place[axis]);
    const auto       whole = static_cast<std::int32_t>(p / q);
    high[axis] = p < 0 && p % q != 0 ? whole - 1 : whole;
    low[axis] = p % q == 0 ? high[axis] - 1 : high[axis];
  }
  const int all = (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1);
  return CountIn(shape, { low[0], low[1], low[2] }, { high[0], high[1], high[2] }) == all;
}

/** The core from its definition: Voronoi vertices in the shape, Voronoi edges and faces all of whose vertices are. */
inline BruteCore
MakeBruteCore(const VoxelShape & shape, const SpacingWeights & weights)
{
  const std::vector<LatticePoint> points = BruteBoundaryVertices(shape);
  const std::set<Indices>         all = BruteCospherical(points, weights);

  // Smallest balls depend on the configuration alone, and few configurations are met.
  std::map<std::vector<LatticePoint>, BigRational> balls;
  const auto                                       ball = [&](const Indices & indices) {
    std::vector<LatticePoint> relative;
    const LatticePoint &      o = points[indices[0]];
    for (const std::uint32_t index : indices)
    {
      relative.push_back({ points[index].x - o.x, points[index].y - o.y, points[index].z - o.z });
    }
    const auto [at, isNew] = balls.try_emplace(relative);
    if (isNew)
    {
      at->second = BruteSquaredBall(relative, weights);
    }
    return at->second;
  };

  struct Cell
  {
    BigVector centre;
    Indices   on;
    bool      inside;
  };
  std::vector<Cell> cells;
  for (const Indices & on : all)
  {
    std::optional<BigVector> centre;
    for (std::size_t i = 2; i < on.size() && !centre; ++i)
    {
      for (std::size_t j = i + 1; j < on.size() && !centre; ++j)
      {
        centre = ExactCircumcentre({ points[on[0]], points[on[1]], points[on[i]], points[on[j]] }, weights);
      }
    }
    cells.push_back({ *centre, on, LiesInOpenShape(shape, *centre) });
  }
  // Inside first, by centre: an index is then the number of the core's vertex.
  std::sort(cells.begin(), cells.end(), [](const Cell & a, const Cell & b) {
    return a.inside != b.inside ? a.inside : a.centre < b.centre;
  });

  BruteCore                                     core;
  std::map<Indices, std::set<std::uint32_t>>    cellsWithPair; // two boundary vertices -> cells
  std::vector<std::map<std::uint32_t, Indices>> neighbours(cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i)
  {
    const Cell & cell = cells[i];
    if (cell.inside)
    {
      core.centres.push_back(cell.centre);
      core.squaredRadius.push_back(ExactSquaredDistance(cell.centre, ToBigVector(points[cell.on[0]]), weights));
      core.squaredMeasure.push_back(ball(cell.on));
    }
    for (std::size_t p = 0; p < cell.on.size(); ++p)
    {
      for (std::size_t q = p + 1; q < cell.on.size(); ++q)
      {
        cellsWithPair[{ cell.on[p], cell.on[q] }].insert(i);
      }
    }
    for (std::uint32_t j = 0; j < i; ++j)
    {
      Indices common;
      std::set_intersection(cell.on.begin(),
                            cell.on.end(),
                            cells[j].on.begin(),
                            cells[j].on.end(),
                            std::back_inserter(common));
      if (common.size() >= 3) // on a circle: no three in line, so they span a facet
      {
        neighbours[i][j] = neighbours[j][i] = common;
        if (cell.inside && cells[j].inside)
        {
          core.edges[{ j, i }] = ball(common);
        }
      }
    }
  }
  for (const auto & entry : cellsWithPair)
  {
    const auto & pair = entry.first; // no structured binding: clang 14 lets no lambda see one
    const auto & around = entry.second;
    // Two points are the ends of an inner Delaunay edge when the cells that hold both close up around them: each has
    // two neighbours across facets with both. (A diagonal has one or two cells; an edge of the hull does not close.)
    const bool closed = around.size() >= 3 && std::all_of(around.begin(), around.end(), [&](std::uint32_t cell) {
                          return std::count_if(around.begin(), around.end(), [&](std::uint32_t other) {
                                   const auto at = neighbours[cell].find(other);
                                   return at != neighbours[cell].end() &&
                                          std::includes(at->second.begin(), at->second.end(), pair.begin(), pair.end());
                                 }) == 2;
                        });
    if (closed && *around.rbegin() < core.centres.size())
    {
      core.faces[Indices(around.begin(), around.end())] = ball(pair);
    }
  }
  return core;
}

} // namespace voxelcore::testing
