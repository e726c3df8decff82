// skeleton and measure as a user runs them, on the shapes other programs stumble over.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

class SkeletonCommand : public ::testing::Test
{
protected:
  /** Runs `skeleton` on a scan with all further files and `core --with-skeleton` beside; gives the report's labels. */
  Json
  Labels(const TestScan & scan, const std::vector<std::string> & more = {})
  {
    WriteNrrd(m_Folder / "scan.nrrd", scan);
    const auto run = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), { "--report", m_Folder / "report.json", "--force" });
      arguments.insert(arguments.end(), more.begin(), more.end());
      const ProgramResult result = RunProgram(arguments);
      EXPECT_EQ(result.code, 0) << result.error;
      EXPECT_EQ(WithoutHollowWarnings(result.error), "");
      return Json::parse(ReadAll(m_Folder / "report.json")).at("labels");
    };
    const Json beside =
      run({ "core", m_Folder / "scan.nrrd", "-o", m_Folder / "b.vtp", "--with-skeleton", "--refine", "off" });
    const Json labels =
      run({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "a.vtp", "--also", "csv,swc,mrk.json,graphml,ma" });
    EXPECT_EQ(ReadAll(m_Folder / "a.vtp"), ReadAll(m_Folder / "b_skeleton.vtp"));
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const Json & shape = labels[i].at("shape");
      EXPECT_EQ(labels[i].at("skeleton").at("betti"), shape.at("betti"));
      EXPECT_EQ(labels[i].at("skeleton").at("euler"), shape.at("euler"));
      EXPECT_EQ(labels[i].at("certificate").at("passed"), true);
      EXPECT_EQ(beside[i].at("skeleton").at("total_length_mm"), labels[i].at("skeleton").at("total_length_mm"));
    }
    // What was written can be measured again.
    const ProgramResult measured =
      RunProgram({ "measure", m_Folder / "a.vtp", "-o", m_Folder / "m.csv", "--force", "--quiet" });
    EXPECT_EQ(measured.code, 0) << measured.error;
    EXPECT_EQ(ReadAll(m_Folder / "m_branches.csv"), ReadAll(m_Folder / "a_branches.csv"));
    return labels;
  }

  TemporaryFolder m_Folder;
};

TEST_F(SkeletonCommand, OneVoxelIsAPoint)
{
  TestScan scan({ 3, 3, 3 });
  scan.At(1, 1, 1) = 1;
  const Json skeleton = Labels(scan).at(0).at("skeleton");
  EXPECT_EQ(skeleton.at("isolated_points"), 1);
  EXPECT_EQ(skeleton.at("branches"), 0);
  // A scan may also be no more than this voxel.
  TestScan alone({ 1, 1, 1 });
  alone.At(0, 0, 0) = 7;
  EXPECT_EQ(Labels(alone).at(0).at("skeleton").at("isolated_points"), 1);
}

TEST_F(SkeletonCommand, ARodIsItsAxis)
{
  for (const std::size_t width : { 1U, 2U, 4U })
  {
    TestScan scan({ 64, 8, 8 });
    scan.Fill({ 2, 2, 2 }, { 61, 1 + width, 1 + width }, 1);
    const Json skeleton = Labels(scan).at(0).at("skeleton");
    EXPECT_EQ(skeleton.at("branches"), 1) << width;
    EXPECT_EQ(skeleton.at("tips"), 2) << width;
    EXPECT_NEAR(skeleton.at("total_length_mm").get<double>(), 60 - static_cast<double>(width), 2) << width;
  }
}

TEST_F(SkeletonCommand, APlateIsAPointOrALineOrStays)
{
  // Corners of 90 degrees do not stand out: of a square its centre is left, of an oblong its axis.
  TestScan square({ 30, 30, 6 });
  square.Fill({ 2, 2, 2 }, { 27, 27, 3 }, 1);
  EXPECT_EQ(Labels(square).at(0).at("skeleton").at("isolated_points"), 1);
  TestScan scan({ 60, 20, 6 });
  scan.Fill({ 2, 2, 2 }, { 57, 17, 3 }, 1);
  const Json curves = Labels(scan).at(0).at("skeleton");
  EXPECT_EQ(curves.at("plate_faces"), 0);
  EXPECT_EQ(curves.at("branches"), 1);
  EXPECT_EQ(curves.at("tips"), 2);
  EXPECT_GT(Labels(scan, { "--plates", "3vox" }).at(0).at("skeleton").at("plate_faces"), 100);
}

TEST_F(SkeletonCommand, VoxelsThatTouchAtAnEdgeOrACornerAreTwo)
{
  for (const std::size_t z : { 1U, 2U })
  {
    TestScan scan({ 4, 4, 4 });
    scan.At(1, 1, 1) = scan.At(2, 2, z) = 1;
    const Json skeleton = Labels(scan).at(0).at("skeleton");
    EXPECT_EQ(skeleton.at("isolated_points"), 2);
    EXPECT_EQ(skeleton.at("components"), 2);
  }
  TestScan scan({ 4, 4, 4 });
  scan.At(1, 1, 1) = scan.At(2, 1, 1) = 1;
  EXPECT_EQ(Labels(scan).at(0).at("skeleton").at("components"), 1);
}

TEST_F(SkeletonCommand, AClosedShellStaysASurfaceAndThatIsSaid)
{
  TestScan scan({ 16, 16, 16 });
  scan.Fill({ 2, 2, 2 }, { 13, 13, 13 }, 1);
  scan.Fill({ 4, 4, 4 }, { 11, 11, 11 }, 0);
  const Json skeleton = Labels(scan).at(0).at("skeleton");
  EXPECT_GT(skeleton.at("closed_faces"), 100);
  EXPECT_EQ(skeleton.at("branches"), 0);
  const ProgramResult result =
    RunProgram({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "c.vtp", "--fill-cavities" });
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.output.find("closed surfaces"), std::string::npos) << result.output;
  const ProgramResult said = RunProgram({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "d.vtp" });
  EXPECT_NE(said.output.find("faces of closed surfaces stay"), std::string::npos) << said.output;
}

TEST_F(SkeletonCommand, RootsAndRingsKeepWhatTheOptionsSay)
{
  TestScan ring({ 40, 40, 10 });
  ring.Fill({ 4, 4, 3 }, { 35, 35, 6 }, 1);
  ring.Fill({ 8, 8, 3 }, { 31, 31, 6 }, 0);
  EXPECT_EQ(Labels(ring).at(0).at("skeleton").at("cycles"), 1);
  const Json cut = Labels(ring, { "--cut-loops" }).at(0).at("skeleton");
  EXPECT_EQ(cut.at("cycles"), 0);
  EXPECT_EQ(cut.at("cuts").size(), 1U);
  TestScan cross({ 60, 60, 8 });
  cross.Fill({ 2, 28, 2 }, { 57, 31, 5 }, 1);
  cross.Fill({ 28, 2, 2 }, { 31, 57, 5 }, 1);
  const Json whole = Labels(cross).at(0).at("skeleton");
  EXPECT_EQ(whole.at("tips"), 4);
  EXPECT_EQ(whole.at("components"), 1);
  EXPECT_EQ(Labels(cross, { "--split-at-junctions" }).at(0).at("skeleton").at("components"), whole.at("branches"));
  EXPECT_EQ(Labels(cross, { "--prune-branches", "50%" }).at(0).at("skeleton").at("branches"), 1);
  EXPECT_EQ(Labels(cross, { "--prune-branches", "60mm" }).at(0).at("skeleton").at("branches"), 1);
  EXPECT_EQ(Labels(cross, { "--prune-branches", "3r" }).at(0).at("skeleton").at("tips"), 4);
  EXPECT_EQ(Labels(cross, { "--stand-out", "90%" }).at(0).at("skeleton").at("isolated_points"), 1);
}

using HeavySkeletonCommand = SkeletonCommand;

TEST_F(HeavySkeletonCommand, HundredsOfLabelsGiveTheSameWhateverTheThreads)
{
  const std::filesystem::path atlas = "/usr/share/mricron/templates/inia19-NeuroMaps.nii.gz";
  if (!std::filesystem::exists(atlas))
  {
    GTEST_SKIP() << "Debian's mricron-data is not installed";
  }
  for (const char * threads : { "1", "3" })
  {
    const std::filesystem::path folder = m_Folder / threads;
    const ProgramResult         result = RunProgram({ "skeleton",
                                                      atlas,
                                                      "-o",
                                                      folder.string() + "/",
                                                      "--also",
                                                      "csv",
                                                      "--threads",
                                                      threads,
                                                      "--quiet",
                                                      "--report",
                                                      m_Folder / (std::string(threads) + ".json") });
    EXPECT_EQ(result.code, 0) << result.error;
  }
  const Json labels = Json::parse(ReadAll(m_Folder / "1.json")).at("labels");
  EXPECT_EQ(labels.size(), 724U);
  std::size_t files = 0;
  for (const auto & entry : std::filesystem::directory_iterator(m_Folder / "1"))
  {
    const std::string name = entry.path().filename().string();
    ++files;
    if (entry.path().extension() != ".jsonl") // tells of labels as they were finished, and how long they took
    {
      ASSERT_EQ(ReadAll(entry.path()), ReadAll(m_Folder.Path() / "3" / name)) << name;
    }
  }
  EXPECT_EQ(files, 724U + 4U); // tables of branches and labels, their columns, what is finished
  for (const Json & label : labels)
  {
    ASSERT_EQ(label.at("skeleton").at("betti"), label.at("shape").at("betti")) << label.at("name");
  }
}

} // namespace
} // namespace voxelcore::testing
