#include "voxelcore/Base/SpatialUnit.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore
{
namespace
{

TEST(SpatialUnit, NamesLeadBack)
{
  for (const SpatialUnit unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    EXPECT_EQ(UnitNamed(UnitName(unit)), unit);
  }
  EXPECT_EQ(UnitNamed("inch"), std::nullopt);
}

TEST(SpatialUnit, TextsOfVoxelsNameNoMillimetre)
{
  const auto inVoxels = [](const char * text) { return InUnit(text, SpatialUnit::Voxels); };
  EXPECT_EQ(inVoxels("mm"), "vox");
  EXPECT_EQ(inVoxels("area_mm2,volume_mm3,radius_mm"), "area_vox2,volume_vox3,radius_vox");
  EXPECT_EQ(inVoxels("1.5mm or 2 mm^2"), "1.5vox or 2 vox^2");
  EXPECT_EQ(inVoxels("comma, summary, mmx, xmm"), "comma, summary, mmx, xmm");
  EXPECT_EQ(InUnit("1.5 mm", SpatialUnit::Millimetres), "1.5 mm");
}

TEST(SpatialUnit, KeysOfAllDepthsAreFoundInEitherUnit)
{
  using Json = nlohmann::ordered_json;
  const Json json{ { "size", { 1, 2 } }, { "labels", { { { "area_mm2", 3 }, { "name", "area_mm2" } } } } };
  EXPECT_EQ(KeysInUnit(json, SpatialUnit::Millimetres), json);
  const Json voxels = KeysInUnit(json, SpatialUnit::Voxels);
  EXPECT_EQ(voxels.dump(), R"({"size":[1,2],"labels":[{"area_vox2":3,"name":"area_mm2"}]})");
  EXPECT_EQ(AtLength(voxels["labels"][0], "area_mm2"), 3);
  EXPECT_EQ(AtLength(json["labels"][0], "area_mm2"), 3);
  EXPECT_THROW(AtLength(json, "area_mm2"), Json::out_of_range);
}

} // namespace
} // namespace voxelcore
