#include "MeasuredGraphs.h"

#include "voxelcore/Vessels/Centerlines.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

namespace voxelcore::testing
{

namespace
{

/** A trunk of radius 3 up to the origin, and a fork of 60 degrees with radii of 2; the left arm forks again. */
MeasuredSkeleton
TwoForks()
{
  GraphOfLines       lines;
  const double       angle = std::numbers::pi / 6;
  const ElementIndex base = lines.Point({ 0, -30, 0 }, 3.5);
  const ElementIndex fork = lines.Point({ 0, 0, 0 }, 3);
  const ElementIndex right = lines.Point({ 40 * std::sin(angle), 40 * std::cos(angle), 0 }, 2);
  const ElementIndex left = lines.Point({ -40 * std::sin(angle), 40 * std::cos(angle), 0 }, 2);
  const ElementIndex up = lines.Point({ -40 * std::sin(angle), 40 * std::cos(angle) + 25, 0 }, 1.5);
  const ElementIndex out = lines.Point({ -40 * std::sin(angle) - 25, 40 * std::cos(angle), 0 }, 1.5);
  lines.Line(base, fork, 30);
  lines.Line(fork, right, 40);
  lines.Line(fork, left, 40);
  lines.Line(left, up, 25);
  lines.Line(left, out, 25);
  return lines.Measured(5);
}

double
LengthOf(const CenterlineTract & tract)
{
  double length = 0;
  for (std::size_t i = 1; i < tract.places.size(); ++i)
  {
    length += Distance(tract.places[i], tract.places[i - 1]);
  }
  return length;
}

std::vector<CenterlineTract>
Split(const std::vector<MeasuredSkeleton> & parts, const std::vector<Vector3> & places = {})
{
  return SplitCenterlines(parts, FindInlets(parts, { places, {} }));
}

} // namespace

TEST(Centerlines, LeadFromTheInletToEachTipByTurnsThroughBranchesAndBifurcations)
{
  const auto                                           tracts = Split({ TwoForks() });
  std::map<std::int64_t, std::vector<CenterlineTract>> lines;
  for (const CenterlineTract & tract : tracts)
  {
    lines[tract.centerline].push_back(tract);
    EXPECT_EQ(tract.label, 5);
  }
  ASSERT_EQ(lines.size(), 3U);
  std::multiset<std::size_t> counts;
  for (const auto & [number, line] : lines)
  {
    counts.insert(line.size());
    for (std::size_t i = 0; i < line.size(); ++i)
    {
      EXPECT_EQ(line[i].tract, static_cast<std::int64_t>(i));
      EXPECT_EQ(line[i].isBlanked, i % 2 == 1);
      if (i > 0)
      {
        EXPECT_LT(Distance(line[i].places.front(), line[i - 1].places.back()), 1e-9);
      }
    }
    EXPECT_EQ(line.front().places.front(), (Vector3{ 0, -30, 0 })); // the thickest tip
  }
  EXPECT_EQ(counts, (std::multiset<std::size_t>{ 3, 5, 5 }));
}

TEST(Centerlines, HaveOneGroupPerBranchAndPerBifurcation)
{
  const auto                                       tracts = Split({ TwoForks() });
  std::map<std::int64_t, std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < tracts.size(); ++i)
  {
    groups[tracts[i].group].push_back(i);
  }
  // 5 branches, the first with three lines and one with two; 2 bifurcations, with three lines and two.
  ASSERT_EQ(groups.size(), 7U);
  EXPECT_EQ(groups.rbegin()->first, 6);
  std::multiset<std::size_t> branches;
  std::multiset<std::size_t> bifurcations;
  for (const auto & [group, members] : groups)
  {
    const CenterlineTract & first = tracts[members.front()];
    (first.isBlanked ? bifurcations : branches).insert(members.size());
    std::set<std::int64_t> lines;
    for (const std::size_t member : members)
    {
      EXPECT_EQ(tracts[member].isBlanked, first.isBlanked);
      lines.insert(tracts[member].centerline);
      if (!first.isBlanked)
      {
        EXPECT_NEAR(LengthOf(tracts[member]), LengthOf(first), 1e-9);
      }
    }
    EXPECT_EQ(lines.size(), members.size());
  }
  EXPECT_EQ(branches, (std::multiset<std::size_t>{ 1, 1, 1, 2, 3 }));
  EXPECT_EQ(bifurcations, (std::multiset<std::size_t>{ 2, 3 }));
}

TEST(Centerlines, BifurcationsEndWhereTheLineLeavesTheOthersTubeAndBeginOneBallUpstream)
{
  const auto tracts = Split({ TwoForks() });
  for (const CenterlineTract & tract : tracts)
  {
    if (!tract.isBlanked || tract.tract != 1)
    {
      continue;
    }
    // On the right arm; its mirror image is the tube it leaves, beside the trunk's last ball, of radius 3.
    const Vector3 end = tract.places.back();
    const double  along = Length(end);
    const double  angle = std::numbers::pi / 3;
    // Distance to a ball of the other arm, radius 3 - t / 40, at t: least over t.
    double gap = HUGE_VAL;
    for (double t = 0; t <= 40; t += 0.001)
    {
      const double away = std::sqrt(along * along + t * t - 2 * along * t * std::cos(angle));
      gap = std::min(gap, away - (3 - t / 40));
    }
    EXPECT_NEAR(gap, 0, 1e-3);
    // The ball where it begins reaches as far as the end; at the fork at the latest.
    const Vector3 begin = tract.places.front();
    EXPECT_LE(begin[1], 1e-9);
    EXPECT_TRUE(Length(begin) < 1e-9 || std::abs(Distance(begin, end) - tract.radius.front()) < 1e-6);
  }
}

TEST(Centerlines, BeginAtTheTipNearestToThePlaceThatIsGiven)
{
  for (const CenterlineTract & tract : Split({ TwoForks() }, { { 25, 35, 3 } }))
  {
    if (tract.tract == 0)
    {
      EXPECT_NEAR(tract.places.front()[0], 20, 1e-9);
    }
  }
}

TEST(Centerlines, OfSeveralBodiesAreNumberedThrough)
{
  const auto             tracts = Split({ TwoForks(), TwoForks() });
  std::set<std::int64_t> lines;
  std::set<std::int64_t> groups;
  for (const CenterlineTract & tract : tracts)
  {
    lines.insert(tract.centerline);
    groups.insert(tract.group);
  }
  EXPECT_EQ(lines, (std::set<std::int64_t>{ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(groups.size(), 14U);
  EXPECT_EQ(*groups.rbegin(), 13);
}

TEST(Centerlines, OfATubeAreOneTractAndInALoopGoByTheThickerWay)
{
  GraphOfLines       tube;
  const ElementIndex a = tube.Point({ 0, 0, 0 }, 2);
  const ElementIndex b = tube.Point({ 10, 0, 0 }, 1);
  tube.Line(a, b, 10);
  const auto one = Split({ tube.Measured() });
  ASSERT_EQ(one.size(), 1U);
  EXPECT_FALSE(one[0].isBlanked);
  EXPECT_NEAR(LengthOf(one[0]), 10, 1e-12);
  EXPECT_EQ(one[0].radius.front(), 2);

  GraphOfLines       ring;
  const ElementIndex in = ring.Point({ 0, 0, 0 }, 2);
  const ElementIndex split = ring.Point({ 10, 0, 0 }, 2);
  const ElementIndex thick = ring.Point({ 20, 15, 0 }, 2);
  const ElementIndex thin = ring.Point({ 20, -5, 0 }, 0.5);
  const ElementIndex join = ring.Point({ 30, 0, 0 }, 2);
  const ElementIndex out = ring.Point({ 40, 0, 0 }, 1.5);
  ring.Line(in, split, 10);
  ring.Line(split, thick, 10);
  ring.Line(thick, join, 10);
  ring.Line(split, thin, 10);
  ring.Line(thin, join, 10);
  ring.Line(join, out, 10);
  double length = 0;
  for (const CenterlineTract & tract : Split({ ring.Measured() }))
  {
    length += LengthOf(tract);
  }
  EXPECT_NEAR(length, 20 + 2 * std::sqrt(325.0), 1e-9);
}

} // namespace voxelcore::testing
