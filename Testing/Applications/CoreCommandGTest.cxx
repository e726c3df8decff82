// `voxelcore core` as a user runs it.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;
using Names = std::set<std::string>;

class CoreCommand : public ::testing::Test
{
protected:
  CoreCommand()
  {
    WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  }

  /** Runs `voxelcore core a.nrrd ...`, which must succeed and say nothing on stderr but what it sees in a mask; returns
   *  stdout. */
  std::string
  Core(const std::vector<std::string> & more, const std::string & scan = "a.nrrd")
  {
    std::vector<std::string> arguments{ "core", m_Folder / scan };
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(WithoutDiagnoses(result.error), "");
    return result.output;
  }

  TemporaryFolder m_Folder;
};

TEST_F(CoreCommand, TwoRunsGiveTheSameBytesWhereverTheyRun)
{
  Core({ "-o", m_Folder / "one.vtp", "--threads", "1", "--report", m_Folder / "one.json" });
  std::filesystem::create_directory(m_Folder / "moved");
  std::filesystem::copy_file(m_Folder / "a.nrrd", m_Folder / "moved/a.nrrd");
  Core({ "-o", m_Folder / "two.vtp", "--threads", "2", "--quiet" }, "moved/a.nrrd");
  EXPECT_FALSE(ReadAll(m_Folder / "one.vtp").empty());
  EXPECT_EQ(ReadAll(m_Folder / "one.vtp"), ReadAll(m_Folder / "two.vtp"));
}

TEST_F(CoreCommand, TheTableHasARowPerLabel)
{
  const std::string table = Core({ "-o", m_Folder / "out.vtp" });
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7) << table; // with a note on two labels that are lines now
  for (const char * word : { "label-1",
                             "label-2",
                             "label-9",
                             "voxels",
                             "boundary vertices",
                             "core faces",
                             "1.2diag",
                             "b0/b1/b2",
                             "passed",
                             "seconds" })
  {
    EXPECT_NE(table.find(word), std::string::npos) << word << " in\n" << table;
  }
  EXPECT_EQ(Core({ "-o", m_Folder / "quiet.vtp", "--quiet" }), "");
}

TEST_F(CoreCommand, TheReportSaysWhatIsInTheFile)
{
  Core({ "--labels", "1,9", "--lambda", "0,2mm", "-o", m_Folder / "out.vtp", "--report", m_Folder / "r.json" });
  const Json report = Json::parse(ReadAll(m_Folder / "r.json"));
  ASSERT_EQ(report["labels"].size(), 2U);
  EXPECT_EQ(report["labels"][0]["label"], 1);
  EXPECT_EQ(report["labels"][1]["label"], 9);
  EXPECT_EQ(report["labels"][0]["voxels"], 6 * 10 * 8 - 1);
  EXPECT_EQ(report["labels"][0]["shape"]["betti"], (Json{ 1, 0, 1 })) << "the cavity";
  EXPECT_EQ(report["labels"][0]["core"]["betti"], (Json{ 1, 0, 1 }));
  EXPECT_EQ(report["labels"][0]["pruned"][1]["betti"], (Json{ 1, 0, 1 }));
  EXPECT_EQ(report["labels"][1]["boundary_vertices"], 7 * 11 * 5 - 5 * 9 * 3);
  EXPECT_EQ(report["parameters"]["lattice_weights"], (Json{ 1, 1, 2 }));
  EXPECT_EQ(report["parameters"]["lattice_deviation"], 0);
  EXPECT_EQ(report["labels"][0]["pruned"][1]["output"], (m_Folder / "out_lambda-2mm.vtp").string());
  EXPECT_EQ(report["input"]["origin_mm"], (Json{ -5, 6.5, 7 }));
  EXPECT_TRUE(report["labels"][1]["certificate"]["passed"]);
  EXPECT_GT(report["peak_memory_mb"], 1);
  EXPECT_EQ(m_Folder.Names(), (Names{ "a.nrrd", "out_lambda-0.vtp", "out_lambda-2mm.vtp", "r.json" }));
}

TEST_F(CoreCommand, AFolderReceivesAFilePerLabel)
{
  Core({ "-o", (m_Folder / "deep/surfaces").string() + "/" });
  Names names;
  for (const auto & entry : std::filesystem::directory_iterator(m_Folder / "deep/surfaces"))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(
    names,
    (Names{ "a_label-1_medial.vtp", "a_label-2_medial.vtp", "a_label-9_medial.vtp", "a_medial_finished.jsonl" }));
}

TEST_F(CoreCommand, EveryFormatIsWritten)
{
  for (const char * extension : { "vtp", "vtk", "ply", "obj", "stl", "ma" })
  {
    const std::string name = std::string("out.") + extension;
    Core({ "-o", m_Folder / name });
    EXPECT_GT(std::filesystem::file_size(m_Folder / name), 500U) << name;
  }
}

TEST_F(CoreCommand, AFormatThatCannotHoldEdgesSaysHowManyItLeftOut)
{
  TestScan rod({ 3, 3, 9 });
  rod.Fill({ 1, 1, 1 }, { 1, 1, 7 }, 1);
  WriteNrrd(m_Folder / "rod.nrrd", rod);
  const std::string output = Core({ "--lambda", "0", "-o", m_Folder / "rod.stl" }, "rod.nrrd");
  EXPECT_NE(output.find("6 edges"), std::string::npos) << output;
}

TEST_F(CoreCommand, ForceReplaces)
{
  Core({ "-o", m_Folder / "out.vtp" });
  WriteAll(m_Folder / "new.vtp", "old");
  Core({ "-o", m_Folder / "new.vtp", "--force" });
  EXPECT_EQ(ReadAll(m_Folder / "new.vtp"), ReadAll(m_Folder / "out.vtp"));
}

TEST_F(CoreCommand, BinaryAndThresholdMakeOneShape)
{
  Core({ "--binary", "-o", m_Folder / "b.vtp", "--report", m_Folder / "b.json" });
  Core({ "--threshold", "2:9", "-o", m_Folder / "t.vtp", "--report", m_Folder / "t.json" });
  const Json binary = Json::parse(ReadAll(m_Folder / "b.json"));
  const Json threshold = Json::parse(ReadAll(m_Folder / "t.json"));
  ASSERT_EQ(binary["labels"].size(), 1U);
  ASSERT_EQ(threshold["labels"].size(), 1U);
  EXPECT_EQ(binary["labels"][0]["voxels"], 12 * 10 * 8 - 1);
  EXPECT_EQ(threshold["labels"][0]["voxels"], 6 * 10 * 8);
}

TEST_F(CoreCommand, CrossCheckRunsBothEnginesAndChangesNothing)
{
  const auto run = [this](const std::string & name, const std::vector<std::string> & more) {
    std::vector<std::string> arguments{ "core",     m_Folder / "a.nrrd",         "-o", m_Folder / (name + ".vtp"),
                                        "--report", m_Folder / (name + ".json"), "-q" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  };
  ASSERT_EQ(run("plain", {}).code, 0);
  const ProgramResult checked = run("checked", { "--cross-check" });
  if (checked.code == 2)
  {
    EXPECT_EQ(checked.error,
              "voxelcore: --cross-check needs TetGen, which this build lacks; configure it with "
              "-DVOXELCORE_TETGEN=ON\n");
    EXPECT_EQ(m_Folder.Names(), (Names{ "a.nrrd", "plain.json", "plain.vtp" }));
    EXPECT_EQ(RunProgram({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "t.vtp", "--engine", "tetgen" }).code, 1);
    return;
  }
  ASSERT_EQ(checked.code, 0) << checked.error;
  EXPECT_EQ(ReadAll(m_Folder / "plain.vtp"), ReadAll(m_Folder / "checked.vtp"));
  EXPECT_EQ(Json::parse(ReadAll(m_Folder / "plain.json"))["parameters"]["cross_check"], false);
  EXPECT_EQ(Json::parse(ReadAll(m_Folder / "checked.json"))["parameters"]["cross_check"], true);
  EXPECT_EQ(UnpackedVtp(ReadAll(m_Folder / "checked.vtp")).find("cross_check"), std::string::npos);
}

TEST_F(CoreCommand, ProgressComesAsAsked)
{
  const auto run = [this](const std::string & style) {
    return RunProgram({ "core", m_Folder / "a.nrrd", "-o", m_Folder / (style + ".vtp"), "--progress", style });
  };
  const ProgramResult plain = run("plain");
  EXPECT_NE(plain.error.find("delaunay"), std::string::npos) << plain.error;
  EXPECT_NE(plain.error.find("100 %"), std::string::npos) << plain.error;
  const ProgramResult json = run("json");
  ASSERT_FALSE(json.error.empty());
  double             last = 0;
  std::istringstream lines(json.error);
  for (std::string line; std::getline(lines, line);)
  {
    const Json   object = Json::parse(line);
    const double fraction = object.at("fraction").get<double>();
    EXPECT_GE(fraction, last);
    last = fraction;
    EXPECT_FALSE(object.at("stage").get<std::string>().empty());
  }
  EXPECT_EQ(last, 1);
  EXPECT_EQ(run("none").error, "");
  EXPECT_EQ(run("bar").error, "") << "a bar is for terminals";
}

// Obtained with two other programs.
TEST_F(CoreCommand, EllipsoidHasTheKnownNumbers)
{
  ASSERT_EQ(RunProgram({ "phantom", "ellipsoid", "--size", "64", "-o", m_Folder / "e.nrrd" }).code, 0);
  Core({ "--lambda", "0", "-o", m_Folder / "e.vtp", "--report", m_Folder / "e.json" }, "e.nrrd");
  const Json report = Json::parse(ReadAll(m_Folder / "e.json"));
  const Json label = report["labels"][0];
  EXPECT_EQ(label["boundary_vertices"], 7354);
  EXPECT_EQ(label["core"]["vertices"], 7474);
  EXPECT_EQ(label["core"]["edges"], 16427);
  EXPECT_EQ(label["core"]["faces"], 8954);
  EXPECT_NEAR(label["core"]["area_mm2"].get<double>(), 27153.226, 0.0005);
}

// A cut of a real atlas: every label certified, and the figures of one computed by `info` from the voxels alone.
TEST_F(CoreCommand, ACutOfTheAalAtlasPasses)
{
  const TestScan cut = CropNifti("/usr/share/mricron/templates/aal.nii.gz", { 60, 80, 50 }, { 56, 60, 48 });
  if (cut.voxels.empty())
  {
    GTEST_SKIP() << "mricron-data is not installed";
  }
  WriteNrrd(m_Folder / "cut.nrrd", cut);
  Core({ "--lambda", "0,1.5vox", "-o", m_Folder / "cut.vtp", "--report", m_Folder / "cut.json" }, "cut.nrrd");
  const Json report = Json::parse(ReadAll(m_Folder / "cut.json"));
  Names      values;
  for (const std::uint8_t value : cut.voxels)
  {
    if (value != 0)
    {
      values.insert(std::to_string(value));
    }
  }
  EXPECT_GT(values.size(), 20U);
  EXPECT_EQ(report["labels"].size(), values.size());
  for (const Json & label : report["labels"])
  {
    const auto value = label["label"].get<int>();
    EXPECT_EQ(values.count(std::to_string(value)), 1U);
    EXPECT_EQ(label["voxels"], std::count(cut.voxels.begin(), cut.voxels.end(), value));
    EXPECT_TRUE(label["certificate"]["passed"]) << label["name"];
    EXPECT_EQ(label["shape"]["betti"], label["core"]["betti"]) << label["name"];
    EXPECT_EQ(label["shape"]["betti"], label["pruned"][1]["betti"]) << label["name"];
  }
}

} // namespace
} // namespace voxelcore::testing
