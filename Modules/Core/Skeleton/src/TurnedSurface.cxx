#include "TurnedSurface.h"

#include "voxelcore/Base/BucketSort.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Prefetch.h"
#include "voxelcore/Complex/FaceName.h"
#include "voxelcore/Shape/BodyFrame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>

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
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  places.low.fill(most);
  places.high.fill(least);
  std::mutex guard;
  RunInParts(places.steps.size() > 10000, places.steps.size(), [&](std::size_t first, std::size_t last) {
    Steps low{ most, most, most }; // not places.low, which another part may be writing
    Steps high{ least, least, least };
    for (std::size_t vertex = first; vertex < last; ++vertex)
    {
      const Vector3 lattice = PhysicalToLattice(geometry, surface.positions[vertex]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        if (!(std::abs(lattice[axis]) < 0x1p31))
        {
          throw InputError(
            "the medial surface lies beyond 2^31 voxels from the scan's first; give the scan a nearer origin");
        }
        // Places are multiples of kPlaceStep: they are found again whatever rounding did to them, halves included,
        // which go to even steps from either side.
        const std::int64_t step =
          std::llrint(std::nearbyint(lattice[axis] / kPlaceStep) * (kPlaceStep * kStepsPerVoxel));
        places.steps[vertex][axis] = step;
        low[axis] = std::min(low[axis], step);
        high[axis] = std::max(high[axis], step);
      }
    }
    const std::scoped_lock lock(guard);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      places.low[axis] = std::min(places.low[axis], low[axis]);
      places.high[axis] = std::max(places.high[axis], high[axis]);
    }
  });
  return places;
}

std::uint64_t
Mix(std::uint64_t h, std::uint64_t value)
{
  h = (h ^ value) * 0x9E3779B97F4A7C15U;
  return h ^ (h >> 32);
}

// Names a set of vertices, in whatever order, turned in each of some ways. Turnings that begin with the same axes share
// what is computed of these.
std::vector<std::uint64_t>
NamesOf(const Places &                    places,
        const std::vector<double> &       radius,
        const std::vector<ElementIndex> & vertices,
        const std::vector<Turning> &      turnings)
{
  std::vector<std::uint64_t> names(turnings.size(), 0);
  std::mutex                 guard;
  RunInParts(vertices.size() > 10000, vertices.size(), [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> sums(turnings.size(), 0);
    for (std::size_t i = first; i < last; ++i)
    {
      const ElementIndex                          vertex = vertices[i];
      const std::uint64_t                         h = bit_cast<std::uint64_t>(radius[vertex]);
      std::array<std::uint64_t, 6>                steps; // per axis: forwards, backwards
      std::array<std::array<std::uint64_t, 6>, 6> two;   // of the first two axes
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        steps[2 * axis] = static_cast<std::uint64_t>(places.steps[vertex][axis] - places.low[axis]);
        steps[2 * axis + 1] = static_cast<std::uint64_t>(places.high[axis] - places.steps[vertex][axis]);
      }
      for (std::size_t a = 0; a < 6; ++a)
      {
        const std::uint64_t one = Mix(h, steps[a]);
        for (std::size_t b = 0; b < 6; ++b)
        {
          two[a][b] = Mix(one, steps[b]);
        }
      }
      for (std::size_t t = 0; t < turnings.size(); ++t)
      {
        const Turning & turning = turnings[t];
        const auto      way = [&](std::size_t k) { return 2 * turning.axis[k] + (turning.back[k] ? 1 : 0); };
        sums[t] += Mix(two[way(0)][way(1)], steps[way(2)]);
      }
    }
    const std::scoped_lock lock(guard);
    std::transform(names.begin(), names.end(), sums.begin(), names.begin(), std::plus());
  });
  return names;
}

// Across coarse slices first, then along long axes, then by name; what is alike in all of these is symmetric.
Turning
PickTurning(const Places & places, const std::vector<double> & radius, const Vector3 & spacing)
{
  std::array<std::size_t, 3> axes{ 0, 1, 2 };
  const auto                 key = [&](std::size_t axis) {
    const std::int64_t length = places.steps.empty() ? 0 : places.high[axis] - places.low[axis];
    return std::make_pair(spacing[axis], length / kFraction);
  };
  std::sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
  const auto           first = axes;
  std::vector<Turning> turnings;
  std::sort(axes.begin(), axes.end());
  do
  {
    const bool isFirst = key(axes[0]) == key(first[0]) && key(axes[1]) == key(first[1]);
    for (unsigned backwards = 0; isFirst && backwards < 8; ++backwards)
    {
      turnings.push_back({ axes, { (backwards & 1U) != 0, (backwards & 2U) != 0, (backwards & 4U) != 0 } });
    }
  } while (std::next_permutation(axes.begin(), axes.end()));

  // Only vertices with short binary fractions count: the others' last step may differ between two turned volumes. Balls
  // around them are as many as one needs.
  std::vector<ElementIndex> vertices;
  for (ElementIndex vertex = 0; vertex < places.steps.size(); ++vertex)
  {
    const Steps & steps = places.steps[vertex];
    if (((steps[0] | steps[1] | steps[2]) & (kFraction - 1)) == 0)
    {
      vertices.push_back(vertex);
    }
  }
  const std::vector<std::uint64_t> names = NamesOf(places, radius, vertices, turnings);
  return turnings[static_cast<std::size_t>(std::min_element(names.begin(), names.end()) - names.begin())];
}

// Side of the cells in whose order vertices come; within one they come in canonical order.
constexpr std::uint64_t kCell = static_cast<std::uint64_t>(32 * kStepsPerVoxel);

// Bits of a cell's numbers in turn.
std::uint64_t
MortonOf(const Steps & steps)
{
  std::uint64_t morton = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::uint64_t bits = (static_cast<std::uint64_t>(steps[axis]) / kCell) & 0x1FFFFFU; // 21 of them
    bits = (bits | bits << 32U) & 0x1F00000000FFFFU;
    bits = (bits | bits << 16U) & 0x1F0000FF0000FFU;
    bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
    bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
    bits = (bits | bits << 2U) & 0x1249249249249249U;
    morton |= bits << axis;
  }
  return morton;
}

// Vertices that lie near each other come near each other, so that what is computed on them is in a cache together.
std::vector<ElementIndex>
SortVertices(const Places & places, const std::vector<double> & radius, const Turning & turning)
{
  struct Place
  {
    std::uint64_t morton;
    std::uint64_t inCell; // along the first two axes
    ElementIndex  vertex;
  };
  std::vector<Place> sorted(places.steps.size());
  const auto         isLess = [&](const Place & a, const Place & b) {
    if (a.morton != b.morton)
    {
      return a.morton < b.morton;
    }
    if (a.inCell != b.inCell)
    {
      return a.inCell < b.inCell;
    }
    const Steps at = places.At(a.vertex, turning);
    const Steps bt = places.At(b.vertex, turning);
    return at != bt                               ? at < bt
                   : radius[a.vertex] != radius[b.vertex] ? radius[a.vertex] < radius[b.vertex]
                                                          : a.vertex < b.vertex;
  };
  const bool worthIt = sorted.size() > 10000;
  const auto middle = static_cast<std::ptrdiff_t>(sorted.size() / 2);
  const auto sort = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
    for (std::ptrdiff_t i = first; i < last; ++i)
    {
      const auto  vertex = static_cast<ElementIndex>(i);
      const Steps at = places.At(vertex, turning);
      const auto  inCell = [&](std::size_t axis) { return static_cast<std::uint64_t>(at[axis]) % kCell; };
      sorted[vertex] = { MortonOf(at), inCell(0) << 29U | inCell(1), vertex };
    }
    std::sort(sorted.begin() + first, sorted.begin() + last, isLess);
  };
  RunBoth(
    worthIt,
    [&] { sort(0, middle); },
    [&] { sort(middle, static_cast<std::ptrdiff_t>(sorted.size())); });
  std::inplace_merge(sorted.begin(), sorted.begin() + middle, sorted.end(), isLess);
  std::vector<ElementIndex> vertices(sorted.size());
  std::transform(sorted.begin(), sorted.end(), vertices.begin(), [](const Place & place) { return place.vertex; });
  return vertices;
}

// Corners of a face, from the smallest on towards the smaller of its two neighbours, and the edges behind each. Gives
// its entry of TurnedSurface::starts.
std::uint32_t
CopyFace(const CellComplex &               from,
         std::size_t                       face,
         const std::vector<ElementIndex> & vertexNumber,
         const std::vector<ElementIndex> & edgeNumber,
         ElementIndex *                    vertices,
         ElementIndex *                    edges)
{
  const auto        corners = from.FaceVertices(face);
  const auto        sides = from.FaceEdges(face);
  const std::size_t count = corners.size();
  const auto        corner = [&](std::size_t i) { return vertexNumber[corners[i < count ? i : i - count]]; };
  std::size_t       start = 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    start = corner(i) < corner(start) ? i : start;
  }
  const bool back = corner(start == 0 ? count - 1 : start - 1) < corner(start + 1);
  for (std::size_t i = 0; i < count; ++i)
  {
    const PlaceBefore at(i, count, start, back);
    *vertices++ = corner(at.corner);
    *edges++ = edgeNumber[sides[at.side]];
  }
  return static_cast<std::uint32_t>(2 * start + (back ? 1 : 0));
}

// Has memory fetched, step by step, for faces that are soon copied.
void
FetchFaces(const CellComplex &               from,
           const std::vector<ElementIndex> & faces,
           std::size_t                       next,
           std::size_t                       end,
           const std::vector<ElementIndex> & vertexNumber,
           const std::vector<ElementIndex> & edgeNumber)
{
  if (next + 16 < end)
  {
    FetchLine(&from.faceOffsets[faces[next + 16]]);
  }
  if (next + 10 < end)
  {
    const std::uint64_t at = from.faceOffsets[faces[next + 10]];
    FetchLine(&from.faceVertices[at]);
    FetchLine(&from.faceEdges[at]);
  }
  if (next + 5 < end)
  {
    for (const ElementIndex vertex : from.FaceVertices(faces[next + 5]))
    {
      FetchLine(&vertexNumber[vertex]);
    }
    for (const ElementIndex edge : from.FaceEdges(faces[next + 5]))
    {
      FetchLine(&edgeNumber[edge]);
    }
  }
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

} // namespace

TurnedSurface
TurnSurface(const MedialComplex & surface, const ImageGeometry & geometry)
{
  const CellComplex & cells = surface.cells;
  Places              places = FindPlaces(surface, geometry);
  const Turning       turning = PickTurning(places, surface.radius, geometry.spacing);
  TurnedSurface       turned;
  CellComplex &       to = turned.surface.cells;

  const std::size_t vertexCount = cells.vertexCount;
  const bool        worthIt = vertexCount > 10000;
  turned.vertices = SortVertices(places, surface.radius, turning);
  to.vertexCount = vertexCount;
  turned.surface.positions.resize(vertexCount);
  turned.surface.radius.resize(vertexCount);
  std::vector<ElementIndex> vertexNumber(vertexCount);
  RunInParts(worthIt, vertexCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      const ElementIndex vertex = turned.vertices[i];
      const Steps        at = places.At(vertex, turning);
      for (std::size_t k = 0; k < 3; ++k)
      {
        turned.surface.positions[i][k] =
          static_cast<double>(at[k]) / kStepsPerVoxel * geometry.spacing[turning.axis[k]];
      }
      turned.surface.radius[i] = surface.radius[vertex];
      vertexNumber[vertex] = static_cast<ElementIndex>(i);
    }
  });

  places = Places();

  const auto ends = [&](std::size_t edge) {
    const auto [a, b] = std::minmax(vertexNumber[cells.edges[edge][0]], vertexNumber[cells.edges[edge][1]]);
    return std::array{ a, b };
  };
  const auto index = [](std::size_t i) { return static_cast<ElementIndex>(i); };
  auto       start = SortIntoBuckets(
    cells.edges.size(),
    vertexCount,
    [&](std::size_t e) { return std::size_t{ ends(e)[0] }; },
    index,
    turned.edges);
  SortEachBucket(start, turned.edges, [&](ElementIndex a, ElementIndex b) { return ends(a)[1] < ends(b)[1]; });
  to.edges.resize(turned.edges.size());
  std::vector<ElementIndex> edgeNumber(turned.edges.size());
  RunInParts(worthIt, turned.edges.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      to.edges[i] = ends(turned.edges[i]);
      edgeNumber[turned.edges[i]] = static_cast<ElementIndex>(i);
    }
  });

  const std::size_t     faceCount = cells.FaceCount();
  std::vector<FaceName> names(faceCount);
  RunInParts(worthIt, faceCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t face = first; face < last; ++face)
    {
      names[face] = NameOfFace(cells, face, vertexNumber);
    }
  });
  start = SortIntoBuckets(
    faceCount,
    vertexCount,
    [&](std::size_t face) { return std::size_t{ names[face][0] }; },
    index,
    turned.faces);
  SortEachBucket(start, turned.faces, [&](ElementIndex a, ElementIndex b) { return names[a] < names[b]; });
  std::vector<FaceName>().swap(names);
  std::vector<std::uint32_t>().swap(start);
  to.faceOffsets.resize(faceCount + 1);
  for (std::size_t i = 0; i < faceCount; ++i)
  {
    to.faceOffsets[i + 1] = to.faceOffsets[i] + cells.FaceVertices(turned.faces[i]).size();
  }
  RunBoth( // new memory is cleared first
    worthIt,
    [&] { to.faceVertices.resize(cells.faceVertices.size()); },
    [&] { to.faceEdges.resize(cells.faceEdges.size()); });
  turned.starts.resize(faceCount);
  RunInParts(worthIt, faceCount, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      FetchFaces(cells, turned.faces, i, last, vertexNumber, edgeNumber);
      const std::uint64_t at = to.faceOffsets[i];
      turned.starts[i] = CopyFace(cells,
                                  turned.faces[i],
                                  vertexNumber,
                                  edgeNumber,
                                  to.faceVertices.data() + at,
                                  to.faceEdges.data() + at);
    }
  });
  return turned;
}

} // namespace voxelcore
