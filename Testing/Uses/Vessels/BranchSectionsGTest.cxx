#include "VesselFixtures.h"

#include <gtest/gtest.h>

#include <iostream>
#include <numbers>
#include <omp.h>

namespace voxelcore::testing
{

namespace
{

struct EllipticTube
{
  std::array<Vector3, 3> turn{}; ///< along it, along the great and the small half axis
  double                 great = 0;
  double                 small = 0;
  double                 length = 0;
};

MeasuredBody
BodyOf(const EllipticTube & tube, const Vector3 & spacing, const Vector3 & shift)
{
  Vector3 half{};
  for (std::size_t k = 0; k < 3; ++k)
  {
    half[k] = 0.5 * tube.length * std::abs(tube.turn[0][k]) + tube.great;
  }
  VoxelShape          shape = VoxelsAround(half, spacing, shift, [&](const Vector3 & p) {
    const double great = Dot(p, tube.turn[1]) / tube.great;
    const double small = Dot(p, tube.turn[2]) / tube.small;
    return std::abs(Dot(p, tube.turn[0])) <= 0.5 * tube.length && great * great + small * small <= 1;
  });
  const ImageGeometry geometry = GridOf(shape, spacing);
  return MeasureBody(std::move(shape), geometry);
}

} // namespace

TEST(BranchSections, OfEllipsesHaveTheirAreaAndDiametersInAnyDirection)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  constexpr int   bodies = 8;
  double          meanLeast = 0;
  double          meanGreatest = 0;
  for (int body = 0; body < bodies; ++body)
  {
    EllipticTube tube;
    tube.turn = AnyTurn(random);
    tube.small = within(4, 7);
    tube.great = tube.small * within(1, 3);
    tube.length = 2 * tube.great + 40;
    const MeasuredBody measured = BodyOf(tube, { 1, 1, 1 }, { within(-.5, .5), within(-.5, .5), within(-.5, .5) });
    const double       area = std::numbers::pi * tube.great * tube.small;
    double             areaOff = 0;
    double             leastOff = 0;
    double             greatestOff = 0;
    double             count = 0;
    for (const BranchSection & section : measured.Sections(1.0))
    {
      // Away from the ends, which are flat.
      if (std::min(section.arc, measured.graph.BranchLength(section.branch) - section.arc) > tube.great)
      {
        areaOff += std::abs(section.area / area - 1);
        leastOff += std::abs(section.leastDiameter - 2 * tube.small);
        greatestOff += std::abs(section.greatestDiameter - 2 * tube.great);
        count += 1;
        if (tube.great > 1.3 * tube.small)
        {
          EXPECT_GT(std::abs(Dot(section.greatestWay, tube.turn[1])), 0.87);
          EXPECT_GT(std::abs(Dot(section.leastWay, tube.turn[2])), 0.87);
        }
        EXPECT_NEAR(section.EquivalentDiameter(), std::sqrt(4 * section.area / std::numbers::pi), 1e-9);
        EXPECT_LT(section.Circularity(), 1);
      }
    }
    ASSERT_GT(count, 7);
    // Along the grid all slices have the same steps; then nothing tells where between them the side is.
    EXPECT_LT(areaOff / count, 0.025) << tube.small << " x " << tube.great;
    EXPECT_LT(leastOff / count, 0.8) << tube.small << " x " << tube.great;
    EXPECT_LT(greatestOff / count, 0.8) << tube.small << " x " << tube.great;
    meanLeast += leastOff / count / bodies;
    meanGreatest += greatestOff / count / bodies;
  }
  // Of so few bodies; of many 0.12 and 0.16 (root mean square).
  EXPECT_LT(meanLeast, 0.2);
  EXPECT_LT(meanGreatest, 0.25);
}

TEST(BranchSections, StenosesKeepTheirDepthAlsoInThickSlices)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int body = 0; body < 6; ++body)
  {
    const Vector3 spacing{ 1, 1, body % 2 == 0 ? 1.0 : 2.0 };
    const double  radius = within(6, 8);
    const double  depth = within(0.3, 0.7);
    const double  sigma = within(3, 6) * spacing[2];
    const auto    turn = AnyTurn(random);
    const double  length = 12 * sigma;
    Vector3       half{};
    for (std::size_t k = 0; k < 3; ++k)
    {
      half[k] = 0.5 * length * std::abs(turn[0][k]) + radius;
    }
    VoxelShape          shape = VoxelsAround(half, spacing, { 0, 0, 0 }, [&](const Vector3 & p) {
      const double along = Dot(p, turn[0]);
      const double here = radius * (1 - depth * std::exp(-0.5 * along * along / (sigma * sigma)));
      return std::abs(along) <= 0.5 * length && Length(AddScaled(p, -along, turn[0])) <= here;
    });
    const ImageGeometry geometry = GridOf(shape, spacing);
    const MeasuredBody  measured = MeasureBody(std::move(shape), geometry);
    double              least = HUGE_VAL;
    for (const BranchSection & section : measured.Sections(0.5))
    {
      const double whole = measured.graph.BranchLength(section.branch);
      least = std::abs(section.arc - 0.5 * whole) < 0.3 * whole ? std::min(least, section.EquivalentDiameter()) : least;
    }
    // Random ones are off by up to 0.032.
    EXPECT_NEAR(least / (2 * radius), 1 - depth, 0.05) << radius << ", " << depth << ", " << sigma;
  }
}

TEST(BranchSections, RunIntoOtherBranchesNearJunctionsAlone)
{
  const double        radius = 4;
  VoxelShape          shape = VoxelsAround({ 40, 40, 8 }, { 1, 1, 1 }, { .2, .1, .3 }, [&](const Vector3 & p) {
    const double along = std::clamp(p[0], -40.0, 40.0);
    const double aside = std::clamp(p[1], 0.0, 40.0);
    return Length({ p[0] - along, p[1], p[2] }) <= radius || Length({ p[0], p[1] - aside, p[2] }) <= radius;
  });
  const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
  const MeasuredBody  measured = MeasureBody(std::move(shape), geometry);
  ASSERT_EQ(measured.graph.BranchCount(), 3U);
  ElementIndex junction = 0;
  for (std::size_t node = 0; node < measured.graph.nodeKinds.size(); ++node)
  {
    junction = measured.graph.nodeKinds[node] == NodeKind::Junction ? measured.graph.nodePoints[node] : junction;
  }
  std::size_t near = 0;
  for (const BranchSection & section : measured.Sections(1.0))
  {
    const double way = Distance(section.place, measured.graph.positions[junction]);
    if (way < 0.5 * radius)
    {
      EXPECT_NE(section.runsInto, kNoBranch) << way;
      ++near;
    }
    else if (way > 3 * radius)
    {
      EXPECT_EQ(section.runsInto, kNoBranch) << way;
    }
    EXPECT_NE(section.runsInto, section.branch);
  }
  EXPECT_GT(near, 3U);
}

TEST(BranchSections, AreMarkedWhereTheBorderCutsThem)
{
  // A tube that lies half outside the scan.
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 60, 20, 20 } });
  for (std::int32_t z = 0; z < 12; ++z)
  {
    for (std::int32_t y = 0; y < 20; ++y)
    {
      for (std::int32_t x = 5; x < 55; ++x)
      {
        if (std::hypot(y - 9.5, z - 3.0 - (x - 5) * 0.1) <= 4)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
  const VoxelBox      scan = shape.Box();
  const MeasuredBody  measured = MeasureBody(std::move(shape), geometry);
  std::size_t         cut = 0;
  std::size_t         whole = 0;
  for (const BranchSection & section : measured.Sections(1.0, scan))
  {
    (section.isCut ? cut : whole) += 1;
    EXPECT_TRUE(section.place[0] > 30 ? !section.isCut : section.place[0] > 12 || section.isCut) << section.place[0];
  }
  EXPECT_GT(cut, 5U);
  EXPECT_GT(whole, 20U);
  for (const BranchSection & section : measured.Sections(1.0))
  {
    EXPECT_FALSE(section.isCut);
  }
}

TEST(BranchSections, OfAMeshAreThatOfItsTriangles)
{
  // A prism with so many sides that it is a cylinder nearly; holes and turns do not matter to its planes.
  constexpr int                             sides = 720;
  const double                              radius = 5.3;
  const Vector3                             centre{ 10.2, 10.4, 0 };
  std::vector<Vector3>                      corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t side = 0; side < sides; ++side)
  {
    const double angle = 2 * std::numbers::pi * side / sides;
    for (const double z : { 1.0, 39.0 })
    {
      corners.push_back({ centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle), z });
    }
    const std::uint32_t next = (side + 1) % sides;
    triangles.push_back({ 2 * side, 2 * next, 2 * side + 1 });
    triangles.push_back({ 2 * side + 1, 2 * next, 2 * next + 1 });
  }
  const auto surface = SurfaceFromTriangles(corners, triangles);
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 22, 22, 40 } });
  for (std::int32_t z = 1; z < 39; ++z)
  {
    for (std::int32_t y = 0; y < 22; ++y)
    {
      for (std::int32_t x = 0; x < 22; ++x)
      {
        if (std::hypot(x + .5 - centre[0], y + .5 - centre[1]) <= radius)
        {
          shape.Insert(x, y, z);
        }
      }
    }
  }
  const ImageGeometry geometry = GridOf(shape, { 1, 1, 1 });
  SkeletonGraph       graph;
  graph.positions = { LatticeToPhysical(geometry, { centre[0], centre[1], 8 }),
                      LatticeToPhysical(geometry, { centre[0], centre[1], 32 }) };
  graph.radius = { radius, radius };
  SortBranches(graph, { { 0, 1 } }, false);
  const auto sections = MeasureSections(graph, { &shape, surface.get(), geometry, {} }, 3.0);
  ASSERT_EQ(sections.size(), 9U);
  for (const BranchSection & section : sections)
  {
    EXPECT_NEAR(section.area, std::numbers::pi * radius * radius, 0.4);
    EXPECT_NEAR(section.leastDiameter, 2 * radius, 0.05);
    EXPECT_NEAR(section.greatestDiameter, 2 * radius, 0.05);
    EXPECT_NEAR(section.perimeter, 2 * std::numbers::pi * radius, 0.1);
    EXPECT_LT(Distance(section.centre, section.place), 0.01);
  }
}

TEST(BranchSections, DoNotDependOnThreads)
{
  EllipticTube tube;
  tube.turn = { Unit({ 1, 2, 3 }), Unit({ 2, -1, 0 }), Unit({ 3, 6, -5 }) };
  tube.great = 6;
  tube.small = 4;
  tube.length = 30;
  const MeasuredBody measured = BodyOf(tube, { 1, 1, 1 }, { .1, .2, .3 });
  const auto         many = measured.Sections();
  const int          threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto one = measured.Sections();
  omp_set_num_threads(threads);
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i)
  {
    EXPECT_EQ(one[i].area, many[i].area);
    EXPECT_EQ(one[i].contours, many[i].contours);
  }
}

} // namespace voxelcore::testing
