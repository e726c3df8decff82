#include "voxelcore/VoxelCore/TolerancePruning.h"

#include "voxelcore/Base/LengthText.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Delaunay/CanonicalCells.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "voxelcore/VoxelCore/ToleranceWeights.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

namespace voxelcore
{

namespace
{

[[noreturn]] void
RefuseHeight(std::string_view text, const char * why)
{
  throw UsageError("tolerance '" + std::string(text) + "' " + why +
                   "; write a number and mm, vox or diag, for example 1.5mm, 2vox or 1diag");
}

std::vector<std::uint8_t>
AtLeast(const std::vector<double> & values, double height)
{
  std::vector<std::uint8_t> live(values.size());
  RunInParts(values.size() > 10000, values.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      live[i] = values[i] >= height ? 1 : 0;
    }
  });
  return live;
}

// The squared radius of each cell in lattice units. All points of a cell lie on its sphere: the first one of its first
// facet gives it.
std::vector<double>
SquaredRadii(const DelaunayCells &                      cells,
             const std::vector<LatticePoint> &          points,
             const SpacingWeights &                     weights,
             const std::vector<std::array<double, 3>> & places)
{
  std::vector<std::uint32_t> firstFacet(cells.CellCount(), 0);
  for (std::size_t facet = cells.FacetCount(); facet-- > 0;)
  {
    for (const std::uint32_t cell : cells.facetCells[facet])
    {
      if (cell != kOutside)
      {
        firstFacet[cell] = static_cast<std::uint32_t>(facet);
      }
    }
  }
  std::vector<double> squared(cells.CellCount());
  RunInParts(cells.CellCount() > 10000, cells.CellCount(), [&](std::size_t first, std::size_t last) {
    for (std::size_t cell = first; cell < last; ++cell)
    {
      const LatticePoint & p = points[cells.FacetPoints(firstFacet[cell]).front()];
      const auto &         c = places[cell];
      const double         dx = static_cast<double>(weights.weight[0]) * (c[0] - (p.x - points[0].x));
      const double         dy = static_cast<double>(weights.weight[1]) * (c[1] - (p.y - points[0].y));
      const double         dz = static_cast<double>(weights.weight[2]) * (c[2] - (p.z - points[0].z));
      squared[cell] = dx * dx + dy * dy + dz * dz;
    }
  });
  return squared;
}

// All points of a cell are corners of its facets.
void
ListTouched(const DelaunayCells & cells, TouchingBalls & balls)
{
  std::vector<std::uint32_t> firstFacet(cells.CellCount() + 1, 0);
  const auto                 forSides = [&](auto use) {
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t cell : cells.facetCells[facet])
      {
        if (cell != kOutside)
        {
          use(cell, static_cast<std::uint32_t>(facet));
        }
      }
    }
  };
  forSides([&](std::uint32_t cell, std::uint32_t) { ++firstFacet[cell + 1]; });
  std::partial_sum(firstFacet.begin(), firstFacet.end(), firstFacet.begin());
  std::vector<std::uint32_t> facets(firstFacet.back());
  forSides([&](std::uint32_t cell, std::uint32_t facet) { facets[firstFacet[cell]++] = facet; });
  // Each begins now where the next one did.
  const auto forCells = [&](auto use) {
    RunInParts(cells.CellCount() > 10000, cells.CellCount(), [&](std::size_t first, std::size_t last) {
      std::vector<std::uint32_t> corners;
      for (std::size_t cell = first; cell < last; ++cell)
      {
        corners.clear();
        for (std::uint32_t i = cell == 0 ? 0 : firstFacet[cell - 1]; i < firstFacet[cell]; ++i)
        {
          const auto points = cells.FacetPoints(facets[i]);
          corners.insert(corners.end(), points.begin(), points.end());
        }
        ranges::sort(corners);
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        use(cell, corners);
      }
    });
  };
  balls.offsets.assign(cells.CellCount() + 1, 0);
  forCells([&](std::size_t cell, const std::vector<std::uint32_t> & corners) {
    balls.offsets[cell + 1] = static_cast<std::uint32_t>(corners.size());
  });
  std::partial_sum(balls.offsets.begin(), balls.offsets.end(), balls.offsets.begin());
  balls.touched.resize(balls.offsets.back());
  forCells([&](std::size_t cell, const std::vector<std::uint32_t> & corners) {
    ranges::copy(corners, balls.touched.begin() + balls.offsets[cell]);
  });
}

} // namespace

Tolerance
ParseTolerance(std::string_view text)
{
  const LengthText length = ReadLength(text, [&](const char * why) { RefuseHeight(text, why); });
  Tolerance        height;
  height.value = std::abs(length.value);
  height.text = length.text;
  const std::string & unit = length.unit;
  if (unit.empty() || unit == "mm")
  {
    height.unit = Tolerance::Unit::Millimetre;
  }
  else if (unit == "vox")
  {
    height.unit = Tolerance::Unit::Voxel;
  }
  else if (unit == "diag")
  {
    height.unit = Tolerance::Unit::Diagonal;
  }
  else
  {
    RefuseHeight(text, "has an unknown unit");
  }
  return height;
}

void
RequireLengthIn(SpatialUnit unit, const Tolerance & height)
{
  if (unit == SpatialUnit::Voxels && height.unit == Tolerance::Unit::Millimetre && height.value != 0)
  {
    RefuseMillimetres(height.text);
  }
}

double
ToleranceInMillimetres(const Tolerance & height, const std::array<double, 3> & spacing)
{
  switch (height.unit)
  {
    case Tolerance::Unit::Millimetre:
      return height.value;
    case Tolerance::Unit::Voxel:
      return height.value * std::min({ spacing[0], spacing[1], spacing[2] });
    case Tolerance::Unit::Diagonal:
      break;
  }
  return height.value * std::sqrt(spacing[0] * spacing[0] + spacing[1] * spacing[1] + spacing[2] * spacing[2]);
}

TouchingBalls
LargestTouchingBalls(const VoxelShape &                shape,
                     const DelaunayCells &             cells,
                     const std::vector<LatticePoint> & points,
                     const SpacingWeights &            weights)
{
  const auto    cellCount = static_cast<std::int64_t>(cells.CellCount());
  TouchingBalls balls{ std::vector<ElementIndex>(points.size(), kOutside),
                       std::vector<std::array<double, 3>>(cells.CellCount()),
                       ToleranceWeights(shape, weights, points),
                       {},
                       {} };
#pragma omp parallel for schedule(static) if (cellCount > 10000)
  for (std::int64_t cell = 0; cell < cellCount; ++cell)
  {
    std::array<LatticePoint, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i)
    {
      const LatticePoint & p = points[cells.tetrahedra[static_cast<std::size_t>(cell)][i]];
      corners[i] = { p.x - points[0].x, p.y - points[0].y, p.z - points[0].z };
    }
    balls.places[static_cast<std::size_t>(cell)] = CentreOfCorners(corners, weights).centre;
  }
  const std::vector<double> squared = SquaredRadii(cells, points, weights, balls.places);
  const auto                isLarger = [&](ElementIndex cell, ElementIndex than) {
    return than == kOutside || squared[cell] > squared[than] || (squared[cell] == squared[than] && cell < than);
  };
  const auto offer = [&](ElementIndex cell, std::uint32_t point) {
    const atomic_ref largest(balls.largest[point]); // what is largest does not depend on who comes first
    ElementIndex     old = largest.load(std::memory_order_relaxed);
    while (isLarger(cell, old) && !largest.compare_exchange_weak(old, cell, std::memory_order_relaxed))
    {}
  };
  RunInParts(cells.FacetCount() > 10000, cells.FacetCount(), [&](std::size_t first, std::size_t last) {
    for (std::size_t facet = first; facet < last; ++facet)
    {
      // Of its two balls the larger one is enough.
      const auto [one, other] = cells.facetCells[facet];
      const ElementIndex larger = other == kOutside || isLarger(one, other) ? one : other;
      ranges::for_each(cells.FacetPoints(facet), [&](std::uint32_t point) { offer(larger, point); });
    }
  });
  if (!balls.weights.empty())
  {
    ListTouched(cells, balls);
  }
  return balls;
}

double
GreatestTolerance(const MedialComplex & core)
{
  const auto & values = core.tolerances.vertices;
  return values.empty() ? 0 : *ranges::max_element(values);
}

void
RaiseTolerances(ToleranceValues & values, double height)
{
  for (auto * one : { &values.vertices, &values.edges, &values.faces })
  {
    std::transform(one->begin(), one->end(), one->begin(), [&](double value) { return std::max(value, height); });
  }
}

LiveElements
LeftByTolerance(const MedialComplex & core, double height)
{
  const ToleranceValues & values = core.tolerances;
  height = std::min(height, GreatestTolerance(core));
  return { AtLeast(values.vertices, height), AtLeast(values.edges, height), AtLeast(values.faces, height) };
}

MedialComplex
PruneByTolerance(const MedialComplex & core, double height)
{
  std::vector<ElementIndex> vertices;
  return PruneByTolerance(core, height, vertices);
}

MedialComplex
PruneByTolerance(const MedialComplex & core, double height, std::vector<ElementIndex> & vertices)
{
  PartElements  elements;
  MedialComplex left = ExtractPart(core, LeftByTolerance(core, height), elements);
  vertices = std::move(elements.vertices);
  RaiseTolerances(left.tolerances, height);
  return left;
}

} // namespace voxelcore
