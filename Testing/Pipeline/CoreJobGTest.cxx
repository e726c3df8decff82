#include "TemporaryFolder.h"
#include "voxelcore/CoreJob.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"

#include <cstdint>
#include <gtest/gtest.h>
#include <random>

namespace voxelcore
{
namespace
{

using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WriteAll;

VoxelShape
Box(std::int32_t x, std::int32_t y, std::int32_t z)
{
  VoxelShape shape(VoxelBox{ { 2, 3, 4 }, { x, y, z } });
  for (std::int32_t k = 0; k < z; ++k)
  {
    for (std::int32_t j = 0; j < y; ++j)
    {
      for (std::int32_t i = 0; i < x; ++i)
      {
        shape.Insert(2 + i, 3 + j, 4 + k);
      }
    }
  }
  return shape;
}

LabelShape
Label(VoxelShape shape)
{
  const std::uint64_t voxels = shape.CountVoxels();
  return { 1, "thing", voxels, std::move(shape) };
}

LabelOutcome
Process(VoxelShape shape, const Vector3 & spacing, const std::string & lambdas)
{
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = spacing;
  return ProcessLabel(Label(std::move(shape)),
                      geometry,
                      ComputeSpacingWeights(spacing),
                      ParseLambdas(lambdas),
                      Engine::Auto);
}

TEST(ProcessLabel, ASingleVoxelHasOneVertex)
{
  const LabelOutcome outcome = Process(Box(1, 1, 1), { 2, 2, 2 }, "0,1.5vox");
  EXPECT_EQ(outcome.record.boundaryVertices, 8U);
  EXPECT_EQ(outcome.record.core.vertices, 1U);
  EXPECT_EQ(outcome.record.core.edges, 0U);
  EXPECT_DOUBLE_EQ(outcome.record.core.maxRadiusMm, std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(outcome.record.volumeMm3, 8);
  EXPECT_TRUE(outcome.record.Passed());
  ASSERT_EQ(outcome.parts.size(), 2U);
  EXPECT_EQ(outcome.parts[1].core.cells.vertexCount, 1U);
  // Voxel (2,3,4) of a scan with 2 mm voxels at the origin.
  EXPECT_EQ(outcome.parts[0].core.positions[0], (std::array<double, 3>{ 4, 6, 8 }));
}

TEST(ProcessLabel, ARodIsAChain)
{
  const LabelOutcome outcome = Process(Box(1, 1, 7), { 1, 1, 1 }, "0");
  EXPECT_EQ(outcome.record.core.vertices, 7U);
  EXPECT_EQ(outcome.record.core.edges, 6U);
  EXPECT_EQ(outcome.record.core.faces, 0U);
}

TEST(ProcessLabel, SeveralLambdasGiveWhatEachGivesAlone)
{
  const LabelOutcome together = Process(Box(9, 7, 5), { 1, 1, 2 }, "2mm,0,1.5vox,1.5mm,100mm");
  ASSERT_EQ(together.parts.size(), 5U);
  std::size_t which = 0;
  for (const char * lambda : { "2mm", "0", "1.5vox", "1.5mm", "100mm" })
  {
    const LabelOutcome alone = Process(Box(9, 7, 5), { 1, 1, 2 }, lambda);
    EXPECT_EQ(alone.parts[0].core.positions, together.parts[which].core.positions) << lambda;
    EXPECT_EQ(alone.parts[0].core.cells.faceVertices, together.parts[which].core.cells.faceVertices) << lambda;
    EXPECT_EQ(alone.record.pruned[0].lambdaMm, together.record.pruned[which].lambdaMm) << lambda;
    EXPECT_EQ(alone.record.pruned[0].complex.areaMm2, together.record.pruned[which].complex.areaMm2) << lambda;
    ++which;
  }
  EXPECT_EQ(together.record.pruned[4].complex.vertices, 1U) << "all of a ball prunes to a point";
}

TEST(ProcessLabel, RandomShapesPassAtAnyLambda)
{
  const std::uint64_t seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  for (int round = 0; round < 40; ++round)
  {
    const auto                       side = static_cast<std::int32_t>(3 + random() % 7);
    std::uniform_real_distribution<> uniform(0, 1);
    const double                     density = uniform(random);
    VoxelShape                       shape(VoxelBox{ { 5, 0, 1 }, { side, side, side } });
    for (std::int32_t v = 0; v < side * side * side; ++v)
    {
      if (v == 0 || uniform(random) < density)
      {
        shape.Insert(5 + v % side, v / side % side, 1 + v / side / side);
      }
    }
    const LabelOutcome outcome = Process(CropToVoxels(shape), { 3, 3, 7 }, "0,1vox,2vox,50%");
    EXPECT_TRUE(outcome.record.Passed());
    EXPECT_EQ(outcome.record.pruned[0].complex.faces, outcome.record.core.faces);
    EXPECT_LE(outcome.record.pruned[2].complex.faces, outcome.record.pruned[1].complex.faces);
  }
}

TEST(IsEnclosed, SeesAVertexOnTheBoundaryOrOutside)
{
  const VoxelShape shape = Box(2, 1, 1); // [2,4] x [3,4] x [4,5]
  MedialComplex    core;
  const auto       at = [&](double x, double y, double z) {
    core.positions = { { x, y, z } };
    return IsEnclosed(core, shape);
  };
  EXPECT_TRUE(at(2.5, 3.5, 4.5));
  EXPECT_TRUE(at(3, 3.5, 4.5)) << "on the inner face";
  EXPECT_FALSE(at(2, 3.5, 4.5)) << "on an outer face";
  EXPECT_FALSE(at(3, 3, 4.5)) << "on an outer edge";
  EXPECT_FALSE(at(4, 4, 5)) << "on a corner";
  EXPECT_FALSE(at(1.5, 3.5, 4.5)) << "outside";
  EXPECT_FALSE(at(2.5, -3.5, 4.5)) << "outside";
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
