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
class BumpChecks : public ::testing::Test
{
protected:
  static constexpr double kHeight = 1.5;

  BumpChecks()
  {
    const VoxelShape shape = testing::EllipsoidWithRod();
    m_Case = testing::MakeCase(shape, { 1, 1, 1 });
    m_Case.core = PruneByBumps(testing::BumpedCoreOf(shape), kHeight);
  }
  VerificationReport
  Verify(double height) const
  {
    VerificationInput input = testing::InputOf(m_Case);
    input.bumpHeight = height;
    input.vertexBump = m_Case.core.bumps.vertices;
    input.edgeBump = m_Case.core.bumps.edges;
    input.faceBump = m_Case.core.bumps.faces;
    return VerifyComplex(input);
  }

  testing::VerificationCase m_Case;
};

TEST_F(BumpChecks, PassOnWhatPruningGives)
{
  const VerificationReport report = Verify(kHeight);
  EXPECT_TRUE(report.passed) << testing::Summary(report);
  ASSERT_TRUE(report.boundaryGap.has_value());
  EXPECT_GT(*report.boundaryGap, 0.5);
  EXPECT_LE(*report.boundaryGap, kHeight);
}

TEST_F(BumpChecks, SeeThatTheBoundaryLiesFarther)
{
  const double gap = *Verify(kHeight).boundaryGap;
  EXPECT_EQ(testing::FailedChecks(Verify(0.999 * gap)), Names{ "coverage" });
}

TEST_F(BumpChecks, SeeHeightsBelowTheWholesOrOutOfOrder)
{
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight + 1000)), Names{ "bump heights" });
  const BumpValues good = m_Case.core.bumps;
  for (auto * values : { &m_Case.core.bumps.vertices, &m_Case.core.bumps.edges, &m_Case.core.bumps.faces })
  {
    ASSERT_FALSE(values->empty());
    const auto place = std::max_element(values->begin(), values->end());
    for (const double wrong : { 0.0, std::numeric_limits<double>::quiet_NaN() })
    {
      *place = wrong;
      EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "bump heights" }) << wrong;
    }
    m_Case.core.bumps = good;
  }
  m_Case.core.bumps.faces.front() = 1e9;
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "bump heights" });
  m_Case.core.bumps.faces.pop_back();
  EXPECT_EQ(testing::FailedChecks(Verify(kHeight)), Names{ "bump heights" });
}

} // namespace
} // namespace voxelcore
