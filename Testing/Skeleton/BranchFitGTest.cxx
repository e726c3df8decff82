#include "TubeShapes.h"

namespace voxelcore::testing
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

/** Expects the length within `allowed`; gives how far off it is, both parts of the whole. */
double
ExpectLengthAndRadius(const Curve &       curve,
                      double              radius,
                      const VoxelShape &  shape,
                      const std::string & what,
                      double              allowed = 0.01)
{
  const SkeletonGraph graph = GraphOf(shape);
  EXPECT_EQ(graph.BranchCount(), 1U) << what;
  if (graph.BranchCount() != 1)
  {
    return 1;
  }
  const double length = CurveLength(curve);
  EXPECT_NEAR(graph.BranchLength(0), length, allowed * length) << what;
  double mean = 0;
  for (const ElementIndex point : graph.Branch(0))
  {
    mean += graph.radius[point];
  }
  mean /= static_cast<double>(graph.Branch(0).size());
  EXPECT_NEAR(mean + 0.25 * std::sqrt(3.0), radius, 0.5) << what;
  for (std::size_t point = 0; point < graph.positions.size(); ++point)
  {
    EXPECT_LE(Distance(graph.positions[point], graph.medial[point]), 0.5 + 1e-12) << what;
  }
  return std::abs(graph.BranchLength(0) - length) / length;
}

TEST(BranchFit, StraightTubesAtAnyAngleHaveTheirLength)
{
  // Where a cap of voxels ends is uncertain by a voxel or two: one end in fifty may be off by more than the one percent.
  int off = 0;
  for (const double radius : { 1.5, 2.5, 4.0 })
  {
    for (int k = 0; k < 8; ++k)
    {
      const double about = 0.37 * k;
      const double tilt = 0.23 * k;
      const Curve  curve = SampleCurve(
        [&](double t) {
          return Turned({ 100 * t - 50, 0, 0 }, about, tilt, { 60, 60, 60 });
        },
        400);
      const double error = ExpectLengthAndRadius(curve,
                                                 radius,
                                                 Tube(curve, radius, { 120, 120, 120 }),
                                                 "radius " + std::to_string(radius) + ", turn " + std::to_string(k),
                                                 0.03);
      off += error > 0.01 ? 1 : 0;
    }
  }
  EXPECT_LE(off, 1);
}

TEST(BranchFit, HelicesAtAnyAngleHaveTheirLength)
{
  for (const double radius : { 2.0, 3.0 })
  {
    for (int k = 0; k < 5; ++k)
    {
      const Curve curve = SampleCurve(
        [&](double t) {
          return Turned({ 22 * std::cos(4 * kPi * t), 22 * std::sin(4 * kPi * t), 60 * t - 30 },
                        0.4 * k,
                        0.3 * k,
                        { 50, 50, 50 });
        },
        2000);
      ExpectLengthAndRadius(curve,
                            radius,
                            Tube(curve, radius, { 100, 100, 100 }),
                            "radius " + std::to_string(radius) + ", turn " + std::to_string(k));
    }
  }
}

TEST(BranchFit, ToriAtAnyAngleHaveTheirLength)
{
  for (const double ring : { 12.0, 25.0 })
  {
    for (const double radius : { 2.0, 4.0, 6.0 })
    {
      for (int k = 0; k < 5; ++k)
      {
        const Curve curve = SampleCurve(
          [&](double t) {
            return Turned({ ring * std::cos(2 * kPi * t), ring * std::sin(2 * kPi * t), 0 },
                          0.4 * k,
                          0.3 * k,
                          { 40, 40, 40 });
          },
          1500);
        ExpectLengthAndRadius(curve,
                              radius,
                              Tube(curve, radius, { 80, 80, 80 }),
                              "ring " + std::to_string(ring) + ", radius " + std::to_string(radius) + ", turn " +
                                std::to_string(k));
      }
    }
  }
}

TEST(BranchFit, WindowZeroLeavesTheMedialSurface)
{
  SkeletonGraph graph = GraphOf(PhantomShape("root", 48));
  EXPECT_NE(graph.positions, graph.medial);
  FitBranches(graph, 0, 0.5);
  EXPECT_EQ(graph.positions, graph.medial);
}

TEST(BranchFit, NodesStay)
{
  const SkeletonGraph graph = GraphOf(PhantomShape("root", 64));
  for (const ElementIndex point : graph.nodePoints)
  {
    EXPECT_EQ(graph.positions[point], graph.medial[point]);
  }
}

} // namespace

} // namespace voxelcore::testing
