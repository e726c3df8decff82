#include "voxelcore/Refinement/Refinement.h"

#include "Fringe.h"
#include "KeepCovered.h"
#include "PointTree.h"
#include "RefinementState.h"
#include "TrimRims.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/VoxelCore/ToleranceWeights.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace voxelcore
{

EdgePoints
NearestToEdges(const DelaunayCells & cells)
{
  const auto forInner = [&](auto use) {
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      if (cells.facetCells[facet][1] != kOutside)
      {
        use(cells.FacetPoints(facet));
      }
    }
  };
  std::size_t count = 0;
  std::size_t points = 0;
  forInner([&](std::span<const std::uint32_t> polygon) {
    ++count;
    points += polygon.size();
  });
  if (points > std::numeric_limits<std::uint32_t>::max())
  {
    throw InputError("the core has too many edges to be refined; crop or split the shape");
  }
  EdgePoints edges;
  edges.offsets.reserve(count + 1);
  edges.points.reserve(points);
  forInner([&](std::span<const std::uint32_t> polygon) {
    edges.points.insert(edges.points.end(), polygon.begin(), polygon.end());
    edges.offsets.push_back(static_cast<std::uint32_t>(edges.points.size()));
  });
  return edges;
}

namespace
{

// Each boundary vertex has surface within half a diagonal, and the surface has a boundary vertex as near everywhere: so
// no ball that touches the surface is smaller or greater by more than that than one that touches a boundary vertex. A
// radius that is has not been measured to the nearest part of a rough surface.
// What is nearest before and after a move is told by how far it went, mostly closely enough.
void
BoundRadii(const PointTree &           boundary,
           const Vector3 &             spacing,
           const std::vector<double> & former,
           RefinedCore &               refined)
{
  MedialComplex & core = refined.core;
  const double    half = 0.5 * Length(spacing);
  const double    slack = 1e-6 * half;
  const auto      count = static_cast<std::ptrdiff_t>(core.positions.size());
#pragma omp parallel for schedule(dynamic, 256) if (count > 512)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto   vertex = static_cast<std::size_t>(i);
    const double moved = Length(Times(refined.displacement[vertex], spacing)) + slack;
    double &     radius = core.radius[vertex];
    if (std::abs(radius - former[vertex]) <= half - moved)
    {
      continue;
    }
    const double farthest = former[vertex] + moved;
    const double nearest = std::sqrt(boundary.SquaredDistance(Times(core.positions[vertex], spacing), farthest));
    radius = std::clamp(radius, nearest - half, nearest + half);
  }
}

} // namespace

std::vector<RefinedCore>
RefineCore(const RefinementInput & input, const std::vector<double> & thresholds, const ProgressCallback & progress)
{
  std::vector<RefinedCore>          refined;
  const std::vector<LiveElements>   found = input.left.empty()
                                              ? LeftToRefine(*input.core, thresholds, input.byTolerance, progress)
                                              : std::vector<LiveElements>();
  const std::vector<LiveElements> & left = input.left.empty() ? found : input.left;
  FootPointFinder                   finder(input, progress);
  const PointTree                   boundary(input.Boundary(), input.spacing);
  const std::vector<double>         weights =
    input.byTolerance && !thresholds.empty()
              ? ToleranceWeights(*input.shape, ComputeSpacingWeights(input.spacing), input.Boundary())
              : std::vector<double>();
  const auto refine = [&](RefinementState & working, double threshold, std::optional<double> height = {}) {
    finder.FindBends(working.GreatestRadii());
    working.Move(finder, threshold > 0, progress);
    FormerBalls former;
    refined.push_back(working.Finish(finder, threshold, former));
    if (height)
    {
      working.MoveRims(finder, former, refined.back());
    }
    BoundRadii(boundary, input.spacing, former.radius, refined.back());
    if (height)
    {
      const ToleranceAt tolerance(std::max(*height, 0.5 * Length(input.spacing)), weights);
      CoveredBoundary   covered = KeepBoundaryCovered(input, boundary, tolerance, former, refined.back());
      working.MeasureAgain(finder, covered.back, refined.back());
      working.GiveMeasures(refined.back().core);
      TrimRims(input, tolerance, std::move(covered), refined.back());
    }
    else if (!(threshold > 0))
    {
      working.GiveMeasures(refined.back().core);
    }
  };
  const auto end = [&] {
    if (input.onLast)
    {
      input.onLast();
    }
  };
  // The parts, of curves and small, take what they need of the core before the others are refined: so it can go early.
  std::deque<RefinementState> parts;
  for (const LiveElements & part : input.parts)
  {
    parts.emplace_back(input, PartOf(input.core->cells, part));
  }
  for (std::size_t i = 0; i < thresholds.size(); ++i)
  {
    CorePart part = PartOf(input.core->cells, left[i]);
    if (!input.byTolerance)
    {
      part = RemoveFringe(input, finder, std::move(part));
    }
    RefinementState working(input, std::move(part));
    if (i + 1 == thresholds.size())
    {
      end();
    }
    if (input.byTolerance)
    {
      refine(working, 0, thresholds[i]);
    }
    else
    {
      refine(working, thresholds[i]);
    }
  }
  if (thresholds.empty())
  {
    end();
  }
  for (; !parts.empty(); parts.pop_front())
  {
    refine(parts.front(), 0);
  }
  return refined;
}

} // namespace voxelcore
