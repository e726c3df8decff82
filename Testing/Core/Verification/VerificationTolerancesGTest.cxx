#include "VerificationFixtures.h"

#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace voxelcore
{
namespace
{

using Names = std::vector<std::string>;

/** An ellipsoid with a rod, pruned to a height. */
class ToleranceChecks : public ::testing::Test
{
protected:
  static constexpr double kHeight = 1.5;

  ToleranceChecks()
  {
    const VoxelShape shape = testing::EllipsoidWithRod();
    m_Case = testing::MakeCase(shape, { 1, 1, 1 });
    m_Case.core = PruneByTolerance(testing::CoreWithTolerancesOf(shape), kHeight);
  }
  VerificationReport
  Verify(double height) const
  {
    VerificationInput input = testing::InputOf(m_Case);
    input.pruningTolerance = height;
    input.vertexTolerance = m_Case.core.tolerances.vertices;
    input.edgeTolerance = m_Case.core.tolerances.edges;
    input.faceTolerance = m_Case.core.tolerances.faces;
    return VerifyComplex(input);
  }

  testing::VerificationCase m_Case;
};

TEST_F(ToleranceChecks, PassOnWhatPruningGives)
{
  const VerificationReport report = Verify(kHeight);
  EXPECT_TRUE(report.passed) << testing::Summary(report);
  ASSERT_TRUE(report.boundaryGap.has_value());
  EXPECT_GT(*report.boundaryGap, 0.5);
  EXPECT_LE(*report.boundaryGap, kHeight);
}

TEST_F(ToleranceChecks, SeeThatTheBoundaryLiesFarther)
{
  const double gap = *Verify(kHeight).boundaryGap;
  EXPECT_EQ(testing::FailedChecks(Verify(0.999 * gap)), Names{ "coverage" });
}

// In thick slices a height counts in full where the boundary runs across them only.
TEST(ToleranceChecksInSlices, SeeWhatOneLengthForAllDirectionsLeaves)
{
  const testing::Spacing3 spacing{ 1, 1, 3 };
  const double            height = 1.2 * std::sqrt(11.0);
  const VoxelShape        shape = testing::ShapeWhere({ 60, 30, 10 }, [](int x, int y, int z) {
    const double across = std::hypot(y - 14.5, 3 * (z - 4.5));
    return std::hypot(x - 15, across) < 10 || (x >= 15 && x < 57 && across < 4); // a ball with a rod
  });
  const SpacingWeights    weights = ComputeSpacingWeights(spacing);
  const auto              points = BoundaryVertices(shape);
  for (const bool byDirection : { true, false })
  {
    DelaunayCells cells = ComputeDelaunayCells(shape, points, weights, Engine::Auto);
    TouchingBalls touching = LargestTouchingBalls(shape, cells, points, weights);
    if (!byDirection)
    {
      touching.weights.clear();
    }
    testing::VerificationCase rest = testing::MakeCase(shape, spacing);
    rest.core = BuildVoxelCore(shape, points, std::move(cells), weights);
    rest.core.tolerances = ComputeTolerances(rest.core, weights, points, std::move(touching));
    rest.core = PruneByTolerance(rest.core, height);
    VerificationInput input = testing::InputOf(rest);
    input.pruningTolerance = height;
    input.vertexTolerance = rest.core.tolerances.vertices;
    input.edgeTolerance = rest.core.tolerances.edges;
    input.faceTolerance = rest.core.tolerances.faces;
    const VerificationReport report = VerifyComplex(input);
    EXPECT_EQ(testing::FailedChecks(report), byDirection ? Names{} : Names{ "coverage" });
    ASSERT_TRUE(report.boundaryGapShare.has_value());
    EXPECT_LE(*report.boundaryGap, height);
    EXPECT_GT(*report.boundaryGapShare, 0.7);
    EXPECT_EQ(*report.boundaryGapShare > 1, !byDirection);
  }
}

TEST_F(ToleranceChecks, SeeHeightsBelowTheWholesOrOutOfOrder)
{
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight + 1000)), Names{ "tolerances" });
  const ToleranceValues good = m_Case.core.tolerances;
  for (auto * values :
       { &m_Case.core.tolerances.vertices, &m_Case.core.tolerances.edges, &m_Case.core.tolerances.faces })
  {
    ASSERT_FALSE(values->empty());
    const auto place = std::max_element(values->begin(), values->end());
    for (const double wrong : { 0.0, std::numeric_limits<double>::quiet_NaN() })
    {
      *place = wrong;
      EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "tolerances" }) << wrong;
    }
    m_Case.core.tolerances = good;
  }
  m_Case.core.tolerances.faces.front() = 1e9;
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "tolerances" });
  m_Case.core.tolerances.faces.pop_back();
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "tolerances" });
}

TEST_F(ToleranceChecks, AreNamedAsFailedWhereWhatTheyBuildOnIsDamaged)
{
  m_Case.core.radius.pop_back();
  const Names failed = testing::FailedChecks(Verify(kHeight));
  for (const char * name : { "tolerances", "coverage", "topology" })
  {
    EXPECT_EQ(std::count(failed.begin(), failed.end(), name), 1) << name;
  }
  EXPECT_EQ(std::count(failed.begin(), failed.end(), "completeness"), 0);
}

TEST_F(ToleranceChecks, PromiseNothingOfTheBoundaryOncePrunedByLambda)
{
  m_Case.threshold = 1;
  const VerificationReport report = Verify(0.1);
  EXPECT_TRUE(std::none_of(report.checks.begin(), report.checks.end(), [](const VerificationCheck & check) {
    return check.name == "coverage";
  }));
  EXPECT_TRUE(report.boundaryGap.has_value());
}

} // namespace
} // namespace voxelcore
