// Pruning by tolerance as a user runs it.

#include "CommandFixture.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;
using Names = std::set<std::string>;

class ToleranceCommand : public CommandFixture
{
protected:
  /** A ball with a rod of one voxel and a plate of one voxel on it, label 1; a box, label 3. */
  void
  WriteBallWithRodAndPlate(const std::string & name) const
  {
    TestScan scan({ 44, 30, 24 });
    scan.spacing = { 1, 1, 1.5 };
    for (std::size_t z = 0; z < 24; ++z)
    {
      for (std::size_t y = 0; y < 30; ++y)
      {
        for (std::size_t x = 0; x < 30; ++x)
        {
          const double dx = static_cast<double>(x) - 11.2;
          const double dy = static_cast<double>(y) - 12.1;
          const double dz = 1.5 * (static_cast<double>(z) - 11.4);
          scan.At(x, y, z) = dx * dx + dy * dy + dz * dz < 100 ? 1 : 0;
        }
      }
    }
    scan.Fill({ 20, 12, 11 }, { 40, 12, 11 }, 1);
    scan.Fill({ 5, 20, 11 }, { 15, 29, 11 }, 1);
    scan.Fill({ 32, 20, 4 }, { 40, 26, 9 }, 3);
    WriteNrrd(m_Folder / name, scan);
  }
};

TEST_F(ToleranceCommand, SeveralHeightsShareARunAndGiveWhatEachGivesAlone)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--tolerance", "0,1.2diag,2.5vox,4", "-o", Path("m.vtp"), "--report", Path("r.json") });
  EXPECT_EQ(m_Folder.Names(),
            (Names{ "a.nrrd",
                    "r.json",
                    "m_tolerance-0.vtp",
                    "m_tolerance-1.2diag.vtp",
                    "m_tolerance-2.5vox.vtp",
                    "m_tolerance-4mm.vtp" }));
  Run({ "core",
        Path("a.nrrd"),
        "--tolerance",
        "1.2diag",
        "--refine",
        "off", // as where a whole core is asked for beside it
        "-o",
        Path("one.vtp"),
        "--threads",
        "1",
        "--engine",
        "lattice" });
  EXPECT_EQ(ReadAll(m_Folder / "one.vtp"), ReadAll(m_Folder / "m_tolerance-1.2diag.vtp"));
  // The option's name in 0.1.
  for (const std::vector<std::string> & former :
       { std::vector<std::string>{ "--bumps", "1.2diag" }, { "--bumps=1.2diag" } })
  {
    std::vector<std::string> arguments{
      "core", Path("a.nrrd"), "-o", Path("former.vtp"), "--force", "--refine", "off"
    };
    arguments.insert(arguments.end(), former.begin(), former.end());
    Run(arguments);
    EXPECT_EQ(ReadAll(m_Folder / "former.vtp"), ReadAll(m_Folder / "one.vtp"));
    std::filesystem::remove(m_Folder / "former.vtp");
  }
  const Json report = Report("r.json");
  EXPECT_EQ(report["parameters"]["tolerance"], (Json{ "0", "1.2diag", "2.5vox", "4mm" }));
  ASSERT_EQ(report["labels"].size(), 2U);
  for (const Json & label : report["labels"])
  {
    EXPECT_EQ(label["certificate"]["covered"], true);
    std::uint64_t faces = label["core"]["faces"].get<std::uint64_t>();
    EXPECT_EQ(label["pruned"][0]["faces"], faces) << "height 0 is not the whole core";
    EXPECT_NEAR(label["pruned"][1]["tolerance_mm"].get<double>(), 1.2 * std::sqrt(4.25), 1e-12);
    for (const Json & pruned : label["pruned"])
    {
      EXPECT_LE(pruned["boundary_gap_mm"].get<double>(), pruned["tolerance_mm"].get<double>() + 1e-9);
      // Voxels are no cubes, so the tolerance differs from place to place; height 0 has no shares.
      EXPECT_EQ(pruned.contains("boundary_gap_share"), pruned["tolerance"] != "0");
      EXPECT_LE(pruned.value("boundary_gap_share", 0.0), 1 + 1e-9);
      EXPECT_LE(pruned["faces"].get<std::uint64_t>(), faces);
      EXPECT_EQ(pruned["betti"], label["shape"]["betti"]);
      faces = pruned["faces"].get<std::uint64_t>();
    }
  }
  // Thin parts stay, which no lambda that clears the ball can do.
  const Json & ball = report["labels"][0]["pruned"][1];
  EXPECT_LT(ball["boundary_gap_mm"].get<double>(), 2.5);
  EXPECT_LT(ball["faces"].get<std::uint64_t>(), report["labels"][0]["core"]["faces"].get<std::uint64_t>() / 4);
}

TEST_F(ToleranceCommand, FilesInAFolderAreNamedByHeight)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--labels", "3", "--tolerance", "1vox,2vox", "-o", Path("out/") });
  Names names;
  for (const auto & entry : std::filesystem::directory_iterator(m_Folder / "out"))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(
    names,
    (Names{ "a_label-3_medial_tolerance-1vox.vtp", "a_label-3_medial_tolerance-2vox.vtp", "a_medial_finished.jsonl" }));
}

TEST_F(ToleranceCommand, PruneGivesTheBytesOfCore)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--tolerance", "0,1vox,1.5vox,2diag", "-o", Path("m.vtp") });
  Run({ "prune", Path("m_tolerance-0.vtp"), "--tolerance", "1vox,1.5vox", "-o", Path("p.vtp") });
  Run({ "prune", Path("p_tolerance-1.5vox.vtp"), "--tolerance", "2diag", "-o", Path("p_tolerance-2diag.vtp") });
  for (const char * height : { "1vox", "1.5vox", "2diag" })
  {
    const std::string name = "_tolerance-" + std::string(height) + ".vtp";
    EXPECT_EQ(ReadAll(m_Folder / ("m" + name)), ReadAll(m_Folder / ("p" + name))) << height;
  }
  // A whole core has all that lambda needs, too.
  Run({ "core", Path("a.nrrd"), "--tolerance", "0", "--keep-edges", "-o", Path("whole.vtp") });
  Run({ "prune", Path("whole.vtp"), "--lambda", "1.5vox", "-o", Path("l.vtp") });
  Run({ "core", Path("a.nrrd"), "--lambda", "1.5vox", "-o", Path("lambda.vtp") });
  EXPECT_EQ(ReadAll(m_Folder / "l.vtp"), ReadAll(m_Folder / "lambda.vtp"));
}

TEST_F(ToleranceCommand, VerifyMeasuresTheGapItself)
{
  WriteBallWithRodAndPlate("a.nrrd");
  for (const char * options : { "0", "1.2diag", "3vox" })
  {
    Run({ "core", Path("a.nrrd"), "--tolerance", options, "-o", Path("m.vtp"), "--force" });
    const std::string text = Run({ "verify", Path("a.nrrd"), Path("m.vtp") });
    EXPECT_NE(text.find("boundary within"), std::string::npos) << text;
    EXPECT_EQ(text.find("% of what is allowed there") != std::string::npos, std::string(options) != "0") << text;
  }
  // A file that claims a lower height than it was made at.
  const std::string good = UnpackedVtp(ReadAll(m_Folder / "m.vtp"));
  std::string       bad = good;
  const std::size_t at = bad.find("\"tolerance_mm\":3.0");
  ASSERT_NE(at, std::string::npos);
  bad.replace(at, 18, "\"tolerance_mm\":0.1");
  WriteAll(m_Folder / "bad.vtp", bad);
  const ProgramResult result = RunProgram({ "verify", Path("a.nrrd"), Path("bad.vtp") });
  EXPECT_EQ(result.code, 4) << result.output << result.error;
  EXPECT_NE(result.output.find("coverage"), std::string::npos) << result.output;
}

TEST_F(ToleranceCommand, AFloorIsPrunedFirstAndPromisesNothing)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core",
        Path("a.nrrd"),
        "--tolerance",
        "0,1vox",
        "--lambda",
        "2vox",
        "-o",
        Path("m.vtp"),
        "--report",
        Path("r.json") });
  Run({ "core", Path("a.nrrd"), "--lambda", "2vox", "-o", Path("l.vtp"), "--report", Path("l.json") });
  const Json report = Report("r.json");
  const Json lambda = Report("l.json");
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Json & pruned = report["labels"][i]["pruned"];
    EXPECT_EQ(pruned[0]["faces"], lambda["labels"][i]["pruned"][0]["faces"]);
    EXPECT_EQ(pruned[0]["lambda"], "2vox");
    EXPECT_FALSE(report["labels"][i]["certificate"].contains("covered"));
    EXPECT_TRUE(pruned[0]["boundary_gap_mm"].is_number());
  }
  const std::string text = Run({ "verify", Path("a.nrrd"), Path("m_tolerance-1vox.vtp") });
  EXPECT_NE(text.find("all passed"), std::string::npos) << text;
}

TEST_F(ToleranceCommand, SkeletonAndOtherFormatsTakeWhatIsLeft)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--tolerance", "1.2diag", "-o", Path("m.vtp") });
  Run({ "skeleton", Path("m.vtp"), "-o", Path("s.vtp") });
  for (const char * extension : { "vtk", "ply", "obj", "ma" })
  {
    Run({ "core", Path("a.nrrd"), "--tolerance", "1.2diag", "-o", Path("m." + std::string(extension)) });
  }
}

TEST_F(ToleranceCommand, ASkeletonOfAScanHasTheBranchesOfTheWholeCoreAndSaysItsTolerance)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--tolerance", "1.2diag", "-o", Path("m.vtp") });
  const std::string note = Run({ "skeleton", Path("m.vtp"), "-o", Path("two.vtp") });
  EXPECT_NE(note.find("1.2diag"), std::string::npos) << note;
  Run({ "skeleton", Path("a.nrrd"), "--tolerance", "1.2diag", "-o", Path("one.vtp"), "--report", Path("r.json") });
  // The rod stands out of the ball; fingers of the ragged rim that tolerance leaves do not.
  const Json   report = Report("r.json");
  const Json & ofScan = report["labels"][0]["skeleton"];
  EXPECT_EQ(ofScan["tips"], 2);
  EXPECT_EQ(ofScan["branches"], 1);
  EXPECT_EQ(report["skeleton"]["tolerance"], "1.2diag");
  for (const Json & label : report["labels"])
  {
    EXPECT_EQ(label["skeleton"]["betti"], label["shape"]["betti"]);
    EXPECT_EQ(label["certificate"]["covered"], true);
  }
  // It says of itself what it was made of, and nought prunes nothing.
  Run({ "skeleton", Path("a.nrrd"), "-o", Path("whole.vtp") });
  EXPECT_NE(ReadAll(m_Folder / "one.vtp"), ReadAll(m_Folder / "whole.vtp"));
  EXPECT_NE(UnpackedVtp(ReadAll(m_Folder / "one.vtp")).find("\"tolerance\":\"1.2diag\""), std::string::npos);
  Run({ "skeleton", Path("a.nrrd"), "--tolerance", "0", "-o", Path("nought.vtp") });
  EXPECT_EQ(ReadAll(m_Folder / "nought.vtp"), ReadAll(m_Folder / "whole.vtp"));
  const auto refused = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "skeleton");
    options.insert(options.end(), { "-o", Path("x.vtp") });
    return RunProgram(options);
  };
  ExpectRefusal(refused({ Path("a.nrrd"), "--tolerance", "1vox,2vox" }), 2, { "--tolerance", "one" });
  ExpectRefusal(refused({ Path("m.vtp"), "--tolerance", "2vox" }), 2, { "--tolerance", "m.vtp" });
}

TEST_F(ToleranceCommand, DegenerateShapesPass)
{
  TestScan scan({ 40, 24, 24 });
  scan.Fill({ 1, 1, 1 }, { 1, 1, 1 }, 1);   // a voxel
  scan.Fill({ 3, 1, 1 }, { 30, 1, 1 }, 2);  // a rod
  scan.Fill({ 1, 4, 3 }, { 30, 20, 3 }, 3); // a plate
  scan.Fill({ 33, 1, 1 }, { 33, 1, 1 }, 4); // voxels that touch along an edge and at a corner
  scan.Fill({ 34, 2, 1 }, { 34, 2, 1 }, 4);
  scan.Fill({ 35, 3, 2 }, { 35, 3, 2 }, 4);
  scan.Fill({ 4, 4, 8 }, { 18, 18, 20 }, 5); // a shell
  scan.Fill({ 6, 6, 10 }, { 16, 16, 18 }, 0);
  WriteNrrd(m_Folder / "a.nrrd", scan);
  Run({ "core",
        Path("a.nrrd"),
        "--tolerance",
        "0,1vox,1.2diag,100vox",
        "-o",
        Path("m.vtp"),
        "--report",
        Path("r.json"),
        "-q" });
  const Json report = Report("r.json");
  for (const Json & label : report["labels"])
  {
    EXPECT_EQ(label["certificate"]["passed"], true);
    EXPECT_EQ(label["certificate"]["covered"], true);
    const Json & last = label["pruned"][3];
    if (label["label"] != 5)
    {
      EXPECT_EQ(last["vertices"], label["shape"]["betti"][0]) << "a point for each piece";
    }
    else
    {
      EXPECT_GT(last["faces"].get<int>(), 0) << "a shell cannot shrink";
    }
  }
  Run({ "verify", Path("a.nrrd"), Path("m_tolerance-1.2diag.vtp") });
  Run({ "verify", Path("a.nrrd"), Path("m_tolerance-100vox.vtp") });
}

TEST_F(ToleranceCommand, ManyLabelsAtOncePass)
{
  constexpr std::size_t side = 45;
  std::string           bytes(2 * side * side * side, '\0');
  std::size_t           value = 0;
  for (std::size_t k = 0; k < 9; ++k)
  {
    for (std::size_t j = 0; j < 9; ++j)
    {
      for (std::size_t i = 0; i < 9 && value < 724; ++i)
      {
        ++value;
        // Blocks of 1 to 4 voxels a side.
        for (std::size_t z = 0; z <= value % 4; ++z)
        {
          for (std::size_t y = 0; y <= value / 4 % 4; ++y)
          {
            for (std::size_t x = 0; x <= value / 16 % 4; ++x)
            {
              const std::size_t at = 2 * (((5 * k + z) * side + 5 * j + y) * side + 5 * i + x);
              bytes[at] = static_cast<char>(value % 256);
              bytes[at + 1] = static_cast<char>(value / 256);
            }
          }
        }
      }
    }
  }
  WriteNrrd(m_Folder / "a.nrrd",
            "type: uint16\nendian: little\ndimension: 3\nsizes: 45 45 45\nspacings: 1 1 1\n",
            bytes);
  Run({ "core", Path("a.nrrd"), "--tolerance", "1vox", "-o", Path("m.vtp"), "--report", Path("r.json") });
  const Json report = Report("r.json");
  ASSERT_EQ(report["labels"].size(), 724U);
  for (const Json & label : report["labels"])
  {
    EXPECT_EQ(label["certificate"]["covered"], true) << label["label"];
  }
}

TEST_F(ToleranceCommand, RefusesWhatMakesNoSense)
{
  WriteBallWithRodAndPlate("a.nrrd");
  Run({ "core", Path("a.nrrd"), "--lambda", "1.5vox", "-o", Path("lambda.vtp"), "--keep-edges" });
  Run({ "core", Path("a.nrrd"), "--tolerance", "2vox", "--keep-edges", "-o", Path("tolerance.vtp") });
  const Names before = m_Folder.Names();
  const auto  core = [&](std::vector<std::string> options) {
    options.insert(options.begin(), { "core", Path("a.nrrd"), "-o", Path("x.vtp") });
    return RunProgram(options);
  };
  ExpectRefusal(core({ "--tolerance", "2%" }), 2, { "2%", "diag" });
  ExpectRefusal(core({ "--tolerance", "-1vox" }), 2, { "-1vox" });
  ExpectRefusal(core({ "--tolerance", "" }), 2, { "tolerance" });
  ExpectRefusal(core({ "--tolerance", "1,1mm" }), 2, { "--tolerance", "twice" });
  ExpectRefusal(core({ "--tolerance", "1vox", "--lambda", "0,1mm" }), 2, { "--lambda", "floor" });
  const auto prune = [&](const std::string & file, std::vector<std::string> options) {
    options.insert(options.begin(), { "prune", Path(file), "-o", Path("x.vtp") });
    return RunProgram(options);
  };
  ExpectRefusal(prune("tolerance.vtp", {}), 2, { "--lambda", "--tolerance" });
  ExpectRefusal(prune("tolerance.vtp", { "--tolerance", "3vox", "--lambda", "3vox" }),
                2,
                { "--lambda", "--tolerance" });
  ExpectRefusal(prune("lambda.vtp", { "--tolerance", "3vox" }), 3, { "lambda.vtp", "--tolerance 0" });
  ExpectRefusal(prune("tolerance.vtp", { "--tolerance", "1vox" }), 3, { "tolerance.vtp", "2vox", "1vox" });
  ExpectRefusal(prune("tolerance.vtp", { "--lambda", "3vox" }), 3, { "tolerance.vtp", "tolerance" });
  EXPECT_EQ(m_Folder.Names(), before);
}

} // namespace
} // namespace voxelcore::testing
