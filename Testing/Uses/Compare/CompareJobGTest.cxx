#include "voxelcore/Compare/CompareCommand.h"
#include "voxelcore/Compare/CompareJob.h"

#include "Program/Jobs/JobFolder.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Imaging/GreyVolume.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

class CompareJob : public JobFolder
{
protected:
  /** Writes shapes as labels 1, 2, ... of a volume of 40 x 40 x 20 voxels, whose first is at `first` mm. */
  void
  Write(const std::string & name, const std::vector<VoxelShape> & shapes, double first = 0, int cut = 0) const
  {
    ImageGeometry geometry;
    geometry.size = { 40 - cut, 40, 20 };
    geometry.spacing = { 0.5, 0.5, 0.5 };
    geometry.origin = { first, 0, 0 };
    std::vector<LabelShape> labels;
    for (const VoxelShape & shape : shapes)
    {
      labels.emplace_back();
      labels.back().value = std::ssize(labels);
      labels.back().name = "label-" + std::to_string(labels.back().value);
      labels.back().shape = CropToVoxels(shape);
      labels.back().voxels = shape.CountVoxels();
    }
    WriteLabelVolume(At(name), geometry, labels);
  }
  /** A ring about (20 - left, 20, 10), without the voxels `gap` to either side of its middle at low y. */
  static VoxelShape
  Ring(double radius, int gap, int left = 0)
  {
    return ShapeWhere({ 40, 40, 20 }, [=](int x, int y, int z) {
      const double across = std::hypot(x + left - 20.0, y - 20.0) - radius;
      return std::hypot(across, z - 10.0) < 3.5 && !(y < 20 && std::abs(x + left - 20) < gap);
    });
  }
  Json
  Report(const std::string & a, const std::string & b, ParameterValues more = {}) const
  {
    more.insert({ { "a", At(a) }, { "b", At(b) }, { "report", At("report.json") }, { "force", "true" } });
    RunCompareJob(CompareOptionsFrom(more));
    return Json::parse(Bytes("report.json"));
  }
  void
  ExpectRefused(const std::string & a, const std::string & b, const std::string & why, ParameterValues more = {}) const
  {
    try
    {
      Report(a, b, std::move(more));
      ADD_FAILURE() << why;
    }
    catch (const std::exception & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
};

TEST_F(CompareJob, ABrokenRingHasLostItsLoopThere)
{
  Write("a.nrrd", { Ring(12, 0) });
  Write("b.nrrd", { Ring(12, 2) });
  const Json report = Report("a.nrrd", "b.nrrd", { { "table", At("t.csv") } });
  EXPECT_EQ(report.at("kind"), "masks");
  EXPECT_EQ(report.at("unit"), "mm");
  const Json & row = report.at("labels").at(0);
  EXPECT_EQ(row.at("b1_a_26"), 1);
  EXPECT_EQ(row.at("b1_b_26"), 0);
  EXPECT_EQ(row.at("b1_error_26"), 1);
  EXPECT_EQ(row.at("b1_error_6"), 1);
  EXPECT_EQ(row.at("loops_missed"), 1);
  EXPECT_EQ(row.at("loops_invented"), 0);
  EXPECT_EQ(row.at("leakage_ratio"), 0);
  EXPECT_EQ(row.at("topology_precision"), 1);
  EXPECT_LT(row.at("topology_sensitivity").get<double>(), 1);
  ASSERT_EQ(report.at("differences").size(), 1U);
  const Json & loop = report.at("differences").at(0);
  EXPECT_EQ(loop.at("kind"), "loop");
  EXPECT_EQ(loop.at("change"), "missed");
  EXPECT_EQ(loop.at("voxels"), 3); // x = 19, 20, 21
  EXPECT_EQ(loop.at("i"), 20);
  EXPECT_NEAR(loop.at("j").get<double>(), 8, 1);
  EXPECT_EQ(
    Names(),
    (std::set<std::string>{ "a.nrrd", "b.nrrd", "report.json", "t.csv", "t_columns.json", "t_differences.csv" }));
}

TEST_F(CompareJob, NumbersThatHaveNoSideAreTheSameBothWays)
{
  Write("a.nrrd", { Ring(12, 0) });
  Write("b.nrrd", { Ring(12.7, 3) });
  const Json there = Report("a.nrrd", "b.nrrd").at("labels").at(0);
  const Json back = Report("b.nrrd", "a.nrrd").at("labels").at(0);
  for (const char * name : { "dice", "jaccard", "hausdorff", "hausdorff_95", "mean_distance", "cl_dice" })
  {
    EXPECT_EQ(there.at(name), back.at(name)) << name;
  }
  EXPECT_EQ(there.at("topology_precision"), back.at("topology_sensitivity"));
  EXPECT_EQ(there.at("loops_missed"), back.at("loops_invented"));
  EXPECT_EQ(there.at("b1_error_26"), back.at("b1_error_26"));
}

TEST_F(CompareJob, RandomMasksAreAllFoundInThemselves)
{
  constexpr std::uint64_t seed = 6921;
  std::cout << "seeds from " << seed << '\n';
  for (std::uint64_t test = 0; test < 5; ++test)
  {
    SCOPED_TRACE("seed " + std::to_string(seed + test));
    Random           random(seed + test);
    const VoxelShape noise = RandomShape(random, { 14, 14, 14 }, 0.6);
    Write("a.nrrd", { noise });
    const Json report = Report("a.nrrd", "a.nrrd", { { "labels", "1" } });
    const Json row = report.at("labels").at(0);
    EXPECT_EQ(row.at("cl_dice"), 1);
    EXPECT_EQ(row.at("tree_length_detected"), 1);
    EXPECT_EQ(row.at("branches_detected"), 1);
    EXPECT_EQ(row.at("hausdorff"), 0);
  }
}

TEST_F(CompareJob, LabelsAreComparedByTheirValues)
{
  const VoxelShape low = Box({ 20, 3, 3 });
  const VoxelShape high = Box({ 20, 3, 3 }, { 20, 20, 10 });
  Write("a.nrrd", { low, high });
  Write("b.nrrd", { high, low });
  const Json both = Report("a.nrrd", "b.nrrd", { { "no-skeletons", "true" } });
  ASSERT_EQ(both.at("labels").size(), 2U);
  EXPECT_EQ(both.at("labels").at(1).at("label"), 2);
  EXPECT_EQ(both.at("labels").at(1).at("dice"), 0);
  EXPECT_TRUE(both.at("labels").at(0).at("cl_dice").is_null());
  const Json one = Report("a.nrrd", "b.nrrd", { { "labels", "2" }, { "no-skeletons", "true" } });
  EXPECT_EQ(one.at("labels").size(), 1U);
  // What only one of them has is missed as a whole.
  Write("c.nrrd", { low });
  const Json missing = Report("a.nrrd", "c.nrrd");
  ASSERT_EQ(missing.at("labels").size(), 2U);
  EXPECT_EQ(missing.at("labels").at(0).at("dice"), 1);
  EXPECT_EQ(missing.at("labels").at(1).at("dice"), 0);
  EXPECT_EQ(missing.at("labels").at(1).at("pieces_missed"), 1);
  EXPECT_TRUE(missing.at("labels").at(1).at("hausdorff").is_null());
  EXPECT_TRUE(missing.at("labels").at(1).at("cl_dice").is_null());
  EXPECT_EQ(missing.at("labels").at(1).at("tree_length_detected"), 0);
}

TEST_F(CompareJob, WhatBothHoldIsComparedWhereTheBoxesDiffer)
{
  // The same ring, seen by a grid that begins 5 voxels later; A has 3 mm of a rod in what B does not hold.
  const VoxelShape ring = Ring(11, 0);
  Write("a.nrrd", { ShapeWhere({ 40, 40, 20 }, [&](int x, int y, int z) {
          return ring.Contains(x, y, z) || (x < 3 && y < 2 && z < 2);
        }) });
  Write("b.nrrd", { CropToVoxels(Ring(11, 0, 5)) }, 2.5, 5);
  const Json report = Report("a.nrrd", "b.nrrd");
  EXPECT_EQ(report.at("labels").at(0).at("dice"), 1);
  ASSERT_EQ(report.at("notes").size(), 1U);
  EXPECT_NE(report.at("notes").at(0).get<std::string>().find("voxels 5:40,0:40,0:20"), std::string::npos);
  EXPECT_EQ(Report("b.nrrd", "a.nrrd").at("labels").at(0).at("dice"), 1);
}

TEST_F(CompareJob, WhatCannotBeComparedIsRefusedInOneLine)
{
  Write("a.nrrd", { Ring(12, 0) });
  Write("half.nrrd", { Ring(12, 0) }, 0.25);
  Write("far.nrrd", { Ring(12, 0) }, 100);
  ExpectRefused("a.nrrd", "half.nrrd", "does not have the grid of");
  ExpectRefused("a.nrrd", "far.nrrd", "lies beside");
  ExpectRefused("a.nrrd", "a.nrrd", "has such a label: --labels 7", { { "labels", "7" } });
  ExpectRefused("a.nrrd", "none.nrrd", "none.nrrd: no such file");
  ExpectRefused("a.nrrd", "a.nrrd", "show branches of skeletons", { { "output", At("o.vtp") } });
  ExpectRefused("a.nrrd", "a.nrrd", "--table", { { "table", At("t.txt") } });
  ExpectRefused("a.nrrd", "a.nrrd", "--near is", { { "near", "2mm" } });
  std::vector<std::uint16_t> grey(40 * 40 * 20);
  for (std::size_t i = 0; i < grey.size(); ++i)
  {
    grey[i] = static_cast<std::uint16_t>(1 + i * 7919 % 30000);
  }
  ImageGeometry geometry;
  geometry.size = { 40, 40, 20 };
  geometry.spacing = { 0.5, 0.5, 0.5 };
  WriteGreyVolume(At("grey.nrrd"), geometry, grey);
  ExpectRefused("a.nrrd", "grey.nrrd", "looks like a grey scan");
  WriteGreyVolume(At("empty.nrrd"), geometry, std::vector<std::uint16_t>(grey.size(), 0));
  ExpectRefused("a.nrrd", "empty.nrrd", "nothing but background");
}

TEST_F(CompareJob, SkeletonsAreComparedWithWhatIsMadeOfThem)
{
  Phantom("root", "root.nrrd", "48");
  RunSkeletonJob(SkeletonOptionsFrom({ { "scan", At("root.nrrd") }, { "output", At("root.vtp") }, { "also", "swc" } }));
  for (const auto & [a, b] :
       { std::pair("root.vtp", "root.swc"), { "root.swc", "root.vtp" }, { "root.nrrd", "root.vtp" } })
  {
    SCOPED_TRACE(std::string(a) + " " + b);
    const Json report = Report(a, b, { { "table", At("t.csv") }, { "output", At("found.vtp") } });
    EXPECT_EQ(report.at("kind"), "skeletons");
    const Json & row = report.at("labels").at(0);
    EXPECT_NEAR(row.at("tree_length_detected").get<double>(), 1, 1e-9);
    EXPECT_EQ(row.at("branches_detected"), 1);
    EXPECT_EQ(row.at("tips_missed"), 0);
    EXPECT_EQ(row.at("tips_invented"), 0);
    EXPECT_LT(row.at("hausdorff").get<double>(), 1e-5); // of nine digits
    EXPECT_NEAR(row.at("radius_error").get<double>(), 0, 1e-5);
    EXPECT_NE(Bytes("found.vtp").find("Name=\"Found\""), std::string::npos);
  }
  Report("root.swc", "root.vtp", { { "html", At("page.html") } });
  EXPECT_NE(Bytes("page.html").find("invented"), std::string::npos);
  EXPECT_TRUE(Names().contains("t_branches.csv") && Names().contains("t_levels.csv"));
}

TEST_F(CompareJob, SurfacesAreApartAsMuchAsPruningTakesAway)
{
  Phantom("box", "a.nrrd");
  Core("whole.vtp", { { "lambda", "0" } });
  Core("pruned.vtp", { { "lambda", "2vox" } });
  const Json same = Report("whole.vtp", "whole.vtp").at("labels").at(0);
  EXPECT_EQ(same.at("hausdorff"), 0);
  EXPECT_EQ(same.at("coverage_a"), 1);
  const Json less = Report("whole.vtp", "pruned.vtp").at("labels").at(0);
  EXPECT_GT(less.at("hausdorff").get<double>(), 0.5);
  EXPECT_LT(less.at("coverage_a").get<double>(), 1);
  EXPECT_NEAR(less.at("coverage_b").get<double>(), 1, 1e-12); // all that is left was there before
  ExpectRefused("a.nrrd", "whole.vtp", "is a medial surface");
  ExpectRefused("whole.vtp", "whole.vtp", "--near 2%: expected a length", { { "near", "2%" } });
}

} // namespace
} // namespace voxelcore::testing
