#include "CaseTable.h"
#include "CohortPage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  EXPECT_EQ(CsvTable({ first, second }), "a_b_0,a_b_1,t,n,x,z\n1,2.5,'=1,,-1,\n,,\"ok,\"\"q\"\"\",,,true\n");
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
