#include "TurnedSurface.h"

#include "voxelcore/BucketSort.h"
#include "voxelcore/Error.h"
#include "voxelcore/FaceName.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

// Lattice coordinates in steps so fine that they tell vertices apart, and so coarse that what rounding does to a
// coordinate on its way through mm, and when a volume is turned, hardly ever shows.
constexpr double       kStepsPerVoxel = 0x1p24;
constexpr std::int64_t kFraction = std::int64_t{ 1 } << 14; // a multiple of it has a short binary fraction

using Steps = std::array<std::int64_t, 3>;

// One of the 48 ways: turned axis k is axis `axis[k]`, backwards where `back[k]`.
struct Turning
{
  std::array<std::size_t, 3> axis{};
  std::array<bool, 3>        back{};
};

// Places on the grid with their box.
struct Places
{
  std::vector<Steps> steps;
  Steps              low{};
  Steps              high{};

  Steps
  At(std::size_t vertex, const Turning & turning) const
  {
    Steps turned;
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t axis = turning.axis[k];
      turned[k] = turning.back[k] ? high[axis] - steps[vertex][axis] : steps[vertex][axis] - low[axis];
    }
    return turned;
  }
};

Places
FindPlaces(const MedialComplex & surface, const ImageGeometry & geometry)
{
  Places places;
  places.steps.resize(surface.positions.size());
  places.low.fill(std::numeric_limits<std::int64_t>::max());
  places.high.fill(std::numeric_limits<std::int64_t>::min());
  for (std::size_t vertex = 0; vertex < surface.positions.size(); ++vertex)
  {
    const Vector3 lattice = PhysicalToLattice(geometry, surface.positions[vertex]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!(std::abs(lattice[axis]) < 0x1p31))
      {
        throw InputError("the medial surface lies beyond 2^31 voxels from the scan's first");
      }
      const std::int64_t step = std::llround(lattice[axis] * kStepsPerVoxel);
      places.steps[vertex][axis] = step;
      places.low[axis] = std::min(places.low[axis], step);
      places.high[axis] = std::max(places.high[axis], step);
    }
  }
  return places;
}

std::uint64_t
Mix(std::uint64_t h, std::uint64_t value)
{
  h = (h ^ value) * 0x9E3779B97F4A7C15U;
  return h ^ (h >> 32);
}

// Names a set of vertices, in whatever order. Only those with short binary fractions count: the others' last step may
// differ between two turned volumes. Balls around them are as many as one needs.
std::uint64_t
NameOf(const Places & places, const std::vector<double> & radius, const Turning & turning)
{
  std::uint64_t name = 0;
  for (std::size_t vertex = 0; vertex < places.steps.size(); ++vertex)
  {
    const Steps & steps = places.steps[vertex];
    if (((steps[0] | steps[1] | steps[2]) & (kFraction - 1)) == 0)
    {
      std::uint64_t h = std::bit_cast<std::uint64_t>(radius[vertex]);
      for (const std::int64_t step : places.At(vertex, turning))
      {
        h = Mix(h, static_cast<std::uint64_t>(step));
      }
      name += h;
    }
  }
  return name;
}

// Across coarse slices first, then along long axes, then by name; what is alike in all of these is symmetric.
Turning
PickTurning(const Places & places, const std::vector<double> & radius, const Vector3 & spacing)
{
  std::array<std::size_t, 3> axes{ 0, 1, 2 };
  const auto                 key = [&](std::size_t axis) {
    return std::make_pair(spacing[axis], (places.high[axis] - places.low[axis]) / kFraction);
  };
  std::sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
  const auto    first = axes;
  Turning       best;
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::sort(axes.begin(), axes.end());
  do
  {
    const bool isFirst = key(axes[0]) == key(first[0]) && key(axes[1]) == key(first[1]);
    for (unsigned backwards = 0; isFirst && backwards < 8; ++backwards)
    {
      const Turning       turning{ axes, { (backwards & 1U) != 0, (backwards & 2U) != 0, (backwards & 4U) != 0 } };
      const std::uint64_t name = NameOf(places, radius, turning);
      if (name <= least)
      {
        least = name;
        best = turning;
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return best;
}

// Corners of a face, from the smallest on towards the smaller of its two neighbours, and the edges behind each.
void
CopyFace(const CellComplex &               from,
         std::size_t                       face,
         const std::vector<ElementIndex> & vertexNumber,
         const std::vector<ElementIndex> & edgeNumber,
         CellComplex &                     to)
{
  const auto        corners = from.FaceVertices(face);
  const auto        sides = from.FaceEdges(face);
  const std::size_t count = corners.size();
  const auto        corner = [&](std::size_t i) { return vertexNumber[corners[i % count]]; };
  std::size_t       start = 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    start = corner(i) < corner(start) ? i : start;
  }
  const bool back = corner(start + count - 1) < corner(start + 1);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t at = back ? start + count - i : start + i;
    to.faceVertices.push_back(corner(at));
    to.faceEdges.push_back(edgeNumber[sides[(back ? at + count - 1 : at) % count]]);
  }
  to.faceOffsets.push_back(to.faceVertices.size());
}

FaceName
NameOfFace(const CellComplex & cells, std::size_t face, const std::vector<ElementIndex> & number)
{
  FaceName name = kNoCorners;
  for (const ElementIndex vertex : cells.FaceVertices(face))
  {
    OfferCorner(name, number[vertex]);
  }
  return name;
}

std::vector<ElementIndex>
Inverse(const std::vector<ElementIndex> & order)
{
  std::vector<ElementIndex> inverse(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    inverse[order[i]] = static_cast<ElementIndex>(i);
  }
  return inverse;
}

} // namespace

TurnedSurface
TurnSurface(const MedialComplex & surface, const ImageGeometry & geometry)
{
  const CellComplex & cells = surface.cells;
  const Places        places = FindPlaces(surface, geometry);
  const Turning       turning = PickTurning(places, surface.radius, geometry.spacing);
  TurnedSurface       turned;
  CellComplex &       to = turned.surface.cells;

  std::vector<Steps> at(cells.vertexCount);
  for (std::size_t vertex = 0; vertex < at.size(); ++vertex)
  {
    at[vertex] = places.At(vertex, turning);
  }
  turned.vertices.resize(cells.vertexCount);
  std::iota(turned.vertices.begin(), turned.vertices.end(), ElementIndex{ 0 });
  std::sort(turned.vertices.begin(), turned.vertices.end(), [&](ElementIndex a, ElementIndex b) {
    return at[a] != at[b]                           ? at[a] < at[b]
           : surface.radius[a] != surface.radius[b] ? surface.radius[a] < surface.radius[b]
                                                    : a < b;
  });
  to.vertexCount = cells.vertexCount;
  for (const ElementIndex vertex : turned.vertices)
  {
    Vector3 position;
    for (std::size_t k = 0; k < 3; ++k)
    {
      position[k] = static_cast<double>(at[vertex][k]) / kStepsPerVoxel * geometry.spacing[turning.axis[k]];
    }
    turned.surface.positions.push_back(position);
    turned.surface.radius.push_back(surface.radius[vertex]);
  }
  const std::vector<ElementIndex> vertexNumber = Inverse(turned.vertices);

  const auto ends = [&](std::size_t edge) {
    const auto [a, b] = std::minmax(vertexNumber[cells.edges[edge][0]], vertexNumber[cells.edges[edge][1]]);
    return std::array{ a, b };
  };
  const auto index = [](std::size_t i) { return static_cast<ElementIndex>(i); };
  auto       start = SortIntoBuckets(
    cells.edges.size(),
    cells.vertexCount,
    [&](std::size_t e) { return std::size_t{ ends(e)[0] }; },
    index,
    turned.edges);
  SortEachBucket(start, turned.edges, [&](ElementIndex a, ElementIndex b) { return ends(a)[1] < ends(b)[1]; });
  for (const ElementIndex edge : turned.edges)
  {
    to.edges.push_back(ends(edge));
  }
  const std::vector<ElementIndex> edgeNumber = Inverse(turned.edges);

  const auto nameOf = [&](std::size_t face) { return NameOfFace(cells, face, vertexNumber); };
  start = SortIntoBuckets(
    cells.FaceCount(),
    cells.vertexCount,
    [&](std::size_t face) { return std::size_t{ nameOf(face)[0] }; },
    index,
    turned.faces);
  SortEachBucket(start, turned.faces, [&](ElementIndex a, ElementIndex b) { return nameOf(a) < nameOf(b); });
  for (const ElementIndex face : turned.faces)
  {
    CopyFace(cells, face, vertexNumber, edgeNumber, to);
  }
  return turned;
}

} // namespace voxelcore
