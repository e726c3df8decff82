#include "voxelcore/SideBySide.h"

#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
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

} // namespace
} // namespace voxelcore
