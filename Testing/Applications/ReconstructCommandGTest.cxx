// The balls of a core as a volume.

#include "CommandFixture.h"
#include "Program.h"
#include "Scans.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

class Reconstruct : public CommandFixture
{};

// A voxel's centre lies in a Delaunay cell and so in its ball; no ball holds a centre beyond the boundary's squares.
TEST_F(Reconstruct, AWholeCoreGivesTheScanBack)
{
  TestScan scan = ThreeBlocks();
  scan.spacing = { 1, 1, 1 };
  scan.At(0, 0, 0) = 9; // a voxel by itself
  WriteNrrd(m_Folder / "a.nrrd", scan);
  Run({ "core", Path("a.nrrd"), "--lambda", "0", "-o", Path("m.vtp") });
  Run({ "reconstruct", Path("m.vtp"), "-o", Path("r.nrrd"), "--scan", Path("a.nrrd"), "--report", Path("r.json") });
  const Json report = Report("r.json");
  ASSERT_EQ(report["labels"].size(), 3U);
  for (const Json & label : report["labels"])
  {
    EXPECT_EQ(label["dice"], 1.0);
    EXPECT_EQ(label["voxels"], label["scan_voxels"]);
    EXPECT_EQ(label["largest_surface_distance_mm"], 0.0);
    EXPECT_LT(label["boundary_gap_mm"].get<double>(), 1e-9);
  }
  // The volume itself: its core is the scan's.
  Run({ "core", Path("r.nrrd"), "--lambda", "0", "-o", Path("again.vtp"), "--report", Path("again.json") });
  Run({ "verify", Path("r.nrrd"), Path("again.vtp") });
  Run({ "core", Path("a.nrrd"), "--lambda", "0", "-o", Path("m2.vtp"), "--report", Path("m2.json") });
  EXPECT_EQ(Report("again.json")["labels"][2]["core"], Report("m2.json")["labels"][2]["core"]);
}

TEST_F(Reconstruct, OfAPrunedCoreLosesNoMoreThanTheHeight)
{
  Run({ "phantom", "thick-and-thin", "--size", "48", "-o", Path("a.nrrd") });
  for (const auto & [height, refine] : { std::pair("1.2diag", "off"), { "2diag", "off" }, { "1.2diag", "auto" } })
  {
    Run({ "core",
          Path("a.nrrd"),
          "--tolerance",
          height,
          "--refine",
          refine,
          "-o",
          Path("m.vtp"),
          "--report",
          Path("m.json"),
          "--force" });
    Run({ "reconstruct",
          Path("m.vtp"),
          "-o",
          Path("r.nii.gz"),
          "--scan",
          Path("a.nrrd"),
          "--report",
          Path("r.json"),
          "--force" });
    const Json   pruned = Report("m.json")["labels"][0]["pruned"][0];
    const Json   label = Report("r.json")["labels"][0];
    const double gap = label["boundary_gap_mm"];
    EXPECT_NEAR(gap, pruned["boundary_gap_mm"].get<double>(), 1e-9);
    EXPECT_LE(gap, pruned["tolerance_mm"].get<double>() + 1e-9);
    // A volume's surface lies within a voxel's diagonal of the balls'.
    EXPECT_LE(label["largest_surface_distance_mm"].get<double>(), gap + 1.74);
    EXPECT_GT(label["largest_surface_distance_mm"].get<double>(), 0.0);
    EXPECT_GT(label["dice"].get<double>(), 0.8);
    EXPECT_LT(label["dice"].get<double>(), 1.0);
    if (std::string(refine) == "off") // refined balls touch the smooth surface, not the voxels' corners
    {
      EXPECT_LT(label["voxels"].get<int>(), label["scan_voxels"].get<int>());
    }
  }
  // What lambda loses shows: the rods and the plate.
  Run({ "core", Path("a.nrrd"), "--lambda", "3vox", "-o", Path("l.vtp") });
  Run({ "reconstruct", Path("l.vtp"), "-o", Path("l.nrrd"), "--scan", Path("a.nrrd"), "--report", Path("l.json") });
  EXPECT_GT(Report("l.json")["labels"][0]["boundary_gap_mm"].get<double>(), 5.0);
}

TEST_F(Reconstruct, TakesTheGridOfAnotherScan)
{
  TestScan scan({ 20, 20, 20 });
  scan.Fill({ 4, 4, 4 }, { 15, 12, 10 }, 2);
  WriteNrrd(m_Folder / "a.nrrd", scan);
  TestScan fine({ 40, 40, 40 });
  fine.spacing = { 0.5, 0.5, 0.5 };
  fine.At(0, 0, 0) = 1;
  WriteNrrd(m_Folder / "fine.nrrd", fine);
  Run({ "core", Path("a.nrrd"), "--lambda", "0", "-o", Path("m.vtp") });
  Run({ "reconstruct", Path("m.vtp"), "-o", Path("r.nrrd"), "--like", Path("fine.nrrd"), "--report", Path("r.json") });
  const Json report = Report("r.json");
  EXPECT_EQ(report["size"], (Json{ 40, 40, 40 }));
  const double volume = report["labels"][0]["voxels"].get<double>() / 8;
  EXPECT_NEAR(volume, 12 * 9 * 7, 0.25 * 12 * 9 * 7);
}

TEST_F(Reconstruct, SplitComponentsBecomeOneLabelAgain)
{
  TestScan scan({ 20, 10, 10 });
  scan.Fill({ 1, 1, 1 }, { 6, 6, 6 }, 2);
  scan.Fill({ 9, 1, 1 }, { 17, 6, 6 }, 2);
  WriteNrrd(m_Folder / "a.nrrd", scan);
  Run({ "core", Path("a.nrrd"), "--lambda", "0", "--split-components", "-o", Path("m.vtp") });
  Run({ "reconstruct", Path("m.vtp"), "-o", Path("r.nrrd"), "--scan", Path("a.nrrd"), "--report", Path("r.json") });
  const Json report = Report("r.json");
  ASSERT_EQ(report["labels"].size(), 1U);
  EXPECT_EQ(report["labels"][0]["dice"], 1.0);
  EXPECT_EQ(report["labels"][0]["name"], "label-2");
}

TEST_F(Reconstruct, RefusesWhatItCannotUse)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  TestScan other({ 5, 5, 5 });
  other.At(2, 2, 2) = 1;
  WriteNrrd(m_Folder / "other.nrrd", other);
  Run({ "core", Path("a.nrrd"), "-o", Path("m.vtp") });
  const auto before = m_Folder.Names();
  const auto run = [&](const std::string & core, const std::string & output, std::vector<std::string> options) {
    options.insert(options.begin(), { "reconstruct", Path(core), "-o", Path(output) });
    return RunProgram(options);
  };
  ExpectRefusal(run("none.vtp", "r.nrrd", {}), 3, { "none.vtp" });
  ExpectRefusal(run("a.nrrd", "r.nrrd", {}), 3, { "a.nrrd" });
  ExpectRefusal(run("m.vtp", "r.vtp", {}), 2, { "r.vtp" });
  ExpectRefusal(run("m.vtp", "a.nrrd", {}), 1, { "a.nrrd" });
  ExpectRefusal(run("m.vtp", "r.nrrd", { "--scan", Path("other.nrrd") }), 3, { "other.nrrd" });
  ExpectRefusal(run("m.vtp", "r.nrrd", { "--scan", Path("a.nrrd"), "--like", Path("a.nrrd") }),
                2,
                { "--like", "--scan" });
  EXPECT_EQ(m_Folder.Names(), before);
}

} // namespace
} // namespace voxelcore::testing
