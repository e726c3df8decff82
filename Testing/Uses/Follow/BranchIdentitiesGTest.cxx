#include "voxelcore/Follow/BranchIdentities.h"

#include "GrowingLines.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

namespace voxelcore::testing
{
namespace
{

constexpr double kLeast = 0.5;

Line
Straight(const Vector3 & from, const Vector3 & to)
{
  Line      line;
  const int steps = static_cast<int>(std::lround(Distance(from, to)));
  for (int step = 0; step <= steps; ++step)
  {
    line.push_back(AddScaled(from, static_cast<double>(step) / steps, Minus(to, from)));
  }
  return line;
}

std::vector<FollowedDay>
Follow(const std::vector<std::vector<Line>> & trees, const Vector3 & root = {})
{
  std::vector<SkeletonGraph> graphs;
  for (const auto & tree : trees)
  {
    graphs.push_back(TreeOf(tree, 1));
  }
  auto days = FollowBranches(std::move(graphs), { RootChoice::Kind::Point, root }, kLeast);
  RequireIdentities(days, std::vector<RigidMotion>(days.size()), kLeast);
  return days;
}

/** The branch whose tip is at a place. */
const FollowedBranch &
At(const FollowedDay & day, const Vector3 & tip)
{
  const auto found = std::find_if(day.branches.begin(), day.branches.end(), [&](const FollowedBranch & branch) {
    return Distance(day.graph.positions[branch.points.back()], tip) < 1e-9;
  });
  if (found == day.branches.end())
  {
    throw std::out_of_range("no branch ends there");
  }
  return *found;
}

const Line kStem = Straight({ 0, 0, 0 }, { 0, 0, 30 });
const Line kLongStem = Straight({ 0, 0, 0 }, { 0, 0, 36 });
const Line kLateral = Straight({ 0, 0, 10 }, { 12, 0, 10 });
const Line kLongLateral = Straight({ 0, 0, 10 }, { 15, 0, 10 });

TEST(BranchIdentities, AreKeptWhereOthersSpringAndTipsGrow)
{
  const Line second = Straight({ 12, 0, 10 }, { 12, 6, 10 }); // of the lateral, where its tip was
  const auto days =
    Follow({ { kStem, kLateral }, { kLongStem, kLongLateral, Straight({ 0, 0, 20 }, { 0, 9, 20 }), second } });
  ASSERT_EQ(days[0].branches.size(), 2U);
  ASSERT_EQ(days[1].branches.size(), 4U);
  const FollowedBranch & stem = At(days[1], { 0, 0, 36 });
  const FollowedBranch & lateral = At(days[1], { 15, 0, 10 });
  EXPECT_EQ(stem.id, At(days[0], { 0, 0, 30 }).id);
  EXPECT_EQ(lateral.id, At(days[0], { 12, 0, 10 }).id);
  EXPECT_EQ(stem.length, 36);
  EXPECT_EQ(lateral.length, 15);
  EXPECT_NEAR(stem.growth, 6, 1e-9);
  EXPECT_NEAR(lateral.growth, 3, 1e-9);
  EXPECT_EQ(lateral.parent, stem.id);
  EXPECT_EQ(stem.state, BranchState::Kept);
  EXPECT_EQ(At(days[1], { 0, 9, 20 }).state, BranchState::New);
  EXPECT_EQ(At(days[1], { 0, 9, 20 }).parent, stem.id);
  EXPECT_EQ(At(days[1], { 12, 6, 10 }).parent, lateral.id);
  EXPECT_EQ(At(days[1], { 12, 6, 10 }).order, 2);
  EXPECT_EQ(At(days[1], { 12, 6, 10 }).id, 4);
  EXPECT_TRUE(days[1].lost.empty());
}

TEST(BranchIdentities, OfLostBranchesComeBackWithThem)
{
  const auto days = Follow({ { kStem, kLateral }, { kLongStem }, { kLongStem, kLongLateral } });
  const auto id = At(days[0], { 12, 0, 10 }).id;
  ASSERT_EQ(days[1].lost.size(), 1U);
  EXPECT_EQ(days[1].lost[0].id, id);
  EXPECT_EQ(days[1].lost[0].tip, (Vector3{ 12, 0, 10 }));
  EXPECT_EQ(At(days[2], { 15, 0, 10 }).id, id);
  EXPECT_EQ(At(days[2], { 15, 0, 10 }).state, BranchState::Back);
  EXPECT_EQ(At(days[2], { 15, 0, 10 }).before, 0U);
}

TEST(BranchIdentities, AreNewForAnotherCourseFromTheSamePlace)
{
  const auto days = Follow({ { kStem, kLateral }, { kStem, Straight({ 0, 0, 10 }, { 0, 12, 10 }) } });
  EXPECT_EQ(days[1].lost.size(), 1U);
  EXPECT_EQ(At(days[1], { 0, 12, 10 }).state, BranchState::New);
  EXPECT_EQ(At(days[1], { 0, 12, 10 }).id, 3);
}

TEST(BranchIdentities, AreKeptOfWhatShrinksAndOfATreeThatBeginsAtItsOtherEnd)
{
  const auto days = Follow({ { kLongStem, kLongLateral }, { kStem, Straight({ 0, 0, 10 }, { 7, 0, 10 }) } });
  EXPECT_EQ(At(days[1], { 7, 0, 10 }).id, At(days[0], { 15, 0, 10 }).id);
  EXPECT_NEAR(At(days[1], { 7, 0, 10 }).growth, -8, 1e-9);
  // The thickest tip of the second day would be another; it begins where the first did.
  const auto down = Follow({ { kStem, kLateral }, { kLongStem, kLongLateral } }, { 0, 0, 30 });
  EXPECT_EQ(down[0].branches.size(), 2U);
  EXPECT_EQ(down[1].branches.size(), 2U);
  EXPECT_EQ(At(down[1], { 15, 0, 10 }).id, At(down[0], { 12, 0, 10 }).id);
}

TEST(BranchIdentities, RadiusChangesAreThoseOfTheSharedCourse)
{
  std::vector<SkeletonGraph> graphs{ TreeOf({ kStem, kLateral }, 1), TreeOf({ kLongStem, kLongLateral }, 1.25) };
  for (std::size_t point = 0; point < graphs[1].positions.size(); ++point)
  {
    if (graphs[1].positions[point][2] > 30.5) // what grew is thin
    {
      graphs[1].radius[point] = 0.2;
    }
  }
  const auto days = FollowBranches(std::move(graphs), { RootChoice::Kind::Point, {} }, kLeast);
  EXPECT_NEAR(At(days[1], { 0, 0, 36 }).radiusChange, 0.25, 1e-9);
  EXPECT_NEAR(At(days[1], { 15, 0, 10 }).radiusChange, 0.25, 1e-9);
  EXPECT_LT(At(days[1], { 0, 0, 36 }).meanRadius, 1.2);
}

TEST(BranchIdentities, OfRandomTreesThatGrowAreTheirs)
{
  constexpr std::uint64_t seed = 3301;
  std::cout << "seeds from " << seed << '\n';
  std::size_t roots = 0;
  std::size_t kept = 0;
  for (std::uint64_t test = 0; test < 20; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random                         random(seed + test);
    const auto                     whole = RandomTree(random, 8);
    std::vector<std::vector<Line>> trees;
    for (std::size_t day = 0; day < 5; ++day)
    {
      trees.emplace_back();
      for (std::size_t number = 0; number < whole.size(); ++number)
      {
        const std::size_t all = whole[number].size();
        const std::size_t now = number == 0 ? all - 4 + day : day >= number % 4 ? std::min(all, 4 + 3 * day) : 0;
        if (now > 0)
        {
          trees.back().emplace_back(whole[number].begin(), whole[number].begin() + static_cast<std::ptrdiff_t>(now));
        }
      }
    }
    const auto                      days = Follow(trees, whole[0][0]);
    std::map<Vector3, std::int64_t> idOf; // by the way's second point, which no two have
    for (std::size_t day = 0; day < days.size(); ++day)
    {
      for (const Line & line : trees[day])
      {
        const auto found =
          std::find_if(days[day].branches.begin(), days[day].branches.end(), [&](const FollowedBranch & branch) {
            return days[day].graph.positions[branch.points.back()] == line.back();
          });
        const std::int64_t id = found == days[day].branches.end() ? 0 : found->id;
        const auto         known = idOf.emplace(line[1], id);
        roots += known.second ? 0 : 1;
        kept += !known.second && known.first->second == id && id != 0 ? 1 : 0;
      }
    }
  }
  std::cout << kept << " of " << roots << " kept\n";
  EXPECT_GE(static_cast<double>(kept), 0.97 * static_cast<double>(roots)); // some wander into each other
}

TEST(BranchIdentities, ThatAreWrongAreRefused)
{
  const auto                     days = Follow({ { kStem, kLateral }, { kLongStem, kLongLateral } });
  const std::vector<RigidMotion> motions(2);
  const auto                     refused = [&](const char * why, const auto & change) {
    auto wrong = days;
    auto moved = motions;
    change(wrong, moved);
    try
    {
      RequireIdentities(wrong, moved, kLeast);
      ADD_FAILURE() << why;
    }
    catch (const CertificateError & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  using Days = std::vector<FollowedDay>;
  using Motions = std::vector<RigidMotion>;
  refused("not rigid", [](Days &, Motions & moved) { moved[1].rotation[0] = 1.001; });
  refused("not rigid", [](Days &, Motions & moved) { moved[1].rotation[8] = -1; });
  refused("two branches", [](Days & wrong, Motions &) { wrong[1].branches[1].id = wrong[1].branches[0].id; });
  refused("a piece of", [](Days & wrong, Motions &) { wrong[1].branches.pop_back(); });
  refused("do not sum up", [](Days & wrong, Motions &) { wrong[1].branches[0].length += 1; });
  refused("parent that is not", [](Days & wrong, Motions &) { wrong[1].branches[1].parent = 9; });
  refused("order", [](Days & wrong, Motions &) { wrong[1].branches[1].order = 2; });
  refused("a wrong state", [](Days & wrong, Motions &) { wrong[1].branches[1].state = BranchState::New; });
  refused("measured wrong", [](Days & wrong, Motions &) { wrong[1].branches[1].advance += 1; });
  refused("grown otherwise", [](Days & wrong, Motions &) { wrong[1].branches[1].growth += 1; });
  refused("what is lost", [](Days & wrong, Motions &) { wrong[1].lost.push_back({ 2, {} }); });
  refused("measured wrong", [](Days & wrong, Motions &) { // each is called as the other was
    std::swap(wrong[1].branches[0].id, wrong[1].branches[1].id);
    wrong[1].branches[1].parent = wrong[1].branches[0].id;
  });
}

} // namespace
} // namespace voxelcore::testing
