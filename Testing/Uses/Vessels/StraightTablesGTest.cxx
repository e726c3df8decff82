#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Vessels/StraightTables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace voxelcore::testing
{

namespace
{

std::vector<std::vector<std::string>>
FieldsOf(const std::string & text)
{
  std::vector<std::vector<std::string>> rows;
  std::istringstream                    lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    rows.emplace_back();
    for (std::size_t at = 0; at <= line.size();)
    {
      const std::size_t end = std::min(line.find(',', at), line.size());
      rows.back().push_back(line.substr(at, end - at));
      at = end + 1;
    }
  }
  return rows;
}

} // namespace

TEST(StraightTables, HaveTheColumnsThatAreExplained)
{
  const TemporaryFolder folder;
  AxisPlane             plane;
  plane.arc = 1.5;
  plane.place = { 1.0 / 3, 2, 3 };
  plane.across = { 1, 0, 0 };
  plane.up = { 0, 1, 0 };
  plane.along = { 0, 0, 1 };
  plane.radius = 4;
  plane.bend = 0.25;
  plane.branch = 7;
  AxisPlane straight = plane;
  straight.bend = 0;
  WritePlaneCsv(folder / "planes.csv", std::vector<AxisPlane>{ plane, straight });
  WriteMappedCsv(folder / "points.csv",
                 std::vector<MappedPoint>{ { { 1, 2, 3 }, Vector3{ 4, 5, 6 }, true }, { { 7, 8, 9 }, {}, false } });
  const auto planes = FieldsOf(ReadAll(folder / "planes.csv"));
  const auto points = FieldsOf(ReadAll(folder / "points.csv"));
  const auto columns = nlohmann::json::parse(StraightColumnsJson(SpatialUnit::Millimetres));
  for (const auto & [table, rows] : { std::pair("planes", planes), std::pair("points", points) })
  {
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(columns.at(table).size(), rows[0].size());
    for (const std::string & column : rows[0])
    {
      EXPECT_TRUE(columns.at(table).contains(column)) << column;
    }
    EXPECT_EQ(rows[1].size(), rows[0].size());
    EXPECT_EQ(rows[2].size(), rows[0].size());
  }
  EXPECT_EQ(
    planes[1],
    (std::vector<
      std::
        string>{ "0", "1.5", "0.3333333333", "2", "3", "1", "0", "0", "0", "1", "0", "0", "0", "1", "4", "4", "7" }));
  EXPECT_EQ(planes[2][15], "") << "without a bend there is no radius of it";
  EXPECT_EQ(points[1], (std::vector<std::string>{ "1", "2", "3", "4", "5", "6", "1" }));
  EXPECT_EQ(points[2], (std::vector<std::string>{ "7", "8", "9", "", "", "", "0" }));
  EXPECT_EQ(nlohmann::json::parse(StraightColumnsJson(SpatialUnit::Voxels)).at("points").at("x").at("Units"), "vox");
}

} // namespace voxelcore::testing
