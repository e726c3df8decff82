#include "voxelcore/Base/Stopwatch.h"

#include <gtest/gtest.h>

#include <thread>

namespace voxelcore
{
namespace
{

TEST(Stopwatch, ALapBeginsWhereTheLastOneEnded)
{
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  Stopwatch  watch;
  const auto started = Clock::now();
  double     laps = 0;
  for (int lap = 0; lap < 3; ++lap)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const double seconds = watch.Lap();
    EXPECT_GE(seconds, 0.005);
    laps += seconds;
  }
  const auto ended = Clock::now();
  // Together they are the time from beginning to end, so that nothing counts twice and nothing is left out.
  EXPECT_LE(laps, std::chrono::duration<double>(ended - begin).count());
  watch.Lap();
  EXPECT_GE(laps, std::chrono::duration<double>(ended - started).count() - 0.05);
}

} // namespace
} // namespace voxelcore
