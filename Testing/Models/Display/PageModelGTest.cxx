// What a page is made of is valid JSON whatever is shown, and nothing of a label is lost.

#include "MeshBudget.h"
#include "PageModel.h"

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Display/LabelSurface.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using Json = nlohmann::json;

constexpr int kCount = 1; ///< of an array's place, length and bytes a number

DisplayLabel
LabelOf(const VoxelShape & shape, std::int64_t value, const std::string & name)
{
  ImageGeometry geometry;
  geometry.size = { 64, 64, 64 };
  DisplayLabel label;
  label.label = value;
  label.name = name;
  label.surface = LabelSurface(shape, geometry);
  label.medial = ToPhysical(ComputeVoxelCore(shape, ComputeSpacingWeights(geometry.spacing)), geometry, value);
  return label;
}

TEST(PageModel, PagesWithoutFacesAreValidJson)
{
  DisplayContent content;
  content.labels.push_back(LabelOf(Box({ 1, 1, 1 }), 1, "one voxel"));
  content.labels.push_back(LabelOf(Box({ 5, 1, 1 }, { 20, 0, 0 }), 2, "a row"));
  content.labels.emplace_back(); // nothing at all
  ASSERT_EQ(content.labels[0].medial.core.cells.FaceCount(), 0U);
  ASSERT_EQ(content.labels[0].medial.core.cells.edges.size(), 0U);
  ASSERT_EQ(content.labels[1].medial.core.cells.FaceCount(), 0U);
  const Json   page = Json::parse(MakePageModel(content, {}).json);
  const Json & labels = page.at("labels");
  ASSERT_EQ(labels.size(), 3U);
  EXPECT_EQ(labels[0].at("medial").at("dots")[kCount], 1);
  EXPECT_EQ(labels[0].at("medial").at("triangles")[kCount], 0);
  EXPECT_EQ(labels[1].at("medial").at("dots")[kCount], 0);
  EXPECT_EQ(labels[1].at("medial").at("segments")[kCount], 2 * content.labels[1].medial.core.cells.edges.size());
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(labels[0].at("medial").at("low")[k], 0.0); // the voxel's centre
    EXPECT_EQ(labels[0].at("medial").at("high")[k], 0.0);
  }
  EXPECT_EQ(labels[1].at("medial").at("low")[0], 20.0);
  EXPECT_EQ(labels[1].at("medial").at("high")[0], 24.0);
  EXPECT_FALSE(labels[2].contains("medial"));
}

TEST(PageModel, PointsOfASkeletonWithoutABranchAreThere)
{
  DisplayContent content;
  content.labels.emplace_back();
  content.labels[0].curves.positions = { { 1, 2, 3 } };
  content.labels[0].curves.radius = { 0.5 };
  content.labels[0].curves.erosionThickness = { std::numeric_limits<double>::infinity() };
  const Json page = Json::parse(MakePageModel(content, {}).json);
  EXPECT_EQ(page.at("labels")[0].at("curves").at("dots")[kCount], 1);
  EXPECT_FALSE(page.at("ranges").contains("ErosionThickness"));
}

TEST(PageModel, ALabelThatWouldShowLittleOfACommonRangeBeginsWithItsOwn)
{
  DisplayContent content;
  content.labels.push_back(LabelOf(Box({ 60, 60, 1 }), 1, "plate"));
  EXPECT_EQ(Json::parse(MakePageModel(content, {}).json).at("ownRanges"), Json::array());
  content.labels.push_back(LabelOf(Box({ 9, 9, 9 }, { 0, 0, 30 }), 2, "cube"));
  const Json page = Json::parse(MakePageModel(content, {}).json);
  EXPECT_EQ(page.at("ownRanges"), Json::array({ "Radius", "Lambda" }));
}

TEST(PageModel, NoNameEndsTheScriptOrTheJson)
{
  DisplayContent    content;
  const std::string hostile = "</script><b>\"\\\n\xE2\x82\xAC";
  content.labels.push_back(LabelOf(Box({ 1, 1, 1 }), 1, hostile));
  content.labels.push_back(LabelOf(Box({ 1, 1, 1 }), 2, "no UTF-8: \xFF"));
  HtmlOptions options;
  options.title = hostile;
  options.groups = hostile;
  options.voxel = 0.5;
  const std::string text = MakePageModel(content, options).json;
  EXPECT_EQ(text.find('<'), std::string::npos);
  const Json page = Json::parse(text);
  EXPECT_EQ(page.at("title"), hostile);
  EXPECT_EQ(page.at("groups"), hostile);
  EXPECT_EQ(page.at("voxel"), 0.5);
  EXPECT_EQ(page.at("labels")[0].at("name"), hostile);
  EXPECT_EQ(page.at("labels")[1].at("name"), "no UTF-8: \xEF\xBF\xBD");
}

TEST(PageModel, ABudgetIsKeptAndSharedBySize)
{
  DisplayContent content;
  content.labels.push_back(LabelOf(Ellipsoid(40), 1, "large"));
  content.labels.push_back(LabelOf(Ellipsoid(16), 2, "small"));
  content.labels.push_back(LabelOf(Box({ 1, 1, 1 }), 3, "point"));
  HtmlOptions options;
  options.triangles = 3000;
  const Json page = Json::parse(MakePageModel(content, options).json);
  EXPECT_GT(page.at("allTriangles"), 12000);
  EXPECT_LE(page.at("triangles"), 3200);
  EXPECT_GT(page.at("triangles"), 2000);
  const auto triangles = [&page](std::size_t label, const char * kind) {
    return page.at("labels")[label].at(kind).at("triangles")[kCount].get<std::size_t>() / 3;
  };
  for (const char * kind : { "surface", "medial" })
  {
    EXPECT_GT(triangles(0, kind), 2 * triangles(1, kind)) << kind;
    EXPECT_GE(triangles(1, kind), 60U) << kind;
  }
  EXPECT_EQ(page.at("labels")[2].at("medial").at("dots")[kCount], 1);
}

TEST(PageModel, SharesOfABudgetAddUpToIt)
{
  EXPECT_EQ(SharesOfBudget({ { 10, 0.4 }, { 0, 1 }, { 20, 1 } }, 100), (std::vector<std::size_t>{ 10, 0, 20 }));
  const auto shares = SharesOfBudget({ { 100000, 1 }, { 100000, 0.5 }, { 10000, 1 }, { 100, 1 }, { 0, 1 } }, 6500);
  EXPECT_EQ(shares[3], 64U);
  EXPECT_EQ(shares[4], 0U);
  EXPECT_NEAR(static_cast<double>(shares[0]) / static_cast<double>(shares[1]), 2, 0.02);
  EXPECT_NEAR(static_cast<double>(shares[0]) / static_cast<double>(shares[2]), 10, 0.1);
  EXPECT_NEAR(static_cast<double>(shares[0] + shares[1] + shares[2] + shares[3]), 6500, 5);
  // What the light ones cannot use, as they are whole, goes to none: the budget is enough for all.
  EXPECT_EQ(SharesOfBudget({ { 1000, 0.1 }, { 1000, 1 } }, 2000), (std::vector<std::size_t>{ 1000, 1000 }));
  std::size_t sum = 0; // many more meshes than the budget has triangles for
  for (const std::size_t share : SharesOfBudget(std::vector<MeshDemand>(1000, { 500, 1 }), 12000))
  {
    sum += share;
  }
  EXPECT_LE(sum, 12000U);
}

TEST(PageModel, WhatIsNoNumberIsRefusedByName)
{
  for (const double bad : { std::numeric_limits<double>::infinity(), std::nan("") })
  {
    DisplayContent content;
    content.labels.push_back(LabelOf(Box({ 2, 2, 2 }), 1, "broken"));
    content.labels[0].medial.core.positions.back()[1] = bad;
    try
    {
      MakePageModel(content, {});
      FAIL() << "a page with " << bad;
    }
    catch (const Error & error)
    {
      EXPECT_NE(std::string(error.what()).find("'broken'"), std::string::npos) << error.what();
    }
  }
}

} // namespace
} // namespace voxelcore::testing
