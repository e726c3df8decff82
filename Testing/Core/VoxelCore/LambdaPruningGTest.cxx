#include "voxelcore/VoxelCore/LambdaPruning.h"

#include "VoxelCoreTesting/Cores.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

namespace voxelcore
{
namespace
{

using testing::CoreOf;
using testing::ExpectSameCore;
using testing::Spacing3;

// A free element and its only coface, both below lambda, by looking at all of them; empty when there is none.
std::string
SimplePairBelow(const MedialComplex & core, double lambda)
{
  std::vector<std::vector<std::size_t>> edgesAt(core.cells.vertexCount);
  std::vector<std::vector<std::size_t>> facesAt(core.cells.edges.size());
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    edgesAt[core.cells.edges[edge][0]].push_back(edge);
    edgesAt[core.cells.edges[edge][1]].push_back(edge);
  }
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : core.cells.FaceEdges(face))
    {
      facesAt[edge].push_back(face);
    }
  }
  for (std::size_t edge = 0; edge < facesAt.size(); ++edge)
  {
    if (facesAt[edge].size() == 1 && core.edgeLambda[edge] < lambda && core.faceLambda[facesAt[edge][0]] < lambda)
    {
      return "edge " + std::to_string(edge) + " and its face";
    }
  }
  for (std::size_t vertex = 0; vertex < edgesAt.size(); ++vertex)
  {
    if (edgesAt[vertex].size() == 1 && core.vertexLambda[vertex] < lambda &&
        core.edgeLambda[edgesAt[vertex][0]] < lambda)
    {
      return "vertex " + std::to_string(vertex) + " and its edge";
    }
  }
  return {};
}

// Elements by the places of their corners, so that those of a part can be found in the whole.
using Places = std::vector<std::array<double, 3>>;

struct Elements
{
  std::map<Places, double> vertices, edges, faces;
};

Elements
ElementsOf(const MedialComplex & core)
{
  Elements   elements;
  const auto places = [&](auto indices) {
    Places result;
    for (const ElementIndex index : indices)
    {
      result.push_back(core.positions[index]);
    }
    return result;
  };
  for (ElementIndex vertex = 0; vertex < core.cells.vertexCount; ++vertex)
  {
    elements.vertices[places(std::array<ElementIndex, 1>{ vertex })] = core.vertexLambda[vertex];
  }
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    elements.edges[places(core.cells.edges[edge])] = core.edgeLambda[edge];
  }
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    elements.faces[places(core.cells.FaceVertices(face))] = core.faceLambda[face];
  }
  return elements;
}

// `part` holds nothing but elements of `whole`, and all of those with a measure of at least lambda.
void
ExpectLambdaSubset(const std::map<Places, double> & whole, const std::map<Places, double> & part, double lambda)
{
  for (const auto & [places, measure] : part)
  {
    const auto found = whole.find(places);
    ASSERT_TRUE(found != whole.end() && found->second == measure) << "an element that was not there before";
  }
  for (const auto & [places, measure] : whole)
  {
    ASSERT_TRUE(measure < lambda || part.contains(places)) << "an element of measure " << measure << " is gone";
  }
}

// Thresholds that fall on measures as well as between them.
std::vector<double>
Thresholds(const MedialComplex & core, testing::Random & random)
{
  std::vector<double> thresholds{ 0 };
  for (int i = 0; i < 4 && !core.edgeLambda.empty(); ++i)
  {
    const auto at = static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(core.edgeLambda.size()) - 1));
    thresholds.push_back(core.edgeLambda[at] * (i % 2 == 0 ? 1.0 : 1.01));
  }
  std::sort(thresholds.begin(), thresholds.end());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  return thresholds;
}

TEST(LambdaPruning, ToZeroLeavesTheWholeCore)
{
  for (const auto & volume : testing::RandomVolumes(300, 20))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCore(PruneByLambda(core, { 0.0 }).front(), core));
  }
}

TEST(LambdaPruning, OfNothingIsNothing)
{
  const auto pruned = PruneByLambda(MedialComplex{}, { 0.0, 1.0 });
  ASSERT_EQ(pruned.size(), 2U);
  EXPECT_EQ(pruned[1].cells.vertexCount, 0U);
}

TEST(LambdaPruning, KeepsWhatMeasuresLambdaAndLeavesNoSimplePairBelow)
{
  for (const auto & volume : testing::RandomVolumes(400, 120))
  {
    SCOPED_TRACE(volume.Describe());
    testing::Random     random(volume.seed);
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    const Elements      whole = ElementsOf(core);
    const auto          thresholds = Thresholds(core, random);
    const auto          pruned = PruneByLambda(core, thresholds);
    ASSERT_EQ(pruned.size(), thresholds.size());
    for (std::size_t i = 0; i < thresholds.size(); ++i)
    {
      const Elements part = ElementsOf(pruned[i]);
      ASSERT_NO_FATAL_FAILURE(ExpectLambdaSubset(whole.vertices, part.vertices, thresholds[i]));
      ASSERT_NO_FATAL_FAILURE(ExpectLambdaSubset(whole.edges, part.edges, thresholds[i]));
      ASSERT_NO_FATAL_FAILURE(ExpectLambdaSubset(whole.faces, part.faces, thresholds[i]));
      ASSERT_EQ(SimplePairBelow(pruned[i], thresholds[i]), "") << "at " << thresholds[i];
      ASSERT_EQ(ComputeComplexTopology(pruned[i].cells), ComputeComplexTopology(core.cells));
    }
  }
}

TEST(LambdaPruning, OfACoreThatIsUsedUpIsTheSame)
{
  for (const auto & volume : testing::RandomVolumes(800, 60))
  {
    SCOPED_TRACE(volume.Describe());
    testing::Random     random(volume.seed);
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    const auto          thresholds = Thresholds(core, random);
    const auto          pruned = PruneByLambda(core, thresholds);
    const auto          inPlace = PruneByLambda(MedialComplex(core), thresholds);
    ASSERT_EQ(inPlace.size(), pruned.size());
    for (std::size_t i = 0; i < thresholds.size(); ++i)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectSameCore(inPlace[i], pruned[i])) << "at " << thresholds[i];
    }
  }
}

/** Of some 300,000 boundary vertices: so many that threads share the work. */
VoxelShape
WavySheets()
{
  constexpr std::int32_t side = 96;
  VoxelShape             shape(VoxelBox{ { 0, 0, 0 }, { side, side, side } });
  for (std::int32_t z = 0; z < side; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t x = 0; x < side; ++x)
      {
        const double wave = std::sin(0.35 * x) * std::cos(0.35 * y) + std::sin(0.35 * y) * std::cos(0.35 * z) +
                            std::sin(0.35 * z) * std::cos(0.35 * x);
        if (std::abs(wave) < 0.5)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  return shape;
}

MedialComplex
CoreToPrune(const VoxelShape & shape, const Spacing3 & spacing = { 1, 1, 1 })
{
  const SpacingWeights      weights = ComputeSpacingWeights(spacing);
  std::vector<LatticePoint> points = BoundaryVertices(shape);
  DelaunayCells             cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto, {}, Facets::Inside);
  return BuildVoxelCore(shape, std::move(points), std::move(cells), weights, CoreUse::Pruning);
}

void
ExpectSameCores(const std::vector<MedialComplex> & a, const std::vector<MedialComplex> & b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(a[i], b[i]));
  }
}

TEST(LambdaPruning, OfALargeCoreWithoutCornersIsTheSame)
{
  const VoxelShape    shape = WavySheets();
  const MedialComplex whole = CoreOf(shape);
  const MedialComplex bare = CoreToPrune(shape);
  ASSERT_FALSE(bare.cells.HasCorners());
  for (const std::vector<double> & thresholds : { std::vector<double>{ 1.5 }, std::vector<double>{ 1.0, 1.5, 2.5 } })
  {
    const std::vector<MedialComplex> expected = PruneByLambda(whole, thresholds);
    ASSERT_LT(expected.back().cells.FaceCount(), whole.cells.FaceCount());
    ASSERT_NO_FATAL_FAILURE(ExpectSameCores(PruneByLambda(MedialComplex(bare), thresholds), expected));
  }
}

TEST(LambdaPruning, OfACoreWithoutCornersIsTheSame)
{
  for (const testing::RandomVolume & volume : testing::RandomVolumes(8300, 20))
  {
    SCOPED_TRACE(volume.Describe());
    testing::Random                  random(volume.seed);
    const MedialComplex              whole = CoreOf(volume.shape, volume.spacing);
    const auto                       thresholds = Thresholds(whole, random);
    const std::vector<MedialComplex> expected = PruneByLambda(whole, thresholds);
    MedialComplex                    bare = CoreToPrune(volume.shape, volume.spacing);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCores(PruneByLambda(std::move(bare), thresholds), expected));
  }
}

TEST(LambdaPruning, OfACoreWithoutCornersInALeftHandedScanIsTheSame)
{
  const VoxelShape shape = WavySheets();
  ImageGeometry    geometry;
  geometry.size = { 96, 96, 96 };
  geometry.direction = { -1, 0, 0, 0, 1, 0, 0, 0, 1 };
  ASSERT_TRUE(IsLeftHanded(geometry));
  const MedialComplex whole = PlaceInLps(CoreOf(shape), geometry);
  MedialComplex       bare = PlaceInLps(CoreToPrune(shape), geometry);
  EXPECT_EQ(DescribeComplex(bare, {}).areaMm2, DescribeComplex(whole, {}).areaMm2);
  EXPECT_EQ(DescribeComplex(bare, {}).maxRadiusMm, DescribeComplex(whole, {}).maxRadiusMm);
  const std::vector<MedialComplex> expected = PruneByLambda(whole, { 1.5 });
  ASSERT_NO_FATAL_FAILURE(ExpectSameCores(PruneByLambda(std::move(bare), { 1.5 }), expected));
}

TEST(LambdaPruning, OnToAGreaterLambdaEqualsPruningToTheGreater)
{
  for (const auto & volume : testing::RandomVolumes(600, 120))
  {
    SCOPED_TRACE(volume.Describe());
    testing::Random     random(volume.seed);
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    const auto          thresholds = Thresholds(core, random);
    const auto          together = PruneByLambda(core, thresholds);
    for (std::size_t i = 0; i < thresholds.size(); ++i)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectSameCore(PruneByLambda(core, { thresholds[i] }).front(), together[i]));
      if (i > 0)
      {
        ASSERT_NO_FATAL_FAILURE(ExpectSameCore(PruneByLambda(together[i - 1], { thresholds[i] }).front(), together[i]));
      }
    }
  }
}

TEST(LambdaPruning, ToInfinityLeavesNoFreeElement)
{
  for (const auto & volume : testing::RandomVolumes(800, 30))
  {
    SCOPED_TRACE(volume.Describe());
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    const auto          pruned = PruneByLambda(core, { HUGE_VAL }).front();
    ASSERT_EQ(SimplePairBelow(pruned, HUGE_VAL), "");
    const TopologyNumbers numbers = ComputeComplexTopology(pruned.cells);
    ASSERT_EQ(numbers, ComputeComplexTopology(core.cells));
    if (numbers.betti[1] == 0 && numbers.betti[2] == 0)
    {
      ASSERT_LE(pruned.cells.vertexCount, core.cells.vertexCount);
    }
  }
}

TEST(LambdaPruning, CanBeCancelled)
{
  const MedialComplex core = CoreOf(testing::Ellipsoid(24));
  EXPECT_THROW(PruneByLambda(core, { 1.5, 3.0 }, [](std::string_view, double) { return false; }), Cancelled);
}

} // namespace
} // namespace voxelcore
