#include "voxelcore/Compare/ProbabilityExtension.h"
#include "voxelcore/Compare/ProbabilityJob.h"

#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Base/Text.h"
#include "voxelcore/Imaging/GreyVolume.h"

#include <cmath>
#include <limits>

namespace voxelcore::testing
{
namespace
{

class ProbabilityJob : public JobFolder
{
protected:
  /** A trunk of 0.95 along x, a branch of it along y that is as sure as told, a piece apart of 0.55, a loop of 0.95. */
  static float
  ValueAt(int x, int y, int z, float branch)
  {
    const auto within = [](double away) { return away < 3; };
    if (within(std::hypot(y - 20.0, z - 10.0)) && x >= 5 && x < 55)
    {
      return 0.95F;
    }
    if (within(std::hypot(x - 22.0, z - 10.0)) && y >= 20 && y < 38)
    {
      return branch;
    }
    if (within(std::hypot(x - 12.0, z - 10.0)) && y >= 26 && y < 40)
    {
      return 0.55F;
    }
    return within(std::hypot(std::hypot(x - 42.0, y - 20.0) - 8, z - 10.0)) ? 0.95F : 0.0F;
  }
  void
  Write(const std::string & name, float branch, float scale = 1, float one = 0) const
  {
    ImageGeometry geometry;
    geometry.size = { 60, 45, 20 };
    geometry.spacing = { 0.5, 0.5, 0.5 };
    WriteFloatVolume(At(name), geometry, [&](std::int64_t k, std::span<float> slice) {
      for (std::size_t i = 0; i < slice.size(); ++i)
      {
        slice[i] = ValueAt(static_cast<int>(i % 60), static_cast<int>(i / 60), static_cast<int>(k), branch);
        slice[i] = scale > 1 ? std::round(slice[i] * scale) : slice[i];
      }
      slice[3] = k == 3 ? one : slice[3];
    });
  }
  ProbabilityResult
  Run(const std::string & map, const std::string & output, ParameterValues more = {}) const
  {
    more.insert({ { "probability", "true" }, { "scan", At(map) }, { "output", At(output) }, { "force", "true" } });
    return RunProbabilityJob(ProbabilityOptionsFrom(more));
  }
  void
  ExpectRefused(const std::string & map, const std::string & why, ParameterValues more = {}) const
  {
    const std::set<std::string> before = Names();
    try
    {
      Run(map, "refused.vtp", std::move(more));
      ADD_FAILURE() << why;
    }
    catch (const std::exception & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
    EXPECT_EQ(Names(), before);
  }
};

TEST_F(ProbabilityJob, EachThresholdHasATreeAndTheChosenOneKeepsWhatIsStable)
{
  Write("map.nrrd", 0.55F);
  const auto result = Run("map.nrrd", "t.vtp", { { "thresholds", "0.7,0.5,0.3,0.97" }, { "also", "csv" } });
  EXPECT_EQ(Names(),
            (std::set<std::string>{ "map.nrrd",
                                    "t.vtp",
                                    "t_branches.csv",
                                    "t_summary.csv",
                                    "t_columns.json",
                                    "t_threshold-0.3.vtp",
                                    "t_threshold-0.5.vtp",
                                    "t_threshold-0.7.vtp",
                                    "t_thresholds.csv",
                                    "t_thresholds_columns.json" }));
  ASSERT_EQ(result.thresholds.size(), 4U);
  EXPECT_EQ(result.thresholds[0].topology.betti[0], 2);
  EXPECT_EQ(result.thresholds[2].topology.betti[0], 1);
  EXPECT_GE(result.thresholds[2].topology.betti[1], 1);
  EXPECT_EQ(result.thresholds[3].voxels, 0U);
  EXPECT_TRUE(result.thresholds[1].isChosen);
  const SkeletonModel tree = ReadSkeletonVtp(At("t.vtp"));
  ASSERT_EQ(tree.parts.at(0).lives.size(), tree.parts[0].graph.BranchCount());
  for (const BranchLife & life : tree.parts[0].lives)
  {
    EXPECT_EQ(life.lowest, 0.3);
    EXPECT_TRUE(life.highest == 0.5 || life.highest == 0.7) << life.highest;
  }
  EXPECT_EQ(tree.parts[0].graph.BranchCount(), result.thresholds[1].branches);
}

TEST_F(ProbabilityJob, InAFolderFilesHaveTheMapsName)
{
  Write("map.nrrd", 0.55F);
  Run("map.nrrd", "t.vtp", { { "thresholds", "0.5,0.7" } });
  Run("map.nrrd", "folder/", { { "thresholds", "0.5,0.7" } });
  for (const std::string ending : { ".vtp", "_threshold-0.5.vtp", "_threshold-0.7.vtp", "_thresholds.csv" })
  {
    EXPECT_EQ(Bytes("folder/map_skeleton" + ending), Bytes("t" + ending)) << ending;
  }
}

TEST_F(ProbabilityJob, EndsAndPiecesThatAreNotStableAreLeftOut)
{
  Write("map.nrrd", 0.55F);
  const auto   result = Run("map.nrrd", "t.vtp", { { "thresholds", "0.4,0.5,0.6" } });
  const auto   all = ReadSkeletonVtp(At("t_threshold-0.5.vtp"));
  const auto   kept = ReadSkeletonVtp(At("t.vtp"));
  const auto   sure = ReadSkeletonVtp(At("t_threshold-0.6.vtp"));
  const auto & record = result.report.labels.at(0);
  EXPECT_TRUE(result.thresholds[1].isChosen);
  EXPECT_EQ(result.thresholds[1].topology.betti[0], 2);
  EXPECT_EQ(record.shape.betti[0], 1); // without the piece
  EXPECT_EQ(record.skeleton->topology, record.shape);
  EXPECT_LT(kept.parts[0].graph.BranchCount(), all.parts[0].graph.BranchCount());
  EXPECT_EQ(kept.parts[0].graph.BranchCount(), sure.parts[0].graph.BranchCount());
  EXPECT_EQ(record.skeleton->numbers.branches, kept.parts[0].graph.BranchCount());
  EXPECT_EQ(record.skeleton->numbers.cycles, record.shape.betti[1]);
  // Nothing is left of it where all must be stable, and everything where nothing need be.
  ExpectRefused("map.nrrd", "less persistence", { { "thresholds", "0.4,0.5" } });
  Run("map.nrrd", "t.vtp", { { "thresholds", "0.4,0.5,0.6" }, { "persistence", "0" } });
  EXPECT_EQ(ReadSkeletonVtp(At("t.vtp")).parts[0].graph.BranchCount(), all.parts[0].graph.BranchCount());
}

TEST_F(ProbabilityJob, TheTreeOfAThresholdIsThatOfAScanTakenFromIt)
{
  Write("map.nrrd", 0.7F);
  Run("map.nrrd", "t.vtp", { { "thresholds", "0.3,0.7" } }); // 0.7 is less than 0.7 in float32
  ParameterValues values{ { "scan", At("map.nrrd") },
                          { "threshold", RoundTripText(static_cast<double>(0.7F)) + ":inf" },
                          { "output", At("plain.vtp") } };
  RunSkeletonJob(SkeletonOptionsFrom(values));
  EXPECT_EQ(Bytes("plain.vtp"), Bytes("t_threshold-0.7.vtp"));
}

TEST_F(ProbabilityJob, WholeNumbersUpTo255StandForProbabilities)
{
  Write("map.nrrd", 0.55F);
  Write("bytes.nrrd", 0.55F, 255);
  const auto a = Run("map.nrrd", "a.vtp", { { "thresholds", "0.3,0.5,0.7" } });
  const auto b = Run("bytes.nrrd", "b.vtp", { { "thresholds", "0.3,0.5,0.7" } });
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(a.thresholds[i].voxels, b.thresholds[i].voxels);
    EXPECT_EQ(a.thresholds[i].length, b.thresholds[i].length);
  }
  EXPECT_EQ(ReadSkeletonVtp(At("a.vtp")).parts[0].graph.positions,
            ReadSkeletonVtp(At("b.vtp")).parts[0].graph.positions);
}

TEST_F(ProbabilityJob, WhatIsNoMapIsRefusedAndNothingIsWritten)
{
  Write("map.nrrd", 0.55F);
  Write("large.nrrd", 0.55F, 1, 300);
  Write("mixed.nrrd", 0.55F, 1, 7);
  Write("below.nrrd", 0.55F, 1, -1);
  Write("none.nrrd", 0.55F, 1, std::numeric_limits<float>::quiet_NaN());
  ExpectRefused("large.nrrd", "no probabilities");
  ExpectRefused("mixed.nrrd", "not all whole");
  ExpectRefused("below.nrrd", "from -1 to 0.95");
  ExpectRefused("none.nrrd", "finite");
  ExpectRefused("map.nrrd", "above 0 and up to 1", { { "thresholds", "0.5,1.2" } });
  ExpectRefused("map.nrrd", "each once", { { "thresholds", "0.5,0.50" } });
  ExpectRefused("map.nrrd", "2 to 100", { { "thresholds", "0.5" } });
  ExpectRefused("map.nrrd", "a number from 0 to 1", { { "persistence", "2" } });
  ExpectRefused("map.nrrd", "leave out --binary", { { "binary", "true" } });
  ExpectRefused("map.nrrd", "written as .vtp", { { "output", At("refused.csv") } });
  ExpectRefused("map.nrrd", "no voxel lies", { { "thresholds", "0.98,0.99" } });
  EXPECT_THROW(kProbabilityExtension.isAsked({ { "scan", "a.nrrd" }, { "thresholds", "0.5" } }), UsageError);
  EXPECT_FALSE(kProbabilityExtension.isAsked({ { "scan", "a.nrrd" } }));
}

TEST_F(ProbabilityJob, TheTableOfThresholdsSaysWhatWasFound)
{
  Write("map.nrrd", 0.55F);
  const auto        result = Run("map.nrrd", "t.vtp", { { "thresholds", "0.3,0.5,0.7" } });
  const std::string text = ThresholdsText(result);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_NE(text.find("chosen"), std::string::npos);
  const std::string table = Bytes("t_thresholds.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "threshold,voxels,pieces,loops,branches,length,stable_branches,stable_length,chosen");
  EXPECT_NE(table.find("\n0.5," + std::to_string(result.thresholds[1].voxels) + ","), std::string::npos);
}

} // namespace
} // namespace voxelcore::testing
