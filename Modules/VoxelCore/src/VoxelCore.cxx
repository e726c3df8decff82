#include "voxelcore/VoxelCore.h"

#include "Measures.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace voxelcore
{

namespace
{

// A core edge as one side of a face: the dual of one facet around the face's Delaunay edge (p, q), p < q.
struct Side
{
  std::uint32_t q;
  std::uint32_t turn; // twice the edge, plus 1 when the face, seen against p -> q, passes it from end 0 to end 1

  ElementIndex
  Edge() const
  {
    return turn >> 1;
  }
};

// Whether the Delaunay edge between two points lies on the boundary: then it is a side of a voxel, and not all of the
// four voxels around it are in (Theorem 3.1 and Lemma 3.6).
bool
IsBoundaryEdge(const LatticePoint & a, const LatticePoint & b, const VoxelShape & shape)
{
  const int steps = std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
  if (steps != 1)
  {
    return false;
  }
  const LatticePoint & low = std::min(a, b);
  const int            dx = a.x != b.x ? 0 : -1;
  const int            dy = a.y != b.y ? 0 : -1;
  const int            dz = a.z != b.z ? 0 : -1;
  for (int z = dz; z <= 0; ++z)
  {
    for (int y = dy; y <= 0; ++y)
    {
      for (int x = dx; x <= 0; ++x)
      {
        if (!shape.Contains(low.x + x, low.y + y, low.z + z))
        {
          return true;
        }
      }
    }
  }
  return false;
}

// Calls visit(p, side) for every side of a face of the core; in parallel, in any order.
template <typename TVisit>
void
VisitSides(const VoxelShape &                shape,
           const std::vector<LatticePoint> & points,
           const DelaunayCells &             cells,
           const std::vector<ElementIndex> & edgeOf,
           TVisit                            visit)
{
  const auto facets = static_cast<std::ptrdiff_t>(cells.FacetCount());
#pragma omp parallel for schedule(static) if (facets > 10000)
  for (std::ptrdiff_t i = 0; i < facets; ++i)
  {
    const auto facet = static_cast<std::size_t>(i);
    if (cells.facetCells[facet][1] == kOutside)
    {
      continue;
    }
    const auto polygon = cells.FacetPoints(facet);
    for (std::size_t j = 0; j < polygon.size(); ++j)
    {
      const std::uint32_t u = polygon[j];
      const std::uint32_t v = polygon[j + 1 == polygon.size() ? 0 : j + 1];
      if (IsBoundaryEdge(points[u], points[v], shape))
      {
        continue;
      }
      // The facet's normal points from cell 0 to cell 1. A facet that runs p -> q lies on the left of that direction,
      // so going round it counter-clockwise passes from cell 0 to cell 1.
      const bool forward = points[u] < points[v];
      visit(forward ? u : v, Side{ forward ? v : u, edgeOf[facet] << 1 | (forward ? 1U : 0U) });
    }
  }
}

// The sides of all faces, bucketed by p, the lexicographically smaller end of their Delaunay edge.
struct Sides
{
  std::vector<std::uint64_t> start; // points + 1
  std::vector<Side>          side;
};

Sides
CollectSides(const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const DelaunayCells &             cells,
             const std::vector<ElementIndex> & edgeOf)
{
  Sides sides;
  sides.start.assign(points.size() + 2, 0);
  VisitSides(shape, points, cells, edgeOf, [&](std::uint32_t p, const Side &) {
    std::atomic_ref(sides.start[p + 2]).fetch_add(1, std::memory_order_relaxed);
  });
  for (std::size_t p = 2; p < sides.start.size(); ++p)
  {
    sides.start[p] += sides.start[p - 1];
  }
  sides.side.resize(sides.start.back());
  VisitSides(shape, points, cells, edgeOf, [&](std::uint32_t p, const Side & side) {
    sides.side[std::atomic_ref(sides.start[p + 1]).fetch_add(1, std::memory_order_relaxed)] = side;
  });
  sides.start.pop_back();
  return sides;
}

// The sides of one face, next to each other in a bucket.
struct Group
{
  std::array<ElementIndex, 3> smallest; // vertices of the face: they decide its place, as faces share at most an edge
  std::uint32_t               p;
  std::uint32_t               first; // in p's bucket
  std::uint32_t               count;
};

using Edges = std::vector<std::array<ElementIndex, 2>>;

ElementIndex
Tail(const Side & side, const Edges & edges)
{
  return edges[side.Edge()][1 - (side.turn & 1U)];
}

ElementIndex
Head(const Side & side, const Edges & edges)
{
  return edges[side.Edge()][side.turn & 1U];
}

[[noreturn]] void
FailOpenFace()
{
  throw CertificateError("the Delaunay cells around an edge do not close; please report this input");
}

// Sorts each bucket by q, which makes groups; a vertex of a face is the tail of one side.
std::vector<Group>
GroupSides(Sides & sides, const Edges & edges)
{
  constexpr std::size_t           chunk = 1U << 14;
  const std::size_t               buckets = sides.start.size() - 1;
  const std::size_t               chunks = (buckets + chunk - 1) / chunk;
  std::vector<std::vector<Group>> parts(chunks);
  bool                            open = false;
#pragma omp parallel for schedule(dynamic) reduction(|| : open) if (chunks > 1)
  for (std::size_t part = 0; part < chunks; ++part)
  {
    for (std::size_t p = part * chunk; p < std::min(buckets, (part + 1) * chunk); ++p)
    {
      const std::span<Side> own{ sides.side.data() + sides.start[p], sides.side.data() + sides.start[p + 1] };
      std::sort(own.begin(), own.end(), [](const Side & a, const Side & b) { return a.q < b.q; });
      for (std::size_t first = 0, last = 0; first < own.size(); first = last)
      {
        constexpr ElementIndex      none = 0xFFFFFFFFU;
        std::array<ElementIndex, 3> smallest{ none, none, none };
        for (; last < own.size() && own[last].q == own[first].q; ++last)
        {
          ElementIndex vertex = Tail(own[last], edges);
          for (ElementIndex & place : smallest)
          {
            if (vertex < place)
            {
              std::swap(vertex, place);
            }
          }
        }
        open = open || last - first < 3;
        parts[part].push_back({ smallest,
                                static_cast<std::uint32_t>(p),
                                static_cast<std::uint32_t>(first),
                                static_cast<std::uint32_t>(last - first) });
      }
    }
  }
  if (open)
  {
    FailOpenFace();
  }
  std::vector<Group> groups;
  std::size_t        count = 0;
  for (const auto & part : parts)
  {
    count += part.size();
  }
  groups.reserve(count);
  for (auto & part : parts)
  {
    groups.insert(groups.end(), part.begin(), part.end());
    std::vector<Group>().swap(part);
  }
  return groups;
}

// Groups in the canonical order of their faces, by buckets of the smallest vertex.
std::vector<std::uint32_t>
CanonicalFaceOrder(const std::vector<Group> & groups, std::size_t vertexCount)
{
  std::vector<std::uint32_t> start(vertexCount + 2, 0);
  for (const Group & group : groups)
  {
    ++start[group.smallest[0] + 2];
  }
  for (std::size_t vertex = 2; vertex < start.size(); ++vertex)
  {
    start[vertex] += start[vertex - 1];
  }
  std::vector<std::uint32_t> order(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    order[start[groups[i].smallest[0] + 1]++] = static_cast<std::uint32_t>(i);
  }
#pragma omp parallel for schedule(static) if (vertexCount > 10000)
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    std::sort(order.begin() + start[vertex], order.begin() + start[vertex + 1], [&](std::uint32_t a, std::uint32_t b) {
      return groups[a].smallest < groups[b].smallest;
    });
  }
  return order;
}

// Chains the sides of one face head to tail from its smallest vertex on; false when they do not close.
bool
WriteFace(std::span<Side> sides,
          const Edges &   edges,
          ElementIndex    smallest,
          ElementIndex *  vertices,
          ElementIndex *  faceEdges)
{
  ElementIndex at = smallest;
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const auto next = std::find_if(sides.begin() + static_cast<std::ptrdiff_t>(i), sides.end(), [&](const Side & side) {
      return Tail(side, edges) == at;
    });
    if (next == sides.end())
    {
      return false;
    }
    std::iter_swap(sides.begin() + static_cast<std::ptrdiff_t>(i), next);
    vertices[i] = at;
    faceEdges[i] = sides[i].Edge();
    at = Head(sides[i], edges);
  }
  return at == smallest;
}

// The faces of the core in canonical order, with their measures.
void
WriteFaces(Sides sides, const std::vector<LatticePoint> & points, const SpacingWeights & weights, MedialComplex & core)
{
  CellComplex &                    complex = core.cells;
  const std::vector<Group>         groups = GroupSides(sides, complex.edges);
  const std::vector<std::uint32_t> order = CanonicalFaceOrder(groups, complex.vertexCount);
  complex.faceOffsets.assign(order.size() + 1, 0);
  for (std::size_t face = 0; face < order.size(); ++face)
  {
    complex.faceOffsets[face + 1] = complex.faceOffsets[face] + groups[order[face]].count;
  }
  complex.faceVertices.resize(complex.faceOffsets.back());
  complex.faceEdges.resize(complex.faceOffsets.back());
  core.faceLambda.resize(order.size());
  bool open = false;
#pragma omp parallel for schedule(static) reduction(|| : open) if (order.size() > 10000)
  for (std::size_t face = 0; face < order.size(); ++face)
  {
    const Group &         group = groups[order[face]];
    const std::span<Side> own{ sides.side.data() + sides.start[group.p] + group.first, group.count };
    const std::uint32_t   q = own[0].q;
    const auto            at = static_cast<std::ptrdiff_t>(complex.faceOffsets[face]);
    open = !WriteFace(own,
                      complex.edges,
                      group.smallest[0],
                      complex.faceVertices.data() + at,
                      complex.faceEdges.data() + at) ||
           open;
    const Int128 squared = SquaredDistance(points[group.p], points[q], weights);
    core.faceLambda[face] = ToMillimetres(RatioToDouble(static_cast<UInt128>(squared), 4), weights);
  }
  if (open)
  {
    FailOpenFace();
  }
}

// The points by x, with the cells renumbered to match. Cells and facets are in the order of their centres' x: with the
// points in that order too, what is worked on together lies together in memory.
std::vector<LatticePoint>
SortAlongX(const std::vector<LatticePoint> & points, DelaunayCells & cells)
{
  if (points.empty())
  {
    return {};
  }
  const auto byX = [](const LatticePoint & a, const LatticePoint & b) { return a.x < b.x; };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), byX);
  const std::int32_t         first = low->x;
  std::vector<std::uint32_t> next(static_cast<std::size_t>(high->x - first) + 2, 0);
  for (const LatticePoint & p : points)
  {
    ++next[static_cast<std::size_t>(p.x - first) + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<std::uint32_t> place(points.size());
  std::vector<LatticePoint>  sorted(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    place[i] = next[static_cast<std::size_t>(points[i].x - first)]++;
    sorted[place[i]] = points[i];
  }
  const auto corners = static_cast<std::ptrdiff_t>(cells.facetPoints.size());
#pragma omp parallel for schedule(static) if (corners > 10000)
  for (std::ptrdiff_t i = 0; i < corners; ++i)
  {
    cells.facetPoints[static_cast<std::size_t>(i)] = place[cells.facetPoints[static_cast<std::size_t>(i)]];
  }
  for (auto & tetrahedron : cells.tetrahedra)
  {
    for (std::uint32_t & corner : tetrahedron)
    {
      corner = place[corner];
    }
  }
  return sorted;
}

} // namespace

MedialComplex
BuildVoxelCore(const VoxelShape &                shape,
               const std::vector<LatticePoint> & scanPoints,
               DelaunayCells                     cells,
               const SpacingWeights &            weights)
{
  const std::vector<LatticePoint> points = SortAlongX(scanPoints, cells);
  MedialComplex                   core;
  core.cells.vertexCount = cells.CellCount();
  std::size_t edgeCount = 0;
  {
    CellMeasures measures = MeasureCells(cells, points, weights);
    for (std::vector<double> * values : { &measures.sphere, &measures.cell, &measures.facet })
    {
      for (double & value : *values)
      {
        value = ToMillimetres(value, weights);
      }
    }
    core.radius = std::move(measures.sphere);
    core.vertexLambda = std::move(measures.cell);
    core.edgeLambda = std::move(measures.facet);
  }
  std::vector<std::array<std::uint32_t, 4>>().swap(cells.tetrahedra);
  // Facets are sorted by their cells, so the edges come out in canonical order.
  std::vector<ElementIndex> edgeOf(cells.FacetCount());
  for (std::size_t facet = 0; facet < edgeOf.size(); ++facet)
  {
    edgeOf[facet] = static_cast<ElementIndex>(edgeCount);
    edgeCount += cells.facetCells[facet][1] != kOutside;
  }
  if (edgeCount >= std::size_t{ 1 } << 31)
  {
    throw InputError("the core has more than 2^31 edges; crop or split the shape");
  }
  core.cells.edges.reserve(edgeCount);
  for (std::size_t facet = 0; facet < edgeOf.size(); ++facet)
  {
    if (cells.facetCells[facet][1] != kOutside)
    {
      core.edgeLambda[edgeOf[facet]] = core.edgeLambda[facet];
      core.cells.edges.push_back(cells.facetCells[facet]);
    }
  }
  core.edgeLambda.resize(edgeCount);
  core.edgeLambda.shrink_to_fit();

  Sides sides = CollectSides(shape, points, cells, edgeOf);
  core.positions = std::move(cells.centres);
  cells = {};
  std::vector<ElementIndex>().swap(edgeOf);
  WriteFaces(std::move(sides), points, weights, core);
  return core;
}

MedialComplex
ComputeVoxelCore(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 Engine                   engine,
                 const ProgressCallback & progress)
{
  const std::vector<LatticePoint> points = BoundaryVertices(shape);
  return BuildVoxelCore(shape, points, ComputeDelaunayCells(shape, points, weights, engine, progress), weights);
}

} // namespace voxelcore
