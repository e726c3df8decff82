// Commands say which files they wrote, and what a user should know of them.

#include "CommandFixture.h"
#include "Scans.h"

#include <filesystem>

namespace voxelcore::testing
{
namespace
{

class WrittenFiles : public CommandFixture
{
protected:
  void
  SetUp() override
  {
    WriteNrrd(Path("blocks.nrrd"), ThreeBlocks());
  }
  bool
  Exists(const std::string & name) const
  {
    return std::filesystem::exists(Path(name));
  }
};

TEST_F(WrittenFiles, AreNamedWithTheTimeTaken)
{
  const std::string core =
    Run({ "core", Path("blocks.nrrd"), "--lambda", "0", "-o", Path("a.vtp"), "--report", Path("a.json") });
  EXPECT_NE(core.find("wrote " + Path("a.vtp") + "\n"), std::string::npos) << core;
  EXPECT_NE(core.find("wrote " + Path("a.json") + "\n"), std::string::npos) << core;
  EXPECT_NE(core.find(" s, peak memory "), std::string::npos) << core;
  const std::string skeleton = Run({ "skeleton", Path("a.vtp"), "-o", Path("s.vtp"), "--also", "csv" });
  EXPECT_NE(skeleton.find("wrote " + Path("s_columns.json") + "\n"), std::string::npos) << skeleton;
  EXPECT_NE(skeleton.find(" s, peak memory "), std::string::npos) << skeleton;
}

TEST_F(WrittenFiles, OfAFolderAreCounted)
{
  const std::string text =
    Run({ "core", Path("blocks.nrrd"), "--lambda", "0,1vox,2vox", "-o", Path("out/"), "--table", Path("t.csv") });
  EXPECT_NE(text.find("wrote 9 files to " + Path("out") + "\n"), std::string::npos) << text;
  EXPECT_NE(text.find("wrote 2 files to " + m_Folder.Path().string() + "\n"), std::string::npos) << text;
}

TEST_F(WrittenFiles, AreNotNamedWhereNothingOrOnlyJsonIsToBePrinted)
{
  EXPECT_EQ(Run({ "core", Path("blocks.nrrd"), "--lambda", "0", "-o", Path("a.vtp"), "-q" }), "");
  const std::string json = Run({ "info", Path("blocks.nrrd"), "--json" });
  EXPECT_TRUE(nlohmann::json::accept(json));
}

TEST_F(WrittenFiles, LabelsOfWhichPruningLeavesNoFaceAreNamed)
{
  const ProgramResult result = RunProgram({ "core", Path("blocks.nrrd"), "--lambda", "1e9mm", "-o", Path("a.vtp") });
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(
    result.error.find("warning: --lambda 1e9mm leaves no face, only curves or a point, of label 2 (label-2) with "
                      "a largest radius of "),
    std::string::npos)
    << result.error;
  EXPECT_NE(result.error.find("; for surfaces give a smaller value"), std::string::npos) << result.error;
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  EXPECT_EQ(RunProgram({ "core", Path("blocks.nrrd"), "--lambda", "0", "-o", Path("b.vtp") }).error, "");
}

TEST_F(WrittenFiles, LabelsOfWhichPruningAFileLeavesNoFaceAreNamed)
{
  Run({ "core", Path("blocks.nrrd"), "--lambda", "0", "--keep-edges", "-o", Path("a.vtp") });
  const ProgramResult result =
    RunProgram({ "prune", Path("a.vtp"), "--lambda", "1e9mm", "--keep-edges", "-o", Path("b.vtp") });
  EXPECT_EQ(result.code, 0);
  EXPECT_NE(
    result.error.find("warning: --lambda 1e9mm leaves no face, only curves or a point, of label 2 (label-2) with "
                      "a largest radius of "),
    std::string::npos)
    << result.error;
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
  // Where there was no face before, pruning has taken none.
  EXPECT_EQ(RunProgram({ "prune", Path("b.vtp"), "--lambda", "1e9mm", "-o", Path("c.vtp") }).error, "");
  EXPECT_EQ(RunProgram({ "prune", Path("a.vtp"), "--lambda", "0", "-o", Path("d.vtp") }).error, "");
}

TEST_F(WrittenFiles, TheTableOfBranchesIsWrittenOnce)
{
  Run({ "skeleton", Path("blocks.nrrd"), "-o", Path("s.vtp"), "--also", "csv", "--table", Path("t.csv") });
  EXPECT_TRUE(Exists("t.csv") && Exists("s_summary.csv") && Exists("s_columns.json"));
  EXPECT_FALSE(Exists("s_branches.csv"));
  Run({ "skeleton", Path("blocks.nrrd"), "-o", Path("u.vtp"), "--also", "csv" });
  EXPECT_EQ(ReadAll(Path("t.csv")), ReadAll(Path("u_branches.csv")));
}

TEST_F(WrittenFiles, SkeletonsAsCsvAreTablesAlone)
{
  Run({ "skeleton", Path("blocks.nrrd"), "-o", Path("x.csv") });
  EXPECT_TRUE(Exists("x_branches.csv") && Exists("x_summary.csv"));
  EXPECT_FALSE(Exists("x.csv") || Exists("x.vtp"));
  EXPECT_NE(Run({ "skeleton", "--help" }).find("as .csv its tables alone"), std::string::npos);
  ExpectRefusal(RunProgram({ "skeleton", Path("blocks.nrrd"), "-o", Path("x.obj") }),
                2,
                { "x.obj", ".csv (tables alone)" });
}

} // namespace
} // namespace voxelcore::testing
