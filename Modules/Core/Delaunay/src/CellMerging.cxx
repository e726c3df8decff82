#include "PointPredicates.h"
#include "Tetrahedra.h"

#include "voxelcore/Base/BucketSort.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Predicates.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

namespace voxelcore
{

namespace
{

bool
IsPositive(const std::array<std::uint32_t, 4> & t, const std::vector<LatticePoint> & p)
{
  const Int128 det = Orientation(p[t[0]], p[t[1]], p[t[2]], p[t[3]]);
  if (det == 0)
  {
    throw Error("the Delaunay engine made a flat tetrahedron; please report this input");
  }
  return det > 0;
}

// A triangle between two cells, or between a cell and the outside. Those of one cell with the same key are one facet.
struct Triangle
{
  std::uint64_t                wall;
  std::uint32_t                beyond;
  std::array<std::uint32_t, 3> points;

  auto
  Key() const
  {
    return std::tie(beyond, wall);
  }
};

// Appends the outline of coplanar triangles with consistent orientation: sides that are not met the other way round.
void
AppendOutline(std::span<const Triangle> triangles, std::vector<std::uint32_t> & polygon)
{
  if (triangles.size() == 1)
  {
    polygon.insert(polygon.end(), triangles[0].points.begin(), triangles[0].points.end());
    return;
  }
  std::vector<std::array<std::uint32_t, 2>> sides;
  for (const Triangle & triangle : triangles)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint32_t from = triangle.points[i];
      const std::uint32_t to = triangle.points[(i + 1) % 3];
      const auto          twin = std::find(sides.begin(), sides.end(), std::array<std::uint32_t, 2>{ to, from });
      if (twin != sides.end())
      {
        *twin = sides.back();
        sides.pop_back();
      }
      else
      {
        sides.push_back({ from, to });
      }
    }
  }
  const std::size_t start = polygon.size();
  polygon.push_back(sides[0][0]);
  for (std::uint32_t at = sides[0][1]; at != polygon[start];)
  {
    polygon.push_back(at);
    const auto next = std::find_if(sides.begin(), sides.end(), [&](const auto & side) { return side[0] == at; });
    if (next == sides.end() || polygon.size() - start > sides.size())
    {
      throw Error("the facets of a Delaunay cell do not close; please report this input");
    }
    at = (*next)[1];
  }
}

// The facets of consecutive cells.
struct Outlines
{
  std::vector<std::array<std::uint32_t, 2>> cells;
  std::vector<std::uint32_t>                sizes;
  std::vector<std::uint32_t>                points;
  std::vector<std::uint64_t>                walls; // of those with the outside beyond
};

void
AppendFacets(std::uint32_t cell, std::span<Triangle> triangles, Outlines & outlines)
{
  std::sort(triangles.begin(), triangles.end(), [](const Triangle & a, const Triangle & b) {
    return a.Key() < b.Key();
  });
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last)
  {
    while (last < triangles.size() && triangles[last].Key() == triangles[first].Key())
    {
      ++last;
    }
    const std::size_t before = outlines.points.size();
    AppendOutline(triangles.subspan(first, last - first), outlines.points);
    outlines.cells.push_back({ cell, triangles[first].beyond });
    outlines.sizes.push_back(static_cast<std::uint32_t>(outlines.points.size() - before));
    if (triangles[first].beyond == kOutside)
    {
      outlines.walls.push_back(triangles[first].wall);
    }
  }
}

// Which faces two cospherical tetrahedra inside the shape share: bit i for the face opposite to corner i.
template <typename TNumber>
std::vector<std::uint8_t>
FindAlike(const Tetrahedra &                tetrahedra,
          const std::vector<std::uint8_t> & inside,
          const std::vector<LatticePoint> & points,
          const SpacingWeights &            weights)
{
  const std::size_t         count = inside.size();
  std::vector<std::uint8_t> alike(count, 0);
#pragma omp parallel for schedule(dynamic, 4096) if (count > 10000)
  for (std::size_t t = 0; t < count; ++t)
  {
    if (!inside[t])
    {
      continue;
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::uint32_t neighbour = tetrahedra.neighbours[t][i];
      if (neighbour == kOutside || neighbour < t || !inside[neighbour])
      {
        continue;
      }
      const auto & across = tetrahedra.neighbours[neighbour];
      const auto   far = static_cast<std::size_t>(std::find(across.begin(), across.end(), t) - across.begin());
      const auto & c = tetrahedra.corners[t];
      if (InSphere<TNumber>({ points[c[0]], points[c[1]], points[c[2]], points[c[3]] },
                            points[tetrahedra.corners[neighbour][far]],
                            weights) == 0)
      {
        alike[t] = static_cast<std::uint8_t>(alike[t] | 1U << i);
      }
    }
  }
  return alike;
}

// Unites tetrahedra inside the shape across faces whose far corner lies exactly on the near sphere.
UnionFind
UniteCospherical(const Tetrahedra &                tetrahedra,
                 const std::vector<std::uint8_t> & inside,
                 const std::vector<LatticePoint> & points,
                 const SpacingWeights &            weights)
{
  const std::size_t               count = inside.size();
  const std::vector<std::uint8_t> alike = FitsSmallIntegers(points, weights)
                                            ? FindAlike<std::int64_t>(tetrahedra, inside, points, weights)
                                            : FindAlike<__int128>(tetrahedra, inside, points, weights);
  UnionFind                       sets(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (std::size_t i = 0; alike[t] != 0 && i < 4; ++i)
    {
      if ((alike[t] >> i & 1U) != 0)
      {
        sets.Unite(t, tetrahedra.neighbours[t][i]);
      }
    }
  }
  return sets;
}

} // namespace

DelaunayCells
MergeTetrahedra(Tetrahedra                        tetrahedra,
                const std::vector<std::uint8_t> & inside,
                const std::vector<LatticePoint> & points,
                const SpacingWeights &            weights,
                const NameWall &                  nameWall,
                std::vector<std::uint64_t> *      walls)
{
  const std::size_t          count = tetrahedra.corners.size();
  DelaunayCells              cells;
  std::vector<std::uint32_t> cellOf(count, kOutside);
  {
    UnionFind sets = UniteCospherical(tetrahedra, inside, points, weights);
    for (std::size_t t = 0; t < count; ++t)
    {
      // The representative is the smallest of its set, so it has its number when others ask for it.
      if (inside[t])
      {
        const std::uint32_t root = sets.Find(t);
        if (root == t)
        {
          cellOf[t] = static_cast<std::uint32_t>(cells.tetrahedra.size());
          cells.tetrahedra.push_back(tetrahedra.corners[t]);
        }
        else
        {
          cellOf[t] = cellOf[root];
        }
      }
    }
  }

  // From here on `neighbours` are the cells beyond.
  const bool                worthIt = count > 10000;
  std::vector<std::uint8_t> positive(count, 0);
  RunInParts(worthIt, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t)
    {
      positive[t] = inside[t] && IsPositive(tetrahedra.corners[t], points);
      for (std::uint32_t & beyond : tetrahedra.neighbours[t])
      {
        beyond = beyond == kOutside ? kOutside : cellOf[beyond];
      }
    }
  });
  // Triangles by the cell of smaller number; item 4 t + i is the face of tetrahedron t opposite to its corner i.
  const auto ownerOf = [&](std::size_t item) {
    const std::uint32_t cell = cellOf[item / 4];
    return std::size_t{ tetrahedra.neighbours[item / 4][item % 4] > cell ? cell : kOutside };
  };
  std::vector<Triangle>            triangles;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    4 * count,
    cells.CellCount(),
    ownerOf,
    [&](std::size_t item) {
      const std::size_t t = item / 4;
      const std::size_t i = item % 4;
      Triangle          triangle{ 0, tetrahedra.neighbours[t][i], {} };
      for (std::size_t j = 0; j < 3; ++j)
      {
        triangle.points[positive[t] ? j : 2 - j] = tetrahedra.corners[t][tetrahedronFaces[i][j]];
      }
      if (triangle.beyond == kOutside)
      {
        triangle.wall = nameWall(t, i, triangle.points);
      }
      return triangle;
    },
    triangles);
  tetrahedra = {};
  cellOf = {};

  std::map<std::size_t, Outlines> parts;
  std::mutex                      mutex;
  RunInParts(worthIt, cells.CellCount(), [&](std::size_t first, std::size_t last) {
    Outlines part;
    for (std::size_t cell = first; cell < last; ++cell)
    {
      AppendFacets(static_cast<std::uint32_t>(cell),
                   { triangles.data() + start[cell], triangles.data() + start[cell + 1] },
                   part);
    }
    const std::lock_guard lock(mutex);
    parts[first] = std::move(part);
  });
  for (auto & [first, part] : parts)
  {
    cells.facetCells.insert(cells.facetCells.end(), part.cells.begin(), part.cells.end());
    for (const std::uint32_t size : part.sizes)
    {
      cells.facetOffsets.push_back(cells.facetOffsets.back() + size);
    }
    cells.facetPoints.insert(cells.facetPoints.end(), part.points.begin(), part.points.end());
    if (walls != nullptr)
    {
      walls->insert(walls->end(), part.walls.begin(), part.walls.end());
    }
    part = {};
  }
  return cells;
}

} // namespace voxelcore
