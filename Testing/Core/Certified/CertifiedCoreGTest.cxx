#include "CertifiedFixtures.h"
#include "VoxelCoreTesting/Messages.h"
#include "VoxelCoreTesting/Random.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <tuple>

namespace voxelcore
{
namespace
{

using testing::MessageOf;

TEST(CertifiedCore, SeveralLambdasAndPruningLaterGiveWhatEachGivesAlone)
{
  const ImageGeometry            grid = Grid({ 1, 1, 2 });
  const std::vector<std::string> texts{ "2mm", "0", "1.5vox", "1.5mm", "100mm" };
  const CertifiedResult          together = ComputeCertified(Box(9, 7, 5), grid, Lambdas(texts));
  const CertifiedResult          whole = ComputeCertified(Box(9, 7, 5), grid, Lambdas({ "0" }));
  for (std::size_t i = 0; i < texts.size(); ++i)
  {
    const CertifiedResult alone = ComputeCertified(Box(9, 7, 5), grid, Lambdas({ texts[i] }));
    const auto            later = PruneCertified(whole.cores[0], whole.shape, { ParseLambda(texts[i]) });
    for (const CertifiedCore & other : { alone.cores[0], later[0] })
    {
      EXPECT_EQ(other.core.core.positions, together.cores[i].core.core.positions) << texts[i];
      EXPECT_EQ(other.core.core.cells.faceVertices, together.cores[i].core.core.cells.faceVertices) << texts[i];
      EXPECT_EQ(other.numbers.lambdaMm, together.cores[i].numbers.lambdaMm) << texts[i];
      EXPECT_EQ(other.numbers.complex.areaMm2, together.cores[i].numbers.complex.areaMm2) << texts[i];
    }
  }
  EXPECT_EQ(together.cores[4].numbers.complex.vertices, 1U) << "all of a box prunes to a point";
}

TEST(CertifiedCore, PruningLaterByToleranceGivesWhatAskingForItGives)
{
  const ImageGeometry grid = Grid({ 1, 1, 1.5 });
  CertifiedRequest    request = Lambdas({ "0" });
  request.tolerances = { ParseTolerance("0") };
  request.surface = SurfaceSource(); // nothing is refined
  const CertifiedResult whole = ComputeCertified(Box(12, 9, 7), grid, request);
  EXPECT_EQ(whole.covered, true);
  request.tolerances = { ParseTolerance("1diag") };
  const CertifiedResult asked = ComputeCertified(Box(12, 9, 7), grid, request);
  const auto            later = PruneCertified(whole.cores[0], whole.shape, request.tolerances);
  EXPECT_EQ(later[0].core.core.positions, asked.cores[0].core.core.positions);
  EXPECT_EQ(later[0].core.core.tolerances.faces, asked.cores[0].core.core.tolerances.faces);
  EXPECT_TRUE(asked.cores[0].numbers.tolerance->boundaryGapMm.has_value());
  EXPECT_THROW(PruneCertified(asked.cores[0], asked.shape, { ParseTolerance("0.5diag") }), UsageError);
  EXPECT_THROW(PruneCertified(asked.cores[0], asked.shape, { ParseLambda("2vox") }), UsageError);
}

// So that neither colours nor a slider are stretched by it.
TEST(CertifiedCore, WhatNeverGoesHasAToleranceALittleAboveAllOthers)
{
  CertifiedRequest request = Lambdas({ "0" });
  request.tolerances = { ParseTolerance("0") };
  request.surface = SurfaceSource();
  const CertifiedResult   whole = ComputeCertified(Box(12, 9, 7), Grid({ 1, 1, 1.5 }), request);
  const ToleranceValues & values = whole.cores[0].core.core.tolerances;
  const double            never = GreatestTolerance(whole.cores[0].core.core);
  double                  last = 0;
  for (const double value : values.vertices)
  {
    last = value < never ? std::max(last, value) : last;
  }
  EXPECT_GT(last, 0);
  EXPECT_NEAR(never, 1.01 * last, 1e-12 * last);
  // Beyond it all the same is left, which then has the height it was pruned at.
  const auto atNever = PruneCertified(whole.cores[0], whole.shape, { ParseTolerance(std::to_string(never) + "mm") });
  for (const double height : { 1.5 * never, 2.0 * never })
  {
    const auto later = PruneCertified(whole.cores[0], whole.shape, { ParseTolerance(std::to_string(height) + "mm") });
    const MedialComplex & core = later[0].core.core;
    EXPECT_EQ(core.positions, atNever[0].core.core.positions);
    EXPECT_EQ(core.cells.vertexCount, 1U) << "all of a box prunes to a point";
    const double given = later[0].numbers.tolerance->heightMm;
    EXPECT_EQ(core.tolerances.vertices, std::vector<double>{ given });
    const auto again = PruneCertified(later[0], whole.shape, { ParseTolerance("100diag") });
    EXPECT_EQ(again[0].core.core.positions, core.positions);
    EXPECT_EQ(again[0].core.core.tolerances.vertices, std::vector<double>{ again[0].numbers.tolerance->heightMm });
  }
}

TEST(CertifiedCore, ACoreOfNothingIsPrunedToNothing)
{
  const CertifiedResult whole = ComputeCertified(Box(5, 4, 3), Grid({ 1, 1, 1 }), Lambdas({ "0" }));
  EXPECT_THROW(PruneCertified(whole.cores[0], whole.shape, { ParseTolerance("1diag") }), UsageError)
    << "it has no tolerances";
  const auto pruned = PruneCertified(CertifiedCore(), CertifiedShape(), { ParseTolerance("1diag") });
  ASSERT_EQ(pruned.size(), 1U);
  EXPECT_EQ(pruned[0].core.core.cells.vertexCount, 0U);
}

TEST(CertifiedCore, ACoreWithOtherNumbersThanItsShapeIsRefused)
{
  CertifiedResult result = ComputeCertified(Box(5, 4, 3), Grid({ 1, 1, 1 }), Lambdas({ "0" }));
  CertifiedCore   core = result.cores[0];
  CertifiedShape  shape = result.shape;
  shape.name = "label 4 (bone)";
  EXPECT_NO_THROW(RequireTopologyOf(shape, core));
  for (std::size_t dimension = 0; dimension < 3; ++dimension)
  {
    CertifiedShape other = shape;
    ++other.topology.betti[dimension];
    other.topology.euler += dimension == 1 ? -1 : 1;
    const auto message = MessageOf<CertificateError>([&] { RequireTopologyOf(other, core); });
    EXPECT_NE(message.find("label 4 (bone)"), std::string::npos) << message;
    // Pruning looks at what is left, whatever was said of the core before.
    CertifiedCore claimed = core;
    claimed.numbers.complex.topology = other.topology;
    EXPECT_THROW(PruneCertified(claimed, other, { ParseLambda("2vox") }), CertificateError);
  }
}

TEST(CertifiedCore, ACoreThatLostAFaceIsSeenWhenItIsPruned)
{
  // The core of a plate with a hole in the middle of it, after the fact.
  CertifiedResult result = ComputeCertified(Box(9, 9, 1), Grid({ 1, 1, 1 }), Lambdas({ "0" }));
  CertifiedCore   core = result.cores[0];
  CellComplex &   cells = core.core.core.cells;
  const auto      middle = cells.FaceCount() / 2;
  for (auto * corners : { &cells.faceVertices, &cells.faceEdges })
  {
    corners->erase(corners->begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[middle]),
                   corners->begin() + static_cast<std::ptrdiff_t>(cells.faceOffsets[middle + 1]));
  }
  const std::uint64_t size = cells.faceOffsets[middle + 1] - cells.faceOffsets[middle];
  cells.faceOffsets.erase(cells.faceOffsets.begin() + static_cast<std::ptrdiff_t>(middle));
  for (std::size_t face = middle; face < cells.faceOffsets.size(); ++face)
  {
    cells.faceOffsets[face] -= face > 0 && face >= middle && cells.faceOffsets[face] >= size ? size : 0;
  }
  auto & measures = core.core.core.faceLambda;
  measures.erase(measures.begin() + static_cast<std::ptrdiff_t>(middle));
  EXPECT_THROW(PruneCertified(core, result.shape, { ParseLambda("1.2vox") }), CertificateError);
}

TEST(CertifiedCore, WhatIsPrunedFurtherOrOtherwiseAlreadyIsNotPrunedBack)
{
  const VoxelShape      box = Box(8, 7, 6);
  const ImageGeometry   grid = Grid({ 1, 1, 1 });
  const CertifiedResult pruned = ComputeCertified(box, grid, Lambdas({ "2vox" }));
  const auto            message =
    MessageOf<UsageError>([&] { PruneCertified(pruned.cores[0], pruned.shape, { ParseLambda("1.5vox") }); });
  EXPECT_NE(message.find("pruned at 2vox already, beyond 1.5vox"), std::string::npos) << message;
  // To what it is pruned to nothing changes.
  const auto same = PruneCertified(pruned.cores[0], pruned.shape, { ParseLambda("2mm") });
  EXPECT_EQ(same[0].core.core.positions, pruned.cores[0].core.core.positions);
  EXPECT_EQ(same[0].numbers.lambda, "2mm");
  EXPECT_THROW(PruneCertified(pruned.cores[0], pruned.shape, { ParseTolerance("1diag") }), UsageError)
    << "it holds no tolerances";
}

/** A box's core, refined. */
CertifiedResult
RefinedBox(const Vector3 & spacing, const std::string & lambda, const std::vector<std::string> & tolerances = {})
{
  CertifiedRequest request = Lambdas({ lambda });
  for (const std::string & text : tolerances)
  {
    request.tolerances.push_back(ParseTolerance(text));
  }
  request.surface = [spacing](const VoxelShape & voxels, const ProgressCallback & progress) {
    return std::shared_ptr<const SurfaceEstimate>(SurfaceFromLabels(voxels, spacing, progress));
  };
  return ComputeCertified(Box(14, 11, 8), Grid(spacing), request);
}

/** Of each vertex where it was, where it is and its radius: each of `part` is one of `whole`. */
void
ExpectPlacesAmong(const PlacedCore & part, const PlacedCore & whole)
{
  const auto placesOf = [](const PlacedCore & core) {
    std::set<std::tuple<Vector3, Vector3, double, double>> places;
    for (std::size_t v = 0; v < core.core.positions.size(); ++v)
    {
      places.emplace(core.core.positions[v], core.displacement.at(v), core.core.radius[v], core.radiusMargin.at(v));
    }
    return places;
  };
  ASSERT_EQ(part.displacement.size(), part.core.positions.size());
  const auto some = placesOf(part);
  const auto all = placesOf(whole);
  EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
  EXPECT_LT(some.size(), all.size());
}

TEST(CertifiedCore, ARefinedOneIsPrunedOnByItsOwnMeasuresAndKeepsItsPlaces)
{
  const CertifiedResult refined = RefinedBox({ 1, 1, 1.5 }, "0.5vox");
  const auto pruned = PruneCertified(refined.cores[0], refined.shape, { ParseLambda("1.5vox"), ParseLambda("2vox") });
  for (const CertifiedCore & one : pruned)
  {
    ExpectPlacesAmong(one.core, refined.cores[0].core);
    EXPECT_EQ(one.numbers.complex.topology, refined.shape.topology);
    EXPECT_EQ(one.numbers.refined->maxDisplacement, refined.cores[0].numbers.refined->maxDisplacement);
    EXPECT_EQ(one.numbers.refined->radiusMargin.value().max,
              *std::max_element(one.core.radiusMargin.begin(), one.core.radiusMargin.end()));
    const auto & before = refined.cores[0].core.core.faceLambda;
    const auto   isWide = [&](double lambda) { return lambda >= one.numbers.lambdaMm; };
    EXPECT_LE(std::count_if(before.begin(), before.end(), isWide), one.core.core.cells.FaceCount())
      << "what is wide enough stays";
  }
  // On and on is as at once.
  const auto again = PruneCertified(pruned[0], refined.shape, { ParseLambda("2vox") });
  EXPECT_EQ(again[0].core.core.positions, pruned[1].core.core.positions);
  EXPECT_EQ(again[0].core.core.cells.faceVertices, pruned[1].core.core.cells.faceVertices);
  EXPECT_EQ(again[0].core.displacement, pruned[1].core.displacement);
  // To what it is pruned to nothing changes.
  const auto same = PruneCertified(refined.cores[0], refined.shape, { ParseLambda("0.5mm") });
  EXPECT_EQ(same[0].core.core.positions, refined.cores[0].core.core.positions);
  EXPECT_EQ(same[0].core.displacement, refined.cores[0].core.displacement);
}

TEST(CertifiedCore, ARefinedOnePrunedOnByToleranceHasTheCellsOfOneRefinedThere)
{
  for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 1, 1, 2.5 } })
  {
    const CertifiedResult low = RefinedBox(spacing, "0", { "0", "0.3diag" });
    const CertifiedResult high = RefinedBox(spacing, "0", { "0.8diag" });
    for (const CertifiedCore & from : low.cores)
    {
      const auto later = PruneCertified(from, low.shape, { ParseTolerance("0.8diag") });
      ExpectPlacesAmong(later[0].core, from.core);
      const MedialComplex & core = later[0].core.core;
      const MedialComplex & once = high.cores[0].core.core;
      EXPECT_EQ(core.cells.edges, once.cells.edges);
      EXPECT_EQ(core.cells.faceVertices, once.cells.faceVertices);
      EXPECT_EQ(core.tolerances.vertices, once.tolerances.vertices);
      EXPECT_EQ(core.tolerances.edges, once.tolerances.edges);
      EXPECT_EQ(core.tolerances.faces, once.tolerances.faces);
      EXPECT_GT(core.cells.FaceCount(), 10U);
    }
  }
}

TEST(CertifiedCore, WhatNeverGoesOfARefinedOneHasTheGreatestToleranceThatIsANumber)
{
  const VoxelShape ring = testing::ShapeWhere({ 40, 40, 14 }, [](int x, int y, int z) {
    const double around = std::hypot(x - 19.5, y - 19.5) - 12;
    return std::hypot(around, 1.5 * (z - 6.5)) < 6;
  });
  CertifiedRequest request;
  request.tolerances = { ParseTolerance("0.6diag") };
  const CertifiedResult refined = ComputeCertified(ring, Grid({ 1, 1, 1 }), request);
  ASSERT_TRUE(refined.cores[0].numbers.refined.has_value());
  const MedialComplex & core = refined.cores[0].core.core;
  ASSERT_EQ(refined.shape.topology.betti[1], 1) << "its loop never goes";
  const double never = GreatestTolerance(core);
  EXPECT_TRUE(std::isfinite(never));
  EXPECT_GT(std::count(core.tolerances.vertices.begin(), core.tolerances.vertices.end(), never), 10);
  EXPECT_LT(*std::min_element(core.tolerances.vertices.begin(), core.tolerances.vertices.end()), never);
}

// What was trimmed at its rims has heights of its own, of which each greater tolerance leaves what has the topology.
TEST(CertifiedCore, ARefinedOneWithTrimmedRimsKeepsItsTopologyWhenPrunedOn)
{
  testing::Random  random(11);
  const VoxelShape ellipsoid = testing::Ellipsoid(40);
  const VoxelShape rough = testing::ShapeWhere({ 40, 40, 40 }, [&](int x, int y, int z) {
    return ellipsoid.Contains(x, y, z) && (ellipsoid.Contains(x, y, z + 1) || random.Chance(0.7));
  });
  for (const VoxelShape & shape : { ellipsoid, rough })
  {
    CertifiedRequest request;
    request.tolerances = { ParseTolerance("1.2diag") };
    const CertifiedResult refined = ComputeCertified(shape, Grid({ 1, 1, 1 }), request);
    ASSERT_TRUE(refined.cores[0].numbers.refined.has_value());
    EXPECT_EQ(refined.cores[0].numbers.complex.topology, refined.shape.topology);
    std::size_t faces = refined.cores[0].core.core.cells.FaceCount();
    for (const char * height : { "1.21diag", "1.4diag", "1.7diag", "2.5diag", "8diag" })
    {
      const auto later = PruneCertified(refined.cores[0], refined.shape, { ParseTolerance(height) });
      EXPECT_EQ(later[0].numbers.complex.topology, refined.shape.topology) << height;
      EXPECT_LE(later[0].core.core.cells.FaceCount(), faces) << height;
      faces = later[0].core.core.cells.FaceCount();
    }
    EXPECT_EQ(faces, 0U);
  }
}

TEST(CertifiedCore, LengthsInMillimetresNeedAScanThatHasThem)
{
  ImageGeometry grid = Grid({ 1, 1, 1 });
  grid.unit = SpatialUnit::Voxels;
  const CertifiedResult whole = ComputeCertified(Box(5, 4, 3), grid, Lambdas({ "0" }));
  EXPECT_THROW(PruneCertified(whole.cores[0], whole.shape, { ParseLambda("2mm") }), InputError);
  EXPECT_EQ(PruneCertified(whole.cores[0], whole.shape, { ParseLambda("2vox") }).size(), 1U);
}

TEST(CertifiedCore, PruningCanBeStopped)
{
  const CertifiedResult whole = ComputeCertified(Box(9, 7, 5), Grid({ 1, 1, 1 }), Lambdas({ "0" }));
  double                last = 0;
  const auto            all = PruneCertified(whole.cores[0],
                                  whole.shape,
                                  { ParseLambda("1vox"), ParseLambda("2vox") },
                                  [&](std::string_view, double fraction) {
                                    EXPECT_GE(fraction, last);
                                    last = fraction;
                                    return true;
                                  });
  EXPECT_EQ(all.size(), 2U);
  EXPECT_THROW(PruneCertified(whole.cores[0],
                              whole.shape,
                              { ParseLambda("2vox") },
                              [](std::string_view, double) { return false; }),
               Cancelled);
}

} // namespace
} // namespace voxelcore
