#include "voxelcore/Models/TableColumns.h"

#include <array>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore
{
namespace
{

constexpr auto kColumns = std::to_array<Column>({
  kLabelColumn,
  { "area", "mm^2", "of it" },
  { "flatness", "1", "how flat" },
  { "angle", "deg", "of it" },
});

TEST(TableHead, NamesColumnsAndIfAskedForTheirUnits)
{
  EXPECT_EQ(HeadLine(kColumns, {}), "label,area,flatness,angle\n");
  EXPECT_EQ(HeadLine(kColumns, SpatialUnit::Millimetres), "label,area [mm^2],flatness,angle [deg]\n");
  EXPECT_EQ(HeadLine(kColumns, SpatialUnit::Voxels), "label,area [vox^2],flatness,angle [deg]\n");
  const std::vector<TextColumn> written{ { "volume_vox3", "vox^3", "of it" } };
  EXPECT_EQ(HeadLine(written, SpatialUnit::Millimetres), "volume_vox3 [vox^3]\n") << "is said already";
}

TEST(TableHead, DescriptionsOfSeveralTablesAreOne)
{
  const auto one = TablesJson({ { "a", ColumnsJson(kColumns, SpatialUnit::Voxels) } });
  const auto other = TablesJson({ { "b", ColumnsJson(kColumns, SpatialUnit::Millimetres) }, { "c", "{}" } });
  const auto json = nlohmann::ordered_json::parse(JoinedTables(one, other));
  ASSERT_EQ(json.size(), 3U);
  EXPECT_EQ(json.at("a").at("area").at("Units"), "vox^2");
  EXPECT_EQ(json.at("b").at("area").at("Units"), "mm^2");
  EXPECT_EQ(json.at("b").at("label").size(), 1U) << "has no unit";
  EXPECT_EQ(JoinedTables(one, other).back(), '\n');
}

} // namespace
} // namespace voxelcore
