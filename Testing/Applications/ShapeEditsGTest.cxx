// --crop, --mend-shape, --fill-cavities, --min-voxels, --largest, --smooth-shape, --simplify-topology,
// --tree, --connectivity, --split-components as a user gives them.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;
using Names = std::set<std::string>;
using Texts = std::vector<std::string>;

/** 30 x 12 x 12 voxels of 1 x 1 x 2 mm. Label 1: a hollow block (voxels 1 to 8 each way, a cavity of 4^3 with a voxel
 *  floating in it), a block of 5 x 5 x 5, and two single voxels. Label 2: two blocks of 3 x 3 x 3 each. */
TestScan
Pieces()
{
  TestScan scan({ 30, 12, 12 });
  scan.spacing = { 1, 1, 2 };
  scan.Fill({ 1, 1, 1 }, { 8, 8, 8 }, 1);
  scan.Fill({ 3, 3, 3 }, { 6, 6, 6 }, 0);
  scan.At(4, 4, 4) = 1;
  scan.Fill({ 11, 2, 2 }, { 15, 6, 6 }, 1);
  scan.At(11, 10, 1) = 1;
  scan.At(13, 10, 1) = 1;
  scan.Fill({ 20, 2, 2 }, { 22, 4, 4 }, 2);
  scan.Fill({ 25, 2, 2 }, { 27, 4, 4 }, 2);
  return scan;
}

constexpr int kHollow = 512 - 64; // voxels of the hollow block's wall

class ShapeEdits : public ::testing::Test
{
protected:
  ShapeEdits()
  {
    WriteNrrd(m_Folder / "a.nrrd", Pieces());
  }

  static std::string
  Run(const Texts & arguments)
  {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_EQ(WithoutDiagnoses(result.error), "");
    return result.output;
  }

  Texts
  With(Texts arguments, const Texts & edits) const
  {
    arguments.insert(arguments.begin() + 1, m_Folder / "a.nrrd");
    arguments.insert(arguments.end(), edits.begin(), edits.end());
    return arguments;
  }

  /** `core` with these edits: its report. The file must pass `verify`. */
  Json
  Core(const Texts & edits)
  {
    Run(With({ "core", "-o", m_Folder / "m.vtp", "--report", m_Folder / "m.json", "--force" }, edits));
    ExpectVerified("m.vtp");
    return Json::parse(ReadAll(m_Folder / "m.json"));
  }

  void
  ExpectVerified(const std::string & model)
  {
    const ProgramResult result = RunProgram({ "verify", m_Folder / "a.nrrd", m_Folder / model });
    EXPECT_EQ(result.code, 0) << result.output << result.error;
    EXPECT_EQ(result.error, "");
    EXPECT_NE(result.output.find("all passed"), std::string::npos) << result.output;
  }

  Json
  Info(const Texts & edits)
  {
    return Json::parse(Run(With({ "info", "--json" }, edits)));
  }

  TemporaryFolder m_Folder;
};

/** Label 0 of a report as voxels, b0, b1, b2. */
std::vector<int>
First(const Json & report)
{
  const Json & label = report["labels"][0];
  const Json & betti = label.contains("shape") ? label["shape"]["betti"] : label["betti"];
  return { label["voxels"], betti[0], betti[1], betti[2] };
}

using Numbers = std::vector<int>;

TEST_F(ShapeEdits, WithoutThemNothingIsChangedOrSaid)
{
  const Json report = Core({});
  EXPECT_EQ(First(report), (Numbers{ kHollow + 1 + 125 + 2, 5, 0, 1 }));
  EXPECT_FALSE(report["labels"][0].contains("edits"));
  EXPECT_FALSE(report["labels"][0].contains("component"));
  EXPECT_TRUE(report["parameters"]["crop"].is_null());
}

TEST_F(ShapeEdits, CropCutsByVoxelsLikeASlice)
{
  // x 4 to 12 of the hollow block and of the other one; y and z whole.
  const Json report = Core({ "--crop", "4:13,:,0:12" });
  EXPECT_EQ(report["parameters"]["crop"], (Json{ { 4, 13 }, { 0, 12 }, { 0, 12 } }));
  ASSERT_EQ(report["labels"].size(), 1U) << "label 2 lies outside";
  EXPECT_EQ(report["parameters"]["labels"], Json{ 1 });
  // Of the hollow block 5 of 8 slices, 3 of them with a hole of 4 x 4; cut open it is a pot. One of the single voxels.
  EXPECT_EQ(First(report), (Numbers{ 5 * 64 - 3 * 16 + 1 + 2 * 25 + 1, 4, 0, 0 }));
  EXPECT_EQ(report["labels"][0]["bounding_box"]["lower"], (Json{ 4, 1, 1 }));
  // Places do not move: the same scan with everything else set to 0 gives the same core.
  TestScan rest = Pieces();
  for (std::size_t at = 0; at < rest.voxels.size(); ++at)
  {
    const std::size_t x = at % 30;
    rest.voxels[at] = x >= 4 && x < 13 ? rest.voxels[at] : std::uint8_t{ 0 };
  }
  WriteNrrd(m_Folder / "rest.nrrd", rest);
  Run({ "core", m_Folder / "a.nrrd", "--crop", "4:13,:,:", "-o", m_Folder / "c.obj" });
  Run({ "core", m_Folder / "rest.nrrd", "-o", m_Folder / "r.obj" });
  EXPECT_EQ(ReadAll(m_Folder / "c.obj"), ReadAll(m_Folder / "r.obj"));
}

TEST_F(ShapeEdits, FillingJoinsWhatFloatsInside)
{
  const Json report = Core({ "--fill-cavities" });
  EXPECT_EQ(First(report), (Numbers{ 512 + 125 + 2, 4, 0, 0 }));
  const Json & edits = report["labels"][0]["edits"];
  EXPECT_EQ(edits["cavities_filled"], 1);
  EXPECT_EQ(edits["voxels_added"], 63);
  EXPECT_EQ(edits["components_joined"], 1);
  EXPECT_EQ(report["labels"][1]["edits"]["cavities_filled"], 0);
}

TEST_F(ShapeEdits, GapsCloseUpToTheWidthGiven)
{
  // The blocks of label 2 lie two voxels (2 mm) apart, and those of label 1 so, too.
  const Json wide = Core({ "--close", "2mm" });
  EXPECT_EQ(wide["parameters"]["close"], "2mm");
  EXPECT_EQ(wide["labels"][1]["shape"]["betti"], (Json{ 1, 0, 0 }));
  EXPECT_EQ(wide["labels"][1]["edits"]["closed"]["components_joined"], 1);
  EXPECT_GT(wide["labels"][0]["edits"]["closed"]["voxels_added"], 0);
  const Json narrow = Core({ "--close", "1.9mm" });
  EXPECT_EQ(narrow["labels"][1]["shape"]["betti"], (Json{ 2, 0, 0 }));
  EXPECT_EQ(Info({ "--close", "2vox" })["labels"][1]["betti"], (Json{ 1, 0, 0 }));
  EXPECT_FALSE(Core({})["parameters"].contains("close"));
  Run(With({ "skeleton", "-o", m_Folder / "s.vtp", "--force" }, { "--close", "2vox", "--labels", "2" }));
}

/** A tube along i that is open at its ends, 3 wide inside, and a box with a hole of two voxels through its wall. */
TestScan
Hollow()
{
  TestScan scan({ 40, 20, 20 });
  scan.Fill({ 1, 1, 1 }, { 15, 5, 5 }, 1);
  scan.Fill({ 1, 2, 2 }, { 15, 4, 4 }, 0);
  scan.Fill({ 20, 1, 1 }, { 38, 16, 16 }, 3);
  scan.Fill({ 22, 3, 3 }, { 36, 14, 14 }, 0);
  scan.Fill({ 28, 6, 1 }, { 29, 7, 2 }, 0);
  return scan;
}

TEST_F(ShapeEdits, LumensFillSliceBySliceOrBehindTheirHoles)
{
  WriteNrrd(m_Folder / "a.nrrd", Hollow());
  const Json slices = Core({ "--fill-slices", "i" });
  EXPECT_EQ(slices["parameters"]["fill_slices"], "i");
  EXPECT_EQ(First(slices), (Numbers{ 15 * 5 * 5, 1, 0, 0 }));
  EXPECT_EQ(slices["labels"][0]["edits"]["slices_filled"]["holes"], 15);
  const Json hollows = Core({ "--fill-hollows", "2vox" });
  EXPECT_EQ(hollows["labels"][0]["edits"]["hollows_filled"]["voxels_added"], 0) << "a tube with open ends has a mouth";
  EXPECT_EQ(hollows["labels"][1]["edits"]["hollows_filled"]["holes"], 1);
  EXPECT_EQ(hollows["labels"][1]["shape"]["betti"], (Json{ 1, 0, 0 }));
  EXPECT_EQ(Core({ "--fill-slices", "k" })["labels"][0]["edits"]["slices_filled"]["holes"], 0);
}

TEST_F(ShapeEdits, AMedianTakesEdgesAndFillsCorners)
{
  WriteNrrd(m_Folder / "a.nrrd", Hollow());
  const Json median = Core({ "--median", "3", "--labels", "3" });
  EXPECT_EQ(median["parameters"]["median"], 3);
  EXPECT_GT(median["labels"][0]["edits"]["median"]["voxels_removed"], 0);
  EXPECT_GT(median["labels"][0]["edits"]["median"]["voxels_added"], 0);
}

TEST_F(ShapeEdits, WidthsAndAxesThatAreNoneAreRefused)
{
  const auto refused = [&](const Texts & edits, int code, const char * word) {
    const ProgramResult result = RunProgram(With({ "info" }, edits));
    EXPECT_EQ(result.code, code) << result.error;
    EXPECT_NE(result.error.find(word), std::string::npos) << result.error;
  };
  refused({ "--close", "4%" }, 2, "--close: width '4%' has an unknown unit");
  refused({ "--fill-hollows", "0" }, 2, "--fill-hollows: width '0' is 0");
  refused({ "--fill-slices", "z" }, 2, "--fill-slices z: expected i, j or k");
  refused({ "--median", "4" }, 2, "--median 4: expected an odd number from 3 to 15");
  refused({ "--close", "5000vox" }, 3, "more than 2000 voxels");
}

TEST_F(ShapeEdits, DustIsRemovedAndTheLargestKept)
{
  const Json clean = Core({ "--min-voxels", "126" });
  EXPECT_EQ(First(clean), (Numbers{ kHollow, 1, 0, 1 }));
  EXPECT_EQ(clean["labels"][0]["edits"]["components_removed"], 4);
  EXPECT_EQ(clean["labels"][0]["edits"]["voxels_removed"], 128);
  ASSERT_EQ(clean["labels"].size(), 1U) << "label 2 has no component that large";
  EXPECT_EQ(First(Core({ "--min-voxels", "125" })), (Numbers{ kHollow + 125, 2, 0, 1 }));
  const Json largest = Core({ "--largest", "1" });
  ASSERT_EQ(largest["labels"].size(), 2U);
  EXPECT_EQ(First(largest), (Numbers{ kHollow, 1, 0, 1 }));
  // Equally large: the one that comes first.
  EXPECT_EQ(largest["labels"][1]["bounding_box"]["lower"], (Json{ 20, 2, 2 }));
}

TEST_F(ShapeEdits, FillingComesBeforeCounting)
{
  // The wall alone has 448 voxels, the solid block 512.
  EXPECT_EQ(First(Core({ "--min-voxels", "500", "--fill-cavities" })), (Numbers{ 512, 1, 0, 0 }));
}

TEST_F(ShapeEdits, ComponentsAreEntriesOfTheirOwnInOneFile)
{
  const Json report = Core({ "--split-components", "--min-voxels", "2", "--lambda", "1mm" });
  ASSERT_EQ(report["labels"].size(), 4U);
  const std::vector<std::pair<std::string, int>> expected{ { "label-1#1", kHollow },
                                                           { "label-1#2", 125 },
                                                           { "label-2#1", 27 },
                                                           { "label-2#2", 27 } };
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Json & label = report["labels"][i];
    EXPECT_EQ(label["label"], i / 2 + 1);
    EXPECT_EQ(label["component"], i % 2 + 1);
    EXPECT_EQ(label["name"], expected[i].first);
    EXPECT_EQ(label["voxels"], expected[i].second);
    EXPECT_EQ(label["shape"]["betti"][0], 1);
  }
  EXPECT_EQ(report["labels"][3]["bounding_box"]["lower"], (Json{ 25, 2, 2 }));
  EXPECT_EQ(report["parameters"]["labels"], (Json{ 1, 2 }));
  EXPECT_TRUE(report["parameters"]["split_components"]);
}

TEST_F(ShapeEdits, AFolderReceivesAFilePerComponent)
{
  Run(With({ "core", "-o", (m_Folder / "out").string() + "/", "--lambda", "0,1mm" },
           { "--split-components", "--largest", "2" }));
  Names names;
  for (const auto & entry : std::filesystem::directory_iterator(m_Folder / "out"))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names.erase("a_medial_finished.jsonl"), 1U);
  EXPECT_EQ(names,
            (Names{ "a_label-1_component-1_medial_lambda-0.vtp",
                    "a_label-1_component-1_medial_lambda-1mm.vtp",
                    "a_label-1_component-2_medial_lambda-0.vtp",
                    "a_label-1_component-2_medial_lambda-1mm.vtp",
                    "a_label-2_component-1_medial_lambda-0.vtp",
                    "a_label-2_component-1_medial_lambda-1mm.vtp",
                    "a_label-2_component-2_medial_lambda-0.vtp",
                    "a_label-2_component-2_medial_lambda-1mm.vtp" }));
  for (const std::string & name : names)
  {
    ExpectVerified("out/" + name);
  }
}

TEST_F(ShapeEdits, PruningAComponentFileGivesTheBytesOfCore)
{
  const Texts edits{ "--crop", "0:29,:,:", "--split-components", "--fill-cavities", "--min-voxels", "2" };
  Run(With({ "core", "--lambda", "0", "--keep-edges", "-o", m_Folder / "whole.vtp" }, edits));
  Run({ "prune", m_Folder / "whole.vtp", "--lambda", "1.2mm", "-o", m_Folder / "pruned.vtp" });
  Run(With({ "core", "--lambda", "1.2mm", "-o", m_Folder / "direct.vtp" }, edits));
  EXPECT_TRUE(ReadAll(m_Folder / "pruned.vtp") == ReadAll(m_Folder / "direct.vtp"));
}

TEST_F(ShapeEdits, VerifySeesThatTheScanIsAnother)
{
  Run(With({ "core", "--largest", "1", "--labels", "1", "-o", m_Folder / "m.vtp" }, {}));
  TestScan other = Pieces();
  other.At(4, 4, 4) = 0; // a voxel that was removed: the scan is another, what is checked is not
  WriteNrrd(m_Folder / "b.nrrd", other);
  EXPECT_EQ(RunProgram({ "verify", m_Folder / "b.nrrd", m_Folder / "m.vtp" }).code, 0);
  other.At(4, 4, 3) = 1; // now the wall is thicker there
  WriteNrrd(m_Folder / "b.nrrd", other);
  EXPECT_EQ(RunProgram({ "verify", m_Folder / "b.nrrd", m_Folder / "m.vtp" }).code, 4);
}

TEST_F(ShapeEdits, InfoAppliesThemToo)
{
  EXPECT_EQ(First(Info({ "--fill-cavities", "--largest", "1" })), (Numbers{ 512, 1, 0, 0 }));
  const Json split = Info({ "--split-components", "--crop", ":,:,1:9" });
  ASSERT_EQ(split["labels"].size(), 7U);
  EXPECT_EQ(split["labels"][4]["component"], 5);
  EXPECT_EQ(split["labels"][4]["name"], "label-1#5");
  const std::string text = Run(With({ "info" }, { "--min-voxels", "100" }));
  EXPECT_NE(text.find("5 components removed, with 57 voxels"), std::string::npos) << text;
  EXPECT_NE(text.find("nothing is left of label 2 (label-2)"), std::string::npos) << text;
}

TEST_F(ShapeEdits, CoreSaysWhatWasChanged)
{
  const std::string text = Run(With({ "core", "-o", m_Folder / "m.vtp" }, { "--fill-cavities", "--largest", "1" }));
  EXPECT_NE(text.find("1 cavity filled with 63 voxels, 1 component in them joined"), std::string::npos) << text;
  EXPECT_NE(text.find("4 components removed, with 154 voxels"), std::string::npos) << text;
}

TEST_F(ShapeEdits, LabelsThatLookHollowAreToldOfUntilTheyAreFilled)
{
  for (const bool filled : { false, true })
  {
    const Texts         fill = filled ? Texts{ "--fill-cavities" } : Texts{};
    const ProgramResult core =
      RunProgram(With({ "core", "-o", m_Folder / "m.vtp", "--force", "--report", m_Folder / "r.json" }, fill));
    const ProgramResult info = RunProgram(With({ "info", "--labels", "1" }, fill));
    for (const ProgramResult & result : { core, info })
    {
      EXPECT_EQ(result.code, 0) << result.error;
      EXPECT_EQ(result.error.find("looks hollow: it walls in 0.11 times its own volume") == std::string::npos, filled)
        << result.error;
    }
    const Json label = Json::parse(ReadAll(m_Folder / "r.json")).at("labels").at(0);
    EXPECT_EQ(label.contains("hollow"), !filled);
    EXPECT_EQ(UnpackedVtp(ReadAll(m_Folder / "m.vtp")).find("hollow"), std::string::npos);
  }
}

/** A block of 14 x 14 x 14 with a bump and a pit of one voxel, and a rod of one voxel's width that was cut off it. */
TestScan
Rough()
{
  TestScan scan({ 30, 18, 18 });
  scan.Fill({ 2, 2, 2 }, { 15, 15, 15 }, 1);
  scan.At(8, 8, 16) = 1;
  scan.At(8, 2, 8) = 0;
  scan.Fill({ 17, 8, 8 }, { 26, 8, 8 }, 1);
  return scan;
}

TEST_F(ShapeEdits, SmoothingFlipsSingleVoxelsAndKeepsTheTopology)
{
  WriteNrrd(m_Folder / "a.nrrd", Rough());
  const Json report = Core({ "--smooth-shape", "--lambda", "1.5vox", "--keep-edges" });
  EXPECT_EQ(First(report), (Numbers{ 14 * 14 * 14 + 10, 2, 0, 0 }));
  const Json & smoothed = report["labels"][0]["edits"]["smoothed"];
  EXPECT_EQ(smoothed, (Json{ { "voxels_added", 1 }, { "voxels_removed", 1 }, { "largest_shift_voxels", 1.0 } }));
  EXPECT_TRUE(report["parameters"]["smooth_shape"]);
  EXPECT_FALSE(report["labels"][0]["edits"].contains("mended"));
  EXPECT_EQ(First(Info({ "--smooth-shape" })), (Numbers{ 14 * 14 * 14 + 10, 2, 0, 0 }));
  const std::string text = Run(With({ "core", "-o", m_Folder / "n.vtp" }, { "--smooth-shape" }));
  EXPECT_NE(text.find("smoothed: 1 voxel added, 1 removed; the boundary moved by 1.00 voxels at most"),
            std::string::npos)
    << text;
  Run({ "prune", m_Folder / "m.vtp", "--lambda", "3vox", "-o", m_Folder / "p.vtp" });
  ExpectVerified("p.vtp");
}

TEST_F(ShapeEdits, MendingComesBeforeDustIsRemoved)
{
  WriteNrrd(m_Folder / "a.nrrd", Rough());
  EXPECT_EQ(First(Core({ "--largest", "1" })), (Numbers{ 14 * 14 * 14, 1, 0, 0 }));
  const Json report = Core({ "--largest", "1", "--mend-shape", "--smooth-shape" });
  EXPECT_EQ(First(report), (Numbers{ 14 * 14 * 14 + 11, 1, 0, 0 }));
  EXPECT_EQ(report["labels"][0]["edits"]["mended"]["pieces_joined"], 1);
  EXPECT_EQ(report["labels"][0]["edits"]["mended"]["voxels_added"], 1);
  EXPECT_EQ(report["labels"][0]["edits"]["components_removed"], 0);
  Run({ "skeleton", m_Folder / "a.nrrd", "--mend-shape", "--smooth-shape", "-o", m_Folder / "s.vtp" });
}

TEST_F(ShapeEdits, VoxelsThatTouchOverCornersAreJoinedAndTheirListMakesTheSameShape)
{
  TestScan scan({ 12, 12, 12 });
  for (int i = 1; i < 10; ++i)
  {
    scan.At(i, i, i) = 1;
  }
  WriteNrrd(m_Folder / "a.nrrd", scan);
  EXPECT_EQ(First(Core({})), (Numbers{ 9, 9, 0, 0 }));
  const Json report = Core({ "--connectivity", "26" });
  EXPECT_EQ(First(report), (Numbers{ 25, 1, 0, 0 }));
  EXPECT_EQ(report["parameters"]["connectivity"], 26);
  const Json & made = report["labels"][0]["edits"]["connected"];
  EXPECT_EQ(made["closed_mask"]["betti"], (Json{ 1, 0, 0 }));
  EXPECT_EQ(made["pieces_joined"], 8);
  EXPECT_EQ(made["voxels_added"], 16);
  EXPECT_EQ(made["voxels_removed"], 0);
  std::ofstream list(m_Folder / "changes.txt");
  for (const Json & run : made["changes"])
  {
    list << run.get<std::string>() << '\n';
  }
  list.close();
  const Json again = Core({ "--change-voxels", m_Folder / "changes.txt" });
  EXPECT_EQ(First(again), (Numbers{ 25, 1, 0, 0 }));
  EXPECT_EQ(again["labels"][0]["core"], report["labels"][0]["core"]);
  for (const Texts & options : { Texts{ "--tree" },
                                 Texts{ "--simplify-topology", "2vox", "--pieces", "1" },
                                 Texts{ "--mend-shape" },
                                 Texts{ "--close", "3vox" } })
  {
    EXPECT_EQ(First(Core(options)), (Numbers{ 25, 1, 0, 0 })) << options[0] << ": joined, not removed";
  }
  EXPECT_EQ(First(Core({ "--simplify-topology", "2vox", "--pieces", "4" })), (Numbers{ 19, 4, 0, 0 }));
  const Json tree = Core({ "--tree" })["labels"][0]["edits"]["topology_simplified"];
  EXPECT_EQ(tree["before"]["betti"], (Json{ 9, 0, 0 }));
  EXPECT_EQ(tree["fills"], 8);
  EXPECT_EQ(tree["voxels_added"], 16);
  EXPECT_EQ(tree["changes"][0]["voxels"], 2);
  EXPECT_EQ(tree["changes"][0]["pieces"], -1);
}

TEST_F(ShapeEdits, SkeletonsJoinPiecesThatTouchAndCoresSayThatTheyMay)
{
  TestScan scan({ 12, 12, 12 });
  for (int i = 1; i < 10; ++i)
  {
    scan.At(i, i, i) = 1;
  }
  WriteNrrd(m_Folder / "a.nrrd", scan);
  const auto run = [&](const Texts & arguments) {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << result.error;
    return result.error + result.output;
  };
  const auto has = [](const std::string & text, const std::string & part) {
    return text.find(part) != std::string::npos;
  };
  const auto skeleton = [&](const Texts & more) {
    return run(With({ "skeleton", "-o", m_Folder / "s.vtp", "--report", m_Folder / "s.json", "--force" }, more));
  };
  const auto        report = [&] { return Json::parse(ReadAll(m_Folder / "s.json")); };
  const std::string said = "8 pieces fewer, with 16 voxels; to keep them apart: --connectivity 6";
  const std::string advice =
    "label 1 (label-1): 8 pieces touch others over edges or corners alone (89 % of the voxels); join them with "
    "--connectivity joined";

  EXPECT_TRUE(has(skeleton({}), said));
  EXPECT_EQ(First(report()), (Numbers{ 25, 1, 0, 0 }));
  EXPECT_EQ(report()["parameters"]["connectivity"], "joined");
  EXPECT_EQ(report()["labels"][0]["skeleton"]["branches"], 1);
  const Json made = report()["labels"][0]["edits"]["touching"];
  EXPECT_EQ(made["pieces_joined"], 8);
  EXPECT_EQ(made["pieces_apart"], 0);
  EXPECT_EQ(made["voxels_added"], 16);

  const std::string apart = skeleton({ "--connectivity", "6" });
  EXPECT_FALSE(has(apart, said)) << apart;
  EXPECT_EQ(First(report()), (Numbers{ 9, 9, 0, 0 }));
  EXPECT_EQ(report()["labels"][0]["diagnosis"]["touching_pieces"], 8);

  const std::string core = run(With({ "core", "--lambda", "0", "-o", m_Folder / "c.vtp" }, {}));
  EXPECT_TRUE(has(core, advice)) << core;
  const std::string ofCore = run({ "skeleton", m_Folder / "c.vtp", "-o", m_Folder / "t.vtp" });
  EXPECT_TRUE(has(ofCore, "make the core with --connectivity joined")) << ofCore;
  const std::string joined =
    run(With({ "core", "--lambda", "0", "-o", m_Folder / "c.vtp", "--force" }, { "--connectivity", "joined" }));
  EXPECT_TRUE(has(joined, said) && !has(joined, advice)) << joined;
  ExpectVerified("c.vtp");
  const std::string ofJoined = run({ "skeleton", m_Folder / "c.vtp", "-o", m_Folder / "t.vtp", "--force" });
  EXPECT_TRUE(has(ofJoined, "was made with --connectivity joined")) << ofJoined;
}

TEST_F(ShapeEdits, TheTopologyAskedForIsMadeAndItsChangesAreListed)
{
  const Json   report = Core({ "--labels", "2", "--simplify-topology", "1vox", "--pieces", "1" });
  const Json & label = report["labels"][0];
  EXPECT_EQ(label["voxels"], 2 * 27 + 2);
  EXPECT_EQ(label["shape"]["betti"], (Json{ 1, 0, 0 }));
  const Json & made = label["edits"]["topology_simplified"];
  EXPECT_EQ(made["before"]["betti"], (Json{ 2, 0, 0 }));
  EXPECT_EQ(made["as_asked"], true);
  ASSERT_EQ(made["changes"].size(), 1U);
  const Json & fill = made["changes"][0];
  EXPECT_EQ(fill["kind"], "fill");
  EXPECT_EQ(fill["voxels"], 2);
  EXPECT_EQ(fill["cost_voxels"], 2);
  EXPECT_EQ(fill["pieces"], -1);
  const double origin = report["input"]["origin_mm"][0];
  EXPECT_EQ(fill["centre_mm"][0], origin + 23.5) << "between voxels 23 and 24";
  EXPECT_EQ(report["parameters"]["simplify_topology"], "1vox");

  // Five pieces of label 1 are not nine, and no cut makes them so.
  const Texts nine{ "--labels", "1", "--simplify-topology", "1vox", "--pieces", "9" };
  const Json  missed = Core(nine)["labels"][0];
  EXPECT_EQ(missed["edits"]["topology_simplified"]["as_asked"], false);
  EXPECT_LT(missed["shape"]["betti"][0], 9);
  const std::string text = Run(With({ "core", "-o", m_Folder / "n.vtp" }, nine));
  EXPECT_NE(text.find("was not reached within 1vox of the boundary"), std::string::npos) << text;
}

TEST_F(ShapeEdits, WrongUseAndUnfitInputAreToldApart)
{
  const auto refuse = [&](const Texts & edits, int code, const Texts & words) {
    SCOPED_TRACE(edits[1]);
    for (const char * command : { "core", "info" })
    {
      Texts arguments = With({ command }, edits);
      if (std::string(command) == "core")
      {
        arguments.insert(arguments.end(), { "-o", m_Folder / "no.vtp" });
      }
      ExpectRefusal(RunProgram(arguments), code, words);
    }
  };
  for (const char * crop : { "0:5", "5:5,:,:", "9:5,:,:", "a:b,:,:", "0:5,0:5,-3:5" })
  {
    refuse({ "--crop", crop }, 2, { "--crop", crop });
  }
  refuse({ "--crop=-1:5,:,:", "--quiet" }, 2, { "--crop", "-1:5" });
  refuse({ "--min-voxels", "0" }, 2, { "--min-voxels" });
  refuse({ "--pieces", "1" }, 2, { "--pieces", "--simplify-topology" });
  refuse({ "--simplify-topology", "0" }, 2, { "--simplify-topology" });
  refuse({ "--simplify-topology", "40vox" }, 3, { "40vox", "32 voxels" });
  refuse({ "--largest", "0" }, 2, { "--largest" });
  refuse({ "--largest", "some" }, 2, { "--largest" });
  refuse({ "--crop", "0:31,:,:" }, 3, { "a.nrrd", "--crop", "30 x 12 x 12" });
  refuse({ "--crop", ":,12:,:" }, 3, { "a.nrrd", "--crop :,12:,: " });
  refuse({ "--crop", "0:1,:,:" }, 3, { "a.nrrd", "every voxel within the crop is 0" });
  refuse({ "--crop", "4:13,:,:", "--labels", "1,2" }, 3, { "a.nrrd", "no label '2' within the crop" });
  refuse({ "--min-voxels", "1000" }, 3, { "a.nrrd", "nothing is left" });
  refuse({ "--min-voxels", "100", "--labels", "1,2" }, 3, { "a.nrrd", "label 2" });
  EXPECT_EQ(m_Folder.Names(), (Names{ "a.nrrd" }));
}

TEST_F(ShapeEdits, AnOpenThresholdIsVerified)
{
  Core({ "--threshold", "2:inf" });
  Core({ "--threshold=-inf:1", "--crop", "9:19,:,:", "--split-components", "--largest", "1" });
}

} // namespace
} // namespace voxelcore::testing
