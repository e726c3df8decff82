#include "voxelcore/Compare/CompareTables.h"

#include "CompareGraphs.h"
#include "TablesJson.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Report/CsvText.h"

#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>

namespace voxelcore::testing
{
namespace
{

ComparedMasks
Masks()
{
  ComparedMasks masks;
  masks.label = 4;
  masks.name = "airway, left";
  masks.overlap = { 8, 8, 4 };
  masks.surface = { std::nan(""), 2.5, 0.125 };
  masks.closed.errors = { 0, 1, 2 };
  masks.parts = { { PartKind::Cavity, PartChange::Joined, 7, { 1, 2, 3 } } };
  return masks;
}

ImageGeometry
Geometry()
{
  ImageGeometry geometry;
  geometry.spacing = { 0.5, 0.5, 2 };
  geometry.origin = { 10, 0, 0 };
  return geometry;
}

TEST(CompareTables, ANumberIsTheSameInTableAndReport)
{
  const auto            tables = TablesOf({ Masks() }, Geometry());
  const TemporaryFolder folder;
  const auto            json = TablesAsJson(tables);
  const auto            meanings = nlohmann::json::parse(CompareColumnsJson(tables));
  for (const CompareTable & table : tables)
  {
    WriteCompareCsv(folder / table.name, table);
    const auto rows = ParseCsv(ReadAll(folder / table.name), table.name);
    ASSERT_EQ(rows.size(), 2U);
    ASSERT_EQ(rows[0].fields.size(), table.columns.size());
    const std::set<std::string> names(rows[0].fields.begin(), rows[0].fields.end());
    EXPECT_EQ(names.size(), rows[0].fields.size()) << "each column has a name of its own";
    for (std::size_t i = 0; i < rows[0].fields.size(); ++i)
    {
      const std::string & name = rows[0].fields[i];
      const auto &        value = json.at(table.name).at(0).at(name);
      EXPECT_TRUE(meanings.at(table.name).contains(name)) << name;
      EXPECT_EQ(rows[1].fields[i].empty(), value.is_null()) << name;
      if (value.is_number())
      {
        EXPECT_NEAR(std::stod(rows[1].fields[i]), value.get<double>(), 1e-7) << name; // of seven digits
      }
    }
  }
  const auto & row = json.at("labels").at(0);
  EXPECT_EQ(row.at("name"), "airway, left");
  EXPECT_EQ(row.at("volume_a"), 4); // 8 voxels of 0.5 mm3
  EXPECT_EQ(row.at("dice"), 0.5);
  EXPECT_TRUE(row.at("hausdorff").is_null());
  EXPECT_EQ(row.at("hausdorff_95"), 2.5);
  EXPECT_EQ(row.at("b2_error_26"), 2);
  EXPECT_EQ(row.at("b2_error_6"), 0);
  EXPECT_EQ(row.at("cavities_joined"), 1);
  EXPECT_TRUE(row.at("cl_dice").is_null());
  EXPECT_TRUE(row.at("loops_missed").is_null()); // nothing has looked for them
  const auto & place = json.at("differences").at(0);
  EXPECT_EQ(place.at("kind"), "cavity");
  EXPECT_EQ(place.at("x"), 10.5);
  EXPECT_EQ(place.at("z"), 6);
}

TEST(CompareTables, LengthsAreInTheUnitOfTheScan)
{
  ImageGeometry geometry = Geometry();
  geometry.unit = SpatialUnit::Voxels;
  const auto meanings = nlohmann::json::parse(CompareColumnsJson(TablesOf({ Masks() }, geometry)));
  EXPECT_EQ(meanings.at("labels").at("hausdorff").at("Units"), InUnit("mm", SpatialUnit::Voxels));
  EXPECT_EQ(meanings.at("labels").at("volume_a").at("Units"), InUnit("mm3", SpatialUnit::Voxels));
}

TEST(CompareTables, TreesAreSummedUp)
{
  const SkeletonGraph a = GraphOf({ { { 0, 0, 0 }, { 20, 0, 0 } } }, 1);
  const SkeletonGraph b = GraphOf({ { { 0, 0, 0 }, { 17, 0, 0 } }, { { 0, 9, 0 }, { 5, 9, 0 } } }, 1);
  ComparedTrees       trees;
  trees.found = CompareTrees(a, b, {});
  trees.levelsA = MeasureBranches(a).levels;
  trees.levelsB = MeasureBranches(b).levels;
  const auto   json = TablesAsJson(TablesOf({ trees }, SpatialUnit::Millimetres));
  const auto & row = json.at("labels").at(0);
  EXPECT_EQ(row.at("length_difference"), 2);
  EXPECT_NEAR(row.at("tree_length_detected").get<double>(), 18 / 20.0, 1e-8); // a radius beyond the end
  EXPECT_EQ(row.at("branches_detected"), 1);
  EXPECT_EQ(row.at("branches_invented"), 1);
  EXPECT_NEAR(row.at("leakage").get<double>(), 5, 1e-12);
  EXPECT_EQ(row.at("tips_found"), 1);
  EXPECT_EQ(row.at("tips_missed"), 1);
  EXPECT_EQ(row.at("tips_invented"), 3);
  EXPECT_EQ(json.at("branches").size(), 3U);
  EXPECT_EQ(json.at("levels").at(0).at("length_b"), 22);
}

TEST(CompareTables, PeopleReadWhatDiffersAndWhere)
{
  const std::string text = CompareTablesText(TablesOf({ Masks() }, Geometry()));
  EXPECT_NE(text.find("airway, left: cavity joined, 7 voxels, at voxel 1,2,3 (10.500, 1.000, 6.000)\n"),
            std::string::npos)
    << text;
  EXPECT_NE(text.find("0.500"), std::string::npos);
  ComparedMasks many = Masks();
  many.parts.assign(11, many.parts[0]);
  EXPECT_NE(CompareTablesText(TablesOf({ many }, Geometry())).find("and 3 more differences"), std::string::npos);
}

} // namespace
} // namespace voxelcore::testing
