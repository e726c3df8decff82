#include "VerificationFixtures.h"

#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

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
