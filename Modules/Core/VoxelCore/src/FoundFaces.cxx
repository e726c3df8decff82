#include "FoundFaces.h"

#include "Measures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Base/SpentMemory.h"
#include "voxelcore/Lattice/Predicates.h"

#include <omp.h>

#include <algorithm>

namespace voxelcore
{

namespace
{

constexpr std::uint32_t kRank = ~kBoundarySide;

struct Side
{
  std::uint32_t q;
  Turn          turn;
};

constexpr std::size_t kPointsAhead = 3; // from the one worked on to one whose edges are fetched

// Consecutive points are worked on together: their sides fit the caches.
constexpr std::size_t kRangeBits = 14; // at most 16

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
FacetsByRange(const FacetPolygons & polygons, std::size_t ranges)
{
  const std::size_t facets = polygons.Count();
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
      visit(static_cast<std::uint32_t>(facet), polygons[facet]);
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

// What a thread needs for one range; kept for the next, since getting memory takes long.
struct RangeWork
{
  std::vector<std::uint32_t> start; // of the sides of each point
  std::vector<std::uint16_t> owner; // of each side as it is met
  std::vector<std::uint64_t> met;
  std::vector<std::uint64_t> sides; // by point: the other point, and in the lower half the turn
  std::vector<ElementIndex>  tails; // of one face
  std::vector<ElementIndex>  heads;
};

// Puts the sides of one face head to tail from its smallest corner on; false when they do not close, or are fewer than
// three.
bool
ChainFace(std::span<const std::uint64_t> sides,
          const CoreEdges &              edges,
          RangeWork &                    work,
          Turn *                         turns,
          FaceName &                     name)
{
  const std::size_t count = sides.size();
  if (work.tails.size() < count)
  {
    work.tails.resize(count);
    work.heads.resize(count);
  }
  ElementIndex * const tails = work.tails.data();
  ElementIndex * const heads = work.heads.data();
  for (std::size_t i = 0; i < count; ++i)
  {
    turns[i] = static_cast<Turn>(sides[i]);
    tails[i] = Tail(turns[i], edges);
    heads[i] = Head(turns[i], edges);
    OfferCorner(name, tails[i]);
  }
  ElementIndex at = name[0];
  for (std::size_t i = 0; i < count; ++i)
  {
    std::size_t next = i;
    while (next < count && tails[next] != at)
    {
      ++next;
    }
    if (next == count)
    {
      return false;
    }
    at = heads[next];
    std::swap(turns[i], turns[next]);
    tails[next] = tails[i];
    heads[next] = heads[i];
  }
  return at == name[0] && count >= 3 && count < kMostSides;
}

// Lays down the sides of a range by p, sorts each p's by q, and makes a face of those with the same q. False when one
// does not close.
bool
FindInRange(const FacetPolygons &             polygons,
            const RangeFacets &               byRange,
            std::size_t                       range,
            const CoreEdges &                 edges,
            const std::vector<LatticePoint> & sortedPoints,
            const SpacingWeights &            weights,
            RangeWork &                       work,
            Turn *                            turns,
            std::vector<FoundFace> &          faces)
{
  const std::size_t low = range << kRangeBits;
  const std::size_t size = std::min(sortedPoints.size() - low, std::size_t{ 1 } << kRangeBits);
  const std::size_t count = byRange.sidesBefore[range + 1] - byRange.sidesBefore[range];
  work.start.assign(size + 2, 0);
  if (work.met.size() < count)
  {
    work.owner.resize(count);
    work.met.resize(count);
    work.sides.resize(count);
  }
  std::uint32_t * const start = work.start.data();
  // Facets are fetched from memory once.
  std::size_t met = 0;
  for (std::uint64_t i = byRange.start[range]; i < byRange.start[range + 1]; ++i)
  {
    VisitSides(polygons[byRange.facet[i]], byRange.facet[i], [&](std::uint32_t p, const Side & side) {
      if (RangeOf(p) == range)
      {
        work.owner[met] = static_cast<std::uint16_t>(p - low);
        work.met[met++] = std::uint64_t{ side.q } << 32 | side.turn;
        ++start[p - low + 2];
      }
    });
  }
  for (std::size_t p = 2; p < size + 2; ++p)
  {
    start[p] += start[p - 1];
  }
  for (std::size_t i = 0; i < met; ++i)
  {
    work.sides[start[work.owner[i] + std::size_t{ 1 }]++] = work.met[i];
  }
  faces.clear();
  for (std::size_t p = 0; p < size; ++p)
  {
    for (std::size_t i = start[std::min(p + kPointsAhead, size)]; i < start[std::min(p + kPointsAhead + 1, size)]; ++i)
    {
      FetchLine(&edges[static_cast<Turn>(work.sides[i]) >> 1]);
    }
    const auto own = std::span(work.sides).subspan(start[p], start[p + 1] - start[p]);
    std::sort(own.begin(), own.end());
    for (std::size_t first = 0, last = 0; first < own.size(); first = last)
    {
      const std::uint64_t q = own[first] >> 32;
      while (last < own.size() && own[last] >> 32 == q)
      {
        ++last;
      }
      FoundFace face{ 0, kNoCorners, static_cast<std::uint32_t>(last - first) };
      if (!ChainFace(own.subspan(first, last - first), edges, work, turns + start[p] + first, face.name))
      {
        return false;
      }
      const Int128 squared = SquaredDistance(sortedPoints[low + p], sortedPoints[q], weights);
      face.lambda = ToMillimetres(RatioToDouble(static_cast<UInt128>(squared), 4), weights);
      faces.push_back(face);
    }
  }
  return true;
}

// Before which facet none has a point of this range or of one that follows.
std::vector<std::uint32_t>
FirstFacets(const RangeFacets & byRange, std::size_t facets)
{
  std::vector<std::uint32_t> first(byRange.start.size(), static_cast<std::uint32_t>(facets));
  for (std::size_t range = first.size() - 1; range-- > 0;)
  {
    const bool has = byRange.start[range] < byRange.start[range + 1];
    first[range] = has ? std::min(first[range + 1], byRange.facet[byRange.start[range]]) : first[range + 1];
  }
  return first;
}

} // namespace

FoundFaces
FindFaces(FacetPolygons             polygons,
          std::vector<LatticePoint> sortedPoints,
          const SpacingWeights &    weights,
          const CoreEdges &         edges)
{
  const std::size_t                ranges = (sortedPoints.size() + (std::size_t{ 1 } << kRangeBits) - 1) >> kRangeBits;
  RangeFacets                      byRange = FacetsByRange(polygons, ranges);
  const std::vector<std::uint32_t> firstFacets = FirstFacets(byRange, edges.size());
  SpentFront                       lists(byRange.facet);
  SpentFront                       starts(polygons.Starts());
  SpentFront                       corners(polygons.Points());
  SpentFront                       points(sortedPoints); // the greater one of each pair lies in the range or beyond
  // A few ranges at a time; then what they alone asked for goes.
  const auto                          threads = static_cast<std::size_t>(omp_get_max_threads());
  const std::size_t                   most = std::max(2 * threads, ranges / 16);
  std::vector<RangeWork>              work(threads);
  std::vector<std::vector<FoundFace>> found(std::min(most, ranges));
  FoundFaces                          result;
  result.turns.reserve(byRange.sidesBefore[ranges]);
  result.faces.reserve(byRange.sidesBefore[ranges] / 3);
  for (std::size_t first = 0; first < ranges; first += most)
  {
    const std::size_t last = std::min(first + most, ranges);
    result.turns.resize(byRange.sidesBefore[last]);
    bool         closed = true;
    FirstFailure failure;
#pragma omp parallel for schedule(dynamic) reduction(&& : closed) if (last - first > 1)
    for (std::size_t range = first; range < last; ++range)
    {
      bool isClosed = true;
      failure.Guard(range, [&] {
        isClosed = FindInRange(polygons,
                               byRange,
                               range,
                               edges,
                               sortedPoints,
                               weights,
                               work[static_cast<std::size_t>(omp_get_thread_num())],
                               result.turns.data() + byRange.sidesBefore[range],
                               found[range - first]);
      });
      closed = closed && isClosed;
    }
    failure.Rethrow();
    if (!closed)
    {
      throw CertificateError("the Delaunay cells around an edge do not close; please report this input");
    }
    for (std::size_t range = first; range < last; ++range)
    {
      result.faces.insert(result.faces.end(), found[range - first].begin(), found[range - first].end());
    }
    lists.SpendTo(byRange.start[last]);
    corners.SpendTo(polygons.Start(firstFacets[last]));
    starts.SpendTo(firstFacets[last]);
    points.SpendTo(std::min(last << kRangeBits, sortedPoints.size()));
  }
  return result;
}

} // namespace voxelcore
