#include "Tetrahedra.h"

#include "voxelcore/Error.h"

#include "voxelcore/Predicates.h"
#include "voxelcore/UnionFind.h"

#include <algorithm>
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
  std::uint32_t                beyond;
  std::uint64_t                wall;
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

// Unites tetrahedra inside the shape across faces whose far corner lies exactly on the near sphere.
UnionFind
UniteCospherical(const Tetrahedra &                tetrahedra,
                 const std::vector<std::uint8_t> & inside,
                 const std::vector<LatticePoint> & points,
                 const SpacingWeights &            weights)
{
  // Which faces two cospherical tetrahedra share is asked side by side: bit i for the face opposite to corner i.
  const std::size_t         count = inside.size();
  std::vector<std::uint8_t> alike(count, 0);
#pragma omp parallel for schedule(dynamic, 4096) if (count > 10000)
  for (std::size_t t = 0; t < count; ++t)
  {
    if (!inside[t])
    {
      continue;
    }
    const auto &       corners = tetrahedra.corners[t];
    const CircumSphere sphere =
      MakeCircumSphere(points[corners[0]], points[corners[1]], points[corners[2]], points[corners[3]], weights);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::uint32_t neighbour = tetrahedra.neighbours[t][i];
      if (neighbour == kOutside || neighbour < t || !inside[neighbour])
      {
        continue;
      }
      const auto & across = tetrahedra.neighbours[neighbour];
      const auto   far = static_cast<std::size_t>(std::find(across.begin(), across.end(), t) - across.begin());
      if (Power(sphere, points[tetrahedra.corners[neighbour][far]], weights) == 0)
      {
        alike[t] = static_cast<std::uint8_t>(alike[t] | 1U << i);
      }
    }
  }
  UnionFind sets(count);
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

  // Triangles by the cell of smaller number, counted first so that they can be laid down in place.
  const auto isFacet = [&](std::size_t t, std::size_t i) {
    const std::uint32_t neighbour = tetrahedra.neighbours[t][i];
    const std::uint32_t beyond = neighbour == kOutside ? kOutside : cellOf[neighbour];
    return std::make_pair(cellOf[t] != kOutside && beyond > cellOf[t], beyond);
  };
  std::vector<std::uint64_t> start(cells.CellCount() + 2, 0);
  for (std::size_t t = 0; t < count; ++t)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      if (isFacet(t, i).first)
      {
        ++start[cellOf[t] + 2];
      }
    }
  }
  for (std::size_t cell = 2; cell < start.size(); ++cell)
  {
    start[cell] += start[cell - 1];
  }
  std::vector<Triangle> triangles(start.back());
  for (std::size_t t = 0; t < count; ++t)
  {
    if (cellOf[t] == kOutside)
    {
      continue;
    }
    const bool positive = IsPositive(tetrahedra.corners[t], points);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto [wanted, beyond] = isFacet(t, i);
      if (!wanted)
      {
        continue;
      }
      Triangle triangle{ beyond, 0, {} };
      for (std::size_t j = 0; j < 3; ++j)
      {
        triangle.points[positive ? j : 2 - j] = tetrahedra.corners[t][tetrahedronFaces[i][j]];
      }
      if (beyond == kOutside)
      {
        triangle.wall = nameWall(t, i, triangle.points);
      }
      triangles[start[cellOf[t] + 1]++] = triangle;
    }
  }
  tetrahedra = {};

  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    const std::span<Triangle> own{ triangles.data() + start[cell], triangles.data() + start[cell + 1] };
    std::sort(own.begin(), own.end(), [](const Triangle & a, const Triangle & b) { return a.Key() < b.Key(); });
    for (std::size_t first = 0, last = 0; first < own.size(); first = last)
    {
      while (last < own.size() && own[last].Key() == own[first].Key())
      {
        ++last;
      }
      AppendOutline(own.subspan(first, last - first), cells.facetPoints);
      cells.facetCells.push_back({ static_cast<std::uint32_t>(cell), own[first].beyond });
      cells.facetOffsets.push_back(cells.facetPoints.size());
      if (walls != nullptr && own[first].beyond == kOutside)
      {
        walls->push_back(own[first].wall);
      }
    }
  }
  return cells;
}

} // namespace voxelcore
