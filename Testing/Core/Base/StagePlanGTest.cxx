#include "voxelcore/Base/StagePlan.h"

#include "VoxelCoreTesting/Random.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{
namespace
{

using Reports = std::vector<std::pair<std::string, double>>;

ProgressCallback
WriteTo(Reports & reports)
{
  return [&reports](std::string_view stage, double fraction) {
    reports.emplace_back(stage, fraction);
    return true;
  };
}

TEST(PartOfProgress, LaysFractionsIntoItsPartAndLimitsThem)
{
  Reports    reports;
  const auto part = PartOfProgress(WriteTo(reports), 0.5, 0.75);
  const auto named = PartOfProgress(WriteTo(reports), "mending", 0.5, 0.75);
  part("core", -1);
  part("core", 0.5);
  part("core", 7);
  named("core", 1);
  EXPECT_EQ(reports, (Reports{ { "core", 0.5 }, { "core", 0.625 }, { "core", 0.75 }, { "mending", 0.75 } }));
}

TEST(PartOfProgress, OfNobodyIsNobodyAndAWishToStopComesThrough)
{
  EXPECT_FALSE(PartOfProgress({}, 0, 1));
  EXPECT_FALSE(PartOfProgress({}, "core", 0, 1));
  EXPECT_FALSE(ForwardOnly({}));
  const ProgressCallback stop = [](std::string_view, double) { return false; };
  EXPECT_FALSE(PartOfProgress(stop, 0, 1)("core", 0.5));
  EXPECT_FALSE(PartOfProgress(stop, "core", 0, 1)("core", 0.5));
  EXPECT_FALSE(ForwardOnly(stop)("core", 0.5));
}

TEST(ForwardOnly, NeverGoesBackWhicheverCopyIsCalled)
{
  Reports    reports;
  const auto first = ForwardOnly(WriteTo(reports));
  const auto second = first;
  first("a", 0.4);
  second("b", 0.1);
  second("b", 0.6);
  first("a", 0.5);
  first("a", 3);
  EXPECT_EQ(reports, (Reports{ { "a", 0.4 }, { "b", 0.4 }, { "b", 0.6 }, { "a", 0.6 }, { "a", 1 } }));
}

TEST(StagePlan, StagesFollowEachOtherWithoutAGapAndTheLastEndsAtOne)
{
  constexpr std::uint64_t seed = 20240611;
  testing::Random         random(seed);
  for (int round = 0; round < 200; ++round)
  {
    std::vector<double> weights(static_cast<std::size_t>(random.Between(1, 9)));
    double              all = 0;
    for (double & weight : weights)
    {
      weight = random.Chance(0.2) ? 0 : random.Unit();
      all += weight;
    }
    weights.back() += all > 0 ? 0 : 1;
    all += all > 0 ? 0 : 1;
    Reports   reports;
    StagePlan plan(WriteTo(reports), weights);
    for (std::size_t stage = 0; stage < weights.size(); ++stage)
    {
      const auto part = plan.Next(stage % 2 == 0 ? "" : "even");
      part("odd", 0);
      part("odd", 1);
      const auto & [name, end] = reports.back();
      EXPECT_EQ(name, stage % 2 == 0 ? "odd" : "even");
      EXPECT_NEAR(end - reports[reports.size() - 2].second, weights[stage] / all, 1e-12) << "seed " << seed;
      if (stage > 0)
      {
        EXPECT_DOUBLE_EQ(reports[reports.size() - 2].second, reports[reports.size() - 3].second) << "seed " << seed;
      }
    }
    EXPECT_EQ(reports.front().second, 0);
    EXPECT_DOUBLE_EQ(reports.back().second, 1);
    EXPECT_THROW(plan.Next(), std::out_of_range);
  }
}

} // namespace
} // namespace voxelcore
