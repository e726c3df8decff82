#include "Checks.h"

#include "voxelcore/Verification/BallCoverage.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::verification
{

void
CheckTolerances(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const CellComplex &       cells = subject.cells;
  if (input.vertexTolerance.size() != cells.vertexCount || input.edgeTolerance.size() != cells.edges.size() ||
      input.faceTolerance.size() != cells.FaceCount())
  {
    report.checks.push_back({ "tolerances", false, 1, "some elements have none." });
    return;
  }
  const double height = *input.pruningTolerance;
  // A comparison with what is no number fails.
  const auto isWrong = [&](double lower, double upper) { return !(lower >= height && lower <= upper); };
  const auto edgeOffends = [&](std::size_t edge) {
    return isWrong(input.edgeTolerance[edge], input.vertexTolerance[cells.edges[edge][0]]) ||
           isWrong(input.edgeTolerance[edge], input.vertexTolerance[cells.edges[edge][1]]);
  };
  const auto faceOffends = [&](std::size_t face) {
    const auto edges = cells.FaceEdges(face);
    return std::any_of(edges.begin(), edges.end(), [&](ElementIndex edge) {
      return isWrong(input.faceTolerance[face], input.edgeTolerance[edge]);
    });
  };
  AddCheck(
    report,
    "tolerances",
    cells.vertexCount + cells.edges.size() + cells.FaceCount(),
    [&](std::size_t i) {
      if (i < cells.vertexCount)
      {
        return !(input.vertexTolerance[i] >= height);
      }
      i -= cells.vertexCount;
      return i < cells.edges.size() ? edgeOffends(i) : faceOffends(i - cells.edges.size());
    },
    [&](std::size_t i) {
      const std::size_t edges = cells.vertexCount + cells.edges.size();
      return (i < cells.vertexCount ? DescribeVertex(subject, i)
              : i < edges           ? DescribeEdge(subject, i - cells.vertexCount)
                                    : DescribeFace(subject, i - edges)) +
             " has one below " + Describe(height) + " mm or above that of what it bounds.";
    });
}

void
CheckCoverage(VerificationReport &      report,
              const VerificationInput & input,
              double                    positionTolerance,
              const PromisedGap &       promised)
{
  const SpacingWeights & weights = input.weights;
  const BoundaryGaps gaps = LargestBoundaryGaps(*input.shape, weights, input.positions, input.radius, promised.beyond);
  report.boundaryGap = gaps.plain.largest;
  if (input.threshold.value_or(0.0) > 0)
  {
    return;
  }
  const auto [least, largest] = ranges::minmax(weights.weight);
  if (least != largest && promised.weighed > 0)
  {
    report.boundaryGapShare = gaps.weighed.largest / promised.weighed;
  }
  const double       slack = 4 * positionTolerance * static_cast<double>(largest) * weights.unit;
  const double       most = static_cast<double>(largest) / static_cast<double>(least); // that anything is weighed
  const bool         covered = gaps.weighed.largest <= promised.weighed * (1 + kMeasureTolerance) + most * slack;
  const LatticePoint place{ gaps.weighed.place[0], gaps.weighed.place[1], gaps.weighed.place[2] };
  report.checks.push_back(
    { "coverage",
      covered,
      covered ? 0U : 1U,
      covered ? std::string()
              : "boundary vertex " + Describe(place) + " lies " + Describe(gaps.weighed.largest + promised.beyond) +
                  (least == largest ? " mm" : " mm, weighed by direction,") + " from the nearest ball, " +
                  Describe(promised.weighed + promised.beyond) + " mm are promised." });
}

} // namespace voxelcore::verification
