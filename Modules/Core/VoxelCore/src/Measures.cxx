#include "Measures.h"

#include "FacetMeasure.h"

#include "voxelcore/Base/BucketSort.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Delaunay/CanonicalCells.h"
#include "voxelcore/Lattice/Predicates.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAhead = 8; // places from where a loop is to what it has the memory fetch

// A boundary vertex by its number in the scan.
struct PointEntry
{
  std::uint64_t key;  // x, y, z from the box' lower corner, 21 bits each: ordered as the points are lexicographically
  std::uint32_t rank; // in that order
  std::uint32_t boundaryEdges; // bit 0, 1, 2: the lattice edge to the next corner along z, y, x lies on the boundary
};

LatticePoint
PointOf(const PointEntry & entry, const std::array<std::int32_t, 3> & lower)
{
  constexpr std::uint64_t last = (std::uint64_t{ 1 } << 21) - 1;
  return { lower[0] + static_cast<std::int32_t>(entry.key >> 42),
           lower[1] + static_cast<std::int32_t>((entry.key >> 21) & last),
           lower[2] + static_cast<std::int32_t>(entry.key & last) };
}

constexpr std::array<std::uint64_t, 3> kStep{ 1, std::uint64_t{ 1 } << 21, std::uint64_t{ 1 } << 42 }; // z, y, x

// A side of a voxel lies on the boundary when not all of the four voxels around it are in (Theorem 3.1 and Lemma 3.6).
std::uint32_t
BoundaryEdges(const LatticePoint & p, const VoxelShape & shape)
{
  const unsigned in = shape.Around(p.x, p.y, p.z);
  return ((in & 0xF0U) != 0xF0U ? 1U : 0U) | ((in & 0xCCU) != 0xCCU ? 2U : 0U) | ((in & 0xAAU) != 0xAAU ? 4U : 0U);
}

std::vector<PointEntry>
MakeEntries(const VoxelShape & shape, const std::vector<LatticePoint> & points)
{
  const auto &            low = shape.Box().lower;
  const auto              count = static_cast<std::ptrdiff_t>(points.size());
  std::vector<PointEntry> entries(points.size());
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const LatticePoint & p = points[static_cast<std::size_t>(i)];
    const auto offset = [](std::int32_t c, std::int32_t from) { return static_cast<std::uint64_t>(c - from); };
    entries[static_cast<std::size_t>(i)] = { offset(p.x, low[0]) << 42 | offset(p.y, low[1]) << 21 |
                                               offset(p.z, low[2]),
                                             0,
                                             BoundaryEdges(p, shape) };
  }
  return entries;
}

// Ranks by counting along y, then along x; the scan's order, by z first, decides among equals.
void
RankLexicographically(const VoxelShape &                shape,
                      const std::vector<LatticePoint> & points,
                      std::vector<PointEntry> &         entries)
{
  const auto &               box = shape.Box();
  std::vector<std::uint32_t> byY;
  std::vector<std::uint32_t> order;
  SortIntoBuckets(
    points.size(),
    static_cast<std::size_t>(box.size[1]) + 1,
    [&](std::size_t i) { return static_cast<std::size_t>(points[i].y - box.lower[1]); },
    [&](std::size_t i) { return static_cast<std::uint32_t>(i); },
    byY);
  SortIntoBuckets(
    points.size(),
    static_cast<std::size_t>(box.size[0]) + 1,
    [&](std::size_t i) { return static_cast<std::size_t>(points[byY[i]].x - box.lower[0]); },
    [&](std::size_t i) { return byY[i]; },
    order);
  const auto count = static_cast<std::ptrdiff_t>(points.size());
#pragma omp parallel for schedule(static) if (count > 10000)
  for (std::ptrdiff_t rank = 0; rank < count; ++rank)
  {
    const auto          at = static_cast<std::size_t>(rank);
    const std::uint32_t i = order[at];
    if (at + kAhead < order.size())
    {
      __builtin_prefetch(&entries[order[at + kAhead]], 1);
    }
    entries[i].rank = static_cast<std::uint32_t>(rank);
  }
}

std::vector<LatticePoint>
SortByRank(const std::vector<PointEntry> & entries, const std::array<std::int32_t, 3> & lower)
{
  std::vector<LatticePoint> sorted(entries.size());
  RunInParts(entries.size() > 10000, entries.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      __builtin_prefetch(&sorted[entries[std::min(i + kAhead, last - 1)].rank], 1);
      sorted[entries[i].rank] = PointOf(entries[i], lower);
    }
  });
  return sorted;
}

// The points by their numbers in the scan.
struct EntryPoints
{
  const std::vector<PointEntry> &     entries;
  const std::array<std::int32_t, 3> & lower;

  LatticePoint
  operator[](std::uint32_t point) const
  {
    return PointOf(entries[point], lower);
  }
};

// A facet's plane, by its counter-clockwise points seen from outside its first cell.
struct Plane
{
  LatticePoint          a{}, b{}, c{};
  std::array<double, 3> normal{}; // (b - a) x (c - a), exact: minors stay below 2^53

  explicit Plane(const std::vector<LatticePoint> & polygon)
    : a(polygon[0])
    , b(polygon[1])
    , c(polygon[2])
  {
    const std::array<std::int64_t, 3> u{ b.x - a.x, b.y - a.y, b.z - a.z };
    const std::array<std::int64_t, 3> v{ c.x - a.x, c.y - a.y, c.z - a.z };
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t j = (i + 1) % 3;
      const std::size_t k = (i + 2) % 3;
      normal[i] = static_cast<double>(u[j] * v[k] - u[k] * v[j]);
    }
  }

  // Sign of the side of a centre rounded once: 1 outside the facet's first cell, -1 inside, 0 too near to tell.
  int
  SideOf(const std::array<double, 3> & centre) const
  {
    const std::array<double, 3> from{ static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z) };
    double                      side = 0.0;
    double                      bound = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double arm = centre[i] - from[i];
      side += normal[i] * arm;
      bound += std::abs(normal[i]) * (std::abs(centre[i]) + 4.0 * std::abs(arm));
    }
    // Half an ulp of the coordinate, one of the difference, one of the product and two of the sums.
    bound *= 2.0 * std::numeric_limits<double>::epsilon();
    return side > bound ? 1 : side < -bound ? -1 : 0;
  }
};

// Whether the centre of a cell's sphere lies strictly beyond one of its facets; side 0 for the facet's first cell.
bool
LiesBeyond(const Plane &          plane,
           const DelaunayCells &  cells,
           std::uint32_t          cell,
           int                    side,
           const EntryPoints &    points,
           const SpacingWeights & weights)
{
  const int sign = plane.SideOf(cells.centres[cell]);
  if (sign != 0)
  {
    return (sign > 0) == (side == 0);
  }
  // Any point of the cell off the facet's plane sees the centre; the one of four that is not on the plane will do.
  for (const std::uint32_t corner : cells.tetrahedra[cell])
  {
    if (Orientation(plane.a, plane.b, plane.c, points[corner]) != 0)
    {
      return CentreSide(plane.a, plane.b, plane.c, points[corner], weights) < 0;
    }
  }
  return false;
}

void
RaiseTo(double & value, double to)
{
  atomic_ref<double> atomic(value);
  double             old = atomic.load(std::memory_order_relaxed);
  while (old < to && !atomic.compare_exchange_weak(old, to, std::memory_order_relaxed))
  {}
}

// What is noted of a cell.
constexpr std::uint8_t kCentreBeyond = 8; // a facet; below it a bit for the axis of each voxel's side it has

// A facet on the boundary is a side of a voxel (Theorem 3.1). No lattice point lies within the ball that has its
// diagonal for diameter, so that the centre of the cell beside it is on the cell's side. Its measure, half its diagonal
// squared, depends on its axis alone.
std::array<double, 3>
VoxelSideMeasures(const SpacingWeights & weights)
{
  std::array<double, 3> measures{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const LatticePoint opposite{ axis == 0 ? 0 : 1, axis == 1 ? 0 : 1, axis == 2 ? 0 : 1 };
    measures[axis] = RatioToDouble(static_cast<UInt128>(SquaredDistance({ 0, 0, 0 }, opposite, weights)), 4);
  }
  return measures;
}

// From any thread. One facet is enough: those that come later need not look where it lies.
template <typename TLiesBeyond>
void
NoteCentreBeyond(std::uint8_t & note, const TLiesBeyond & liesBeyond)
{
  atomic_ref<std::uint8_t> atomic(note);
  if ((atomic.load(std::memory_order_relaxed) & kCentreBeyond) == 0 && liesBeyond())
  {
    atomic.fetch_or(kCentreBeyond, std::memory_order_relaxed);
  }
}

// Facets follow each other along x, points and their neighbours along z: what is met next is asked for early.
void
FetchFacet(const DelaunayCells &           cells,
           const FacetPolygons &           polygons,
           std::size_t                     facet,
           const std::vector<PointEntry> & entries)
{
  for (const std::uint32_t point : polygons[facet])
  {
    FetchLine(&entries[point]);
  }
  for (const std::uint32_t cell : cells.facetCells[facet])
  {
    FetchLine(&cells.centres[cell]);
    FetchLine(&cells.tetrahedra[cell]);
  }
}

// Numbers the points of one facet anew, marks its sides on the boundary, and puts its corners into `polygon`.
void
TurnToRanks(const std::vector<PointEntry> &     entries,
            const std::array<std::int32_t, 3> & lower,
            std::span<std::uint32_t>            facet,
            std::vector<LatticePoint> &         polygon)
{
  polygon.clear();
  const PointEntry * const first = &entries[facet[0]];
  const PointEntry *       entry = first;
  for (std::size_t i = 0; i < facet.size(); ++i)
  {
    polygon.push_back(PointOf(*entry, lower));
    const PointEntry * const next = i + 1 == facet.size() ? first : &entries[facet[i + 1]];
    const PointEntry &       low = entry->key < next->key ? *entry : *next;
    const std::uint64_t      step = std::max(entry->key, next->key) - low.key;
    bool                     onBoundary = false;
    for (std::uint32_t axis = 0; axis < 3; ++axis)
    {
      onBoundary = onBoundary || (step == kStep[axis] && ((low.boundaryEdges >> axis) & 1U) != 0);
    }
    facet[i] = entry->rank | (onBoundary ? kBoundarySide : 0);
    entry = next;
  }
}

// The radii of spheres, in mm, and their centres where they are missing.
std::vector<double>
MeasureSpheres(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells)
{
  const std::size_t   count = cells.CellCount();
  const bool          hasCentres = cells.centres.size() == count;
  std::vector<double> radius(count);
  cells.centres.resize(count);
  RunInParts(count > 10000, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell)
    {
      for (const std::uint32_t point : cells.tetrahedra[std::min(cell + kAhead, count - 1)])
      {
        __builtin_prefetch(points.data() + point);
      }
      const auto &                      t = cells.tetrahedra[cell];
      const std::array<LatticePoint, 4> corners{ points[t[0]], points[t[1]], points[t[2]], points[t[3]] };
      if (!hasCentres)
      {
        cells.centres[cell] = CentreOfCorners(corners, weights).centre;
      }
      const CircumSphere sphere = MakeCircumSphere(corners[0], corners[1], corners[2], corners[3], weights);
      radius[cell] = ToMillimetres(SquaredRadius(sphere, weights), weights);
    }
  });
  return radius;
}

// A cell whose sphere's centre lies beyond one of its facets has the nearest point of its hull on the boundary, so
// its smallest ball is the greatest of its facets' balls, or of its voxels' sides; else it is the sphere itself.
void
MeasureHulls(const std::vector<std::uint8_t> &                 notes,
             const std::vector<std::array<std::uint32_t, 2>> & facetCells,
             const SpacingWeights &                            weights,
             MeasuredCells &                                   result)
{
  const std::array<double, 3> sides = VoxelSideMeasures(weights);
  std::array<double, 8>       greatest{}; // of the sides that a cell has
  for (std::size_t have = 1; have < greatest.size(); ++have)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      greatest[have] = std::max(greatest[have], (have >> axis & 1U) != 0 ? ToMillimetres(sides[axis], weights) : 0.0);
    }
  }
  result.cell = result.sphere;
  RunInParts(notes.size() > 10000, notes.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell)
    {
      if ((notes[cell] & kCentreBeyond) != 0)
      {
        result.cell[cell] = greatest[notes[cell] % greatest.size()];
      }
    }
  });
  const auto facets = static_cast<std::ptrdiff_t>(facetCells.size());
#pragma omp parallel for schedule(static) if (facets > 10000)
  for (std::ptrdiff_t i = 0; i < facets; ++i)
  {
    for (const std::uint32_t cell : facetCells[static_cast<std::size_t>(i)])
    {
      if ((notes[cell] & kCentreBeyond) != 0)
      {
        RaiseTo(result.cell[cell], result.facet[static_cast<std::size_t>(i)]);
      }
    }
  }
}

} // namespace

MeasuredCells
MeasureCells(const VoxelShape &        shape,
             std::vector<LatticePoint> points,
             const SpacingWeights &    weights,
             DelaunayCells &           cells)
{
  if (cells.voxelSides.size() != cells.CellCount())
  {
    LeaveOutBoundary(points, weights, cells);
  }
  std::vector<std::uint8_t> notes = std::move(cells.voxelSides);
  MeasuredCells             result;
  result.polygons = FacetPolygons(std::move(cells.facetOffsets), std::move(cells.facetPoints));
  result.sphere = MeasureSpheres(points, weights, cells);
  // What is asked of points from here on their entries tell.
  std::vector<PointEntry> entries = MakeEntries(shape, points);
  RankLexicographically(shape, points, entries);
  std::vector<LatticePoint>().swap(points);
  const auto &      lower = shape.Box().lower;
  const EntryPoints places{ entries, lower };
  result.facet.resize(cells.FacetCount());
  RunInParts(cells.FacetCount() > 10000, cells.FacetCount(), [&](std::size_t first, std::size_t last) {
    std::vector<LatticePoint> polygon;
    for (std::size_t facet = first; facet < last; ++facet)
    {
      if (facet + kAhead < last) // facets of others get their ranks meanwhile
      {
        FetchFacet(cells, result.polygons, facet + kAhead, entries);
      }
      TurnToRanks(entries, lower, result.polygons[facet], polygon);
      result.facet[facet] = ToMillimetres(MeasureFacet(polygon, weights), weights);
      const Plane plane(polygon);
      for (int side = 0; side < 2; ++side)
      {
        const std::uint32_t cell = cells.facetCells[facet][static_cast<std::size_t>(side)];
        NoteCentreBeyond(notes[cell], [&] { return LiesBeyond(plane, cells, cell, side, places, weights); });
      }
    }
  });
  std::vector<std::array<std::uint32_t, 4>>().swap(cells.tetrahedra);
  result.sortedPoints = SortByRank(entries, lower);
  std::vector<PointEntry>().swap(entries);
  MeasureHulls(notes, cells.facetCells, weights, result);
  return result;
}

double
ToMillimetres(double squared, const SpacingWeights & weights)
{
  return std::sqrt(squared) * weights.unit;
}

} // namespace voxelcore
