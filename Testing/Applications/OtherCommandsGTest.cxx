// help, info, phantom, prune, verify as a user runs them.

#include "CommandFixture.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <cstring>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;
using Names = std::set<std::string>;

class OtherCommands : public CommandFixture
{};

TEST_F(OtherCommands, HelpHasExamplesUnitsAndExitCodes)
{
  const std::string help = Run({ "--help" });
  for (const char * word : { "core", "info", "verify", "prune", "phantom", "130", "mm", "Example" })
  {
    EXPECT_NE(help.find(word), std::string::npos) << word;
  }
  for (const char * command : { "core", "info", "verify", "prune", "phantom" })
  {
    const std::string text = Run({ command, "--help" });
    EXPECT_NE(text.find("Example"), std::string::npos) << command;
    EXPECT_NE(text.find(std::string("voxelcore ") + command), std::string::npos) << command;
    EXPECT_NE(text.find("--threads"), std::string::npos) << command;
  }
  const std::string core = Run({ "core", "--help" });
  for (const char * word : { "1.5mm", "2.5vox", "2.5%", "1.5vox", "2.44vox", "thick slices", "--force", "X,Y,Z" })
  {
    EXPECT_NE(core.find(word), std::string::npos) << word;
  }
  const std::string version = Run({ "--version" });
  EXPECT_TRUE(version.starts_with("voxelcore " VOXELCORE_VERSION "\n")) << version;
  for (const char * part : { "\nengines: lattice", "VTK 9.", "libtiff 4.", "libpng 1.", "zlib 1.", "OpenMP 20" })
  {
    EXPECT_NE(version.find(part), std::string::npos) << part << " in " << version;
  }
  EXPECT_EQ(version.find("tetgen") != std::string::npos, version.find("AGPL") != std::string::npos);
}

#ifdef VOXELCORE_EARLY_SIGNAL // without a sanitizer, which needs stacks of its own size
TEST_F(OtherCommands, SmallStacksAreServedAndSmallerOnesOfOpenMPRefused)
{
  ASSERT_EQ(RunProgram({ "phantom", "gyroid", "--size", "40", "-o", Path("g.nrrd") }).code, 0);
  ProgramLimits limits;
  limits.stackBytes = 128 << 10;
  for (const std::vector<std::string> & command :
       std::vector<std::vector<std::string>>{ { "core", Path("g.nrrd"), "-o" },
                                              { "skeleton", Path("g.nrrd"), "-o" },
                                              { "sheets", Path("g.nrrd"), "-o" } })
  {
    auto plain = command;
    auto small = command;
    plain.push_back(Path(command[0] + ".vtp"));
    small.push_back(Path(command[0] + "_small.vtp"));
    EXPECT_EQ(RunProgram(plain).code, 0);
    const ProgramResult result = RunProgram(small, limits);
    EXPECT_EQ(result.code, 0) << command[0] << ": " << result.error;
    EXPECT_TRUE(ReadAll(plain.back()) == ReadAll(small.back())) << command[0];
  }
  setenv("OMP_STACKSIZE", "128k", 1);
  const ProgramResult refused = RunProgram({ "core", Path("g.nrrd"), "-o", Path("no.vtp") });
  setenv("OMP_STACKSIZE", "4M", 1);
  const ProgramResult taken = RunProgram({ "core", Path("g.nrrd"), "-o", Path("yes.vtp") });
  unsetenv("OMP_STACKSIZE");
  ExpectRefusal(refused, 2, { "OMP_STACKSIZE=128k", "unset it" });
  EXPECT_EQ(taken.code, 0) << taken.error;
}
#endif

TEST_F(OtherCommands, InfoCountsWhatIsThere)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  const Json info = Json::parse(Run({ "info", m_Folder / "a.nrrd", "--json" }));
  EXPECT_EQ(info["format"], "NRRD");
  EXPECT_EQ(info["pixel_type"], "uint8");
  EXPECT_EQ(info["size"], (Json{ 14, 12, 10 }));
  EXPECT_EQ(info["spacing_mm"], (Json{ 1, 1, 2 }));
  EXPECT_EQ(info["orientation"], "LPS");
  ASSERT_EQ(info["labels"].size(), 3U);
  EXPECT_EQ(info["labels"][0]["voxels"], 479);
  EXPECT_EQ(info["labels"][0]["volume_mm3"], 958);
  EXPECT_EQ(info["labels"][0]["betti"], (Json{ 1, 0, 1 }));
  EXPECT_EQ(info["labels"][0]["bounding_box"]["lower"], (Json{ 1, 1, 1 }));
  EXPECT_EQ(info["labels"][0]["bounding_box"]["size"], (Json{ 6, 10, 8 }));
  EXPECT_EQ(info["labels"][0]["boundary_vertices"], 7 * 11 * 9 - 5 * 9 * 7 + 8);
  const std::string text = Run({ "info", m_Folder / "a.nrrd" });
  for (const char * word : { "NRRD", "uint8", "14 x 12 x 10", "1 x 1 x 2 mm", "LPS", "label-9", "1/0/1" })
  {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
  }
}

TEST_F(OtherCommands, InfoTellsComponentsOfBothConnectivities)
{
  TestScan scan({ 4, 4, 4 });
  scan.At(1, 1, 1) = scan.At(2, 2, 1) = 3; // touch along an edge
  WriteNrrd(m_Folder / "a.nrrd", scan);
  const Json info = Json::parse(Run({ "info", m_Folder / "a.nrrd", "--json" }));
  EXPECT_EQ(info["labels"][0]["betti"][0], 2);
  EXPECT_EQ(info["labels"][0]["components_26"], 1);
  EXPECT_EQ(info["labels"][0]["betti_26"], (Json{ 1, 0, 0 }));
  const std::string surprise =
    "label 3 (label-3): 1 piece touches others over edges or corners alone (50 % of the voxels); join them with "
    "--connectivity joined";
  EXPECT_EQ(info["warnings"], Json{ surprise });
  const std::string text = Run({ "info", m_Folder / "a.nrrd" });
  for (const char * numbers : { "2/0/0", "1/0/0" })
  {
    EXPECT_NE(text.find(numbers), std::string::npos) << text;
  }
  scan.At(1, 2, 1) = 3; // now they are one either way
  WriteNrrd(m_Folder / "a.nrrd", scan);
  EXPECT_EQ(Json::parse(Run({ "info", m_Folder / "a.nrrd", "--json" }))["warnings"], Json::array());
}

TEST_F(OtherCommands, AComponentIsChosenByCoreInfoAndVerifyAlike)
{
  // Two values a voxel: the first is 1 in a block, the second 2 in a part of it.
  std::string bytes(std::size_t{ 2 } * 6 * 6 * 6, '\0');
  for (std::size_t v = 0; v < 216; ++v)
  {
    const bool inner = v % 6 >= 1 && v % 6 <= 4 && v / 6 % 6 >= 1 && v / 6 % 6 <= 4 && v / 36 >= 1 && v / 36 <= 4;
    bytes[2 * v] = inner ? 1 : 0;
    bytes[2 * v + 1] = inner && v / 36 >= 3 ? 2 : 0;
  }
  WriteNrrd(m_Folder / "v.nrrd",
            "type: uint8\ndimension: 4\nsizes: 2 6 6 6\nkinds: vector domain domain domain\nspace: LPS\n"
            "space directions: none (1,0,0) (0,1,0) (0,0,1)\n",
            bytes);
  for (const char * command : { "info", "core" })
  {
    std::vector<std::string> arguments{ command, m_Folder / "v.nrrd" };
    if (std::string(command) == "core")
    {
      arguments.insert(arguments.end(), { "-o", m_Folder / "no.vtp" });
    }
    ExpectRefusal(RunProgram(arguments), 3, { "v.nrrd", "2 values a voxel", "--component 0 to --component 1" });
    arguments.insert(arguments.end(), { "--component", "2" });
    ExpectRefusal(RunProgram(arguments), 3, { "v.nrrd", "no component 2" });
  }
  const Json info = Json::parse(Run({ "info", m_Folder / "v.nrrd", "--component", "1", "--json" }));
  EXPECT_EQ(info["labels"][0]["label"], 2);
  EXPECT_EQ(info["labels"][0]["voxels"], 32);
  Run({ "core", m_Folder / "v.nrrd", "--component", "1", "-o", m_Folder / "v.vtp", "--report", m_Folder / "v.json" });
  const Json report = Json::parse(ReadAll(m_Folder / "v.json"));
  EXPECT_EQ(report["parameters"]["component"], 1);
  EXPECT_EQ(report["labels"][0]["voxels"], 32);
  // verify takes the component that the file names.
  EXPECT_NE(Run({ "verify", m_Folder / "v.nrrd", m_Folder / "v.vtp" }).find("all passed"), std::string::npos);
}

TEST_F(OtherCommands, PhantomWritesEveryFormatAndTheSameVoxelsEachTime)
{
  Json first;
  for (const char * name : { "p.nrrd", "p.nii", "p.nii.gz", "p.mha", "p.mhd", "p.tif" })
  {
    Run({ "phantom", "porous", "--size", "20,18,16", "--spacing", "1,1,1", "--seed", "5", "-o", m_Folder / name });
    const Json info = Json::parse(Run({ "info", m_Folder / name, "--json" }));
    if (first.empty())
    {
      first = info["labels"];
    }
    EXPECT_EQ(info["labels"][0]["voxels"], first[0]["voxels"]) << name;
    EXPECT_EQ(info["labels"][0]["boundary_vertices"], first[0]["boundary_vertices"]) << name;
    EXPECT_EQ(info["size"], (Json{ 20, 18, 16 })) << name;
  }
  for (const std::string & name : m_Folder.Names())
  {
    EXPECT_EQ(name.find(".part"), std::string::npos) << name;
  }
  Run({ "phantom", "porous", "--size", "20,18,16", "--seed", "6", "-o", m_Folder / "q.nrrd" });
  const Json other = Json::parse(Run({ "info", m_Folder / "q.nrrd", "--json" }));
  EXPECT_NE(other["labels"], first) << "another seed, the same voxels";
  EXPECT_NE(Run({ "phantom", "list" }).find("gyroid"), std::string::npos);
}

class Prune : public OtherCommands
{
protected:
  Prune()
  {
    WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
    Run({ "core", m_Folder / "a.nrrd", "--lambda", "0", "--keep-edges", "-o", m_Folder / "whole.vtp" });
  }
  void
  ExpectSameAsCore(const std::vector<std::string> & options, const std::string & source = "whole.vtp")
  {
    std::vector<std::string> prune{ "prune", m_Folder / source, "-o", m_Folder / "pruned.vtp", "--force" };
    std::vector<std::string> core{ "core", m_Folder / "a.nrrd", "-o", m_Folder / "direct.vtp", "--force" };
    prune.insert(prune.end(), options.begin(), options.end());
    core.insert(core.end(), options.begin(), options.end());
    Run(prune);
    Run(core);
    const std::string pruned = ReadAll(m_Folder / "pruned.vtp");
    EXPECT_GT(pruned.size(), 1000U);
    EXPECT_TRUE(pruned == ReadAll(m_Folder / "direct.vtp")) << ::testing::PrintToString(options);
  }
};

TEST_F(Prune, GivesTheBytesOfCore)
{
  for (const char * lambda : { "0", "1mm", "1.5vox", "2vox", "10%", "3.3mm" })
  {
    ExpectSameAsCore({ "--lambda", lambda });
  }
  ExpectSameAsCore({ "--lambda", "50mm", "-q" }); // else warned of: no face is left
  ExpectSameAsCore({ "--lambda", "1.5vox", "--keep-edges" });
  ExpectSameAsCore({ "--lambda", "1.5vox", "--triangles" });
}

TEST_F(Prune, GoesOnFromAPrunedFile)
{
  Run({ "core", m_Folder / "a.nrrd", "--lambda", "1mm", "--keep-edges", "-o", m_Folder / "some.vtp" });
  ExpectSameAsCore({ "--lambda", "1mm" }, "some.vtp");
  ExpectSameAsCore({ "--lambda", "2.5mm" }, "some.vtp");
  ExpectRefusal(RunProgram({ "prune", m_Folder / "some.vtp", "--lambda", "0.5mm", "-o", m_Folder / "no.vtp" }),
                3,
                { "some.vtp", "1mm", "0.5mm" });
}

TEST_F(Prune, GivesTheBytesOfCoreOnAMirroredAnisotropicScanOfManyLabels)
{
  const TestScan cut = CropNifti("/usr/share/mricron/templates/aal.nii.gz", { 70, 90, 60 }, { 30, 30, 30 });
  if (cut.voxels.empty())
  {
    GTEST_SKIP() << "mricron-data is not installed";
  }
  WriteNrrd(m_Folder / "a.nrrd",
            "type: uint8\ndimension: 3\nsizes: 30 30 30\nspace: left-posterior-superior\nspace directions: "
            "(-0.48828125,0,0) (0,0.6,0.8) (0,-2,1.5)\nspace origin: (100.1,-20.7,3)\n",
            { cut.voxels.begin(), cut.voxels.end() });
  Run({ "core", m_Folder / "a.nrrd", "--lambda", "0", "--keep-edges", "-o", m_Folder / "whole.vtp", "--force" });
  ExpectSameAsCore({ "--lambda", "1.5vox" });
  ExpectSameAsCore({ "--lambda", "1.2mm" });
  ExpectSameAsCore({ "--lambda", "5%" });
}

TEST_F(Prune, SeveralLambdasGiveAFileEach)
{
  Run({ "prune", m_Folder / "whole.vtp", "--lambda", "2mm,0,1mm", "-o", m_Folder / "p.vtp" });
  Run({ "core", m_Folder / "a.nrrd", "--lambda", "0,1mm,2mm", "-o", m_Folder / "c.vtp" });
  for (const char * tag : { "0", "1mm", "2mm" })
  {
    EXPECT_EQ(ReadAll(m_Folder / (std::string("p_lambda-") + tag + ".vtp")),
              ReadAll(m_Folder / (std::string("c_lambda-") + tag + ".vtp")));
  }
}

TEST_F(Prune, RefusesWhatItCannotPrune)
{
  Run({ "core", m_Folder / "a.nrrd", "--lambda", "0", "-o", m_Folder / "plain.vtp" });
  const Names before = m_Folder.Names();
  ExpectRefusal(RunProgram({ "prune", m_Folder / "plain.vtp", "--lambda", "1mm", "-o", m_Folder / "no.vtp" }),
                3,
                { "plain.vtp", "--keep-edges" });
  ExpectRefusal(RunProgram({ "prune", m_Folder / "none.vtp", "--lambda", "1mm", "-o", m_Folder / "no.vtp" }),
                3,
                { "none.vtp" });
  ExpectRefusal(RunProgram({ "prune", m_Folder / "a.nrrd", "--lambda", "1mm", "-o", m_Folder / "no.vtp" }),
                3,
                { "a.nrrd" });
  ExpectRefusal(
    RunProgram({ "prune", m_Folder / "whole.vtp", "--lambda", "1mm", "-o", m_Folder / "whole.vtp", "--force" }),
    1,
    { "whole.vtp", "input" });
  EXPECT_EQ(m_Folder.Names(), before);
}

class Verify : public OtherCommands
{
protected:
  Verify()
  {
    WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  }
  ProgramResult
  Check(const std::string & model, const std::string & scan = "a.nrrd")
  {
    return RunProgram({ "verify", m_Folder / scan, m_Folder / model });
  }
};

TEST_F(Verify, PassesOnWhatCoreWrites)
{
  Run({ "core", m_Folder / "a.nrrd", "--lambda", "0,1.5vox,50mm", "-q", "-o", m_Folder / "m.vtp" });
  for (const char * name : { "m_lambda-0.vtp", "m_lambda-1.5vox.vtp", "m_lambda-50mm.vtp" })
  {
    const ProgramResult result = Check(name);
    EXPECT_EQ(result.code, 0) << result.output << result.error;
    EXPECT_EQ(result.error, "");
    EXPECT_NE(result.output.find("label 9 (label-9)"), std::string::npos) << result.output;
    EXPECT_NE(result.output.find("all passed"), std::string::npos) << result.output;
    EXPECT_EQ(result.output.find("FAILED"), std::string::npos) << result.output;
  }
}

TEST_F(Verify, UsesTheOptionsRecordedInTheFile)
{
  Run({ "core", m_Folder / "a.nrrd", "--threshold", "2:9", "--spacing", "1,2,3", "-o", m_Folder / "m.vtp" });
  EXPECT_EQ(Check("m.vtp").code, 0) << Check("m.vtp").output;
  Run({ "core", m_Folder / "a.nrrd", "--binary", "--keep-edges", "--lambda", "1mm", "-o", m_Folder / "b.vtp" });
  EXPECT_EQ(Check("b.vtp").code, 0) << Check("b.vtp").output;
}

TEST_F(Verify, DisagreesWithAnotherScan)
{
  Run({ "core", m_Folder / "a.nrrd", "--labels", "1", "-o", m_Folder / "m.vtp" });
  TestScan other = ThreeBlocks();
  other.At(3, 4, 4) = 1; // the cavity filled
  WriteNrrd(m_Folder / "b.nrrd", other);
  const ProgramResult result = Check("m.vtp", "b.nrrd");
  EXPECT_EQ(result.code, 4);
  EXPECT_NE(result.output.find("FAILED"), std::string::npos);
  EXPECT_NE(result.output.find("SHA-256"), std::string::npos);
  EXPECT_EQ(std::count(result.error.begin(), result.error.end(), '\n'), 1) << result.error;
}

TEST_F(Verify, SeesAMovedVertex)
{
  Run({ "core", m_Folder / "a.nrrd", "--labels", "1", "--lambda", "0", "-o", m_Folder / "m.vtp" });
  const std::string good = UnpackedVtp(ReadAll(m_Folder / "m.vtp"));
  // Points lie in the file as doubles; x = -1 mm of vertex (2.5 + 1.5 ...) occurs many times: move one of them.
  std::size_t tampered = 0;
  std::size_t seen = 0;
  for (std::size_t at = good.find("<AppendedData"); at + 8 < good.size() && seen < 3; ++at)
  {
    double value = 0;
    std::memcpy(&value, good.data() + at, sizeof(value));
    if (value == -1.0 || value == -2.0 || value == 12.0)
    {
      std::string bad = good;
      value += 0.25;
      std::memcpy(bad.data() + at, &value, sizeof(value));
      WriteAll(m_Folder / "bad.vtp", bad);
      const ProgramResult result = Check("bad.vtp");
      EXPECT_TRUE(result.code == 4 || result.code == 3) << result.code << result.output << result.error;
      tampered += result.code == 4 ? 1 : 0;
      ++seen;
    }
  }
  EXPECT_GT(tampered, 0U) << "found no coordinate to tamper with";
}

TEST_F(Verify, RefusesDamagedFiles)
{
  Run({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "m.vtp" });
  const std::string good = UnpackedVtp(ReadAll(m_Folder / "m.vtp"));
  WriteAll(m_Folder / "half.vtp", good.substr(0, good.size() / 2));
  WriteAll(m_Folder / "text.vtp", "no model");
  ExpectRefusal(Check("half.vtp"), 3, { "half.vtp" });
  ExpectRefusal(Check("text.vtp"), 3, { "text.vtp" });
  ExpectRefusal(Check("none.vtp"), 3, { "none.vtp" });
  ExpectRefusal(Check("m.vtp", "none.nrrd"), 3, { "none.nrrd" });
  std::string record = good;
  const auto  at = record.find("boundary_vertices");
  ASSERT_NE(at, std::string::npos) << "Provenance is no plain text in the file; tamper otherwise";
  record.replace(at, 8, "BOUNDARY");
  WriteAll(m_Folder / "record.vtp", record);
  ExpectRefusal(Check("record.vtp"), 3, { "record.vtp", "Provenance" });
}

} // namespace
} // namespace voxelcore::testing
