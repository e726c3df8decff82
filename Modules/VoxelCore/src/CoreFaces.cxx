#include "CoreFaces.h"

#include "Measures.h"

#include "voxelcore/BucketSort.h"
#include "voxelcore/Error.h"
#include "voxelcore/FaceName.h"
#include "voxelcore/Predicates.h"

#include <omp.h>

#include <algorithm>
#include <atomic>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t kRank = ~kBoundarySide;
constexpr std::size_t   kFacesAhead = 4; // faces

// A core edge as one side of a face, the dual of one facet around the face's Delaunay edge (p, q), p < q: twice the
// edge, plus 1 when the face, seen against p -> q, passes it from end 0 to end 1.
using Turn = std::uint32_t;

struct Side
{
  std::uint32_t q;
  Turn          turn;
};

// Consecutive points are worked on together: their sides fit the caches.
constexpr std::size_t kRangeBits = 14;

std::uint32_t
RangeOf(std::uint32_t point)
{
  return (point & kRank) >> kRangeBits;
}

// For each range of points the facets that have one of its points, ascending.
struct RangeFacets
{
  std::vector<std::uint64_t> start; // ranges + 1
  std::vector<std::uint32_t> facet;
  std::vector<std::uint64_t> sidesBefore; // ranges + 1: sides of faces whose smaller point lies in ranges before
};

// Calls visit(p, side) for the sides of faces that a facet gives.
template <typename TVisit>
void
VisitSides(std::span<const std::uint32_t> polygon, std::uint32_t facet, TVisit visit)
{
  for (std::size_t j = 0; j < polygon.size(); ++j)
  {
    if ((polygon[j] & kBoundarySide) != 0)
    {
      continue;
    }
    const std::uint32_t u = polygon[j] & kRank;
    const std::uint32_t v = polygon[j + 1 == polygon.size() ? 0 : j + 1] & kRank;
    // The facet's normal points from cell 0 to cell 1. A facet that runs p -> q lies on the left of that direction,
    // so going round it counter-clockwise passes from cell 0 to cell 1.
    const bool forward = u < v;
    visit(forward ? u : v, Side{ forward ? v : u, facet << 1 | (forward ? 1U : 0U) });
  }
}

// Calls visit(range) once for each range that a facet has points of.
template <typename TVisit>
void
VisitRanges(std::span<const std::uint32_t> polygon, TVisit visit)
{
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const std::uint32_t range = RangeOf(polygon[i]);
    bool                met = false;
    for (std::size_t j = 0; j < i && !met; ++j)
    {
      met = RangeOf(polygon[j]) == range;
    }
    if (!met)
    {
      visit(range);
    }
  }
}

RangeFacets
FacetsByRange(const DelaunayCells & cells, std::size_t ranges)
{
  const std::size_t facets = cells.facetOffsets.size() - 1;
  const std::size_t threads = facets > 10000 ? static_cast<std::size_t>(omp_get_max_threads()) : 1;
  RangeFacets       result;
  result.start.assign(ranges + 1, 0);
  // Each part of the facets counts for itself; then its entries follow those of the parts before.
  using Counts = std::vector<std::vector<std::uint64_t>>;
  Counts     next(threads, std::vector<std::uint64_t>(ranges, 0));
  Counts     sides = next;
  const auto visitPart = [&](std::size_t part, auto visit) {
    for (std::size_t facet = facets * part / threads; facet < facets * (part + 1) / threads; ++facet)
    {
      visit(static_cast<std::uint32_t>(facet), cells.FacetPoints(facet));
    }
  };
#pragma omp parallel for schedule(static, 1) num_threads(static_cast <int>(threads))
  for (std::size_t part = 0; part < threads; ++part)
  {
    visitPart(part, [&](std::uint32_t facet, std::span<const std::uint32_t> polygon) {
      VisitRanges(polygon, [&](std::uint32_t range) { ++next[part][range]; });
      VisitSides(polygon, facet, [&](std::uint32_t p, const Side &) { ++sides[part][RangeOf(p)]; });
    });
  }
  result.sidesBefore.assign(ranges + 1, 0);
  std::uint64_t sum = 0;
  for (std::size_t range = 0; range < ranges; ++range)
  {
    result.start[range] = sum;
    result.sidesBefore[range + 1] = result.sidesBefore[range];
    for (std::size_t part = 0; part < threads; ++part)
    {
      const std::uint64_t count = next[part][range];
      next[part][range] = sum;
      sum += count;
      result.sidesBefore[range + 1] += sides[part][range];
    }
  }
  result.start[ranges] = sum;
  result.facet.resize(sum);
#pragma omp parallel for schedule(static, 1) num_threads(static_cast <int>(threads))
  for (std::size_t part = 0; part < threads; ++part)
  {
    visitPart(part, [&](std::uint32_t facet, std::span<const std::uint32_t> polygon) {
      VisitRanges(polygon, [&](std::uint32_t range) { result.facet[next[part][range]++] = facet; });
    });
  }
  return result;
}

using Edges = std::vector<std::array<ElementIndex, 2>>;

// The sides of one face, next to each other.
struct Group
{
  FaceName      name;
  std::uint32_t p; // the ends of its Delaunay edge, the smaller first
  std::uint32_t q;
  std::uint32_t count;
  std::uint64_t first; // of all sides
};

ElementIndex
Tail(Turn turn, const Edges & edges)
{
  return edges[turn >> 1][1 - (turn & 1U)];
}

ElementIndex
Head(Turn turn, const Edges & edges)
{
  return edges[turn >> 1][turn & 1U];
}

[[noreturn]] void
FailOpenFace()
{
  throw CertificateError("the Delaunay cells around an edge do not close; please report this input");
}

// All sides, face by face.
struct Faces
{
  std::vector<Turn>  turns;
  std::vector<Group> groups;
};

// Lays down the sides of a range by p, sorts each p's by q, and makes a group of those with the same q; a vertex of a
// face is the tail of one side. False when a face has fewer than three sides.
bool
GroupRange(const DelaunayCells & cells,
           const RangeFacets &   byRange,
           std::size_t           range,
           const Edges &         edges,
           std::size_t           pointCount,
           std::span<Turn>       turns,
           std::uint64_t         shift,
           std::vector<Group> &  groups)
{
  const std::size_t          low = range << kRangeBits;
  const std::size_t          size = std::min(pointCount - low, std::size_t{ 1 } << kRangeBits);
  std::vector<std::uint32_t> start(size + 2, 0);
  // Facets are fetched from memory once.
  std::vector<std::pair<std::uint32_t, Side>> found;
  found.reserve(turns.size());
  for (std::uint64_t i = byRange.start[range]; i < byRange.start[range + 1]; ++i)
  {
    VisitSides(cells.FacetPoints(byRange.facet[i]), byRange.facet[i], [&](std::uint32_t p, const Side & side) {
      if (RangeOf(p) == range)
      {
        found.emplace_back(p, side);
        ++start[p - low + 2];
      }
    });
  }
  for (std::size_t p = 2; p < start.size(); ++p)
  {
    start[p] += start[p - 1];
  }
  std::vector<Side> sides(found.size());
  for (const auto & [p, side] : found)
  {
    sides[start[p - low + 1]++] = side;
  }
  bool closed = true;
  for (std::size_t p = 0; p < size; ++p)
  {
    const std::span<Side> own{ sides.data() + start[p], sides.data() + start[p + 1] };
    std::sort(own.begin(), own.end(), [](const Side & a, const Side & b) { return a.q < b.q; });
    for (std::size_t first = 0, last = 0; first < own.size(); first = last)
    {
      FaceName name = kNoCorners;
      for (; last < own.size() && own[last].q == own[first].q; ++last)
      {
        turns[start[p] + last] = own[last].turn;
        OfferCorner(name, Tail(own[last].turn, edges));
      }
      closed = closed && last - first >= 3;
      groups.push_back({ name,
                         static_cast<std::uint32_t>(low + p),
                         own[first].q,
                         static_cast<std::uint32_t>(last - first),
                         shift + start[p] + first });
    }
  }
  groups.shrink_to_fit(); // all ranges' wait side by side
  return closed;
}

Faces
CollectFaces(DelaunayCells cells, std::size_t pointCount, const Edges & edges)
{
  const std::size_t                  ranges = (pointCount + (std::size_t{ 1 } << kRangeBits) - 1) >> kRangeBits;
  RangeFacets                        byRange = FacetsByRange(cells, ranges);
  std::vector<std::vector<Group>>    parts(ranges);
  const bool                         many = ranges > 1;
  const std::vector<std::uint64_t> & sidesBefore = byRange.sidesBefore;
  Faces                              faces;
  faces.turns.resize(sidesBefore[ranges]);
  bool closed = true;
#pragma omp parallel for schedule(dynamic) reduction(&& : closed) if (many)
  for (std::size_t range = 0; range < ranges; ++range)
  {
    const std::span<Turn> own{ faces.turns.data() + sidesBefore[range], faces.turns.data() + sidesBefore[range + 1] };
    closed = GroupRange(cells, byRange, range, edges, pointCount, own, sidesBefore[range], parts[range]) && closed;
  }
  if (!closed)
  {
    FailOpenFace();
  }
  cells = {};
  byRange = {};
  std::size_t count = 0;
  for (const auto & part : parts)
  {
    count += part.size();
  }
  faces.groups.reserve(count);
  for (auto & part : parts)
  {
    faces.groups.insert(faces.groups.end(), part.begin(), part.end());
    std::vector<Group>().swap(part);
  }
  return faces;
}

// Groups in the canonical order of their faces, by buckets of the smallest vertex.
std::vector<std::uint32_t>
CanonicalFaceOrder(const std::vector<Group> & groups, std::size_t vertexCount)
{
  std::vector<std::uint32_t>       order;
  const std::vector<std::uint32_t> start = SortIntoBuckets(
    groups.size(),
    vertexCount,
    [&](std::size_t i) { return std::size_t{ groups[i].name[0] }; },
    [&](std::size_t i) { return static_cast<std::uint32_t>(i); },
    order);
  SortEachBucket(start, order, [&](std::uint32_t a, std::uint32_t b) { return groups[a].name < groups[b].name; });
  return order;
}

// Chains the sides of one face head to tail from its smallest vertex on; false when they do not close.
bool
WriteFace(std::span<Turn> turns,
          const Edges &   edges,
          ElementIndex    smallest,
          ElementIndex *  vertices,
          ElementIndex *  faceEdges)
{
  ElementIndex at = smallest;
  for (std::size_t i = 0; i < turns.size(); ++i)
  {
    const auto next = std::find_if(turns.begin() + static_cast<std::ptrdiff_t>(i), turns.end(), [&](Turn turn) {
      return Tail(turn, edges) == at;
    });
    if (next == turns.end())
    {
      return false;
    }
    std::iter_swap(turns.begin() + static_cast<std::ptrdiff_t>(i), next);
    vertices[i] = at;
    faceEdges[i] = turns[i] >> 1;
    at = Head(turns[i], edges);
  }
  return at == smallest;
}

} // namespace

void
WriteFaces(DelaunayCells                     cells,
           const std::vector<LatticePoint> & sortedPoints,
           const SpacingWeights &            weights,
           MedialComplex &                   core)
{
  CellComplex &                    complex = core.cells;
  Faces                            faces = CollectFaces(std::move(cells), sortedPoints.size(), complex.edges);
  const std::vector<std::uint32_t> order = CanonicalFaceOrder(faces.groups, complex.vertexCount);
  complex.faceOffsets.assign(order.size() + 1, 0);
  for (std::size_t face = 0; face < order.size(); ++face)
  {
    __builtin_prefetch(faces.groups.data() + order[std::min(face + 4 * kFacesAhead, order.size() - 1)]);
    complex.faceOffsets[face + 1] = complex.faceOffsets[face] + faces.groups[order[face]].count;
  }
  complex.faceVertices.resize(complex.faceOffsets.back());
  complex.faceEdges.resize(complex.faceOffsets.back());
  core.faceLambda.resize(order.size());
  std::atomic<bool> open = false;
  RunInParts(order.size() > 10000, order.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face)
    {
      // Step by step: the group, its sides, the edges that they name.
      if (face + 3 * kFacesAhead < last)
      {
        __builtin_prefetch(&faces.groups[order[face + 3 * kFacesAhead]]);
        __builtin_prefetch(&faces.turns[faces.groups[order[face + 2 * kFacesAhead]].first]);
        const Group & next = faces.groups[order[face + kFacesAhead]];
        for (std::uint32_t side = 0; side < next.count; ++side)
        {
          __builtin_prefetch(&complex.edges[faces.turns[next.first + side] >> 1]);
        }
        __builtin_prefetch(&sortedPoints[next.p]);
        __builtin_prefetch(&sortedPoints[next.q]);
      }
      const Group &         group = faces.groups[order[face]];
      const std::span<Turn> own{ faces.turns.data() + group.first, group.count };
      const auto            at = static_cast<std::ptrdiff_t>(complex.faceOffsets[face]);
      if (!WriteFace(own,
                     complex.edges,
                     group.name[0],
                     complex.faceVertices.data() + at,
                     complex.faceEdges.data() + at))
      {
        open = true;
      }
      const Int128 squared = SquaredDistance(sortedPoints[group.p], sortedPoints[group.q], weights);
      core.faceLambda[face] = ToMillimetres(RatioToDouble(static_cast<UInt128>(squared), 4), weights);
    }
  });
  if (open)
  {
    FailOpenFace();
  }
}

} // namespace voxelcore
