// What is refused before anything is drawn. That pictures are right is tested through the program
// (Testing/Applications), which finds a display.

#include "JobFolder.h"

#include "voxelcore/Jobs/RenderJob.h"

namespace voxelcore::testing
{
namespace
{

class RenderJob : public JobFolder
{
protected:
  RenderJobOptions
  Options(const std::string & file, const std::string & output) const
  {
    RenderJobOptions options;
    options.files = { At(file) };
    options.output = At(output);
    return options;
  }
};

TEST_F(RenderJob, ABuildWithoutADisplaySaysSo)
{
  if (HasDisplay())
  {
    GTEST_SKIP() << "this build can draw";
  }
  EXPECT_THROW(RunRenderJob(Options("core.vtp", "a.png")), UsageError);
}

TEST_F(RenderJob, WhatCannotBeDrawnIsRefusedAndLeavesNothing)
{
  if (!HasDisplay())
  {
    GTEST_SKIP() << "this build cannot draw";
  }
  Phantom("capsule", "a.nrrd", "16");
  Core("core.vtp", { { "with-skeleton", "true" } });
  const auto before = Names();
  ASSERT_TRUE(before.contains("core_skeleton.vtp"));
  EXPECT_THROW(RunRenderJob(Options("core.vtp", "a.jpg")), UsageError);
  EXPECT_THROW(RunRenderJob(Options("none.vtp", "a.png")), InputError);
  EXPECT_THROW(RunRenderJob(Options("a.nrrd", "a.png")), UsageError) << "no result";
  RenderJobOptions lambda = Options("core_skeleton.vtp", "a.png");
  lambda.coloring = "Lambda";
  EXPECT_THROW(RunRenderJob(lambda), UsageError) << "a skeleton has none";
  RenderJobOptions missing = Options("core.vtp", "a.png");
  missing.labels = "9";
  EXPECT_THROW(RunRenderJob(missing), InputError);
  EXPECT_THROW(RunRenderJob(Options("core.vtp", "a.png"), StoppingAfter(1)), Cancelled);
  EXPECT_EQ(Names(), before);
}

TEST_F(RenderJob, APictureThatIsThereIsReplacedOnlyWhenForced)
{
  if (!HasDisplay())
  {
    GTEST_SKIP() << "this build cannot draw";
  }
  WriteAll(At("a.png"), "mine");
  EXPECT_THROW(RunRenderJob(Options("core.vtp", "a.png")), OutputError);
  WriteAll(At("b_001.png"), "mine");
  RenderJobOptions turn = Options("core.vtp", "b.png");
  turn.turntable = 3;
  EXPECT_THROW(RunRenderJob(turn), OutputError) << "the second frame's name is taken";
  EXPECT_EQ(Bytes("b_001.png"), "mine");
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.png", "b_001.png" }));
}

} // namespace
} // namespace voxelcore::testing
