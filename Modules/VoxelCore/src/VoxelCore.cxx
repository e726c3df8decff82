#include "voxelcore/VoxelCore.h"

#include "Measures.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Error.h"
#include "voxelcore/Predicates.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// A core edge as one side of a face: the dual of one facet around the face's Delaunay edge (p, q), p < q.
struct Side
{
  std::uint32_t q;
  ElementIndex  edge;
  std::uint32_t forward; // 1 when the face, seen against the direction p -> q, passes the edge from end 0 to end 1
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

// The sides of all faces, bucketed by the lexicographically smaller end p of their Delaunay edge.
struct Sides
{
  std::vector<std::uint64_t> start; // points + 1
  std::vector<Side>          side;
};

template <typename TVisit>
void
VisitSides(const VoxelShape &                shape,
           const std::vector<LatticePoint> & points,
           const DelaunayCells &             cells,
           TVisit                            visit)
{
  ElementIndex edge = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    if (cells.facetCells[facet][1] == kOutside)
    {
      continue;
    }
    const auto polygon = cells.FacetPoints(facet);
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const std::uint32_t u = polygon[i];
      const std::uint32_t v = polygon[i + 1 == polygon.size() ? 0 : i + 1];
      if (IsBoundaryEdge(points[u], points[v], shape))
      {
        continue;
      }
      // The facet's normal points from cell 0 to cell 1. A facet that runs p -> q lies on the left of that direction,
      // so going round it counter-clockwise passes from cell 0 to cell 1.
      const bool forward = points[u] < points[v];
      visit(forward ? u : v, Side{ forward ? v : u, edge, forward ? 1U : 0U });
    }
    ++edge;
  }
}

Sides
CollectSides(const VoxelShape & shape, const std::vector<LatticePoint> & points, const DelaunayCells & cells)
{
  Sides sides;
  sides.start.assign(points.size() + 2, 0);
  VisitSides(shape, points, cells, [&](std::uint32_t p, const Side &) { ++sides.start[p + 2]; });
  for (std::size_t p = 2; p < sides.start.size(); ++p)
  {
    sides.start[p] += sides.start[p - 1];
  }
  sides.side.resize(sides.start.back());
  VisitSides(shape, points, cells, [&](std::uint32_t p, const Side & side) {
    sides.side[sides.start[p + 1]++] = side;
  });
  sides.start.pop_back();
  return sides;
}

[[noreturn]] void
FailOpenFace()
{
  throw CertificateError("the Delaunay cells around an edge do not close; please report this input");
}

// Faces in the order they are found, with what their canonical order needs.
struct Faces
{
  std::vector<std::uint64_t> offsets{ 0 };
  std::vector<ElementIndex>  vertices;
  std::vector<ElementIndex>  edges;
  std::vector<Int128>        squaredLength; // of the Delaunay edge
};

// Chains the sides of one face head to tail, starting at its smallest vertex.
void
AppendFace(std::span<Side> sides, const std::vector<std::array<ElementIndex, 2>> & coreEdges, Faces & faces)
{
  if (sides.size() < 3)
  {
    FailOpenFace();
  }
  const auto tail = [&](const Side & side) { return coreEdges[side.edge][side.forward ? 0 : 1]; };
  const auto head = [&](const Side & side) { return coreEdges[side.edge][side.forward ? 1 : 0]; };
  std::iter_swap(sides.begin(), std::min_element(sides.begin(), sides.end(), [&](const Side & a, const Side & b) {
                   return tail(a) < tail(b);
                 }));
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    faces.vertices.push_back(tail(sides[i]));
    faces.edges.push_back(sides[i].edge);
    const ElementIndex next = head(sides[i]);
    if (i + 1 == sides.size())
    {
      if (next != tail(sides[0]))
      {
        FailOpenFace();
      }
      break;
    }
    const auto follower = std::find_if(sides.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                       sides.end(),
                                       [&](const Side & s) { return tail(s) == next; });
    if (follower == sides.end())
    {
      FailOpenFace();
    }
    std::iter_swap(sides.begin() + static_cast<std::ptrdiff_t>(i) + 1, follower);
  }
  faces.offsets.push_back(faces.vertices.size());
}

Faces
CollectFaces(Sides                                            sides,
             const std::vector<LatticePoint> &                points,
             const std::vector<std::array<ElementIndex, 2>> & coreEdges,
             const SpacingWeights &                           weights)
{
  Faces faces;
  faces.vertices.reserve(sides.side.size());
  faces.edges.reserve(sides.side.size());
  for (std::size_t p = 0; p + 1 < sides.start.size(); ++p)
  {
    const std::span<Side> own{ sides.side.data() + sides.start[p], sides.side.data() + sides.start[p + 1] };
    std::sort(own.begin(), own.end(), [](const Side & a, const Side & b) { return a.q < b.q; });
    for (std::size_t first = 0, last = 0; first < own.size(); first = last)
    {
      while (last < own.size() && own[last].q == own[first].q)
      {
        ++last;
      }
      AppendFace(own.subspan(first, last - first), coreEdges, faces);
      faces.squaredLength.push_back(SquaredDistance(points[p], points[own[first].q], weights));
    }
  }
  return faces;
}

// Faces by their sorted vertices. Two faces share at most one edge, so the three smallest vertices decide.
std::vector<ElementIndex>
CanonicalFaceOrder(const Faces & faces, std::size_t vertexCount)
{
  const std::size_t                        count = faces.offsets.size() - 1;
  std::vector<std::array<ElementIndex, 2>> behind(count); // second and third smallest vertex
  std::vector<std::uint64_t>               start(vertexCount + 2, 0);
  for (std::size_t face = 0; face < count; ++face)
  {
    const std::span<const ElementIndex> polygon{ faces.vertices.data() + faces.offsets[face],
                                                 faces.vertices.data() + faces.offsets[face + 1] };
    ElementIndex                        second = 0xFFFFFFFFU;
    ElementIndex                        third = 0xFFFFFFFFU;
    for (const ElementIndex vertex : polygon.subspan(1))
    {
      third = std::min(third, std::max(second, vertex));
      second = std::min(second, vertex);
    }
    behind[face] = { second, third };
    ++start[polygon[0] + 2];
  }
  for (std::size_t vertex = 2; vertex < start.size(); ++vertex)
  {
    start[vertex] += start[vertex - 1];
  }
  std::vector<ElementIndex> order(count);
  for (std::size_t face = 0; face < count; ++face)
  {
    order[start[faces.vertices[faces.offsets[face]] + 1]++] = static_cast<ElementIndex>(face);
  }
  for (std::size_t vertex = 0; vertex < vertexCount; ++vertex)
  {
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(start[vertex]),
              order.begin() + static_cast<std::ptrdiff_t>(start[vertex + 1]),
              [&](ElementIndex a, ElementIndex b) { return behind[a] < behind[b]; });
  }
  return order;
}

} // namespace

MedialComplex
BuildVoxelCore(const VoxelShape &                shape,
               const std::vector<LatticePoint> & points,
               const DelaunayCells &             cells,
               const SpacingWeights &            weights)
{
  MedialComplex core;
  core.positions = cells.centres;
  core.cells.vertexCount = cells.CellCount();
  {
    const CellMeasures measures = MeasureCells(cells, points, weights);
    core.radius.resize(cells.CellCount());
    core.vertexLambda.resize(cells.CellCount());
    for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
    {
      core.radius[cell] = ToMillimetres(measures.sphere[cell], weights);
      core.vertexLambda[cell] = ToMillimetres(measures.cell[cell], weights);
    }
    // Facets are sorted by their cells, so the edges come out in canonical order.
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      if (cells.facetCells[facet][1] != kOutside)
      {
        core.cells.edges.push_back(cells.facetCells[facet]);
        core.edgeLambda.push_back(ToMillimetres(measures.facet[facet], weights));
      }
    }
  }

  const Faces faces = CollectFaces(CollectSides(shape, points, cells), points, core.cells.edges, weights);
  const auto  order = CanonicalFaceOrder(faces, core.cells.vertexCount);
  core.cells.faceOffsets.reserve(order.size() + 1);
  core.cells.faceVertices.reserve(faces.vertices.size());
  core.cells.faceEdges.reserve(faces.edges.size());
  core.faceLambda.reserve(order.size());
  for (const ElementIndex face : order)
  {
    const auto first = static_cast<std::ptrdiff_t>(faces.offsets[face]);
    const auto last = static_cast<std::ptrdiff_t>(faces.offsets[face + 1]);
    core.cells.faceVertices.insert(core.cells.faceVertices.end(),
                                   faces.vertices.begin() + first,
                                   faces.vertices.begin() + last);
    core.cells.faceEdges.insert(core.cells.faceEdges.end(), faces.edges.begin() + first, faces.edges.begin() + last);
    core.cells.faceOffsets.push_back(core.cells.faceVertices.size());
    core.faceLambda.push_back(
      ToMillimetres(RatioToDouble(static_cast<UInt128>(faces.squaredLength[face]), 4), weights));
  }
  return core;
}

MedialComplex
ComputeVoxelCore(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 Engine                   engine,
                 const ProgressCallback & progress)
{
  const std::vector<LatticePoint> points = BoundaryVertices(shape);
  const DelaunayCells             cells = ComputeDelaunayCells(shape, points, weights, engine, progress);
  return BuildVoxelCore(shape, points, cells, weights);
}

} // namespace voxelcore
