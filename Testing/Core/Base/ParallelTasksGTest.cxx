#include "voxelcore/Base/ParallelTasks.h"

#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace voxelcore
{
namespace
{

TEST(RunBoth, CallsEachOnceAndTheFirstInTheCallingThread)
{
  for (const int threads : { 1, 2, 3 })
  {
    const testing::Threads scope(threads);
    for (const bool worthIt : { false, true })
    {
      int             firstCalls = 0;
      int             secondCalls = 0;
      std::thread::id first;
      std::thread::id second;
      RunBoth(
        worthIt,
        [&] {
          ++firstCalls;
          first = std::this_thread::get_id();
        },
        [&] {
          ++secondCalls;
          second = std::this_thread::get_id();
        });
      EXPECT_EQ(firstCalls, 1);
      EXPECT_EQ(secondCalls, 1);
      EXPECT_EQ(first, std::this_thread::get_id());
      EXPECT_EQ(second == first, threads == 1 || !worthIt) << threads << " threads";
    }
  }
}

TEST(RunBoth, ThrowsOnWhatEitherThrowsTheFirstsFirst)
{
  for (const int threads : { 1, 2 })
  {
    const testing::Threads scope(threads);
    const auto             thrown = [](bool first, bool second) {
      bool        ran = false;
      std::string text;
      try
      {
        RunBoth(
          true,
          [&] {
            if (first)
            {
              throw std::runtime_error("first");
            }
          },
          [&] {
            ran = true;
            if (second)
            {
              throw std::runtime_error("second");
            }
          });
      }
      catch (const std::runtime_error & error)
      {
        text = error.what();
      }
      EXPECT_TRUE(ran);
      return text;
    };
    EXPECT_EQ(thrown(false, false), "");
    EXPECT_EQ(thrown(true, false), "first");
    EXPECT_EQ(thrown(false, true), "second");
    EXPECT_EQ(thrown(true, true), "first");
  }
}

TEST(RunInParts, GivesEachItemOnce)
{
  for (const int threads : { 1, 2, 7 })
  {
    const testing::Threads scope(threads);
    for (const std::size_t count : { 0U, 1U, 5U, 100U })
    {
      std::vector<std::atomic<int>> met(count);
      std::atomic<int>              parts = 0;
      RunInParts(count > 1, count, [&](std::size_t first, std::size_t last) {
        ++parts;
        for (std::size_t i = first; i < last; ++i)
        {
          ++met[i];
        }
      });
      EXPECT_EQ(parts, count > 1 ? threads : 1);
      EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; })) << count;
    }
  }
}

TEST(RunInParts, AndRunBothEnterNoParallelRegionWhereOneThreadDoesAll)
{
  const testing::Threads scope(2);
  const auto             level = [] { EXPECT_EQ(omp_get_level(), 0); };
  RunBoth(false, level, level);
  RunInParts(false, 5, [&](std::size_t, std::size_t) { level(); });
}

TEST(RunInParts, ThrowsOnWhatTheFirstPartThatFailsThrows)
{
  const testing::Threads scope(3);
  std::atomic<int>       ran = 0;
  std::string            text;
  try
  {
    RunInParts(true, 30, [&](std::size_t first, std::size_t) {
      ++ran;
      if (first > 0)
      {
        throw std::runtime_error(std::to_string(first));
      }
    });
  }
  catch (const std::runtime_error & error)
  {
    text = error.what();
  }
  EXPECT_EQ(text, "10");
  EXPECT_EQ(ran, 3);
}

TEST(RunEach, MeetsEachItemOnceAndCountsWhatIsDone)
{
  for (const int threads : { 1, 3 })
  {
    const testing::Threads        scope(threads);
    std::vector<std::atomic<int>> met(100);
    std::vector<std::size_t>      counts;
    RunEach(
      met.size(),
      [&](std::size_t item) { ++met[item]; },
      [&](std::size_t number) { counts.push_back(number); });
    EXPECT_TRUE(std::all_of(met.begin(), met.end(), [](int times) { return times == 1; }));
    ASSERT_EQ(counts.size(), met.size());
    EXPECT_TRUE(std::is_sorted(counts.begin(), counts.end()));
    EXPECT_EQ(counts.back(), met.size());
  }
  RunEach(0, [](std::size_t) { FAIL(); });
}

TEST(RunEach, StopsAtWhatIsThrownAndThrowsItOn)
{
  for (const int threads : { 1, 3 })
  {
    const testing::Threads scope(threads);
    std::atomic<int>       ran = 0;
    constexpr int          items = 100000; // of 0.1 ms: the one that throws gets its turn before the others are through
    EXPECT_THROW(RunEach(items,
                         [&](std::size_t item) {
                           ++ran;
                           if (item == 5)
                           {
                             throw std::runtime_error("five");
                           }
                           std::this_thread::sleep_for(std::chrono::microseconds(100));
                         }),
                 std::runtime_error);
    EXPECT_LT(ran, items);
    EXPECT_THROW(RunEach(
                   1000,
                   [](std::size_t) {},
                   [](std::size_t) { throw std::logic_error("stop"); }),
                 std::logic_error);
  }
}

TEST(RunEach, MayRunMoreWorkFromDoneAndStopItself)
{
  for (const int threads : { 1, 3 })
  {
    const testing::Threads scope(threads);
    std::atomic<int>       ran = 0;
    const auto             more = [&](std::size_t) {
      RunEach(
        2,
        [&](std::size_t) { ++ran; },
        [&](std::size_t) { ++ran; });
    };
    RunEach(
      5,
      [](std::size_t) {},
      more);
    EXPECT_EQ(ran, 5 * (2 + 2));
  }
}

TEST(FirstFailure, IsThrownOnAfterTheLoopAndEndsIt)
{
  const testing::Threads scope(3);
  FirstFailure           none;
  none.Rethrow();
  EXPECT_FALSE(none.HasFailed());

  FirstFailure     failure;
  std::atomic<int> ran = 0;
  constexpr int    items = 100000;
#pragma omp parallel for schedule(dynamic, 1)
  for (int item = 0; item < items; ++item)
  {
    failure.Guard(static_cast<std::size_t>(item), [&] {
      ++ran;
      if (item == 5)
      {
        throw std::runtime_error("five");
      }
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    });
  }
  EXPECT_LT(ran, items);
  EXPECT_TRUE(failure.HasFailed());
  EXPECT_THROW(failure.Rethrow(), std::runtime_error);
}

TEST(FirstFailure, IsThatOfTheLowestNumberOfThoseThatRan)
{
  const testing::Threads scope(3);
  FirstFailure           failure;
  std::atomic<int>       begun = 0;
#pragma omp parallel for schedule(static, 1) num_threads(3)
  for (int item = 0; item < 3; ++item)
  {
    failure.Guard(static_cast<std::size_t>(item), [&] {
      for (++begun; begun < omp_get_num_threads();) // all are within before the first one throws
      {}
      throw std::runtime_error(std::to_string(item));
    });
  }
  std::string text;
  try
  {
    failure.Rethrow();
  }
  catch (const std::runtime_error & error)
  {
    text = error.what();
  }
  EXPECT_EQ(text, "0");
}

} // namespace
} // namespace voxelcore
