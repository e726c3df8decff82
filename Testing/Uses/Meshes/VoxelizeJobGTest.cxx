#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Meshes/VoxelizeJob.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace voxelcore::testing
{
namespace
{

class VoxelizeJob : public JobFolder
{
protected:
  VoxelizeJobOptions
  Options(const std::vector<std::int64_t> & resolutions, const std::string & output) const
  {
    VoxelizeJobOptions options;
    options.mesh = At("part.off");
    options.resolutions = resolutions;
    options.output = At(output);
    return options;
  }
};

TEST_F(VoxelizeJob, EachResolutionIsAVolumeOfItsOwn)
{
  BoxMesh("part.off");
  VoxelizeJobOptions options = Options({ 6, 12 }, "v.nrrd");
  options.report = At("v.json");
  const VoxelizeResult result = RunVoxelizeJob(options);
  EXPECT_EQ(Names(), (std::set<std::string>{ "part.off", "v_resolution-6.nrrd", "v_resolution-12.nrrd", "v.json" }));
  ASSERT_EQ(result.lines.size(), 2U);
  EXPECT_TRUE(result.warnings.empty());
  const auto volumes = nlohmann::json::parse(Bytes("v.json")).at("volumes");
  for (const std::int64_t resolution : { 6, 12 })
  {
    const std::string name = "v_resolution-" + std::to_string(resolution) + ".nrrd";
    const LabelMap    volume = ReadLabelVolume(At(name), {});
    const auto        voxels = static_cast<std::uint64_t>(resolution / 3 * (2 * resolution / 3) * resolution);
    EXPECT_EQ(volume.labels.at(0).value, 1);
    EXPECT_EQ(volume.labels.at(0).voxels, voxels);
    const std::size_t i = resolution == 6 ? 0 : 1;
    EXPECT_NE(result.lines[i].find(name), std::string::npos) << result.lines[i];
    EXPECT_NE(result.lines[i].find(std::to_string(voxels) + " of them in"), std::string::npos) << result.lines[i];
    EXPECT_EQ(volumes.at(i).at("voxels"), voxels);
  }
  VoxelizeJobOptions spaced = Options({}, "s.nrrd");
  spaced.spacing = Vector3{ 1, 1, 2 };
  RunVoxelizeJob(spaced);
  EXPECT_EQ(ReadLabelVolume(At("s.nrrd"), {}).labels.at(0).voxels, 2U * 4 * 3);
}

TEST_F(VoxelizeJob, AStudyHasARowForEachResolutionAndResult)
{
  BoxMesh("part.off");
  const StudyResult study =
    RunStudyJob(CoreOptionsFrom({ { "scan", At("part.off") }, { "output", At("c.vtp") }, { "lambda", "0,1vox" } }),
                { 6, 12 });
  EXPECT_EQ(study.table, At("c.csv"));
  ASSERT_EQ(study.runs.size(), 2U);
  std::istringstream       table(Bytes("c.csv"));
  std::vector<std::string> rows;
  for (std::string row; std::getline(table, row);)
  {
    EXPECT_TRUE(rows.empty() ||
                std::count(row.begin(), row.end(), ',') == std::count(rows[0].begin(), rows[0].end(), ','));
    rows.push_back(row);
  }
  ASSERT_EQ(rows.size(), 1U + 2 * 2);
  EXPECT_TRUE(rows[1].starts_with("6,1")) << rows[1];
  EXPECT_TRUE(rows[4].starts_with("12,0.5,")) << rows[4];
  for (const char * name : { "c_resolution-6_lambda-0.vtp", "c_resolution-12_lambda-1vox.vtp" })
  {
    EXPECT_TRUE(Names().contains(name)) << name;
  }
}

TEST_F(VoxelizeJob, WhatFailsLeavesNothing)
{
  BoxMesh("part.off");
  EXPECT_THROW(RunVoxelizeJob(Options({}, "v.nrrd")), UsageError) << "neither resolution nor spacing";
  VoxelizeJobOptions both = Options({ 6 }, "v.nrrd");
  both.spacing = Vector3{ 1, 1, 1 };
  EXPECT_THROW(RunVoxelizeJob(both), UsageError);
  VoxelizeJobOptions scan = Options({ 6 }, "v.nrrd");
  scan.mesh = At("a.nrrd");
  EXPECT_THROW(RunVoxelizeJob(scan), InputError);
  EXPECT_THROW(RunVoxelizeJob(Options({ 6 }, "v.xyz")), UsageError);
  EXPECT_THROW(RunVoxelizeJob(Options({ 6 }, "none/v.nrrd")), OutputError);
  EXPECT_THROW(RunVoxelizeJob(Options({ 6, 12 }, "v.nrrd"), StoppingAfter(4)), Cancelled);
  EXPECT_EQ(Names(), (std::set<std::string>{ "part.off" }));
  WriteAll(At("v_resolution-12.nrrd"), "mine");
  EXPECT_THROW(RunVoxelizeJob(Options({ 6, 12 }, "v.nrrd")), OutputError);
  EXPECT_EQ(Names(), (std::set<std::string>{ "part.off", "v_resolution-12.nrrd" })) << "all or nothing";
  CoreOptions study = CoreOptionsFrom({ { "scan", At("part.off") }, { "output", At("c.vtp") } });
  study.display.html = At("c.html");
  EXPECT_THROW(RunStudyJob(study, { 6, 12 }), UsageError);
}

} // namespace
} // namespace voxelcore::testing
