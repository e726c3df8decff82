#include "CaseTable.h"
#include "CohortMeans.h"
#include "CohortPage.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string_view>
#include <utility>

namespace voxelcore
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<Row>
Volumes(const std::vector<double> & volumes, int label = 1)
{
  std::vector<Row> rows;
  for (const double volume : volumes)
  {
    rows.push_back({ { "label", label }, { "name", "liver" }, { "volume_mm3", volume } });
  }
  return rows;
}

TEST(CohortTables, ColumnsAreTheUnionOfTheRowsAndTextIsDisarmed)
{
  Row first;
  Flatten(Row::parse(R"({"a":{"b":[1,2.5]},"t":"=1","n":null,"x":-1})"), "", {}, first);
  const Row second = { { "t", "ok,\"q\"" }, { "z", true } };
  EXPECT_EQ(CsvTable({ first, second }, ColumnsOf({ first, second }), {}),
            "a_b_0,a_b_1,t,n,x,z\n1,2.5,'=1,,-1,\n,,\"ok,\"\"q\"\"\",,,true\n");
}

TEST(CohortTables, UnitsAreThoseThatNamesEndIn)
{
  const Row row = { { "id", "a" },         { "volume_mm3", 1 },   { "pruned_0_area_vox2", 2 },
                    { "spacing_mm_0", 3 }, { "seconds_read", 4 }, { "peak_memory_mb", 5 },
                    { "dimm", 6 } };
  EXPECT_TRUE(CsvTable({ row }, ColumnsOf({ row }), SpatialUnit::Millimetres)
                .starts_with("id,volume_mm3 [mm^3],pruned_0_area_vox2 [vox^2],spacing_mm_0 [mm],seconds_read [s],"
                             "peak_memory_mb [MB],dimm\n"));
}

TEST(CohortTables, OneFarValueOfALabelIsMarkedWithItsDirection)
{
  auto rows = Volumes({ 10, 11, 12, 13, 14, 40, 1e-3 });
  auto other = Volumes({ 40, 41, 42, 43, 44 }, 2);
  rows.insert(rows.end(), other.begin(), other.end());
  FindOutliers(rows);
  // Median 12, median distance 2: beyond 12 +- 3.5 * 1.4826 * 2 = 12 +- 10.4.
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    EXPECT_EQ(rows[i]["outliers"], i == 5 ? "volume_mm3+" : i == 6 ? "volume_mm3-" : "") << i;
  }
}

TEST(CohortTables, EqualValuesAndSmallGroupsHaveNoOutliersButOneAmongEqualsIsFound)
{
  auto few = Volumes({ 1, 1, 1, 100 });
  FindOutliers(few);
  EXPECT_EQ(few[3]["outliers"], "");
  auto same = Volumes({ 5, 5, 5, 5, 5, 5 });
  FindOutliers(same);
  EXPECT_EQ(same[0]["outliers"], "");
  auto one = Volumes({ 5, 5, 5, 5, 5, 5, 5, 6 });
  FindOutliers(one);
  EXPECT_EQ(one[7]["outliers"], "volume_mm3+");
  EXPECT_EQ(one[0]["outliers"], "");
}

/** What the page holds as data of one label. */
Row
PageData(const std::vector<Row> & labels)
{
  PageCase one;
  one.folder = "sub-x";
  one.record.done = true;
  one.labels = labels;
  for (Row & label : one.labels)
  {
    label["outliers"] = "";
  }
  const std::string          page = CohortPage({ one });
  constexpr std::string_view begins = "type=\"application/json\">";
  const std::size_t          begin = page.find(begins) + begins.size();
  return Row::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(CohortTables, ThePageShowsLengthsInOneUnitThatSuitsItsLargestBody)
{
  auto rows = Volumes({ 8e-9, 1e-12 }); // 2 um wide, and 0.1
  rows[0]["core_max_radius_mm"] = 5e-4;
  rows[0]["pruned_0_area_mm2"] = 3e-6;
  rows[0]["shape_betti_1"] = 7;
  Row data = PageData(rows);
  EXPECT_EQ(data["columns"][0], "volume µm³");
  EXPECT_EQ(data["columns"][1], "area µm²");
  EXPECT_EQ(data["columns"][2], "max radius µm");
  EXPECT_EQ(data["columns"][3], "loops");
  const Row & values = data["cases"][0]["labels"][0]["values"];
  EXPECT_NEAR(values[0].get<double>(), 8, 1e-9);
  EXPECT_NEAR(values[1].get<double>(), 3, 1e-9);
  EXPECT_NEAR(values[2].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(values[3], 7);
  EXPECT_EQ(data["columns"].size(), 4U) << "others have no value here";
  EXPECT_NEAR(data["cases"][0]["labels"][1]["values"][0].get<double>(), 1e-3, 1e-9);
  // Of bodies that one would measure in mm nothing changes.
  data = PageData(Volumes({ 1234.5, 8e-9 }));
  EXPECT_EQ(data["columns"][0], "volume mm³");
  EXPECT_EQ(data["cases"][0]["labels"][0]["values"][0], 1234.5);
  EXPECT_EQ(data["cases"][0]["labels"][1]["values"][0], 8e-9);
}

TEST(CohortTables, HistogramsOfThicknessGoWithTheirUnitAndColumnsThatNoCaseHasAreLeftOut)
{
  auto rows = Volumes({ 8e-9, 1e-9 });
  rows[0]["thickness_mean_mm"] = 5e-4;
  rows[0]["thickness_bin_width_mm"] = 2.5e-4;
  rows[0]["thickness_histogram"] = "0 3 12";
  rows[0]["certificate_passed"] = false;
  const Row data = PageData(rows);
  const Row columns = data["columns"];
  EXPECT_EQ(std::count(columns.begin(), columns.end(), "mean thickness µm"), 1);
  EXPECT_EQ(std::count(columns.begin(), columns.end(), "branches"), 0);
  EXPECT_EQ(std::count(columns.begin(), columns.end(), "whorls"), 0);
  const Row & first = data["cases"][0]["labels"][0];
  EXPECT_EQ(first["histogram"]["unit"], "µm");
  EXPECT_NEAR(first["histogram"]["width"].get<double>(), 0.25, 1e-12);
  EXPECT_EQ(first["histogram"]["counts"], Row({ 0, 3, 12 }));
  EXPECT_EQ(first["certificate"], false);
  // Rows without a certificate, as that of the separation, are not said to have failed it.
  const Row & second = data["cases"][0]["labels"][1];
  EXPECT_TRUE(second["histogram"].is_null());
  EXPECT_TRUE(second["certificate"].is_null());
}

TEST(CohortTables, IntervalsOfMeansAreStudents)
{
  // Quantiles at 0.975 as tables have them (Abramowitz and Stegun, table 26.10; the last of 1000 degrees of freedom).
  const std::pair<std::size_t, double> quantiles[] = { { 2, 12.706205 },  { 3, 4.302653 },  { 4, 3.182446 },
                                                       { 5, 2.776445 },   { 10, 2.262157 }, { 31, 2.042272 },
                                                       { 1001, 1.962339 } };
  for (const auto & [n, quantile] : quantiles)
  {
    EXPECT_NEAR(StudentHalfWidth(n), quantile, 1e-6) << n;
  }
  std::vector<Row> rows = Volumes({ 1, 1, 1, 1 });
  rows[2]["label"] = 2;
  rows[0]["compare_dice"] = 0.9;
  rows[1]["compare_dice"] = 0.7;
  rows[2]["compare_dice"] = 0.5;
  rows[3]["compare_dice"] = nullptr; // of nothing
  const auto means = MeansOfComparisons(rows);
  ASSERT_EQ(means.size(), 2U);
  const Row & one = means[0];
  EXPECT_EQ(one["measure"], "dice");
  EXPECT_EQ(one["name"], "liver");
  EXPECT_EQ(one["cases"], 2);
  EXPECT_NEAR(one["mean"].get<double>(), 0.8, 1e-12);
  EXPECT_NEAR(one["sd"].get<double>(), std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(one["ci95_high"].get<double>(), 0.8 + 12.706205 * 0.1, 1e-6);
  EXPECT_NEAR(one["ci95_low"].get<double>(), 0.8 - 12.706205 * 0.1, 1e-6);
  EXPECT_NEAR(one["median"].get<double>(), 0.8, 1e-12);
  EXPECT_EQ(means[1]["label"], 2);
  EXPECT_FALSE(means[1].contains("ci95_low")) << "a single case has none";
  EXPECT_TRUE(MeansOfComparisons(Volumes({ 1, 2 })).empty());
}

TEST(CohortTables, NothingOfACaseIsMarkupOnThePage)
{
  PageCase one;
  one.folder = "sub-x";
  one.record.id = "</script><script>alert(1)</script><!--";
  one.record.reason = "<img src=x onerror=alert(2)>";
  one.record.warnings = { "\xE2\x80\xA8&lt;" };
  const std::string page = CohortPage({ one });
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page, HasSubstr("\\u003c/script\\u003e"));
  EXPECT_THAT(page, Not(HasSubstr("http"))); // nothing from elsewhere
}

} // namespace
} // namespace voxelcore
