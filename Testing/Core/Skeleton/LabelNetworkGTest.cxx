#include "GraphBuilder.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/LabelNetwork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace voxelcore::testing
{
namespace
{

using Place = std::array<double, 3>;

/** The voxels of a grid from (-40, -40, -10) to (40, 40, 10) whose centre is within `radius` of the segment. */
void
AddRod(VoxelShape & shape, const Place & from, const Place & to, double radius, const std::vector<VoxelShape> & taken)
{
  const Vector3 along = Minus(to, from);
  for (std::int32_t z = -10; z < 10; ++z)
  {
    for (std::int32_t y = -40; y < 40; ++y)
    {
      for (std::int32_t x = -40; x < 40; ++x)
      {
        const Vector3 off = Minus({ x + 0.5, y + 0.5, z + 0.5 }, from);
        const double  t = std::clamp(Dot(off, along) / Dot(along, along), 0.0, 1.0);
        const bool isTaken = std::ranges::any_of(taken, [&](const VoxelShape & one) { return one.Contains(x, y, z); });
        if (!isTaken && Length(AddScaled(off, -t, along)) <= radius)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
}

/** Rods as labels 1, 2, .. in lattice coordinates, which are the places of `geometry`; the first has a shared voxel. */
struct Rods
{
  void
  Add(const std::vector<std::array<Place, 2>> & rods, double radius)
  {
    std::vector<VoxelShape> taken;
    for (const LabelShape & label : labels)
    {
      taken.push_back(label.shape);
    }
    VoxelShape shape(VoxelBox{ { -40, -40, -10 }, { 80, 80, 20 } });
    for (const auto & [from, to] : rods)
    {
      AddRod(shape, from, to, radius, taken);
    }
    const auto value = static_cast<std::int64_t>(labels.size() + 1);
    labels.push_back({ value, "rod " + std::to_string(value), shape.CountVoxels(), CropToVoxels(shape) });
  }

  static ImageGeometry
  Geometry()
  {
    ImageGeometry geometry;
    geometry.origin = { 0.5, 0.5, 0.5 };
    return geometry;
  }

  std::vector<LabelShape> labels;
};

struct Counts
{
  std::int64_t components;
  std::int64_t cycles;

  explicit Counts(const SkeletonGraph & graph)
    : components(MeasureBranches(graph).numbers.components)
    , cycles(MeasureBranches(graph).numbers.cycles)
  {}
  bool
  operator==(const Counts &) const = default;
};

/** Cuts, and looks that nothing but labels came to the graph. */
SkeletonNetwork
Cut(SkeletonGraph & graph, const Rods & rods)
{
  const Counts          before(graph);
  const SkeletonNetwork network = CutAtLabels(graph, rods.labels, UnionOfLabels(rods.labels), Rods::Geometry());
  EXPECT_TRUE(Counts(graph) == before);
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const ElementIndex point : graph.Branch(branch))
    {
      EXPECT_TRUE(graph.contact[point] || graph.labels[point] == graph.BranchLabel(branch));
    }
  }
  return network;
}

double
LengthOf(const SkeletonGraph & graph, std::int64_t label)
{
  double length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLabel(branch) == label ? graph.BranchLength(branch) : 0;
  }
  return length;
}

TEST(LabelNetwork, ALineThroughTwoRodsIsCutWhereTheyTouch)
{
  Rods rods;
  rods.Add({ { Place{ -30, 0, 0 }, Place{ -2.6, 0, 0 } } }, 4);
  rods.Add({ { Place{ -2.6, 0, 0 }, Place{ 30, 0, 0 } } }, 4);
  GraphBuilder builder;
  builder.Line({ -30, 0, 0 }, { 30, 0, 0 }, 4);
  SkeletonGraph         graph = builder.Graph();
  const SkeletonNetwork network = Cut(graph, rods);
  ASSERT_EQ(graph.BranchCount(), 2U);
  ASSERT_EQ(network.contacts.size(), 1U);
  ASSERT_EQ(network.contacts[0].places.size(), 1U);
  // The first has the round end of both.
  EXPECT_NEAR(network.contacts[0].places[0][0], 0, 1.5);
  EXPECT_TRUE(network.gaps.empty());
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Contact), 1);
  EXPECT_NEAR(LengthOf(graph, 1) + LengthOf(graph, 2), 60, 1e-9);
}

TEST(LabelNetwork, RoughBordersMakeNoShortPieces)
{
  // A checkerboard of two labels in a band of four voxels between them.
  Rods rods;
  rods.Add({ { Place{ -30, 0, 0 }, Place{ 30, 0, 0 } } }, 4);
  rods.labels.push_back(rods.labels[0]);
  rods.labels[1].value = 2;
  const auto keep = [&](std::size_t label, const std::function<bool(const std::array<std::int32_t, 3> &)> & isKept) {
    VoxelShape kept(rods.labels[label].shape.Box());
    for (std::int32_t x = -40; x < 40; ++x)
    {
      for (std::int32_t y = -5; y < 5; ++y)
      {
        for (std::int32_t z = -5; z < 5; ++z)
        {
          if (rods.labels[label].shape.Contains(x, y, z) && isKept({ x, y, z }))
          {
            kept.Insert(x, y, z);
          }
        }
      }
    }
    rods.labels[label].shape = CropToVoxels(kept);
  };
  const auto isFirst = [](const std::array<std::int32_t, 3> & v) {
    return v[0] < -2 || (v[0] < 2 && (v[0] + v[1] + v[2]) % 2 == 0);
  };
  keep(0, isFirst);
  keep(1, [&](const auto & voxel) { return !isFirst(voxel); });
  GraphBuilder builder;
  builder.Line({ -30, 0, 0 }, { 30, 0, 0 }, 4);
  SkeletonGraph         graph = builder.Graph();
  const SkeletonNetwork network = Cut(graph, rods);
  EXPECT_EQ(graph.BranchCount(), 2U);
  ASSERT_EQ(network.contacts.size(), 1U);
  EXPECT_EQ(network.contacts[0].places.size(), 1U);
}

TEST(LabelNetwork, ThreeLabelsThatMeetInAForkMeetInItsJunction)
{
  // The stem's voxels reach into both arms, and these touch each other.
  Rods rods;
  rods.Add({ { Place{ 0, -30, 0 }, Place{ 0, -1, 0 } } }, 4);
  rods.Add({ { Place{ 0, 0, 0 }, Place{ -25, 25, 0 } } }, 4);
  rods.Add({ { Place{ 0, 0, 0 }, Place{ 25, 25, 0 } } }, 4);
  GraphBuilder builder;
  builder.Line({ 0, -30, 0 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 0 }, { -25, 25, 0 }, 4);
  builder.Line({ 0, 0, 0 }, { 25, 25, 0 }, 4);
  SkeletonGraph         graph = builder.Graph();
  const SkeletonNetwork network = Cut(graph, rods);
  ASSERT_EQ(network.contacts.size(), 3U);
  for (const NetworkContact & contact : network.contacts)
  {
    ASSERT_EQ(contact.places.size(), 1U) << contact.labels[0] << " " << contact.labels[1];
    EXPECT_EQ(contact.places[0], network.contacts[0].places[0]);
  }
  EXPECT_EQ(graph.BranchCount(), 3U);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Junction), 1);
}

TEST(LabelNetwork, LabelsThatRunThroughOneBodyMeetInOneNode)
{
  // Two rods that cross at a sharp angle: the graph runs through both together for a way.
  Rods rods;
  rods.Add({ { Place{ -30, -8, 0 }, Place{ 30, 8, 0 } } }, 4);
  rods.Add({ { Place{ -30, 8, 0 }, Place{ 30, -8, 0 } } }, 4);
  GraphBuilder builder;
  builder.Line({ -30, -8, 0 }, { -3, 0, 0 }, 4);
  builder.Line({ -30, 8, 0 }, { -3, 0, 0 }, 4);
  builder.Line({ -3, 0, 0 }, { 3, 0, 0 }, 4.5);
  builder.Line({ 3, 0, 0 }, { 30, 8, 0 }, 4);
  builder.Line({ 3, 0, 0 }, { 30, -8, 0 }, 4);
  SkeletonGraph         graph = builder.Graph();
  const SkeletonNetwork network = Cut(graph, rods);
  const auto            placed =
    std::ranges::count_if(network.contacts, [](const NetworkContact & contact) { return contact.places.size() == 1; });
  EXPECT_EQ(network.contacts.size(), 2U); // where the second one's body ends before and behind the first
  EXPECT_EQ(placed, 2);
}

TEST(LabelNetwork, ARingKeepsItsCycleWhereverItsLabelsMeet)
{
  for (const double turn : { 0.0, 5.0, 10.0 })
  {
    Rods        rods;
    const Place corners[4]{ { -20, -20, 0 }, { 20, -20, 0 }, { 20, 20, 0 }, { -20, 20, 0 } };
    const auto  side = [&](std::size_t i) { return std::array<Place, 2>{ corners[i % 4], corners[(i + 1) % 4] }; };
    rods.Add({ side(0), side(1), { corners[2], Place{ 20 - turn, 20, 0 } } }, 3);
    rods.Add({ side(2), side(3) }, 3);
    GraphBuilder builder;
    for (std::size_t i = 0; i < 4; ++i)
    {
      builder.Line(side(i)[0], side(i)[1], 3);
    }
    builder.Line({ 20, 20, 0 }, { 30, 30, 0 }, 3);
    SkeletonGraph         graph = builder.Graph();
    const SkeletonNetwork network = Cut(graph, rods);
    EXPECT_EQ(MeasureBranches(graph).numbers.cycles, 1) << turn;
    ASSERT_EQ(network.contacts.size(), 2U) << turn;
    for (const NetworkContact & contact : network.contacts)
    {
      EXPECT_EQ(contact.places.size(), 1U) << turn;
    }
  }
}

TEST(LabelNetwork, ASmallLabelHasAPiece)
{
  Rods rods;
  rods.Add({ { Place{ -1, 3, 0 }, Place{ 1, 3, 0 } } }, 1.5); // beside the middle of the other's line
  rods.Add({ { Place{ -30, 0, 0 }, Place{ 30, 0, 0 } } }, 5);
  GraphBuilder builder;
  builder.Line({ -30, 0, 0 }, { 30, 0, 0 }, 5);
  SkeletonGraph graph = builder.Graph();
  Cut(graph, rods);
  EXPECT_GT(LengthOf(graph, 1), 0);
  EXPECT_LT(LengthOf(graph, 1), 3);
}

TEST(LabelNetwork, LabelsThatDoNotTouchMeetInAGap)
{
  Rods rods;
  rods.Add({ { Place{ -30, 0, 0 }, Place{ -8, 0, 0 } } }, 3);
  rods.Add({ { Place{ 8, 0, 0 }, Place{ 30, 0, 0 } } }, 3);
  GraphBuilder builder;
  builder.Line({ -30, 0, 0 }, { 30, 0, 0 }, 3);
  SkeletonGraph         graph = builder.Graph();
  const SkeletonNetwork network = Cut(graph, rods);
  EXPECT_TRUE(network.contacts.empty());
  ASSERT_EQ(network.gaps.size(), 1U);
  EXPECT_EQ(network.gaps[0].labels, (std::array<std::int64_t, 2>{ 1, 2 }));
  EXPECT_NEAR(network.gaps[0].place[0], 0, 2);
}

TEST(LabelNetwork, PartsByLabelAreTheNetwork)
{
  Rods rods;
  rods.Add({ { Place{ 0, -30, 0 }, Place{ 0, -1, 0 } } }, 4);
  rods.Add({ { Place{ 0, 0, 0 }, Place{ -25, 25, 0 } } }, 4);
  rods.Add({ { Place{ 0, 0, 0 }, Place{ 25, 25, 0 } } }, 4);
  GraphBuilder builder;
  builder.Line({ 0, -30, 0 }, { 0, 0, 0 }, 4);
  builder.Line({ 0, 0, 0 }, { -25, 25, 0 }, 4);
  builder.Line({ 0, 0, 0 }, { 25, 25, 0 }, 4);
  MeasuredSkeleton skeleton;
  skeleton.graph = builder.Graph();
  skeleton.network = Cut(skeleton.graph, rods);
  skeleton.table = MeasureBranches(skeleton.graph);
  double       length = 0;
  std::int64_t tips = 0;
  for (const MeasuredSkeleton & part : PartsByLabel(skeleton))
  {
    EXPECT_EQ(part.table.numbers.branches, 1);
    length += part.table.numbers.totalLength;
    tips += part.table.numbers.tips;
  }
  EXPECT_NEAR(length, skeleton.table.numbers.totalLength, 1e-9);
  EXPECT_EQ(tips, skeleton.table.numbers.tips); // none where labels meet
}

} // namespace
} // namespace voxelcore::testing
