#include "JobFolder.h"

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/ReconstructJob.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

class ReconstructJob : public JobFolder
{
protected:
  ReconstructOptions
  Options(const std::string & core, const std::string & output) const
  {
    ReconstructOptions options;
    options.core = At(core);
    options.output = At(output);
    return options;
  }
};

TEST_F(ReconstructJob, AWholeCoreOfCubesGivesTheScansLabels)
{
  Phantom("cells", "a.nrrd", "16");
  Core("core.vtp", { { "lambda", "0" } });
  ReconstructOptions options = Options("core.vtp", "again.nrrd");
  options.scan = At("a.nrrd");
  options.report = At("again.json");
  const ReconstructResult result = RunReconstructJob(options);
  const auto              before = ReadLabelVolume(At("a.nrrd"), {}).labels;
  const auto              after = ReadLabelVolume(At("again.nrrd"), {}).labels;
  ASSERT_EQ(after.size(), before.size());
  ASSERT_EQ(result.labels.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    EXPECT_EQ(after[i].value, before[i].value);
    EXPECT_EQ(after[i].voxels, before[i].voxels);
    EXPECT_EQ(after[i].shape.Box().lower, before[i].shape.Box().lower);
    EXPECT_EQ(result.labels[i].contested, 0U);
    EXPECT_EQ(result.labels[i].comparison->dice, 1.0);
    EXPECT_EQ(result.labels[i].comparison->surfaceDistanceMm, 0.0);
    EXPECT_LT(result.labels[i].comparison->boundaryGapMm, 1e-9);
  }
  const auto json = nlohmann::json::parse(Bytes("again.json"));
  EXPECT_EQ(json.at("labels").size(), before.size());
  EXPECT_EQ(json.at("labels").at(0).at("dice"), 1.0);
  EXPECT_NE(ReconstructText(result).find("Dice"), std::string::npos);
}

TEST_F(ReconstructJob, AnyVoxelWhoseCentreIsInABallIsInAndNoOther)
{
  Phantom("capsule", "a.nrrd");
  Core("core.vtp", { { "lambda", "2vox" } });
  const ReconstructResult result = RunReconstructJob(Options("core.vtp", "again.nrrd"));
  const auto              core = ReadModel(At("core.vtp")).parts.at(0).core;
  const LabelMap          volume = ReadLabelVolume(At("again.nrrd"), {});
  const VoxelShape &      shape = volume.labels.at(0).shape;
  for (std::int32_t z = 0; z < 20; ++z)
  {
    for (std::int32_t y = 0; y < 20; ++y)
    {
      for (std::int32_t x = 0; x < 20; ++x)
      {
        double least = 1e9;
        for (std::size_t ball = 0; ball < core.radius.size(); ++ball)
        {
          const auto & c = core.positions[ball];
          least = std::min(least, std::hypot(c[0] - x, c[1] - y, c[2] - z) - core.radius[ball]);
        }
        if (std::abs(least) > 1e-9) // on a ball either is right
        {
          ASSERT_EQ(shape.Contains(x, y, z), least < 0) << x << ' ' << y << ' ' << z;
        }
      }
    }
  }
  EXPECT_FALSE(result.labels.at(0).comparison) << "there was nothing to compare with";
  EXPECT_EQ(ReconstructText(result).find("Dice"), std::string::npos);
}

TEST_F(ReconstructJob, WhatDoesNotFitIsRefusedAndLeavesNothing)
{
  Phantom("ball", "a.nrrd");
  Phantom("ball", "other.nrrd", "12");
  Core("core.vtp");
  const auto         before = Names();
  ReconstructOptions options = Options("core.vtp", "again.nrrd");
  options.scan = At("other.nrrd");
  EXPECT_THROW(RunReconstructJob(options), InputError) << "another size";
  options.like = At("other.nrrd");
  EXPECT_THROW(RunReconstructJob(options), UsageError);
  EXPECT_THROW(RunReconstructJob(Options("a.nrrd", "again.nrrd")), InputError);
  EXPECT_THROW(RunReconstructJob(Options("core.vtp", "again.xyz")), UsageError);
  EXPECT_THROW(RunReconstructJob(Options("core.vtp", "a.nrrd")), OutputError) << "is there already";
  EXPECT_THROW(RunReconstructJob(Options("core.vtp", "again.nrrd"), StoppingAfter(1)), Cancelled);
  EXPECT_EQ(Names(), before);
}

} // namespace
} // namespace voxelcore::testing
