// Whether vertices lie inside the shape, as far from the boundary vertices as they say.
#include "Checks.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <cmath>

namespace voxelcore::verification
{

void
CheckVertices(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const std::size_t         count = subject.cells.vertexCount;
  const double              unit = input.weights.unit;
  AddCheck(
    report,
    "vertices inside",
    count,
    [&](std::size_t v) { return !IsInside(*input.shape, input.positions[v], subject.tolerance); },
    [&](std::size_t v) { return DescribeVertex(subject, v) + " is not inside the shape."; });
  AddCheck(
    report,
    "vertices equidistant",
    count,
    [&](std::size_t v) { return !subject.sets.IsKnown(v); },
    [&](std::size_t v) {
      return DescribeVertex(subject, v) +
             " is not equally far from four affinely independent nearest boundary vertices.";
    });
  // The distance of a rounded position is off by no more than the position is.
  const double reach = Reach(input.weights, subject.tolerance) * unit;
  AddCheck(
    report,
    "nothing nearer",
    count,
    [&](std::size_t v) {
      return !(subject.sets.distance[v] * unit >= input.radius[v] * (1 - kMeasureTolerance) - reach);
    },
    [&](std::size_t v) {
      return "A boundary vertex is " + Describe(subject.sets.distance[v] * unit) + " mm from " +
             DescribeVertex(subject, v) + ", whose radius is " + Describe(input.radius[v]) + " mm.";
    });
  const auto radius = [&](std::size_t v) {
    return subject.sets.IsKnown(v)
             ? Radius(CentreOf(subject.sets, subject.tree, input.weights, v), input.weights) * unit
             : subject.sets.distance[v] * unit;
  };
  AddCheck(
    report,
    "radius",
    count,
    [&](std::size_t v) { return !Agree(input.radius[v], radius(v)); },
    [&](std::size_t v) {
      return DescribeVertex(subject, v) + " has radius " + Describe(input.radius[v]) + " mm instead of " +
             Describe(radius(v)) + " mm.";
    });
}

void
CheckTrueSpacing(VerificationReport & report, const Subject & subject)
{
  const VerificationInput & input = subject.input;
  const Position &          spacing = input.spacing;
  const BoundaryTree        tree(subject.tree.Points(), spacing);
  const std::size_t         vertices = subject.cells.vertexCount;
  std::vector<double>       nearest(vertices);
  FirstFailure              failure;
#pragma omp parallel if (vertices > 4096)
  {
    std::vector<BoundaryTree::Candidate> found;
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t v = 0; v < vertices; ++v)
    {
      failure.Guard(v, [&] { nearest[v] = tree.FindNearest(input.positions[v], 0, found); });
    }
  }
  failure.Rethrow();
  // Whatever deviation the weights admit to, lengths that are off by more are wrong.
  const double relative = std::min(input.weights.deviation, kLargestDeviation) + kMeasureTolerance;
  const double reach = subject.tolerance * Length(spacing);
  const auto   measure = [&](std::size_t f) {
    const LatticePoint & a = subject.Point(subject.dualEdges[f][0]);
    const LatticePoint & b = subject.Point(subject.dualEdges[f][1]);
    return Length({ spacing[0] * (static_cast<double>(a.x) - b.x),
                    spacing[1] * (static_cast<double>(a.y) - b.y),
                    spacing[2] * (static_cast<double>(a.z) - b.z) }) /
           2;
  };
  AddCheck(
    report,
    "true spacing",
    vertices + subject.cells.FaceCount(),
    [&](std::size_t i) {
      if (i < vertices)
      {
        return !(std::abs(input.radius[i] - nearest[i]) <= relative * nearest[i] + reach);
      }
      const std::size_t f = i - vertices;
      return subject.dualEdges[f][0] != kNoPoint &&
             !(std::abs(input.faceLambda[f] - measure(f)) <= relative * measure(f));
    },
    [&](std::size_t i) {
      return i < vertices ? "Measured in mm, the nearest boundary vertex is " + Describe(nearest[i]) + " mm from " +
                              DescribeVertex(subject, i) + ", whose radius is " + Describe(input.radius[i]) + " mm."
                          : "Measured in mm, the two nearest boundary vertices of " +
                              DescribeFace(subject, i - vertices) + " are twice " + Describe(measure(i - vertices)) +
                              " mm apart, and its measure is " + Describe(input.faceLambda[i - vertices]) + " mm.";
    });
}

} // namespace voxelcore::verification
