#include "voxelcore/Verification/RefinedVerification.h"

#include "Checks.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/Verification/BettiReduction.h"
#include "voxelcore/Verification/OctantScan.h"

#include <array>
#include <cmath>
#include <string_view>

namespace voxelcore
{

namespace verification
{
namespace
{

constexpr std::array<const char *, 16> kRefinedChecks{ "arrays",
                                                       "numbers",
                                                       "edge ends",
                                                       "polygons",
                                                       "polygon edges",
                                                       "triangles",
                                                       "vertices inside",
                                                       "displacement",
                                                       "origins equidistant",
                                                       "faces not turned over",
                                                       "radius",
                                                       "measures",
                                                       "tolerances",
                                                       "coverage",
                                                       "shape Euler number",
                                                       "topology" };

Position
NormalOf(const std::array<Position, 3> & corners, const Position & spacing)
{
  Position a{};
  Position b{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    a[k] = (corners[1][k] - corners[0][k]) * spacing[k];
    b[k] = (corners[2][k] - corners[0][k]) * spacing[k];
  }
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double
DotOf(const Position & a, const Position & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** A measure is half the width between two feet, taken as the mean over an element's corners where these agree and else
 *  as the least; so none exceeds the mean distance of the farthest feet, or, where it was taken at other corners, too,
 *  twice that of any one. */
void
CheckRefinedMeasures(VerificationReport &             report,
                     const RefinedVerificationInput & input,
                     const std::vector<double> &      farthest)
{
  const CellComplex & cells = *input.cells;
  const std::size_t   edges = cells.vertexCount + cells.edges.size();
  const auto          isWrong = [&](std::size_t i) {
    if (i < cells.vertexCount)
    {
      return !(input.vertexLambda[i] <= 2 * farthest[i]);
    }
    if (i < edges)
    {
      const auto [v, w] = cells.edges[i - cells.vertexCount];
      const double measure = input.edgeLambda[i - cells.vertexCount];
      return !std::isnan(measure) && !(measure <= 2 * std::min(farthest[v], farthest[w]) &&
                                       measure <= std::min(input.vertexLambda[v], input.vertexLambda[w]));
    }
    const double measure = input.faceLambda[i - edges];
    double       sum = 0;
    for (const ElementIndex corner : cells.FaceVertices(i - edges))
    {
      sum += farthest[corner];
      if (!(measure <= input.vertexLambda[corner]))
      {
        return true;
      }
    }
    for (const ElementIndex edge : cells.FaceEdges(i - edges))
    {
      if (measure > input.edgeLambda[edge])
      {
        return true;
      }
    }
    return !(3 * measure <= sum);
  };
  AddCheck(report, "measures", edges + cells.FaceCount(), isWrong, [&](std::size_t i) {
    return (i < cells.vertexCount ? "vertex " + std::to_string(i)
            : i < edges           ? "edge " + std::to_string(i - cells.vertexCount)
                                  : "face " + std::to_string(i - edges)) +
           " has a measure greater than its place in the shape allows, or than one of what it bounds.";
  });
}

void
CheckMoves(VerificationReport &             report,
           const RefinedVerificationInput & input,
           const BoundaryTree &             tree,
           const ProgressCallback &         progress)
{
  const CellComplex & cells = *input.cells;
  // Where a vertex was is a difference of two places from a file.
  const double          tolerance = PositionRounding(input.shape->Box()) + 4 * input.positionTolerance;
  std::vector<Position> origins(input.positions.size());
  for (std::size_t v = 0; v < origins.size(); ++v)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      origins[v][k] = input.positions[v][k] - input.displacement[v][k];
    }
  }
  const auto vertexText = [&](std::size_t v) {
    return "vertex " + std::to_string(v) + " at " + Describe(input.positions[v]);
  };
  AddCheck(
    report,
    "triangles",
    cells.FaceCount(),
    [&](std::size_t face) { return cells.FaceVertices(face).size() != 3; },
    [&](std::size_t face) { return "face " + std::to_string(face) + " is no triangle."; });
  AddCheck(
    report,
    "vertices inside",
    origins.size(),
    [&](std::size_t v) { return !IsInside(*input.shape, input.positions[v], 0); },
    [&](std::size_t v) { return vertexText(v) + " is not inside the shape."; });
  const auto length = [&](std::size_t v) { return std::sqrt(DotOf(input.displacement[v], input.displacement[v])); };
  AddCheck(
    report,
    "displacement",
    origins.size(),
    [&](std::size_t v) { return !(length(v) <= 1 + tolerance); },
    [&](std::size_t v) { return vertexText(v) + " was moved by " + Describe(length(v)) + " voxels."; });
  const NearestSets sets = FindNearestSets(tree, input.weights, origins, tolerance, [&](double fraction) {
    ReportProgress(progress, "verify", 0.2 + 0.5 * fraction);
  });
  AddCheck(
    report,
    "origins equidistant",
    origins.size(),
    [&](std::size_t v) { return !sets.IsKnown(v); },
    [&](std::size_t v) { return vertexText(v) + " was moved from no vertex of the voxel core."; });
  AddCheck(
    report,
    "faces not turned over",
    cells.FaceCount(),
    [&](std::size_t face) {
      const auto corners = cells.FaceVertices(face);
      if (corners.size() != 3)
      {
        return false;
      }
      std::array<Position, 3> before{};
      std::array<Position, 3> after{};
      bool                    moved = false;
      for (std::size_t k = 0; k < 3; ++k)
      {
        before[k] = origins[corners[k]];
        after[k] = input.positions[corners[k]];
        moved = moved || length(corners[k]) > tolerance;
      }
      const Position n0 = NormalOf(before, input.spacing);
      const Position n1 = NormalOf(after, input.spacing);
      // The areas are known up to the tolerance times a side.
      const double slack = 100 * tolerance * input.weights.unit * std::sqrt(DotOf(n0, n0) + DotOf(n1, n1) + 1);
      return moved && DotOf(n0, n1) < -slack;
    },
    [&](std::size_t face) { return "face " + std::to_string(face) + " was turned over."; });
  const double half =
    0.5 * std::sqrt(DotOf(input.spacing, input.spacing)) * (1 + 1e-9) + input.positionTolerance * input.weights.unit;
  const BoundaryTree  inMillimetres(tree.Points(), input.spacing);
  std::vector<double> nearest(origins.size());
  FirstFailure        failure;
#pragma omp parallel if (nearest.size() > 4096)
  {
    std::vector<BoundaryTree::Candidate> found;
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t v = 0; v < nearest.size(); ++v)
    {
      failure.Guard(v, [&] { nearest[v] = inMillimetres.FindNearest(input.positions[v], 0, found); });
    }
  }
  failure.Rethrow();
  // A surface nearer than a billionth of a voxel is none.
  const double least = 1e-9 * half;
  AddCheck(
    report,
    "radius",
    origins.size(),
    [&](std::size_t v) { return !(input.radius[v] > least && std::abs(input.radius[v] - nearest[v]) <= half); },
    [&](std::size_t v) {
      return "the nearest boundary vertex is " + Describe(nearest[v]) + " mm from " + vertexText(v) +
             ", whose radius is " + Describe(input.radius[v]) + " mm.";
    });
  // No foot is farther from a vertex than the boundary vertex that it began at, and where the surface passes that.
  std::vector<double> farthest(origins.size());
  for (std::size_t v = 0; v < farthest.size(); ++v)
  {
    Position move = input.displacement[v];
    for (std::size_t k = 0; k < 3; ++k)
    {
      move[k] *= input.spacing[k];
    }
    farthest[v] =
      (sets.distance[v] * input.weights.unit) * (1 + kLargestDeviation) + std::sqrt(DotOf(move, move)) + 1.5 * half;
  }
  CheckRefinedMeasures(report, input, farthest);
}

} // namespace
} // namespace verification

VerificationReport
VerifyRefinedCore(const RefinedVerificationInput & input, const ProgressCallback & progress)
{
  using namespace verification;
  RequireExactRange(input.shape->Box(), input.weights);
  VerificationReport report;
  ReportProgress(progress, "verify", 0.0);
  VerificationInput plain;
  plain.shape = input.shape;
  plain.weights = input.weights;
  plain.cells = input.cells;
  plain.positions = input.positions;
  plain.radius = input.radius;
  plain.vertexLambda = input.vertexLambda;
  plain.edgeLambda = input.edgeLambda;
  plain.faceLambda = input.faceLambda;
  plain.pruningTolerance = input.pruningTolerance;
  plain.threshold = input.threshold;
  plain.vertexTolerance = input.vertexTolerance;
  plain.edgeTolerance = input.edgeTolerance;
  plain.faceTolerance = input.faceTolerance;
  OctantScan scan = ScanOctants(*input.shape);
  bool       usable = CheckArrays(report, plain) && CheckIncidences(report, *input.cells);
  if (usable && input.displacement.size() != input.positions.size())
  {
    report.checks.front() = { "arrays", false, 1, "not every vertex has a displacement." };
    usable = false;
  }
  if (usable)
  {
    const BoundaryTree tree(std::move(scan.boundary), input.weights);
    CheckMoves(report, input, tree, progress);
    ReportProgress(progress, "verify", 0.9);
    if (input.pruningTolerance)
    {
      CheckTolerances(report, { plain, *input.cells, tree, 0, {}, {} });
      std::vector<Position> moves;
      if (input.prunedOn)
      {
        moves.assign(input.displacement.begin(), input.displacement.end());
      }
      for (Position & move : moves)
      {
        move = { move[0] * input.spacing[0], move[1] * input.spacing[1], move[2] * input.spacing[2] };
      }
      CheckCoverage(report,
                    plain,
                    input.positionTolerance,
                    RefinedGapBound(*input.pruningTolerance, input.spacing, moves));
    }
    report.complexTopology = ReduceToTopologyNumbers(*input.cells);
    CheckTopology(report, *input.shape, scan.euler);
  }
  else
  {
    for (std::size_t i = report.checks.size(); i < kRefinedChecks.size(); ++i)
    {
      const std::string_view name = kRefinedChecks[i];
      const bool             isCovered = input.pruningTolerance && input.threshold.value_or(0.0) == 0;
      if ((name != "tolerances" || input.pruningTolerance) && (name != "coverage" || isCovered))
      {
        report.checks.push_back({ kRefinedChecks[i], false, 0, "Not checked: what it builds on is damaged." });
      }
    }
  }
  FinishReport(report);
  ReportProgress(progress, "verify", 1.0);
  return report;
}

} // namespace voxelcore
