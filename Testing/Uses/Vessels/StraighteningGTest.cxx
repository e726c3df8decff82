#include "MeasuredGraphs.h"
#include "VesselFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Vessels/Straightening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

namespace voxelcore::testing
{

namespace
{

/** A tube around a circle, or around a helix. */
struct RoundTube
{
  std::array<Vector3, 3> turn{};
  double                 ring = 0;   ///< radius of the curve about turn[2]
  double                 rise = 0;   ///< along that, per radian; 0: it is closed
  double                 most = 0;   ///< angle at its end
  double                 radius = 0; ///< of the tube

  double
  PerAngle() const
  {
    return std::hypot(ring, rise);
  }
  Vector3
  At(double angle) const
  {
    const Vector3 out = AddScaled(AddScaled({}, ring * std::cos(angle), turn[0]), ring * std::sin(angle), turn[1]);
    return AddScaled(out, rise * (angle - 0.5 * most), turn[2]);
  }
  /** Angle of the nearest place of the curve, by a search and Newton's steps. */
  double
  Nearest(const Vector3 & place) const
  {
    double    best = 0;
    double    least = std::numeric_limits<double>::infinity();
    const int steps = static_cast<int>(8 * most);
    for (int i = 0; i <= steps; ++i)
    {
      const double distance = Distance(place, At(most * i / steps));
      if (distance < least)
      {
        least = distance;
        best = most * i / steps;
      }
    }
    const Vector3 own{ Dot(place, turn[0]), Dot(place, turn[1]), Dot(place, turn[2]) };
    for (int i = 0; i < 6; ++i)
    {
      const double slope =
        ring * (own[0] * std::sin(best) - own[1] * std::cos(best)) + rise * (rise * (best - 0.5 * most) - own[2]);
      const double bend = ring * (own[0] * std::cos(best) + own[1] * std::sin(best)) + rise * rise;
      best -= slope / bend;
    }
    return rise > 0 ? std::clamp(best, 0.0, most) : best;
  }
  double
  DistanceOf(const Vector3 & place) const
  {
    return Distance(place, At(Nearest(place)));
  }
  /** No place farther from the curve than this is looked at more closely. */
  bool
  IsNear(const Vector3 & place, double reach) const
  {
    return std::abs(std::hypot(Dot(place, turn[0]), Dot(place, turn[1])) - ring) < reach &&
           std::abs(Dot(place, turn[2])) < 0.5 * rise * most + reach;
  }
  SkeletonWay
  Way(int pieces) const
  {
    SkeletonWay way;
    for (int i = 0; i <= pieces; ++i)
    {
      way.places.push_back(At(most * (i == pieces && rise == 0 ? 0 : i) / pieces));
      way.radius.push_back(radius);
      way.branches.push_back(0);
    }
    way.isClosed = rise == 0;
    return way;
  }
};

/** A tube in a grid: its voxels, and a scan with partial volumes at its wall. */
struct ScannedTube
{
  MeasuredBody       body;
  std::vector<float> mask;
  std::vector<float> grey;
  VoxelBox           whole;
};

ScannedTube
Scan(const RoundTube & tube, const Vector3 & spacing, const Vector3 & shift)
{
  const double side = Length(spacing) / std::sqrt(3.0);
  Vector3      half{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    half[k] = tube.ring * std::hypot(tube.turn[0][k], tube.turn[1][k]) +
              0.5 * tube.rise * tube.most * std::abs(tube.turn[2][k]) + tube.radius + 2 * side;
  }
  std::vector<Vector3> corners;
  VoxelShape           shape = VoxelsAround(half, spacing, shift, [&](const Vector3 & place) {
    if (corners.empty())
    {
      corners.push_back(place); // of the first voxel
    }
    return tube.IsNear(place, tube.radius) && tube.DistanceOf(place) < tube.radius;
  });
  ImageGeometry        geometry = GridOf(shape, spacing);
  geometry.origin = corners[0]; // so that places are those of the curve
  ScannedTube scanned;
  scanned.body = MeasureBody(std::move(shape), geometry);
  for (std::size_t k = 0; k < 3; ++k)
  {
    scanned.whole.size[k] = static_cast<std::int32_t>(geometry.size[k]);
  }
  for (std::int32_t z = 0; z < scanned.whole.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < scanned.whole.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < scanned.whole.size[0]; ++x)
      {
        const Vector3 place = LatticeToPhysical(geometry, { x + .5, y + .5, z + .5 });
        const double  in = tube.IsNear(place, tube.radius + side) ? tube.radius - tube.DistanceOf(place) : -side;
        scanned.mask.push_back(scanned.body.shape.Contains(x, y, z) ? 1 : 0);
        scanned.grey.push_back(static_cast<float>(std::clamp(0.5 + in / side, 0.0, 1.0)));
      }
    }
  }
  return scanned;
}

/** A branch that goes on as two that meet again: ends 0 and 9 in x, with a long way round by y. */
SkeletonGraph
Ring()
{
  GraphOfLines graph;
  const auto   from = graph.Point({ 0, 0, 0 }, 1);
  const auto   fork = graph.Point({ 3, 0, 0 }, 1);
  const auto   meet = graph.Point({ 6, 0, 0 }, 2);
  const auto   end = graph.Point({ 9, 0, 0 }, 1);
  const auto   corner = graph.Point({ 4.5, 5, 0 }, 1);
  graph.Line(from, fork, 3);
  graph.Line(fork, meet, 3);
  graph.Line(fork, corner, 4);
  graph.Line(corner, meet, 4);
  graph.Line(meet, end, 3);
  graph.Line(graph.Point({ 0, 30, 0 }, 1), graph.Point({ 5, 30, 0 }, 1), 2);
  return graph.Measured().graph;
}

double
LengthOf(const SkeletonWay & way)
{
  double length = 0;
  for (std::size_t i = 1; i < way.places.size(); ++i)
  {
    length += Distance(way.places[i], way.places[i - 1]);
  }
  return length;
}

/** Number of the branch nearest to a place. */
ElementIndex
NearestBranch(const SkeletonGraph & graph, const Vector3 & place)
{
  ElementIndex nearest = 0;
  double       least = std::numeric_limits<double>::infinity();
  for (ElementIndex branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const ElementIndex point : graph.Branch(branch))
    {
      const double distance = Distance(graph.positions[point], place);
      if (distance < least)
      {
        least = distance;
        nearest = branch;
      }
    }
  }
  return nearest;
}

/** Straightens the scan of a random tube along its skeleton, and looks at length and radii. */
void
ExpectStraightTube(std::mt19937_64 & random, const Vector3 & spacing, bool isRing)
{
  const auto   within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const double side = Length(spacing) / std::sqrt(3.0);
  RoundTube    tube;
  tube.turn = AnyTurn(random);
  tube.radius = side * within(3.5, 5);
  // The skeleton lies up to .05 voxels to the inside.
  tube.ring = std::max(27 * side, tube.radius * within(5, 6.5));
  tube.rise = isRing ? 0 : tube.ring * within(.2, .4);
  tube.most = (isRing ? 2 : 1.5) * std::numbers::pi;
  const ScannedTube scanned = Scan(tube, spacing, { within(-.5, .5), within(-.5, .5), within(-.5, .5) });
  const std::array<ElementIndex, 1> branch{ 0 };
  ASSERT_EQ(scanned.body.graph.BranchCount(), 1U);
  const StraightAxis axis = StraightenWay(WayAlong(scanned.body.graph, branch), side, within(.3, 1.2) * side);
  PlaneGrid          grid;
  grid.spacing = { .25 * side, .25 * side };
  grid.half.fill(static_cast<std::int32_t>(std::ceil(6 * tube.radius / side)));
  std::vector<float> values(static_cast<std::size_t>(grid.Size()[0]) * static_cast<std::size_t>(grid.Size()[1]));
  const auto         radiusIn = [&](const AxisPlane & plane, const std::vector<float> & voxels, bool isLinear) {
    SamplePlane(plane, grid, { scanned.body.geometry, scanned.whole, voxels }, isLinear, 0, values);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return std::sqrt(sum * grid.spacing[0] * grid.spacing[1] / std::numbers::pi);
  };
  const double           skipped = isRing ? 0 : 2 * tube.radius; // round ends
  double                 meanOfMask = 0;
  double                 worst = 0;
  double                 trueLength = 0;
  std::vector<AxisPlane> looked;
  for (const AxisPlane & plane : axis.planes)
  {
    if (plane.arc >= skipped && plane.arc <= axis.length - skipped)
    {
      meanOfMask += radiusIn(plane, scanned.mask, false);
      worst = std::max(worst, std::abs(radiusIn(plane, scanned.grey, true) - tube.radius));
      if (!looked.empty())
      {
        const double turned = tube.Nearest(plane.place) - tube.Nearest(looked.back().place);
        trueLength += tube.PerAngle() * std::abs(std::remainder(turned, 2 * std::numbers::pi));
      }
      looked.push_back(plane);
    }
  }
  meanOfMask /= static_cast<double>(looked.size());
  const double lengthOff = (looked.back().arc - looked.front().arc) / trueLength - 1;
  std::cout << "voxels " << spacing[0] << " x " << spacing[2] << (isRing ? ", ring " : ", helix ") << tube.ring / side
            << ", tube " << tube.radius / side << ": length " << 100 * lengthOff << " %, radius of the mask "
            << (meanOfMask - tube.radius) / side << ", of single planes up to " << worst / side << " voxels off\n";
  EXPECT_LT(std::abs(lengthOff), .002);
  EXPECT_LT(std::abs(meanOfMask - tube.radius), .1 * side);
  EXPECT_LT(worst, .1 * side);
  if (isRing)
  {
    EXPECT_LT(std::abs(axis.length / (tube.most * tube.PerAngle()) - 1), .002);
  }
}

constexpr std::array<Vector3, 3> kSpacings{ Vector3{ 1, 1, 1 }, Vector3{ .4, .4, .4 }, Vector3{ .5, .5, 1 } };

} // namespace

TEST(Straightening, ARingAndAHelixBecomeStraightTubes)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  ExpectStraightTube(random, kSpacings[random() % 3], true);
  ExpectStraightTube(random, kSpacings[random() % 3], false);
}

TEST(HeavyStraightening, RingsAndHelicesBecomeStraightTubesAtThreeSpacings)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  for (int repeat = 0; repeat < 8; ++repeat)
  {
    for (const Vector3 & spacing : kSpacings)
    {
      ExpectStraightTube(random, spacing, true);
      ExpectStraightTube(random, spacing, false);
    }
  }
}

TEST(Straightening, PlanesStandAcrossAndDoNotTurnAboutTheAxis)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int repeat = 0; repeat < 4; ++repeat)
  {
    RoundTube helix;
    helix.turn = AnyTurn(random);
    helix.ring = within(20, 40);
    helix.rise = within(5, 20);
    helix.most = 4 * std::numbers::pi;
    helix.radius = 4;
    const double       step = within(.2, 5);
    const StraightAxis axis = StraightenWay(helix.Way(1500), 1, step);
    EXPECT_NEAR(axis.length, helix.most * helix.PerAngle(), .001 * axis.length);
    ASSERT_EQ(axis.planes.size(), static_cast<std::size_t>(std::floor(axis.length / step)) + 1);
    // Against the normal of the curve, which turns by its torsion, they turn back by as much.
    const double square = helix.PerAngle() * helix.PerAngle();
    double       before = 0;
    double       farthest = 0;
    for (std::size_t i = 0; i < axis.planes.size(); ++i)
    {
      const AxisPlane & plane = axis.planes[i];
      EXPECT_NEAR(Length(plane.across), 1, 1e-12);
      EXPECT_NEAR(Dot(plane.across, plane.along), 0, 1e-12);
      EXPECT_LT(Distance(plane.up, Cross(plane.along, plane.across)), 1e-12);
      const double  angle = helix.Nearest(plane.place);
      const Vector3 inward =
        Unit(Minus(AddScaled({}, Dot(helix.At(angle), helix.turn[2]), helix.turn[2]), helix.At(angle)));
      EXPECT_LT(Distance(plane.place, helix.At(angle)), .02);
      EXPECT_NEAR(plane.bend, helix.ring / square, .05 * helix.ring / square);
      const double turned =
        std::atan2(Dot(plane.across, inward), Dot(plane.up, inward)) + helix.rise / square * helix.PerAngle() * angle;
      farthest = std::max(farthest, i == 0 ? 0 : std::abs(std::remainder(turned - before, 2 * std::numbers::pi)));
      before = i == 0 ? turned : before;
    }
    EXPECT_LT(farthest, .01);
  }
}

TEST(Straightening, PlacesAreMappedThereAndBack)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  RoundTube       helix;
  helix.turn = AnyTurn(random);
  helix.ring = 30;
  helix.rise = 12;
  helix.most = 3 * std::numbers::pi;
  helix.radius = 3;
  const StraightAxis axis = StraightenWay(helix.Way(800), 1, 1.5);
  for (int repeat = 0; repeat < 200; ++repeat)
  {
    const Vector3 straight{ within(-9, 9), within(-9, 9), within(0, axis.planes.back().arc) };
    const Vector3 place = FromStraight(axis.planes, straight);
    const auto    back = ToStraight(axis.planes, place);
    ASSERT_TRUE(back);
    EXPECT_LT(Distance(*back, straight), 1e-8);
    EXPECT_NEAR(std::hypot(straight[0], straight[1]), Distance(place, helix.At(helix.Nearest(place))), .03);
    EXPECT_NEAR(straight[2], helix.PerAngle() * helix.Nearest(place), .1);
  }
  for (const AxisPlane & plane : axis.planes) // those of planes themselves, and no others
  {
    const Vector3 place = AddScaled(AddScaled(plane.place, 2, plane.across), -1, plane.up);
    EXPECT_LT(Distance(ToStraight(axis.planes, place).value(), { 2, -1, plane.arc }), 1e-8);
  }
  const std::span<const AxisPlane> few(axis.planes.data(), 9); // that no other part is beside
  EXPECT_TRUE(ToStraight(few, AddScaled(axis.planes[0].place, 1, axis.planes[0].along)));
  EXPECT_FALSE(ToStraight(few, AddScaled(axis.planes[0].place, -1, axis.planes[0].along)));
}

TEST(Straightening, WaysGoAlongBranchesInARow)
{
  const SkeletonGraph graph = Ring();
  const ElementIndex  stem = NearestBranch(graph, { 1, 0, 0 });
  const ElementIndex  direct = NearestBranch(graph, { 4, 0, 0 });
  const ElementIndex  round = NearestBranch(graph, { 4.5, 5, 0 });
  const ElementIndex  end = NearestBranch(graph, { 8, 0, 0 });
  const auto          along = [&](std::vector<ElementIndex> branches) { return WayAlong(graph, branches); };
  EXPECT_NEAR(LengthOf(along({ stem, direct, end })), 9, 1e-12);
  EXPECT_EQ(along({ stem, direct, end }).places.front(), (Vector3{ 0, 0, 0 }));
  EXPECT_EQ(along({ end, direct, stem }).places.front(), (Vector3{ 9, 0, 0 }));
  EXPECT_NEAR(LengthOf(along({ stem, round, end })), 6 + 2 * std::hypot(1.5, 5), 1e-12);
  const SkeletonWay ring = along({ direct, round });
  EXPECT_TRUE(ring.isClosed);
  EXPECT_EQ(ring.branches.front(), direct);
  EXPECT_EQ(ring.branches.back(), round);
  EXPECT_THROW(along({ stem, end }), UsageError);
  EXPECT_THROW(along({ 99 }), UsageError);
}

TEST(Straightening, WaysBetweenPointsAreTheShortest)
{
  const SkeletonGraph graph = Ring();
  const SkeletonWay   straight = WayBetween(graph, { 1.5, .5, 0 }, { 8.25, -.5, 1 });
  EXPECT_NEAR(LengthOf(straight), 6.75, 1e-12);
  EXPECT_EQ(straight.places.front(), (Vector3{ 1.5, 0, 0 }));
  EXPECT_EQ(straight.places.back(), (Vector3{ 8.25, 0, 0 }));
  EXPECT_NEAR(straight.radius.back(), 1.25, 1e-12);
  const SkeletonWay back = WayBetween(graph, { 8.25, -.5, 1 }, { 1.5, .5, 0 });
  EXPECT_EQ(back.places.front(), straight.places.back());
  EXPECT_NEAR(LengthOf(WayBetween(graph, { 1.5, 0, 0 }, { 2.5, 0, 0 })), 1, 1e-12) << "within a branch";
  // Half way round the ring and farther: back by the other side.
  const Vector3 near = AddScaled({ 3, 0, 0 }, .1, Minus({ 4.5, 5, 0 }, { 3, 0, 0 }));
  EXPECT_NEAR(LengthOf(WayBetween(graph, near, { 5.9, 0, 0 })), .1 * std::hypot(1.5, 5) + 2.9, 1e-9);
  EXPECT_NEAR(LengthOf(WayBetween(graph, { 4.5, 5, 0 }, { 8, 0, 0 })), std::hypot(1.5, 5) + 2, 1e-9);
  EXPECT_THROW(WayBetween(graph, { 1, 0, 0 }, { 2, 30, 0 }), UsageError) << "another component";
  EXPECT_THROW(WayBetween(graph, { 1, 1, 0 }, { 1, 2, 0 }), UsageError) << "one place";
}

TEST(Straightening, SamplesAreLinearOrThoseOfTheNearestVoxel)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  ImageGeometry   geometry;
  geometry.size = { 12, 9, 7 };
  geometry.spacing = { .5, .7, 1.3 };
  geometry.origin = { within(-99, 99), within(-99, 99), within(-99, 99) };
  const auto turn = AnyTurn(random);
  for (std::size_t k = 0; k < 9; ++k)
  {
    geometry.direction[k] = turn[k % 3][k / 3];
  }
  const Vector3      slope{ within(-1, 1), within(-1, 1), within(-1, 1) };
  std::vector<float> whole;
  for (int i = 0; i < 12 * 9 * 7; ++i)
  {
    const Vector3 place = LatticeToPhysical(geometry, { i % 12 + .5, i / 12 % 9 + .5, i / 108 + .5 });
    whole.push_back(static_cast<float>(Dot(slope, Minus(place, geometry.origin))));
  }
  const VoxelBox box{ { 0, 0, 0 }, { 12, 9, 7 } };
  AxisPlane      plane;
  plane.place = LatticeToPhysical(geometry, { 6.1, 4.3, 3.6 });
  const auto across = AnyTurn(random);
  plane.across = across[0];
  plane.up = across[1];
  plane.along = across[2];
  PlaneGrid grid;
  grid.half = { 9, 6 };
  grid.spacing = { .6, .9 }; // in any direction a third of it lies out of the scan
  const std::size_t  count = 19 * 13;
  std::vector<float> linear(count);
  std::vector<float> nearest(count);
  SamplePlane(plane, grid, { geometry, box, whole }, true, -77, linear);
  SamplePlane(plane, grid, { geometry, box, whole }, false, -77, nearest);
  int in = 0;
  int out = 0;
  for (int i = 0; i < static_cast<int>(count); ++i)
  {
    const Vector3 place =
      AddScaled(AddScaled(plane.place, .6 * (i % 19 - 9), plane.across), .9 * (i / 19 - 6), plane.up);
    const Vector3 lattice = PhysicalToLattice(geometry, place);
    const auto    own = static_cast<std::size_t>(i);
    bool          isIn = true;
    bool          isInMiddles = true;
    std::size_t   voxel = 0;
    for (std::size_t k = 3; k-- > 0;)
    {
      const auto size = static_cast<double>(geometry.size[k]);
      isIn = isIn && lattice[k] >= 0 && lattice[k] <= size;
      isInMiddles = isInMiddles && lattice[k] >= .5 && lattice[k] <= size - .5;
      voxel = voxel * static_cast<std::size_t>(geometry.size[k]) +
              static_cast<std::size_t>(std::clamp(std::floor(lattice[k]), 0.0, size - 1));
    }
    EXPECT_EQ(nearest[own], isIn ? whole[voxel] : -77.F);
    EXPECT_EQ(linear[own] == -77.F, !isIn);
    if (isInMiddles)
    {
      EXPECT_NEAR(linear[own], Dot(slope, Minus(place, geometry.origin)), 1e-5);
    }
    (isIn ? in : out) += 1;
  }
  EXPECT_GT(in, 20);
  EXPECT_GT(out, 20);
  // A part of the scan is enough.
  grid.half = { 2, 1 };
  const std::vector<AxisPlane> planes{ plane };
  const VoxelBox               part = VoxelsAt(planes, grid, geometry);
  ASSERT_LT(part.size[0], 12);
  std::vector<float> partly;
  for (std::int32_t z = part.lower[2]; z < part.lower[2] + part.size[2]; ++z)
  {
    for (std::int32_t y = part.lower[1]; y < part.lower[1] + part.size[1]; ++y)
    {
      for (std::int32_t x = part.lower[0]; x < part.lower[0] + part.size[0]; ++x)
      {
        partly.push_back(whole[static_cast<std::size_t>(x + 12 * (y + 9 * z))]);
      }
    }
  }
  std::vector<float> ofPart(5 * 3);
  std::vector<float> ofWhole(5 * 3);
  for (const bool isLinear : { true, false })
  {
    SamplePlane(plane, grid, { geometry, part, partly }, isLinear, -77, ofPart);
    SamplePlane(plane, grid, { geometry, box, whole }, isLinear, -77, ofWhole);
    EXPECT_EQ(ofPart, ofWhole);
  }
  AxisPlane away = plane;
  away.place = LatticeToPhysical(geometry, { 60, 4, 3 });
  EXPECT_EQ(VoxelsAt(std::vector<AxisPlane>{ away }, grid, geometry).size[0], 0);
}

} // namespace voxelcore::testing
