#include "voxelcore/Compare/BranchLives.h"

#include "CompareGraphs.h"
#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>

namespace voxelcore::testing
{
namespace
{

using Line = std::vector<Vector3>;

const Line kTrunk{ { 0, 0, 0 }, { 20, 0, 0 } };
const Line kUp{ { 20, 0, 0 }, { 30, 10, 0 } };
const Line kDown{ { 20, 0, 0 }, { 30, -10, 0 } };

void
ExpectLives(const std::vector<BranchLife> & lives, const std::vector<std::pair<double, double>> & wanted)
{
  ASSERT_EQ(lives.size(), wanted.size());
  for (std::size_t i = 0; i < lives.size(); ++i)
  {
    EXPECT_EQ(lives[i].lowest, wanted[i].first) << i;
    EXPECT_EQ(lives[i].highest, wanted[i].second) << i;
  }
}

TEST(BranchLives, ABranchLivesWhereATreeHasItsPlace)
{
  const TreesOfThresholds all{ { 0.2, 0.4, 0.6, 0.8 },
                               { GraphOf({ kTrunk, kUp, kDown }, 1),
                                 GraphOf({ kTrunk, kUp, kDown }, 1),
                                 GraphOf({ { kTrunk[0], kTrunk[1], kUp[1] } }, 1), // one branch of both
                                 SkeletonGraph() } };
  const auto              lives = LivesOf(all.trees[1], 1, all);
  ExpectLives(lives, { { 0.2, 0.6 }, { 0.2, 0.6 }, { 0.2, 0.4 } }); // by their first points
  EXPECT_EQ(FindWrongLife(all.trees[1], 1, all, lives), 3U);
  EXPECT_EQ(StableOnes(lives, 0.4), (std::vector<std::uint8_t>{ 1, 1, 0 }));
  EXPECT_EQ(StableOnes(lives, 0), (std::vector<std::uint8_t>{ 1, 1, 1 }));
  ExpectLives(LivesOf(all.trees[2], 2, all), { { 0.2, 0.6 } });
}

TEST(BranchLives, WhatIsBrokenOrPassesBesideIsNotThere)
{
  const TreesOfThresholds all{ { 0.3, 0.5, 0.7 },
                               { GraphOf({ { { 0, 3, 0 }, { 20, 3, 0 } } }, 2), // beside, by more than radii
                                 GraphOf({ kTrunk }, 2),
                                 GraphOf({ { { 0, 0, 0 }, { 9, 0, 0 } }, { { 14, 0, 0 }, { 20, 0, 0 } } }, 1) } };
  const auto              lives = LivesOf(all.trees[1], 1, all);
  ExpectLives(lives, { { 0.5, 0.5 } });
  EXPECT_EQ(FindWrongLife(all.trees[1], 1, all, lives), 1U);
}

TEST(BranchLives, TheWayThroughWhatABranchSpringsFromDoesNotCount)
{
  // The same twig, which joins the axis of its trunk farther on.
  const auto tree = [](double joint) {
    SkeletonGraph graph = GraphOf({ { { 0, 0, 0 }, { joint, 0, 0 } },
                                    { { joint, 0, 0 }, { 40, 0, 0 } },
                                    { { joint, 0, 0 }, { 20, 5.5, 0 }, { 20, 9, 0 } } },
                                  5);
    for (std::size_t i = 0; i < graph.positions.size(); ++i)
    {
      graph.radius[i] = graph.positions[i][1] > 0 ? 1 : 5;
    }
    return graph;
  };
  const TreesOfThresholds all{ { 0.3, 0.5 }, { tree(20), tree(23) } };
  for (const std::size_t own : { 0U, 1U })
  {
    const auto lives = LivesOf(all.trees[own], own, all);
    ExpectLives(lives, { { 0.3, 0.5 }, { 0.3, 0.5 }, { 0.3, 0.5 } });
    EXPECT_EQ(FindWrongLife(all.trees[own], own, all, lives), 3U);
  }
}

TEST(BranchLives, TheThresholdIsTakenThatKeepsMostOfWhatIsStable)
{
  const Line        far{ { 0, 50, 0 }, { 30, 50, 0 } };
  TreesOfThresholds all{ { 0.2, 0.3, 0.4, 0.5, 0.6 }, {} };
  for (const double threshold : all.thresholds)
  {
    all.trees.push_back(threshold < 0.45 ? GraphOf({ kTrunk, far }, 1) : GraphOf({ kTrunk }, 1));
  }
  std::vector<std::vector<BranchLife>> lives;
  for (std::size_t i = 0; i < all.trees.size(); ++i)
  {
    lives.push_back(LivesOf(all.trees[i], i, all));
  }
  EXPECT_EQ(all.thresholds[StablestThreshold(all, lives, 0.2)], 0.4);
  EXPECT_EQ(all.thresholds[StablestThreshold(all, lives, 0.3)], 0.5); // what is far is no longer stable
  EXPECT_THROW(StablestThreshold(all, lives, 0.5), InputError);
}

/** Lines far from each other, of which some are missing at some thresholds. */
TEST(BranchLives, LivesAreThoseOfRandomRowsAndAFalseOneIsFound)
{
  constexpr std::uint64_t seed = 20690;
  std::cout << "seed " << seed << '\n';
  Random random(seed);
  for (int round = 0; round < 12; ++round)
  {
    const auto                            lines = static_cast<std::size_t>(random.Between(1, 6));
    TreesOfThresholds                     all{ { 0.1, 0.3, 0.5, 0.7, 0.9 }, {} };
    std::vector<std::vector<bool>>        isThere;
    std::vector<std::vector<std::size_t>> lineOf;
    for (std::size_t i = 0; i < all.thresholds.size(); ++i)
    {
      std::vector<Line> drawn;
      isThere.emplace_back();
      lineOf.emplace_back();
      for (std::size_t line = 0; line < lines; ++line)
      {
        isThere.back().push_back(random.Chance(0.7));
        if (isThere.back().back())
        {
          const double at = 10.0 * static_cast<double>(line) + 0.2 * random.Unit();
          drawn.push_back({ { 0, at, 0 }, { 7, at, 0.1 }, { 15, at, 0 } });
          lineOf.back().push_back(line);
        }
      }
      all.trees.push_back(GraphOf(drawn, 1));
    }
    for (std::size_t own = 0; own < all.trees.size(); ++own)
    {
      auto lives = LivesOf(all.trees[own], own, all);
      for (std::size_t branch = 0; branch < lives.size(); ++branch)
      {
        std::size_t first = own;
        std::size_t last = own;
        while (first > 0 && isThere[first - 1][lineOf[own][branch]])
        {
          --first;
        }
        while (last + 1 < all.trees.size() && isThere[last + 1][lineOf[own][branch]])
        {
          ++last;
        }
        EXPECT_EQ(lives[branch].lowest, all.thresholds[first]) << round;
        EXPECT_EQ(lives[branch].highest, all.thresholds[last]) << round;
      }
      EXPECT_EQ(FindWrongLife(all.trees[own], own, all, lives), lives.size());
      if (!lives.empty())
      {
        const auto which = static_cast<std::size_t>(random.Between(0, std::ssize(lives) - 1));
        auto &     end = random.Chance(0.5) ? lives[which].highest : lives[which].lowest;
        const auto at = std::find(all.thresholds.begin(), all.thresholds.end(), end) - all.thresholds.begin();
        end = all.thresholds[static_cast<std::size_t>(at == 0 ? 1 : at - 1)];
        if (lives[which].lowest <= all.thresholds[own] && lives[which].highest >= all.thresholds[own])
        {
          EXPECT_EQ(FindWrongLife(all.trees[own], own, all, lives), which) << round;
          EXPECT_THROW(RequireLives(all.trees[own], own, all, lives, "map"), CertificateError);
        }
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
