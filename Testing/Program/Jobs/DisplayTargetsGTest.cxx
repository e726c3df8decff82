#include "JobFolder.h"

#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/RenderJob.h"

namespace voxelcore::testing
{
namespace
{

using DisplayTargetsOfJobs = JobFolder;

TEST_F(DisplayTargetsOfJobs, ASceneHasItsDataInAFolderBesideIt)
{
  if (!HasDisplay())
  {
    GTEST_SKIP() << "this build has no scenes";
  }
  Phantom("ball", "a.nrrd", "12");
  Core("a.vtp", { { "scene", At("view.mrml") } });
  EXPECT_TRUE(Names().contains("view_Data")) << "STEM_Data";
  const std::string scene = Bytes("view.mrml");
  std::size_t       files = 0;
  for (const auto & entry : std::filesystem::directory_iterator(At("view_Data")))
  {
    EXPECT_NE(scene.find("view_Data/" + entry.path().filename().string()), std::string::npos) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 2U) << "a segmentation and a surface";
  Core("b.vtp", { { "scene", At("whole.mrb") } });
  EXPECT_FALSE(Names().contains("whole_Data")) << "all is in one file";
  EXPECT_EQ(Bytes("whole.mrb").substr(0, 2), "PK");
}

TEST_F(DisplayTargetsOfJobs, APageHasAtMostAboutSoManyTriangles)
{
  try
  {
    RequirePages();
  }
  catch (const UsageError & error)
  {
    EXPECT_NE(std::string(error.what()).find("--html"), std::string::npos) << error.what();
    GTEST_SKIP() << "this build makes no pages";
  }
  Phantom("ball", "a.nrrd", "24");
  Core("a.vtp", { { "html", At("all.html") } });
  Core("b.vtp", { { "html", At("few.html") }, { "html-triangles", "1000" } });
  EXPECT_LT(Bytes("few.html").size(), Bytes("all.html").size());
  EXPECT_EQ(Bytes("a.vtp"), Bytes("b.vtp")) << "what is shown does not change what is written";
}

TEST_F(DisplayTargetsOfJobs, WhatIsNoSceneIsRefusedBeforeAnythingIsDone)
{
  Phantom("ball", "a.nrrd", "12");
  EXPECT_THROW(Core("a.vtp", { { "scene", At("view.txt") } }), UsageError);
  EXPECT_THROW(Core("a.vtp", { { "html", At("view.txt") } }), UsageError);
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd" }));
}

} // namespace
} // namespace voxelcore::testing
