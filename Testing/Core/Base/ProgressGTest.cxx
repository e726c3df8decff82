#include "voxelcore/Base/Progress.h"

#include <gtest/gtest.h>

#include <string>

namespace voxelcore
{
namespace
{

TEST(ReportProgress, NobodyNeedsToWatch)
{
  EXPECT_NO_THROW(ReportProgress({}, "core", 0.5));
}

TEST(ReportProgress, HandsOnStageAndFractionAndThrowsCancelledOnceToldToStop)
{
  std::string heard;
  bool        goOn = true;
  const auto  listener = [&](std::string_view stage, double fraction) {
    heard += std::string(stage) + " " + std::to_string(fraction) + ";";
    return goOn;
  };
  ReportProgress(listener, "delaunay", 0.25);
  EXPECT_EQ(heard, "delaunay 0.250000;");
  goOn = false;
  EXPECT_THROW(ReportProgress(listener, "core", 1), Cancelled);
  EXPECT_EQ(heard, "delaunay 0.250000;core 1.000000;");
}

} // namespace
} // namespace voxelcore
