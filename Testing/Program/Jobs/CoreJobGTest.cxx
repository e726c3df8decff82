#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <cstdint>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WriteAll;

TEST(ProcessLabel, TellsWhatWasFound)
{
  VoxelShape shape(VoxelBox{ { 2, 3, 4 }, { 1, 1, 7 } });
  for (std::int32_t k = 0; k < 7; ++k)
  {
    shape.Insert(2, 3, 4 + k);
  }
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = { 2, 2, 2 };
  CertifiedRequest request;
  request.lambdas = ParseLambdas("0,1.5vox");
  const LabelOutcome outcome = ProcessLabel({ { 5, "rod", 7, shape }, 0, {} }, geometry, request);
  EXPECT_EQ(outcome.record.label, 5);
  EXPECT_EQ(outcome.record.core.vertices, 7U);
  EXPECT_EQ(outcome.record.core.edges, 6U);
  EXPECT_DOUBLE_EQ(outcome.record.volumeMm3, 56);
  EXPECT_TRUE(outcome.record.Passed());
  ASSERT_EQ(outcome.parts.size(), 2U);
  EXPECT_EQ(outcome.parts[1].label, 5);
  EXPECT_EQ(outcome.record.pruned[1].lambda, "1.5vox");
}

/** A raw NRRD of bytes, 12 x 10 x 8 voxels of 1 x 1 x 2 mm with two blocks, labels 1 and 5. */
void
WriteScan(const std::filesystem::path & path)
{
  std::string voxels(12 * 10 * 8, '\0');
  for (std::size_t z = 1; z < 7; ++z)
  {
    for (std::size_t y = 1; y < 9; ++y)
    {
      for (std::size_t x = 1; x < 11; ++x)
      {
        if (x != 6)
        {
          voxels[(z * 10 + y) * 12 + x] = x < 6 ? 1 : 5;
        }
      }
    }
  }
  WriteAll(path,
           "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 12 10 8\nspace: left-posterior-superior\n"
           "space directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (3,4,5)\nencoding: raw\n\n" +
             voxels);
}

CoreOptions
Options(const std::filesystem::path & scan, const std::filesystem::path & output)
{
  CoreOptions options;
  options.scan = scan;
  options.output = output;
  options.lambdas = ParseLambdas("0,1.5vox");
  return options;
}

TEST(CoreJob, AFolderReceivesAFilePerLabelAndLambda)
{
  const TemporaryFolder folder;
  WriteScan(folder / "s.nrrd");
  const CoreResult result = RunCoreJob(Options(folder / "s.nrrd", folder / "new/"));
  ASSERT_EQ(result.report.labels.size(), 2U);
  std::set<std::string> names;
  for (const auto & entry : std::filesystem::directory_iterator(folder / "new"))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{ "s_label-1_medial_lambda-0.vtp",
                                    "s_label-1_medial_lambda-1.5vox.vtp",
                                    "s_label-5_medial_lambda-0.vtp",
                                    "s_label-5_medial_lambda-1.5vox.vtp",
                                    "s_medial_finished.jsonl" }));
}

TEST(CoreJob, AFileDoesNotDependOnWhatElseTheRunMakes)
{
  const TemporaryFolder folder;
  WriteScan(folder / "s.nrrd");
  RunCoreJob(Options(folder / "s.nrrd", folder / "all/"));
  CoreOptions one = Options(folder / "s.nrrd", folder / "one.vtp");
  one.lambdas = ParseLambdas("1.5vox");
  one.reading.labels = "5";
  RunCoreJob(one);
  EXPECT_EQ(ReadAll(folder / "one.vtp"), ReadAll(folder / "all/s_label-5_medial_lambda-1.5vox.vtp"));
}

TEST(CoreJob, CancellingAtAnyMomentLeavesNothing)
{
  const TemporaryFolder folder;
  WriteScan(folder / "s.nrrd");
  int        calls = 0;
  JobContext counting;
  counting.progress = [&calls](std::string_view, double) {
    ++calls;
    return true;
  };
  CoreOptions options = Options(folder / "s.nrrd", folder / "m.vtp");
  options.report = folder / "r.json";
  const auto clear = [&folder] {
    for (const char * name : { "m_lambda-0.vtp", "m_lambda-1.5vox.vtp", "r.json" })
    {
      EXPECT_TRUE(std::filesystem::remove(folder / name)) << name;
    }
  };
  RunCoreJob(options, counting);
  clear();
  ASSERT_GT(calls, 5);
  for (int stop = 0; stop < calls; ++stop)
  {
    int        seen = 0;
    JobContext stopping;
    stopping.progress = [&](std::string_view, double) { return seen++ != stop; };
    try
    {
      RunCoreJob(options, stopping);
      // An engine that polls by the clock may call a little less often from run to run.
      clear();
      EXPECT_LE(seen, stop);
    }
    catch (const Cancelled &)
    {}
    EXPECT_EQ(folder.Names(), std::set<std::string>{ "s.nrrd" }) << "stopped at call " << stop;
  }
}

TEST(CoreJob, CancellingLeavesWholeLabelsInAFolder)
{
  const TemporaryFolder folder;
  WriteScan(folder / "s.nrrd");
  RunCoreJob(Options(folder / "s.nrrd", folder / "whole/"));
  int       seen = 0;
  bool      isDone = false;
  const int most = 100000;
  for (int stop = 0; !isDone && stop < most; stop += 1 + stop / 8)
  {
    JobContext stopping;
    seen = 0;
    stopping.progress = [&](std::string_view, double) { return seen++ != stop; };
    try
    {
      RunCoreJob(Options(folder / "s.nrrd", folder / "new/"), stopping);
      isDone = true;
    }
    catch (const Cancelled &)
    {}
    for (const auto & entry : std::filesystem::directory_iterator(folder.Path()))
    {
      EXPECT_TRUE(entry.path().filename() == "s.nrrd" || entry.is_directory());
    }
    std::error_code none;
    for (const auto & entry : std::filesystem::directory_iterator(folder / "new", none))
    {
      if (entry.path().extension() == ".vtp")
      {
        EXPECT_EQ(ReadAll(entry.path()), ReadAll(folder / "whole" / entry.path().filename()));
      }
      else
      {
        EXPECT_EQ(entry.path().filename(), "s_medial_finished.jsonl");
      }
    }
  }
  EXPECT_TRUE(isDone);
}

TEST(CoreJob, ProgressNeverRunsBackwards)
{
  const TemporaryFolder folder;
  WriteScan(folder / "s.nrrd");
  double     last = 0;
  JobContext context;
  context.progress = [&last](std::string_view stage, double fraction) {
    EXPECT_GE(fraction, last) << stage;
    EXPECT_LE(fraction, 1) << stage;
    last = fraction;
    return true;
  };
  RunCoreJob(Options(folder / "s.nrrd", folder / "a.vtp"), context);
  EXPECT_EQ(last, 1);
}

} // namespace
} // namespace voxelcore
