#include "Core/Complex/ComplexFixtures.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>

namespace voxelcore::testing
{
namespace
{

using Row = std::vector<bool>;

std::int64_t
DenseRank(std::vector<Row> rows)
{
  std::int64_t      rank = 0;
  const std::size_t columns = rows.empty() ? 0 : rows[0].size();
  for (std::size_t column = 0; column < columns; ++column)
  {
    const auto start = rows.begin() + static_cast<std::ptrdiff_t>(rank);
    const auto pivot = std::find_if(start, rows.end(), [&](const Row & row) { return row[column]; });
    if (pivot == rows.end())
    {
      continue;
    }
    std::iter_swap(start, pivot);
    for (auto row = start + 1; row != rows.end(); ++row)
    {
      if ((*row)[column])
      {
        for (std::size_t c = column; c < columns; ++c)
        {
          (*row)[c] = (*row)[c] != (*start)[c];
        }
      }
    }
    ++rank;
  }
  return rank;
}

/** A random closed subset: the polygons kept, edges kept beside them, and all the vertices these have, plus some. */
CellComplex
RandomSubset(std::mt19937 &                                             generator,
             std::size_t                                                vertexCount,
             const std::vector<Corners> &                               polygons,
             const std::vector<std::pair<ElementIndex, ElementIndex>> & edges,
             unsigned                                                   facePercent,
             unsigned                                                   edgePercent)
{
  const auto           chance = [&](unsigned percent) { return generator() % 100 < percent; };
  std::vector<Corners> keptPolygons;
  std::vector<std::pair<ElementIndex, ElementIndex>> keptEdges;
  std::vector<bool>                                  used(vertexCount, false);
  for (const Corners & polygon : polygons)
  {
    if (chance(facePercent))
    {
      keptPolygons.push_back(polygon);
      for (const ElementIndex v : polygon)
      {
        used[v] = true;
      }
    }
  }
  for (const auto & edge : edges)
  {
    if (chance(edgePercent))
    {
      keptEdges.push_back(edge);
      used[edge.first] = used[edge.second] = true;
    }
  }
  std::vector<ElementIndex> numbers(vertexCount, 0);
  ElementIndex              next = 0;
  for (std::size_t v = 0; v < vertexCount; ++v)
  {
    if (used[v] || chance(5))
    {
      numbers[v] = next++;
    }
  }
  for (Corners & polygon : keptPolygons)
  {
    for (ElementIndex & v : polygon)
    {
      v = numbers[v];
    }
  }
  for (auto & edge : keptEdges)
  {
    edge = { numbers[edge.first], numbers[edge.second] };
  }
  // Shuffled numbers: nothing may hang on an order that follows the grid.
  std::vector<ElementIndex> shuffled(next);
  std::iota(shuffled.begin(), shuffled.end(), ElementIndex{ 0 });
  std::shuffle(shuffled.begin(), shuffled.end(), generator);
  const CellComplex complex = MakeComplex(next, keptPolygons, keptEdges);
  return generator() % 2 == 0 ? complex : Renumber(complex, shuffled);
}

using Steps = std::vector<std::array<std::uint32_t, 3>>;

/** All cells of a grid that are `cell` moved about: for each corner from which all offsets stay in the grid. */
template <typename Add>
void
ForEachPlace(std::uint32_t side, const Steps & cell, Add add)
{
  const auto n = side + 1;
  for (std::uint32_t z = 0; z < n; ++z)
  {
    for (std::uint32_t y = 0; y < n; ++y)
    {
      for (std::uint32_t x = 0; x < n; ++x)
      {
        Corners corners;
        for (const auto & step : cell)
        {
          if (x + step[0] < n && y + step[1] < n && z + step[2] < n)
          {
            corners.push_back(((z + step[2]) * n + y + step[1]) * n + x + step[0]);
          }
        }
        if (corners.size() == cell.size())
        {
          add(corners);
        }
      }
    }
  }
}

} // namespace

CellComplex
MakeComplex(std::size_t                                                vertexCount,
            const std::vector<Corners> &                               polygons,
            const std::vector<std::pair<ElementIndex, ElementIndex>> & edges)
{
  std::map<std::pair<ElementIndex, ElementIndex>, ElementIndex> edgeIndex;
  for (const auto & [v, w] : edges)
  {
    edgeIndex[std::minmax(v, w)] = 0;
  }
  for (const Corners & polygon : polygons)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      edgeIndex[std::minmax(polygon[i], polygon[(i + 1) % polygon.size()])] = 0;
    }
  }
  CellComplex complex;
  complex.vertexCount = vertexCount;
  for (auto & [ends, index] : edgeIndex)
  {
    index = static_cast<ElementIndex>(complex.edges.size());
    complex.edges.push_back({ ends.first, ends.second });
  }
  for (const Corners & polygon : polygons)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      complex.faceVertices.push_back(polygon[i]);
      complex.faceEdges.push_back(edgeIndex[std::minmax(polygon[i], polygon[(i + 1) % polygon.size()])]);
    }
    complex.faceOffsets.push_back(complex.faceVertices.size());
  }
  return complex;
}

CellComplex
Renumber(const CellComplex & complex, const std::vector<ElementIndex> & numbers)
{
  std::vector<Corners>                               polygons;
  std::vector<std::pair<ElementIndex, ElementIndex>> edges;
  for (std::size_t f = 0; f < complex.FaceCount(); ++f)
  {
    Corners polygon;
    for (const ElementIndex v : complex.FaceVertices(f))
    {
      polygon.push_back(numbers[v]);
    }
    polygons.push_back(polygon);
  }
  for (const auto & ends : complex.edges)
  {
    edges.emplace_back(numbers[ends[0]], numbers[ends[1]]);
  }
  return MakeComplex(complex.vertexCount, polygons, edges);
}

TopologyNumbers
DenseTopology(const CellComplex & complex)
{
  std::vector<Row> edgeRows(complex.edges.size(), Row(complex.vertexCount, false));
  for (std::size_t e = 0; e < complex.edges.size(); ++e)
  {
    edgeRows[e][complex.edges[e][0]] = true;
    edgeRows[e][complex.edges[e][1]] = true;
  }
  std::vector<Row> faceRows(complex.FaceCount(), Row(complex.edges.size(), false));
  for (std::size_t f = 0; f < complex.FaceCount(); ++f)
  {
    for (const ElementIndex edge : complex.FaceEdges(f))
    {
      faceRows[f][edge] = !faceRows[f][edge];
    }
  }
  const auto      vertices = static_cast<std::int64_t>(complex.vertexCount);
  const auto      edges = static_cast<std::int64_t>(complex.edges.size());
  const auto      faces = static_cast<std::int64_t>(complex.FaceCount());
  const auto      edgeRank = DenseRank(std::move(edgeRows));
  const auto      faceRank = DenseRank(std::move(faceRows));
  TopologyNumbers numbers;
  numbers.euler = vertices - edges + faces;
  numbers.betti = { vertices - edgeRank, edges - edgeRank - faceRank, faces - faceRank };
  return numbers;
}

CellComplex
RandomCubicalComplex(std::uint32_t seed, std::uint32_t side, unsigned facePercent, unsigned edgePercent)
{
  std::mt19937                                       generator(seed);
  std::vector<Corners>                               polygons;
  std::vector<std::pair<ElementIndex, ElementIndex>> edges;
  const Steps                                        axes{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (std::size_t a = 0; a < 3; ++a)
  {
    const auto & u = axes[a];
    const auto & v = axes[(a + 1) % 3];
    ForEachPlace(side, { { 0, 0, 0 }, u }, [&](const Corners & c) { edges.emplace_back(c[0], c[1]); });
    ForEachPlace(side, { { 0, 0, 0 }, u, { u[0] + v[0], u[1] + v[1], u[2] + v[2] }, v }, [&](const Corners & c) {
      polygons.push_back(c);
    });
  }
  const std::size_t n = side + 1;
  return RandomSubset(generator, n * n * n, polygons, edges, facePercent, edgePercent);
}

CellComplex
RandomSimplicialComplex(std::uint32_t seed, std::uint32_t side, unsigned facePercent, unsigned edgePercent)
{
  std::mt19937                                       generator(seed);
  std::vector<Corners>                               polygons;
  std::vector<std::pair<ElementIndex, ElementIndex>> edges;
  // Kuhn's division: simplices are chains of corners that grow by the componentwise order.
  Steps steps;
  for (std::uint32_t code = 1; code < 8; ++code)
  {
    steps.push_back({ code & 1U, (code >> 1U) & 1U, (code >> 2U) & 1U });
  }
  const auto below = [](const auto & a, const auto & b) {
    return a != b && a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2];
  };
  for (const auto & far : steps)
  {
    ForEachPlace(side, { { 0, 0, 0 }, far }, [&](const Corners & c) { edges.emplace_back(c[0], c[1]); });
    for (const auto & near : steps)
    {
      if (below(near, far))
      {
        ForEachPlace(side, { { 0, 0, 0 }, near, far }, [&](const Corners & c) { polygons.push_back(c); });
      }
    }
  }
  const std::size_t n = side + 1;
  return RandomSubset(generator, n * n * n, polygons, edges, facePercent, edgePercent);
}

CellComplex
Torus()
{
  std::vector<Corners> polygons;
  const auto           at = [](ElementIndex i, ElementIndex j) { return (i % 3) * 3 + j % 3; };
  for (ElementIndex i = 0; i < 3; ++i)
  {
    for (ElementIndex j = 0; j < 3; ++j)
    {
      polygons.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return MakeComplex(9, polygons);
}

CellComplex
CubeSurface(bool withNeighbour)
{
  // Corner x + 2y + 4z; the neighbour lies above, its upper corners are 8 to 11.
  std::vector<Corners> polygons{ { 0, 1, 3, 2 }, { 4, 5, 7, 6 }, { 0, 1, 5, 4 },
                                 { 2, 3, 7, 6 }, { 0, 2, 6, 4 }, { 1, 3, 7, 5 } };
  if (withNeighbour)
  {
    for (const Corners & polygon :
         std::vector<Corners>{ { 8, 9, 11, 10 }, { 4, 5, 9, 8 }, { 6, 7, 11, 10 }, { 4, 6, 10, 8 }, { 5, 7, 11, 9 } })
    {
      polygons.push_back(polygon);
    }
  }
  return MakeComplex(withNeighbour ? 12 : 8, polygons);
}

std::vector<NamedComplex>
KnownComplexes()
{
  std::vector<Corners> cube;
  const CellComplex    surface = CubeSurface();
  for (std::size_t f = 0; f < 6; ++f)
  {
    const auto corners = surface.FaceVertices(f);
    cube.emplace_back(corners.begin(), corners.end());
  }
  const auto moved = [&](ElementIndex shift) {
    std::vector<Corners> result = cube;
    for (Corners & polygon : result)
    {
      for (ElementIndex & v : polygon)
      {
        v += shift;
      }
    }
    return result;
  };
  const auto joined = [](std::vector<Corners> a, const std::vector<Corners> & b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const std::vector<Corners> projectivePlane{ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 3, 4 }, { 0, 4, 5 }, { 0, 1, 5 },
                                              { 1, 2, 4 }, { 2, 3, 5 }, { 1, 3, 4 }, { 2, 4, 5 }, { 1, 3, 5 } };
  return {
    { "nothing", MakeComplex(0, {}), { 0, { 0, 0, 0 } } },
    { "point", MakeComplex(1, {}), { 1, { 1, 0, 0 } } },
    { "segment", MakeComplex(2, {}, { { 0, 1 } }), { 1, { 1, 0, 0 } } },
    { "circle", MakeComplex(3, {}, { { 0, 1 }, { 1, 2 }, { 2, 0 } }), { 0, { 1, 1, 0 } } },
    { "disc", MakeComplex(5, { { 0, 1, 2, 3, 4 } }), { 1, { 1, 0, 0 } } },
    { "sphere", CubeSurface(), { 2, { 1, 0, 1 } } },
    { "torus", Torus(), { 0, { 1, 2, 1 } } },
    { "two spheres sharing a face", CubeSurface(true), { 3, { 1, 0, 2 } } },
    { "theta", MakeComplex(4, {}, { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 } }), { -1, { 1, 2, 0 } } },
    { "wedge of two circles",
      MakeComplex(5, {}, { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 0, 3 }, { 3, 4 }, { 4, 0 } }),
      { -1, { 1, 2, 0 } } },
    { "wedge of a circle and a sphere", MakeComplex(10, cube, { { 0, 8 }, { 8, 9 }, { 9, 0 } }), { 1, { 1, 1, 1 } } },
    // A strip of five quadrilaterals; the last is glued with its ends exchanged.
    { "Moebius band",
      MakeComplex(10, { { 0, 2, 3, 1 }, { 2, 4, 5, 3 }, { 4, 6, 7, 5 }, { 6, 8, 9, 7 }, { 8, 1, 0, 9 } }),
      { 0, { 1, 1, 0 } } },
    { "three half-discs on one seam", MakeComplex(5, { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } }), { 1, { 1, 0, 0 } } },
    // A triangle and two tents over it, one on each side: two cavities.
    { "three discs on one circle",
      MakeComplex(5, { { 0, 1, 2 }, { 3, 0, 1 }, { 3, 1, 2 }, { 3, 2, 0 }, { 4, 0, 1 }, { 4, 1, 2 }, { 4, 2, 0 } }),
      { 3, { 1, 0, 2 } } },
    { "nested shells", MakeComplex(16, joined(cube, moved(8))), { 4, { 2, 0, 2 } } },
    { "nested shells joined by an edge", MakeComplex(16, joined(cube, moved(8)), { { 7, 8 } }), { 3, { 1, 0, 2 } } },
    // Not in 3-space: over GF(2) it has a loop and a cavity.
    { "projective plane", MakeComplex(6, projectivePlane), { 1, { 1, 1, 1 } } },
  };
}

} // namespace voxelcore::testing
