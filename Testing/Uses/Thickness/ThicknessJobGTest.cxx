#include "ThicknessFolder.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Jobs/RenderJob.h"
#include "voxelcore/Models/PlainSurface.h"
#include "voxelcore/Thickness/VoxelHull.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>

namespace voxelcore::testing
{
namespace
{

class ThicknessJob : public ThicknessFolder
{};

TEST_F(ThicknessJob, WritesALengthAtEachVoxelAndZeroOutside)
{
  TwoLabels({ 0.5, 0.5, 0.5 });
  const ThicknessResult result = Thickness("map.nrrd");
  const GreyVolume      map = Map("map.nrrd");
  EXPECT_EQ(map.geometry.spacing, (Vector3{ 0.5, 0.5, 0.5 }));
  EXPECT_NEAR(*map.Row(20, 20, 7), 3, 0.15);
  EXPECT_NEAR(*map.Row(15, 15, 25), 5, 0.25);
  EXPECT_EQ(*map.Row(0, 0, 0), 0);
  EXPECT_EQ(*map.Row(20, 20, 15), 0);
  ASSERT_EQ(result.thickness.size(), 2U);
  EXPECT_EQ(result.thickness[0].numbers.voxels, 32U * 32 * 6);
  EXPECT_NEAR(result.thickness[0].numbers.median, 3, 0.15);
  EXPECT_EQ(result.thickness[0].borderVoxels, 0U);
  EXPECT_NE(ThicknessText(result).find("mean mm"), std::string::npos);
}

TEST_F(ThicknessJob, EveryFormatHoldsTheSameMap)
{
  TwoLabels();
  Thickness("map.nrrd");
  const std::vector<float> expected = Map("map.nrrd").values;
  for (const std::string name : { "map.nii.gz", "map.mha", "map.tif" })
  {
    Thickness(name);
    EXPECT_EQ(Map(name).values, expected) << name;
  }
  EXPECT_THROW(Thickness("map.vtp"), UsageError);
}

TEST_F(ThicknessJob, BoundsStandBesideTheMap)
{
  TwoLabels();
  const ThicknessResult result = Thickness("map.nrrd", { { "bounds", "true" }, { "refine", "off" } });
  const auto            map = Map("map.nrrd").values;
  const auto            lower = Map("map_lower.nrrd").values;
  const auto            upper = Map("map_upper.nrrd").values;
  double                width = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    ASSERT_LE(map[i], lower[i]) << "without refinement the map is of balls that lie in the voxels";
    ASSERT_LE(lower[i], upper[i]);
    width += upper[i] - lower[i];
    ASSERT_EQ(lower[i] > 0, map[i] > 0);
  }
  EXPECT_LE(*result.thickness[0].meanLower, *result.thickness[0].meanUpper);
  EXPECT_LT(width, 0.1 * static_cast<double>(std::count_if(map.begin(), map.end(), [](float v) { return v > 0; })));
  EXPECT_EQ(result.thickness[0].parts, (std::array<std::int32_t, 3>{ 3, 3, 3 }));
  const auto alone = Thickness("alone.nrrd", { { "refine", "off" }, { "report", At("r.json") } });
  EXPECT_EQ(Map("alone.nrrd").values, map) << "bounds change nothing of the map";
  EXPECT_EQ(nlohmann::json::parse(Bytes("r.json"))["thickness"][0].count("bounds"), 0U);
  Thickness("again.nrrd", { { "bounds", "true" }, { "report", At("b.json") } });
  EXPECT_EQ(nlohmann::json::parse(Bytes("b.json"))["thickness"][0]["bounds"]["voxels_cut"],
            nlohmann::json({ 3, 3, 3 }));
  const auto smooth = Map("again.nrrd").values;
  const auto least = Map("again_lower.nrrd").values;
  const auto most = Map("again_upper.nrrd").values;
  for (std::size_t i = 0; i < smooth.size(); ++i)
  {
    ASSERT_LE(least[i], smooth[i]);
    ASSERT_LE(smooth[i], most[i]);
  }
}

TEST_F(ThicknessJob, AFolderGetsAMapPerLabel)
{
  TwoLabels();
  Thickness("maps/", { { "labels", "1,2" } });
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd", "maps" }));
  EXPECT_NEAR(*Map("maps/a_label-1_thickness.nrrd").Row(20, 20, 7), 6, 0.2);
  EXPECT_EQ(*Map("maps/a_label-2_thickness.nrrd").Row(20, 20, 7), 0);
}

TEST_F(ThicknessJob, ThePageMayGoIntoTheFolderThatIsMade)
{
  TwoLabels();
  Thickness("maps/", { { "html", At("maps/a.html") }, { "table", At("maps/t.csv") } });
  EXPECT_TRUE(std::filesystem::exists(At("maps/a.html")));
  EXPECT_TRUE(std::filesystem::exists(At("maps/a_label-2_thickness.nrrd")));
}

TEST_F(ThicknessJob, TheSurfaceIsReadAgainLabelByLabelAndDrawnByItsThickness)
{
  TwoLabels();
  Thickness("t.nrrd", { { "surface", At("s.vtp") }, { "medial", At("m.vtp") } });
  const auto read = ReadMeasuredSurfaces(At("s.vtp"));
  ASSERT_TRUE(read);
  ASSERT_EQ(read->surfaces.size(), 2U);
  for (const MeasuredSurface & one : read->surfaces)
  {
    ASSERT_EQ(one.thickness.size(), one.plain.surface.cells.vertexCount);
    EXPECT_FALSE(one.plain.hasRadius);
    // A slab of 6 voxels, a ball of diameter 10.
    const double middle = *std::max_element(one.thickness.begin(), one.thickness.end());
    EXPECT_NEAR(middle, one.label == 1 ? 6 : 10, 0.7) << "label " << one.label;
  }
  EXPECT_FALSE(ReadMeasuredSurfaces(At("m.vtp"))) << "medial surfaces have radii";
  EXPECT_FALSE(ReadMeasuredSurfaces(At("a.nrrd")));
  if (HasDisplay())
  {
    RenderJobOptions options;
    options.files = { At("s.vtp") };
    options.output = At("s.png");
    options.width = 200;
    options.height = 200;
    RunRenderJob(options);
    EXPECT_TRUE(Names().contains("s.png"));
    options.force = true;
    options.coloring = "Lambda";
    EXPECT_THROW(RunRenderJob(options), UsageError);
    options.coloring = "Radius";
    options.files.push_back(At("m.vtp"));
    EXPECT_THROW(RunRenderJob(options), UsageError) << "surfaces of labels are drawn alone";
  }
}

TEST_F(ThicknessJob, VoxelsWhoseBallTouchesTheBorderAreCountedApart)
{
  // A slab that fills the scan in x and y: its balls touch the border near its sides only.
  Phantom("gyroid", "a.nrrd", "40");
  const ThicknessResult   flagged = Thickness("map.nrrd");
  const ThicknessRecord & all = flagged.thickness[0];
  EXPECT_GT(all.borderVoxels, 0U);
  EXPECT_EQ(all.inner.voxels + all.borderVoxels, all.numbers.voxels);
  const ThicknessRecord kept = Thickness("map2.nrrd", { { "border", "keep" } }).thickness[0];
  EXPECT_EQ(kept.numbers.mean, all.numbers.mean);
  EXPECT_EQ(kept.inner.voxels, 0U);
  const ThicknessRecord dropped = Thickness("map3.nrrd", { { "border", "drop" } }).thickness[0];
  EXPECT_EQ(dropped.numbers.mean, all.inner.mean);
  EXPECT_EQ(dropped.numbers.voxels, all.inner.voxels);
}

TEST_F(ThicknessJob, WhatACropCutsOffIsAtTheBorderLikeWhatTheScanCutsOff)
{
  // A bar of 20 voxels, of which a crop and a smaller scan hold the same 12.
  const auto write = [&](const std::string & name, std::int32_t first, std::int32_t length, std::int64_t size) {
    VoxelShape bar(VoxelBox{ { first, 4, 4 }, { length, 5, 5 } });
    for (std::int32_t i = 0; i < length * 25; ++i)
    {
      bar.Insert(first + i % length, 4 + i / length % 5, 4 + i / length / 5);
    }
    ImageGeometry geometry;
    geometry.size = { size, 13, 13 };
    WriteLabelVolume(At(name), geometry, { { 1, "bar", static_cast<std::uint64_t>(length) * 25, std::move(bar) } });
  };
  write("a.nrrd", 4, 20, 28);
  write("cut.nrrd", 4, 12, 16);
  const ThicknessRecord cropped = Thickness("map.nrrd", { { "crop", "0:16,:,:" } }).thickness[0];
  const ThicknessRecord cut = Thickness("other.nrrd", { { "scan", At("cut.nrrd") } }).thickness[0];
  EXPECT_GT(cut.borderVoxels, 0U);
  EXPECT_EQ(cropped.borderVoxels, cut.borderVoxels);
  EXPECT_EQ(cropped.inner.mean, cut.inner.mean);
  EXPECT_EQ(Thickness("whole.nrrd").thickness[0].borderVoxels, 0U);
}

TEST_F(ThicknessJob, WhereAllVoxelsAreLeftOutNoNumberIsGiven)
{
  VoxelShape all(VoxelBox{ { 0, 0, 0 }, { 6, 6, 4 } });
  for (std::int32_t i = 0; i < 144; ++i)
  {
    all.Insert(i % 6, i / 6 % 6, i / 36);
  }
  ImageGeometry geometry;
  geometry.size = { 6, 6, 4 };
  WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "all", 144, std::move(all) } });
  const ThicknessResult result =
    Thickness("map.nrrd", { { "border", "drop" }, { "table", At("t.csv") }, { "report", At("r.json") } });
  EXPECT_EQ(result.thickness[0].numbers.voxels, 0U);
  EXPECT_EQ(result.thickness[0].borderVoxels, 144U);
  EXPECT_NE(Bytes("t.csv").find("\n1,label-1,0,thickness,0,0,,,,,,,,,,144,,,,\n"), std::string::npos) << Bytes("t.csv");
  EXPECT_TRUE(nlohmann::json::parse(Bytes("r.json"))["thickness"][0]["mean_mm"].is_null());
  EXPECT_EQ(ThicknessText(result).find("0.000"), std::string::npos) << ThicknessText(result);
}

TEST_F(ThicknessJob, WhatMemoryDoesNotHoldIsMeasuredInBlocks)
{
  RunPhantomJob(PhantomOptionsFrom({ { "kind", "porous" },
                                     { "output", At("a.nrrd") },
                                     { "size", "140,30,30" },
                                     { "density", "0.4" },
                                     { "period", "9" } }));
  const VoxelBox all{ { 0, 0, 0 }, { 140, 30, 30 } };
  for (const char * refine : { "off", "labels" })
  {
    const ParameterValues options{ { "refine", refine }, { "separation", "box" } };
    const ThicknessResult whole = Thickness("whole.nrrd", options);
    ParameterValues       less = options;
    less.insert({ { "memory", "100kB" }, { "report", At("r.json") } });
    const ThicknessResult parts = Thickness("parts.nrrd", less);
    EXPECT_EQ(whole.blocks, 0U);
    EXPECT_GE(parts.blocks, 4U) << "two of the label, two of what separates it";
    ASSERT_EQ(parts.thickness.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i)
    {
      const std::string        name = i == 0 ? "" : "_separation";
      const std::vector<float> expected = ReadGreyVolume(At("whole" + name + ".nrrd"), all).values;
      const std::vector<float> found = ReadGreyVolume(At("parts" + name + ".nrrd"), all).values;
      EXPECT_EQ(found, expected) << refine;
      EXPECT_EQ(parts.thickness[i].label, whole.thickness[i].label);
      EXPECT_EQ(parts.thickness[i].isSeparation, i == 1);
      EXPECT_EQ(parts.thickness[i].numbers.mean, whole.thickness[i].numbers.mean);
      EXPECT_EQ(parts.thickness[i].borderVoxels, whole.thickness[i].borderVoxels);
    }
    EXPECT_NE(parts.notes.back().find("measured in 2 blocks"), std::string::npos);
    const auto label = nlohmann::json::parse(Bytes("r.json"))["labels"][0];
    EXPECT_EQ(label.count("core"), 0U) << "none was made of the whole";
    EXPECT_EQ(label.count("certificate"), 0U);
    EXPECT_EQ(label["voxels"], whole.thickness[0].numbers.voxels);
    std::filesystem::remove(At("r.json"));
    std::filesystem::remove(At("whole_separation.nrrd"));
    std::filesystem::remove(At("parts_separation.nrrd"));
    std::filesystem::remove(At("whole.nrrd"));
    std::filesystem::remove(At("parts.nrrd"));
  }
}

TEST_F(ThicknessJob, TheSeparationIsThatOfTheBackgroundInTheBoxOfAllLabels)
{
  TwoLabels();
  const ThicknessResult result = Thickness("map.nrrd", { { "separation", "box" }, { "table", At("t.csv") } });
  ASSERT_EQ(result.thickness.size(), 3U);
  EXPECT_TRUE(result.thickness[2].isSeparation);
  const auto map = Map("map.nrrd").values;
  const auto gaps = Map("map_separation.nrrd").values;
  const auto in = [](const std::vector<float> & values) {
    return std::count_if(values.begin(), values.end(), [](float v) { return v > 0; });
  };
  EXPECT_EQ(in(map) + in(gaps), 32 * 32 * 27) << "the box of both labels";
  for (std::size_t i = 0; i < map.size(); ++i)
  {
    ASSERT_TRUE(map[i] == 0 || gaps[i] == 0);
  }
  EXPECT_NE(Bytes("t.csv").find("separation"), std::string::npos);
  EXPECT_TRUE(Names().contains("t_histogram.csv"));
  EXPECT_TRUE(Names().contains("t_columns.json"));
}

TEST_F(ThicknessJob, TheSeparationInTheHullIsThatOfItsOtherVoxels)
{
  TwoLabels();
  const ThicknessResult   result = Thickness("map.nrrd", { { "separation", "hull" } });
  std::vector<VoxelShape> shapes;
  std::uint64_t           labels = 0;
  for (LabelShape & label : ReadLabelVolume(At("a.nrrd")).labels)
  {
    labels += label.voxels;
    shapes.push_back(std::move(label.shape));
  }
  const VoxelShape hull = HullOfVoxels(shapes);
  ASSERT_EQ(result.thickness.size(), 3U);
  EXPECT_EQ(result.thickness[2].numbers.voxels, hull.CountVoxels() - labels);
  const GreyVolume gaps = Map("map_separation.nrrd");
  std::size_t      at = 0;
  for (std::int32_t z = 0; z < 36; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      for (std::int32_t x = 0; x < 40; ++x, ++at)
      {
        const bool isLabel = shapes[0].Contains(x, y, z) || shapes[1].Contains(x, y, z);
        ASSERT_EQ(gaps.values[at] > 0, hull.Contains(x, y, z) && !isLabel) << x << " " << y << " " << z;
      }
    }
  }
}

TEST_F(ThicknessJob, TheSeparationWithinALabelIsTheThicknessOfThatLabel)
{
  TwoLabels();
  const ThicknessRecord ball = Thickness("ball.nrrd", { { "labels", "2" } }).thickness[0];
  const ThicknessResult result = Thickness("slab.nrrd", { { "labels", "1" }, { "within", "2" } });
  ASSERT_EQ(result.thickness.size(), 2U);
  EXPECT_TRUE(result.thickness[1].isSeparation);
  EXPECT_EQ(result.thickness[1].numbers.voxels, ball.numbers.voxels);
  EXPECT_EQ(result.thickness[1].numbers.mean, ball.numbers.mean);
  try
  {
    Thickness("none.nrrd", { { "labels", "2" }, { "within", "2" } });
    ADD_FAILURE() << "a label leaves no background within itself";
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("--within 2: all of it is in the labels that are measured"),
              std::string::npos)
      << error.what();
  }
}

TEST_F(ThicknessJob, TheSeparationWithinAMaskCountsApartWhatEndsAtTheMask)
{
  // Two plates six voxels apart, and a mask of all that lies between and in them.
  const VoxelBox whole{ { 4, 4, 4 }, { 40, 40, 14 } };
  VoxelShape     plates(whole);
  VoxelShape     mask(whole);
  for (std::int32_t i = 0; i < 40 * 40 * 14; ++i)
  {
    const std::int32_t z = i / 1600;
    mask.Insert(4 + i % 40, 4 + i / 40 % 40, 4 + z);
    if (z < 4 || z >= 10)
    {
      plates.Insert(4 + i % 40, 4 + i / 40 % 40, 4 + z);
    }
  }
  ImageGeometry geometry;
  geometry.size = { 48, 48, 22 };
  WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "plates", 1600 * 8, std::move(plates) } });
  WriteLabelVolume(At("mask.nrrd"), geometry, { { 7, "mask", 1600 * 14, mask } });
  const ThicknessRecord gap = Thickness("map.nrrd", { { "within", At("mask.nrrd") } }).thickness[1];
  EXPECT_EQ(gap.numbers.voxels, 1600U * 6);
  EXPECT_GT(gap.borderVoxels, 0U);
  EXPECT_GT(gap.inner.voxels, 1600U * 3) << "in the middle balls end at the plates";
  EXPECT_NEAR(gap.inner.mean, 6, 0.1);
  geometry.size = { 49, 48, 22 };
  WriteLabelVolume(At("other.nrrd"), geometry, { { 7, "mask", 1600 * 14, std::move(mask) } });
  EXPECT_THROW(Thickness("m.nrrd", { { "within", At("other.nrrd") } }), InputError);
  EXPECT_FALSE(Names().contains("m.nrrd"));
}

TEST_F(ThicknessJob, TheReportHasTheNumbersOfTheTable)
{
  TwoLabels();
  const ThicknessResult result = Thickness("map.nrrd", { { "report", At("r.json") } });
  const auto            report = nlohmann::json::parse(Bytes("r.json"));
  ASSERT_EQ(report["thickness"].size(), 2U);
  EXPECT_EQ(report["thickness"][1]["name"], "label-2");
  EXPECT_EQ(report["thickness"][1]["mean_mm"], result.thickness[1].numbers.mean);
  EXPECT_EQ(report["labels"].size(), 2U);
  EXPECT_EQ(report["parameters"]["refine"], "labels");
}

TEST_F(ThicknessJob, LeavesNothingWhenItIsStopped)
{
  TwoLabels();
  for (const int calls : { 1, 5, 10 })
  {
    EXPECT_THROW(Thickness("maps/", {}, StoppingAfter(calls)), Cancelled);
    EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd" })) << calls;
  }
}

TEST_F(ThicknessJob, TheReportSaysWhereTheBackgroundWasMeasured)
{
  TwoLabels();
  const std::map<std::string, ParameterValues> regions{ { "box", { { "separation", "box" } } },
                                                        { "hull", { { "separation", "hull" } } },
                                                        { "within 2", { { "within", "2" }, { "labels", "1" } } } };
  for (auto [region, more] : regions)
  {
    more.insert({ { "report", At("r.json") }, { "force", "true" } });
    Thickness("map.nrrd", more);
    const auto report = nlohmann::json::parse(Bytes("r.json"));
    EXPECT_EQ(report["thickness"].back()["region"], region);
    EXPECT_FALSE(report["thickness"].front().contains("region"));
  }
}

TEST_F(ThicknessJob, AMaskIsReadWithTheAxesOfTheScan)
{
  // Axes 0.1 degrees off a right angle, as of a scan resampled by hand.
  std::string header =
    "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 12 12 12\n"
    "space directions: (1,0,0) (0.002,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n";
  std::string voxels(12 * 12 * 12, '\0');
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const std::size_t z = i / 144;
    voxels[i] = z < 3 || z > 8 ? '\1' : '\0';
  }
  std::ofstream(At("a.nrrd"), std::ios::binary) << header << voxels;
  std::ofstream(At("mask.nrrd"), std::ios::binary) << header << std::string(voxels.size(), '\1');
  EXPECT_THROW(Thickness("m.nrrd", { { "within", At("mask.nrrd") } }), InputError) << "the scan is skewed";
  const ThicknessResult result = Thickness("m.nrrd", { { "within", At("mask.nrrd") }, { "orthonormalize", "true" } });
  EXPECT_EQ(result.thickness.back().numbers.voxels, 144U * 6);
}

TEST_F(ThicknessJob, AMemoryLimitThatBlocksCannotKeepIsTold)
{
  VoxelShape block(VoxelBox{ { 1, 1, 1 }, { 140, 8, 8 } });
  for (std::int32_t i = 0; i < 140 * 64; ++i)
  {
    block.Insert(1 + i % 140, 1 + i / 140 % 8, 1 + i / 1120);
  }
  ImageGeometry geometry;
  geometry.size = { 142, 10, 10 };
  WriteLabelVolume(At("a.nrrd"), geometry, { { 1, "block", 140 * 64, std::move(block) } });
  const ThicknessResult inBlocks = Thickness("m.nrrd", { { "memory", "1MB" } });
  ASSERT_GT(inBlocks.blocks, 1U);
  const ThicknessResult whole = Thickness("w.nrrd", { { "memory", "1MB" }, { "medial", At("w.vtp") } });
  EXPECT_EQ(whole.blocks, 0U);
  ASSERT_EQ(whole.notes.size(), 1U);
  EXPECT_NE(whole.notes[0].find("measured as a whole"), std::string::npos);
  EXPECT_TRUE(Thickness("x.nrrd", { { "memory", "8GB" }, { "medial", At("x.vtp") } }).notes.empty());
}

TEST_F(ThicknessJob, RefusesWhatMakesNoSense)
{
  TwoLabels();
  EXPECT_THROW(Thickness("map.nrrd", { { "border", "left" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "separation", "ball" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "separation", "box" }, { "within", "2" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "within", "" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "threshold", "1:2" }, { "within", "2" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "labels", "1" }, { "within", "5" } }), InputError);
  EXPECT_THROW(Thickness("map.nrrd", { { "tolerance", "1diag,2diag" } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "table", At("t.txt") } }), UsageError);
  EXPECT_THROW(Thickness("map.nrrd", { { "labels", "9" } }), InputError);
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd" }));
  Thickness("map.nrrd");
  EXPECT_THROW(Thickness("map.nrrd"), OutputError) << "it is there";
  EXPECT_NO_THROW(Thickness("map.nrrd", { { "force", "true" } }));
}

} // namespace
} // namespace voxelcore::testing
