#include "TimeLeft.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

TEST(TimeLeft, IsUnknownBeforeACaseHasFinished)
{
  EXPECT_FALSE(SecondsLeft({}, { 100 }, 5, 2).has_value());
}

TEST(TimeLeft, WaitingCasesTakeTheMedianSideBySide)
{
  EXPECT_EQ(SecondsLeft({ 10 }, {}, 4, 1), 40.0);
  EXPECT_EQ(SecondsLeft({ 10 }, {}, 4, 2), 20.0);
  EXPECT_EQ(SecondsLeft({ 1000, 10, 10 }, {}, 1, 4), 10.0) << "one slow case does not count, and no case is shared out";
}

TEST(TimeLeft, WhatRunningCasesHaveDoneCounts)
{
  EXPECT_EQ(SecondsLeft({ 10 }, { 4 }, 0, 1), 6.0);
  EXPECT_EQ(SecondsLeft({ 10 }, { 4, 10 }, 1, 2), 10.0);
}

TEST(TimeLeft, NeverRisesWhileCasesRun)
{
  double last = 1e9;
  for (double second = 0; second < 100; ++second)
  {
    const double left = SecondsLeft({ 20, 30, 25 }, { second, second / 2 }, 3, 2).value();
    EXPECT_LE(left, last) << second;
    last = left;
  }
}

} // namespace
} // namespace voxelcore
