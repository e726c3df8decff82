// skeleton and measure as a user runs them, on the shapes other programs stumble over.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

class SkeletonCommand : public ::testing::Test
{
protected:
  /** Runs `skeleton` on a scan with all further files and `core --with-skeleton` beside; gives the report's labels.
   *  Bodies are as they are, and end where their voxels do. */
  Json
  Labels(const TestScan & scan, const std::vector<std::string> & more = {})
  {
    WriteNrrd(m_Folder / "scan.nrrd", scan);
    const auto run = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), { "--report", m_Folder / "report.json", "--force" });
      arguments.insert(arguments.end(), more.begin(), more.end());
      const ProgramResult result = RunProgram(arguments);
      EXPECT_EQ(result.code, 0) << result.error;
      EXPECT_EQ(WithoutDiagnoses(result.error), "");
      return Json::parse(ReadAll(m_Folder / "report.json")).at("labels");
    };
    const Json beside =
      run({ "core", m_Folder / "scan.nrrd", "-o", m_Folder / "b.vtp", "--with-skeleton", "--refine", "off" });
    const Json labels = run({ "skeleton",
                              m_Folder / "scan.nrrd",
                              "-o",
                              m_Folder / "a.vtp",
                              "--also",
                              "csv,swc,mrk.json,graphml,ma",
                              "--border",
                              "closed",
                              "--cavities",
                              "keep" });
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

  /** The report of `skeleton` with a few options alone. */
  Json
  ReportOf(const TestScan & scan, const std::vector<std::string> & options, std::string * said = nullptr)
  {
    WriteNrrd(m_Folder / "scan.nrrd", scan);
    std::vector<std::string> arguments{ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "s.vtp", "--force",
                                        "--report", m_Folder / "s.json" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    if (said != nullptr)
    {
      *said = result.output;
    }
    return Json::parse(ReadAll(m_Folder / "s.json"));
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

TEST_F(SkeletonCommand, LoopsThatCarryLittleOfTheLengthAreToldOfAndRingsAreNot)
{
  const auto said = [&](const TestScan & scan, const std::vector<std::string> & more) {
    WriteNrrd(m_Folder / "loop.nrrd", scan);
    std::vector<std::string> arguments{ "skeleton", m_Folder / "loop.nrrd", "-o", m_Folder / "loop.vtp", "--force" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    return result.output;
  };
  const auto tells = [](const std::string & text) { return text.find("to cut loops: --tree") != std::string::npos; };
  // A rod of 3 x 3 voxels with a handle over a hole of 3 x 3.
  TestScan rod({ 404, 16, 9 });
  for (std::size_t x = 2; x < 402; ++x)
  {
    for (std::size_t y = 3; y < 12; ++y)
    {
      for (std::size_t z = 3; z < 6; ++z)
      {
        const bool isHandle = x >= 100 && x < 109 && (x < 103 || x >= 106 || y >= 9);
        rod.At(x, y, z) = y < 6 || isHandle ? 1 : 0;
      }
    }
  }
  const std::string text = said(rod, {});
  EXPECT_TRUE(tells(text) && text.find("label 1 (label-1): 1 loop, closed by ") != std::string::npos) << text;
  EXPECT_FALSE(tells(said(rod, { "--tree" })));
  TestScan ring({ 40, 40, 9 });
  for (std::size_t x = 0; x < 40; ++x)
  {
    for (std::size_t y = 0; y < 40; ++y)
    {
      const double away = std::hypot(static_cast<double>(x) - 20, static_cast<double>(y) - 20);
      for (std::size_t z = 3; z < 6; ++z)
      {
        ring.At(x, y, z) = away > 12 && away < 16 ? 1 : 0;
      }
    }
  }
  EXPECT_FALSE(tells(said(ring, {})));
}

TEST_F(SkeletonCommand, VoxelsThatTouchAtAnEdgeOrACornerAreTwoBySix)
{
  for (const std::size_t z : { 1U, 2U })
  {
    TestScan scan({ 4, 4, 4 });
    scan.At(1, 1, 1) = scan.At(2, 2, z) = 1;
    const Json skeleton = Labels(scan, { "--connectivity", "6" }).at(0).at("skeleton");
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
  const ProgramResult said =
    RunProgram({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "d.vtp", "--cavities", "keep" });
  EXPECT_NE(said.output.find("faces of closed surfaces stay"), std::string::npos) << said.output;
}

TEST_F(SkeletonCommand, CavitiesAreFilledUnlessTheyAreKept)
{
  // A ball in a shell in a shell.
  TestScan scan({ 24, 24, 24 });
  for (const auto & [first, last, value] :
       { std::tuple(2, 21, 1), { 5, 18, 0 }, { 7, 16, 1 }, { 9, 14, 0 }, { 11, 12, 1 } })
  {
    const auto low = static_cast<std::size_t>(first);
    const auto high = static_cast<std::size_t>(last);
    scan.Fill({ low, low, low }, { high, high, high }, static_cast<std::uint8_t>(value));
  }
  std::string said;
  const Json  label = ReportOf(scan, {}, &said).at("labels").at(0);
  EXPECT_EQ(label.at("shape").at("betti"), Json({ 1, 0, 0 }));
  EXPECT_EQ(label.at("skeleton").at("betti"), Json({ 1, 0, 0 }));
  EXPECT_EQ(label.at("skeleton").at("closed_faces"), 0);
  EXPECT_EQ(label.at("edits").at("cavities_filled"), 2);
  EXPECT_NE(said.find("2 cavities filled"), std::string::npos) << said;
  EXPECT_NE(said.find("--cavities keep"), std::string::npos) << said;
  const Json kept = ReportOf(scan, { "--cavities", "keep" }).at("labels").at(0);
  EXPECT_EQ(kept.at("shape").at("betti"), Json({ 3, 0, 2 }));
  EXPECT_GT(kept.at("skeleton").at("closed_faces"), 0);
  // Of a body without any nothing is said.
  TestScan rod({ 20, 8, 8 });
  rod.Fill({ 2, 2, 2 }, { 17, 5, 5 }, 1);
  ReportOf(rod, {}, &said);
  EXPECT_EQ(said.find("cavit"), std::string::npos) << said;
  // A number is for --simplify-topology.
  EXPECT_EQ(RunProgram({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "x.vtp", "--cavities", "1" }).code, 2);
  EXPECT_EQ(RunProgram({ "skeleton", m_Folder / "scan.nrrd", "-o", m_Folder / "x.vtp", "--cavities", "some" }).code, 2);
}

TEST_F(SkeletonCommand, WritesSectionsLesionsVolumesCenterlinesAndPipesOfOneRun)
{
  // A tube with a waist, and a second label beside it.
  TestScan scan({ 70, 24, 24 });
  for (std::size_t x = 2; x < 68; ++x)
  {
    const double radius = 6 * (1 - 0.6 * std::exp(-0.5 * std::pow((static_cast<double>(x) - 35) / 5, 2)));
    for (std::size_t z = 0; z < 15; ++z)
    {
      for (std::size_t y = 0; y < 15; ++y)
      {
        if (std::hypot(static_cast<double>(y) - 7.3, static_cast<double>(z) - 7.2) <= radius)
        {
          scan.At(x, y, z) = 1;
        }
      }
    }
  }
  scan.Fill({ 2, 18, 18 }, { 60, 20, 20 }, 2);
  const auto        file = [&](const char * name) { return (m_Folder / name).string(); };
  const std::vector options{
    std::string("--sections"),    std::string("all"),   std::string("--branch-map"),   file("branches.nrrd"),
    std::string("--order-map"),   file("orders.nrrd"),  std::string("--skeleton-map"), file("lines.nrrd"),
    std::string("--centerlines"), file("lines.vtp"),    std::string("--flow"),         file("pipes.csv"),
    std::string("--inlet"),       std::string("70,7,7")
  };
  const Json   report = ReportOf(scan, options);
  const Json & lesions = report.at("labels").at(0).at("skeleton").at("lesions");
  ASSERT_EQ(lesions.size(), 1U);
  EXPECT_EQ(lesions[0].at("kind"), "stenosis");
  EXPECT_NEAR(lesions[0].at("degree_by_diameter_percent").get<double>(), 60, 4);
  EXPECT_NEAR(lesions[0].at("place_mm").at(0).get<double>(), 30, 1.5); // the first voxel is at -5
  EXPECT_TRUE(report.at("labels").at(1).at("skeleton").at("lesions").empty());
  EXPECT_NE(ReadAll(file("s_lesions.csv")).find("stenosis"), std::string::npos);
  // Each voxel of a label has a branch, which is the row of the only one; background has none.
  const auto counts = [&](const char * name) {
    const ProgramResult info = RunProgram({ "info", file(name), "--json" });
    EXPECT_EQ(info.code, 0) << info.error;
    std::map<int, std::int64_t> voxels;
    const Json                  seen = Json::parse(info.output);
    for (const Json & label : seen.at("labels"))
    {
      voxels[label.at("label")] = label.at("voxels");
    }
    return voxels;
  };
  const std::int64_t first = std::count(scan.voxels.begin(), scan.voxels.end(), 1);
  EXPECT_EQ(counts("branches.nrrd"), (std::map<int, std::int64_t>{ { 1, first }, { 2, 59 * 9 } }));
  EXPECT_EQ(counts("orders.nrrd"), (std::map<int, std::int64_t>{ { 1, first + 59 * 9 } }));
  auto lines = counts("lines.nrrd");
  EXPECT_NEAR(static_cast<double>(lines.at(1)), 65, 3);
  EXPECT_NEAR(static_cast<double>(lines.at(2)), 58, 3);
  // Both tubes are one tract and one pipe, the first from the inlet that was given.
  const std::string pipes = ReadAll(file("pipes.csv"));
  EXPECT_EQ(std::count(pipes.begin(), pipes.end(), '\n'), 3);
  const std::string nodes = ReadAll(file("pipes_nodes.csv"));
  const std::size_t at = nodes.find("inlet,");
  ASSERT_NE(at, std::string::npos);
  EXPECT_GT(std::stod(nodes.substr(at + 6)), 60);
  EXPECT_TRUE(Json::parse(ReadAll(file("pipes_columns.json"))).contains("nodes"));
  const std::string centerlines = ReadAll(file("lines.vtp"));
  for (const char * name : { "CenterlineIds", "TractIds", "GroupIds", "Blanking", "MaximumInscribedSphereRadius" })
  {
    EXPECT_NE(centerlines.find(name), std::string::npos) << name;
  }
  // The finished skeleton gives the same pipes and lines.
  ASSERT_EQ(RunProgram({ "measure",
                         file("s.vtp"),
                         "-o",
                         file("m.csv"),
                         "--flow",
                         file("again.csv"),
                         "--centerlines",
                         file("again.vtp"),
                         "--inlet",
                         "70,7,7" })
              .code,
            0);
  EXPECT_EQ(ReadAll(file("again.csv")), pipes);
  EXPECT_EQ(ReadAll(file("again.vtp")), centerlines);
  ASSERT_EQ(RunProgram({ "measure", file("s.vtp"), "-o", file("n.csv"), "--flow", file("pipes.json") }).code, 0);
  EXPECT_EQ(Json::parse(ReadAll(file("pipes.json"))).at("vessels").size(), 2U);
  const ProgramResult openBf = RunProgram({ "measure", file("s.vtp"), "-o", file("o.csv"), "--flow", file("p.yaml") });
  EXPECT_EQ(openBf.code, 3);
  EXPECT_NE(openBf.error.find("p.yaml: openBF takes a network with one inlet, and this one has 2"), std::string::npos)
    << openBf.error;
  EXPECT_FALSE(std::filesystem::exists(file("o_branches.csv")));
}

TEST_F(SkeletonCommand, RefusesVolumesAndPipesThatCannotBeWritten)
{
  TestScan scan({ 20, 6, 6 });
  scan.Fill({ 2, 2, 2 }, { 17, 4, 4 }, 1);
  WriteNrrd(m_Folder / "scan.nrrd", scan);
  const auto refused = [&](const std::vector<std::string> & more) {
    std::vector<std::string> arguments{ "skeleton", m_Folder / "scan.nrrd" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 2) << result.error;
    return result.error;
  };
  const std::string to = m_Folder / "s.vtp";
  EXPECT_NE(refused({ "-o", (m_Folder / "d").string() + "/", "--flow", m_Folder / "f.csv" }).find("one file"),
            std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--flow", m_Folder / "f.vtp" }).find(".csv"), std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--centerlines", m_Folder / "f.csv" }).find(".vtp"), std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--branch-map", m_Folder / "f.vtp" }).find("f.vtp"), std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--inlet", "1,2,3" }).find("--flow"), std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--soma", "auto" }).find("--also swc"), std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--also", "swc", "--soma", "1,2" }).find("X,Y,Z"), std::string::npos);
  EXPECT_NE(refused({ "-o", (m_Folder / "d").string() + "/", "--also", "swc", "--soma", "1,2,3" }).find("one label"),
            std::string::npos);
  EXPECT_NE(refused({ "-o", to, "--flow", m_Folder / "f.csv", "--inlet", "1,2" }).find("X,Y,Z"), std::string::npos);
  ASSERT_EQ(RunProgram({ "core", m_Folder / "scan.nrrd", "-o", m_Folder / "c.vtp" }).code, 0);
  const ProgramResult fromCore =
    RunProgram({ "skeleton", m_Folder / "c.vtp", "-o", to, "--skeleton-map", m_Folder / "m.nrrd" });
  EXPECT_EQ(fromCore.code, 2);
  EXPECT_NE(fromCore.error.find("--skeleton-map: needs a scan"), std::string::npos) << fromCore.error;
}

TEST_F(SkeletonCommand, ABodyThatTheBorderCutsRunsUpToIt)
{
  TestScan scan({ 40, 13, 13 });
  scan.Fill({ 0, 2, 2 }, { 39, 10, 10 }, 1);
  std::string said;
  const Json  report = ReportOf(scan, {}, &said);
  EXPECT_EQ(report.at("skeleton").at("border"), "open");
  const Json & open = report.at("labels").at(0).at("skeleton");
  EXPECT_NEAR(open.at("total_length_mm").get<double>(), 40, 0.01);
  EXPECT_NEAR(open.at("volume_mm3").get<double>(), 40 * 81, 0.02 * 40 * 81);
  EXPECT_EQ(open.at("border").at("ends"), 2);
  ASSERT_EQ(open.at("border").at("sections").size(), 2U);
  EXPECT_EQ(open.at("border").at("sections").at(0).at("side"), "i-");
  EXPECT_EQ(open.at("border").at("sections").at(1).at("side"), "i+");
  EXPECT_NE(said.find("the border of the scan cuts 1 body (i+, i-); 2 branches run up to it"), std::string::npos)
    << said;
  const Json closed = ReportOf(scan, { "--border", "closed" });
  EXPECT_FALSE(closed.at("skeleton").contains("border"));
  // To the middles of both flat ends, but for half a voxel.
  EXPECT_NEAR(closed.at("labels").at(0).at("skeleton").at("total_length_mm").get<double>(), 39, 0.3);
  const Json overlap = ReportOf(scan, { "--border", "overlap" });
  EXPECT_NEAR(overlap.at("labels").at(0).at("skeleton").at("total_length_mm").get<double>(), 39, 0.05);
  // The side of a crop is a border, too.
  const Json cropped = ReportOf(scan, { "--crop", "10:30,:,:" });
  EXPECT_NEAR(cropped.at("labels").at(0).at("skeleton").at("total_length_mm").get<double>(), 20, 0.01);
  // A core ends at the border, and that is said.
  ASSERT_EQ(RunProgram({ "core", m_Folder / "scan.nrrd", "-o", m_Folder / "c.vtp" }).code, 0);
  const ProgramResult fromCore = RunProgram({ "skeleton", m_Folder / "c.vtp", "-o", m_Folder / "cs.vtp" });
  EXPECT_NE(fromCore.output.find("1 body at the border of the scan ends there"), std::string::npos) << fromCore.output;
  EXPECT_EQ(
    RunProgram({ "skeleton", m_Folder / "c.vtp", "-o", m_Folder / "cs.vtp", "--force", "--border", "open" }).code,
    2);
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
