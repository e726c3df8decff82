#include "voxelcore/RunBoth.h"

#include "VoxelCoreTesting/Threads.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <thread>

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

} // namespace
} // namespace voxelcore
