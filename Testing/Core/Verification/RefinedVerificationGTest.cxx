#include "voxelcore/Verification/RefinedVerification.h"

#include "Core/Verification/VerificationFixtures.h"

#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace voxelcore::testing
{
namespace
{

/** A refined core with its shape. */
struct RefinedCase
{
  VoxelShape            shape;
  SpacingWeights        weights;
  std::array<double, 3> spacing;
  RefinedCore           refined;
};

/** An ellipsoid with a rod, pruned a little and refined. */
const RefinedCase &
GoodRefined()
{
  static const RefinedCase made = [] {
    RefinedCase one{ EllipsoidWithRod(), {}, { 0.5, 0.5, 1 }, {} };
    one.weights = ComputeSpacingWeights(one.spacing);
    const auto          points = BoundaryVertices(one.shape);
    DelaunayCells       cells = ComputeDelaunayCells(one.shape, points, one.weights, Engine::Auto);
    const EdgePoints    edgePoints = NearestToEdges(cells);
    const MedialComplex core = BuildVoxelCore(one.shape, points, std::move(cells), one.weights);
    const auto          surface = SurfaceFromLabels(one.shape, one.spacing);
    one.refined =
      std::move(RefineCore({ &one.shape, &points, &core, &edgePoints, surface.get(), one.spacing }, { 0.75 })[0]);
    return one;
  }();
  return made;
}

std::vector<std::string>
FailuresOf(const RefinedCase & subject, std::optional<double> tolerance = {}, RefinedVerificationInput input = {})
{
  input.shape = &subject.shape;
  input.weights = subject.weights;
  input.spacing = subject.spacing;
  const MedialComplex & core = subject.refined.core;
  input.cells = &core.cells;
  input.positions = core.positions;
  input.displacement = subject.refined.displacement;
  input.radius = core.radius;
  input.vertexLambda = core.vertexLambda;
  input.edgeLambda = core.edgeLambda;
  input.faceLambda = core.faceLambda;
  input.pruningTolerance = tolerance;
  input.vertexTolerance = core.tolerances.vertices;
  input.edgeTolerance = core.tolerances.edges;
  input.faceTolerance = core.tolerances.faces;
  const VerificationReport report = VerifyRefinedCore(input);
  EXPECT_EQ(report.passed, FailedChecks(report).empty());
  return FailedChecks(report);
}

/** A vertex that was moved, on a face. */
std::size_t
MovedVertex(const RefinedCore & refined)
{
  for (const ElementIndex vertex : refined.core.cells.faceVertices)
  {
    const Vector3 & moved = refined.displacement[vertex];
    if (moved[0] * moved[0] + moved[1] * moved[1] + moved[2] * moved[2] > 0.01)
    {
      return vertex;
    }
  }
  ADD_FAILURE() << "no vertex was moved";
  return 0;
}

TEST(RefinedVerification, ARefinedCorePasses)
{
  EXPECT_EQ(FailuresOf(GoodRefined()), std::vector<std::string>{});
  EXPECT_GT(GoodRefined().refined.core.cells.FaceCount(), 20U);
}

/** With a height for all elements. */
RefinedCase
WithTolerances(double height)
{
  RefinedCase         one = GoodRefined();
  const CellComplex & cells = one.refined.core.cells;
  ToleranceValues &   values = one.refined.core.tolerances;
  values.vertices.assign(cells.vertexCount, height);
  values.edges.assign(cells.edges.size(), height);
  values.faces.assign(cells.FaceCount(), height);
  return one;
}

TEST(RefinedVerification, TolerancesThatAreMissingTooLowOrFallAreSeen)
{
  const std::vector<std::string> seen{ "tolerances" };
  EXPECT_EQ(FailuresOf(GoodRefined(), 10), seen) << "there are none";
  EXPECT_EQ(FailuresOf(WithTolerances(9.9), 10), seen);
  for (auto values : { &ToleranceValues::vertices, &ToleranceValues::edges, &ToleranceValues::faces })
  {
    RefinedCase damaged = WithTolerances(11);
    for (double & value : damaged.refined.core.tolerances.*values)
    {
      value = values == &ToleranceValues::faces ? 12 : 9;
    }
    EXPECT_EQ(FailuresOf(damaged, 10), seen);
  }
}

TEST(RefinedVerification, AToleranceThatTheBallsDoNotKeepIsSeen)
{
  const RefinedCase good = WithTolerances(10);
  EXPECT_EQ(FailuresOf(good, 10), std::vector<std::string>{});
  RefinedCase shrunk = good;
  for (std::size_t v = 0; v < shrunk.refined.core.radius.size(); ++v)
  {
    shrunk.refined.core.radius[v] *= v % 2 == 0 ? 1 : 0.01; // which the check of radii sees, too
  }
  EXPECT_EQ(FailuresOf(good, -10), std::vector<std::string>{ "coverage" });
  const auto failed = FailuresOf(shrunk, 0.0);
  EXPECT_NE(std::find(failed.begin(), failed.end(), "radius"), failed.end());
}

/** Lets a vertex come from beyond the opposite side of its first face. */
void
MirrorOrigin(RefinedCore & refined, std::size_t vertex)
{
  const CellComplex & cells = refined.core.cells;
  const auto          place = std::find(cells.faceVertices.begin(), cells.faceVertices.end(), vertex);
  const auto          corners = cells.FaceVertices(static_cast<std::size_t>(place - cells.faceVertices.begin()) / 3);
  for (std::size_t k = 0; k < 3; ++k)
  {
    refined.displacement[vertex][k] = 3 * refined.core.positions[vertex][k];
    for (const ElementIndex corner : corners)
    {
      refined.displacement[vertex][k] -= refined.core.positions[corner][k];
    }
  }
}

/** A face of four corners around the first edge that joins two triangles. */
void
AddQuadrangle(MedialComplex & core)
{
  CellComplex &                       cells = core.cells;
  std::map<ElementIndex, std::size_t> before; // place of an edge in faceEdges
  const auto next = [](std::size_t place, std::size_t steps) { return place - place % 3 + (place + steps) % 3; };
  for (std::size_t place = 0; place < cells.faceEdges.size(); ++place)
  {
    const auto [other, isNew] = before.emplace(cells.faceEdges[place], place);
    const std::size_t first = other->second;
    if (!isNew && cells.faceVertices[first] == cells.faceVertices[next(place, 1)])
    {
      for (const std::size_t corner : { next(first, 1), next(first, 2), next(place, 1), next(place, 2) })
      {
        cells.faceVertices.push_back(cells.faceVertices[corner]);
        cells.faceEdges.push_back(cells.faceEdges[corner]);
      }
      cells.faceOffsets.push_back(cells.faceVertices.size());
      core.faceLambda.push_back(0);
      return;
    }
  }
  ADD_FAILURE() << "no two triangles meet";
}

TEST(RefinedVerification, EachDamageIsSeenByTheCheckOfItsName)
{
  struct Damage
  {
    const char *                                       check;
    std::function<void(RefinedCore &, std::size_t at)> apply;
  };
  const Damage damages[] = {
    { "arrays", [](RefinedCore & r, std::size_t) { r.displacement.pop_back(); } },
    { "numbers",
      [](RefinedCore & r, std::size_t at) { r.core.radius[at] = std::numeric_limits<double>::quiet_NaN(); } },
    { "vertices inside",
      [](RefinedCore & r, std::size_t at) {
        r.core.positions[at][0] += 1000;
        r.displacement[at][0] += 1000;
      } },
    { "displacement",
      [](RefinedCore & r, std::size_t at) {
        r.core.positions[at][1] += 2;
        r.displacement[at][1] += 2;
      } },
    { "origins equidistant", [](RefinedCore & r, std::size_t at) { r.core.positions[at][2] += 0.001; } },
    { "radius", [](RefinedCore & r, std::size_t at) { r.core.radius[at] += 1.5; } },
    { "radius", [](RefinedCore & r, std::size_t at) { r.core.radius[at] = 0; } },
    { "measures", [](RefinedCore & r, std::size_t at) { r.core.vertexLambda[at] *= 100; } },
    { "measures", [](RefinedCore & r, std::size_t) { r.core.faceLambda[0] *= 1.5; } },
    { "measures",
      [](RefinedCore & r, std::size_t) { r.core.edgeLambda[r.core.cells.faceEdges[0]] = 0.9 * r.core.faceLambda[0]; } },
    { "measures", [](RefinedCore & r, std::size_t) { r.core.edgeLambda[r.core.cells.faceEdges[0]] = 1000; } },
    { "faces not turned over", MirrorOrigin },
    { "triangles", [](RefinedCore & r, std::size_t) { AddQuadrangle(r.core); } },
    { "topology",
      [](RefinedCore & r, std::size_t) {
        CellComplex &cells = r.core.cells;
        cells.faceOffsets.pop_back();
        cells.faceVertices.resize(cells.faceOffsets.back());
        cells.faceEdges.resize(cells.faceOffsets.back());
        r.core.faceLambda.pop_back();
      } },
  };
  for (const Damage & damage : damages)
  {
    RefinedCase damaged = GoodRefined();
    damage.apply(damaged.refined, MovedVertex(damaged.refined));
    const auto failures = FailuresOf(damaged);
    EXPECT_TRUE(std::find(failures.begin(), failures.end(), damage.check) != failures.end()) << damage.check;
  }
}

TEST(RefinedVerification, WhatCannotBeCheckedIsNamedAsFailed)
{
  RefinedCase damaged = WithTolerances(11);
  damaged.refined.displacement.pop_back();
  const auto names = [&](std::optional<double> tolerance, std::optional<double> threshold) {
    RefinedVerificationInput input;
    input.threshold = threshold;
    const auto failures = FailuresOf(damaged, tolerance, input);
    return std::set<std::string>(failures.begin(), failures.end());
  };
  const auto all = names(10, {});
  EXPECT_TRUE(all.count("topology") == 1 && all.count("tolerances") == 1 && all.count("coverage") == 1);
  const auto pruned = names(10, 1);
  EXPECT_TRUE(pruned.count("tolerances") == 1 && pruned.count("coverage") == 0);
  const auto without = names({}, {});
  EXPECT_TRUE(without.count("topology") == 1 && without.count("tolerances") == 0 && without.count("coverage") == 0);
}

TEST(RefinedVerification, PrunedOnTheMovesCountForTheBoundary)
{
  RefinedVerificationInput input;
  input.prunedOn = true;
  EXPECT_EQ(FailuresOf(WithTolerances(10), 10, input), std::vector<std::string>{});
}

TEST(RefinedVerification, TheCoreOfAnotherShapeFails)
{
  RefinedCase other = GoodRefined();
  const auto  box = other.shape.Box();
  other.shape.Insert(box.lower[0], box.lower[1], box.lower[2]);
  const auto failures = FailuresOf(other);
  EXPECT_TRUE(std::find(failures.begin(), failures.end(), "topology") != failures.end());
}

TEST(RefinedVerification, StopsWhenAsked)
{
  const RefinedCase &      good = GoodRefined();
  RefinedVerificationInput input;
  input.shape = &good.shape;
  input.weights = good.weights;
  input.cells = &good.refined.core.cells;
  EXPECT_THROW(VerifyRefinedCore(input, [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
