#include "voxelcore/Follow/FollowCommand.h"
#include "voxelcore/Follow/FollowJob.h"

#include "Program/Jobs/JobFolder.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Models/TreeFiles.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

class FollowJob : public JobFolder
{
protected:
  /** A stem along x, 8 voxels longer and 0.4 thicker with each day, with a lateral, and from the second day on with
   *  another; all `shift` voxels further. With two labels the second is a plate beside. */
  void
  Write(const std::string & name, int day, int shift = 0, std::int64_t labels = 1) const
  {
    ImageGeometry geometry;
    geometry.size = { 100, 60, 32 };
    geometry.spacing = { 0.5, 0.5, 0.5 };
    std::vector<LabelShape> all;
    for (std::int64_t value = 1; value <= labels; ++value)
    {
      all.emplace_back();
      all.back().value = value;
      all.back().shape = CropToVoxels(ShapeWhere({ 100, 60, 32 }, [=](int x, int y, int z) {
        const auto rod = [&](const Vector3 & from, const Vector3 & to, double radius) {
          const Vector3 at = Minus({ x - shift + 0.0, y + 0.0, z + 0.0 }, from);
          const Vector3 way = Minus(to, from);
          return Distance(at, AddScaled({}, std::clamp(Dot(at, way) / Dot(way, way), 0.0, 1.0), way)) < radius;
        };
        return value == 2 ? z > 29
                          : rod({ 6, 20, 14 }, { 52.0 + 8 * day, 20, 14 }, 3 + 0.4 * day) ||
                              rod({ 22, 20, 14 }, { 18, 4, 18 }, 2.4) ||
                              (day > 0 && rod({ 36, 20, 14 }, { 38, 31.0 + 6 * day, 16 }, 2.4));
      }));
      all.back().voxels = all.back().shape.CountVoxels();
    }
    WriteLabelVolume(At(name), geometry, all);
  }
  FollowResult
  Run(const std::vector<std::string> & days, ParameterValues more = {}) const
  {
    std::string list;
    for (const std::string & day : days)
    {
      list += (list.empty() ? "" : "\n") + At(day);
    }
    more.insert({ { "days", list }, { "output", At("out") }, { "root", "2.5,10,7" }, { "force", "true" } });
    return RunFollowJob(FollowOptionsFrom(more));
  }
  void
  ExpectRefused(const std::vector<std::string> & days, const std::string & why, ParameterValues more = {}) const
  {
    try
    {
      Run(days, std::move(more));
      ADD_FAILURE() << why;
    }
    catch (const std::exception & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
};

TEST_F(FollowJob, GrowthOfMasksIsByTheUnitOfTime)
{
  for (int day = 0; day < 3; ++day)
  {
    Write("d" + std::to_string(day) + ".nrrd", day, 4 * day);
  }
  const FollowResult result =
    Run({ "d0.nrrd", "d1.nrrd", "d2.nrrd" }, { { "times", "0,2,4" }, { "report", At("report.json") } });
  EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
  ASSERT_EQ(result.days.size(), 3U);
  EXPECT_EQ(result.days[0].branches.size(), 2U);
  EXPECT_EQ(result.days[1].branches.size(), 3U);
  EXPECT_EQ(result.days[2].branches.size(), 3U);
  EXPECT_NEAR(result.motions[2].motion.shift[0], -4, 0.15); // mm: eight voxels
  EXPECT_LT(result.motions[2].motion.Turn(), 2);            // about the stem little holds it
  const Json   report = Json::parse(Bytes("report.json"));
  double       growth = 0;
  double       change = 0;
  std::int64_t kept = 0;
  for (const Json & row : report.at("branches"))
  {
    kept += row.at("state") == "kept";
    if (row.at("id") == 1 && row.at("day") == 3)
    {
      growth = row.at("growth");
      change = row.at("radius_change");
    }
  }
  EXPECT_EQ(kept, 5);
  EXPECT_NEAR(growth, 2, 0.15);   // 4 mm in 2
  EXPECT_NEAR(change, 0.2, 0.05); // 0.4 voxels
  EXPECT_EQ(report.at("days").at(1).at("new"), 1);
  EXPECT_EQ(report.at("days").at(0).at("found"), nullptr);
  std::set<std::string> names;
  for (const auto & entry : std::filesystem::directory_iterator(At("out")))
  {
    names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names,
            (std::set<std::string>{ "branches.csv",
                                    "columns.json",
                                    "day-1.rsml",
                                    "day-2.rsml",
                                    "day-3.rsml",
                                    "days.csv",
                                    "identities.vtp" }));
}

TEST_F(FollowJob, RsmlOfADayIsOfTheSequenceAndCallsRootsByTheirNumbers)
{
  Write("d0.nrrd", 0);
  Write("d1.nrrd", 1);
  const FollowResult result = Run({ "d0.nrrd", "d1.nrrd" });
  for (std::size_t day = 0; day < 2; ++day)
  {
    const std::string name = "out/day-" + std::to_string(day + 1) + ".rsml";
    const std::string text = Bytes(name);
    EXPECT_NE(text.find("<time-sequence>\n      <label>d0</label>\n      <index>" + std::to_string(day) +
                        "</index>\n      <unified>true</unified>"),
              std::string::npos);
    double length = 0;
    for (const FollowedBranch & branch : result.days[day].branches)
    {
      EXPECT_NE(text.find("<root ID=\"root-" + std::to_string(branch.id) + "\""), std::string::npos);
      length += branch.length;
    }
    const SkeletonGraph read = ReadTreeFile(At(name)).parts[0].graph;
    double              sum = 0;
    for (std::size_t branch = 0; branch < read.BranchCount(); ++branch)
    {
      sum += read.BranchLength(branch);
    }
    EXPECT_NEAR(sum, length, 1e-6 * length);
  }
  // The files are days themselves; what they say is the same again, wherever the days lie.
  const FollowResult again = Run({ "out/day-1.rsml", "out/day-2.rsml" }, { { "output", At("again") } });
  ASSERT_EQ(again.days[1].branches.size(), result.days[1].branches.size());
  for (std::size_t i = 0; i < again.days[1].branches.size(); ++i)
  {
    EXPECT_NEAR(again.days[1].branches[i].length, result.days[1].branches[i].length, 1e-6);
  }
}

TEST_F(FollowJob, IsTheSameAgainToTheByte)
{
  Write("d0.nrrd", 0);
  Write("d1.nrrd", 1, 7);
  Run({ "d0.nrrd", "d1.nrrd" });
  std::map<std::string, std::string> first;
  for (const char * name : { "branches.csv", "days.csv", "identities.vtp", "day-2.rsml" })
  {
    first[name] = Bytes(std::string("out/") + name);
  }
  Run({ "d0.nrrd", "d1.nrrd" });
  for (const auto & [name, bytes] : first)
  {
    EXPECT_EQ(Bytes("out/" + name), bytes) << name;
  }
}

TEST_F(FollowJob, WhereNothingMovesNothingIsMoved)
{
  Write("d0.nrrd", 0);
  Write("d1.nrrd", 1);
  const FollowResult result = Run({ "d0.nrrd", "d1.nrrd" }, { { "motion", "none" } });
  EXPECT_EQ(result.motions[1].motion.shift, Vector3{});
  EXPECT_GT(result.motions[1].found, 0.99);
  Write("d1.nrrd", 1, 25);
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "leave out --motion none", { { "motion", "none" } });
}

TEST_F(FollowJob, WhatCannotBeFollowedIsRefused)
{
  Write("d0.nrrd", 0);
  Write("d1.nrrd", 1);
  Write("two.nrrd", 1, 0, 2);
  ExpectRefused({ "d0.nrrd" }, "two days or more");
  ExpectRefused({ "d0.nrrd", "two.nrrd" }, "2 labels; choose one with --labels");
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "a time for each of the 2 days", { { "times", "0" } });
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "each later than the one before", { { "times", "3,3" } });
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "--times", { { "times", "3,x" } });
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "--motion", { { "motion", "some" } });
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "--near", { { "near", "far" } });
  ExpectRefused({ "d0.nrrd", "d1.nrrd" }, "length in mm", { { "near", "2vox" } });
  ExpectRefused({ "d0.nrrd", "none.nrrd" }, "none.nrrd");
  WriteAll(At("bare.swc"), "1 2 0 0 0 0 -1\n2 2 9000 0 0 0 1\n3 2 9000 4000 0 0 2\n4 2 20000 0 100 0 2\n");
  ExpectRefused({ "bare.swc", "bare.swc" }, "give --near");
  WriteAll(At("point.swc"), "1 2 0 0 0 1 -1\n");
  ExpectRefused({ "d0.nrrd", "point.swc" }, "no branch to follow");
  WriteAll(At("other.swc"),
           "1 2 0 0 0 100 -1\n2 2 500000 0 0 100 1\n3 2 600000 400000 90000 100 2\n4 2 900000 -200000 100000 100 2\n");
  ExpectRefused({ "other.swc", "d0.nrrd" }, "check the order of the days");
  EXPECT_FALSE(std::filesystem::exists(At("out")));
}

} // namespace
} // namespace voxelcore::testing
