#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Roots/RootFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

/** A stem of two points' radius 3 with one lateral. */
RootModel
SmallModel()
{
  RootModel                              model;
  std::vector<std::vector<ElementIndex>> lines(3);
  const auto                             add = [&](std::size_t line, const Vector3 & place, double radius) {
    lines[line].push_back(static_cast<ElementIndex>(model.graph.positions.size()));
    model.graph.positions.push_back(place);
    model.graph.radius.push_back(radius);
    model.graph.erosionThickness.push_back(0);
  };
  for (int z = 60; z >= 30; --z)
  {
    add(0, { 0, 0, static_cast<double>(z) }, 3);
  }
  const ElementIndex fork = lines[0].back();
  lines[1].push_back(fork);
  lines[2].push_back(fork);
  for (int z = 29; z >= 0; --z)
  {
    add(1, { 0, 0, static_cast<double>(z) }, 3);
  }
  for (int x = 1; x <= 40; ++x)
  {
    add(2, { static_cast<double>(x), 0, 30 }, 1.25);
  }
  SortBranches(model.graph, lines, true);
  model.name = "a<b>&c";
  RootRules rules;
  rules.up = Vector3{ 0, 0, 1 };
  model.roots = FindRoots(model.graph, rules);
  model.traits = MeasureRoots(model.graph, model.roots);
  return model;
}

std::size_t
Count(const std::string & text, const std::string & what)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
  {
    ++count;
  }
  return count;
}

TEST(RootFiles, RsmlNestsRootsWithTheirLinesAndDiameters)
{
  const TemporaryFolder folder;
  const RootModel       model = SmallModel();
  WriteRsml(folder.Path() / "a.rsml", model, { "2020-01-02T03:04:05", "test 1", "ab" });
  const std::string text = ReadAll(folder.Path() / "a.rsml");
  EXPECT_EQ(Count(text, "<plant "), 1U);
  EXPECT_EQ(Count(text, "<root "), 2U);
  EXPECT_EQ(Count(text, "<point "), 61U + 41U);
  EXPECT_EQ(Count(text, "<sample "), 61U + 41U);
  EXPECT_EQ(Count(text, "</root>\n      </root>"), 1U); // nested
  EXPECT_NE(text.find("<point x=\"40\" y=\"0\" z=\"30\"/>"), std::string::npos);
  EXPECT_NE(text.find("<sample value=\"2.5\"/>"), std::string::npos);
  EXPECT_NE(text.find("<parent-node>30</parent-node>"), std::string::npos);
  EXPECT_NE(text.find("a&lt;b&gt;&amp;c"), std::string::npos);
  EXPECT_NE(text.find("<last-modified>2020-01-02T03:04:05</last-modified>"), std::string::npos);
}

TEST(RootFiles, SwcIsAForestWithTypesByLevel)
{
  const TemporaryFolder folder;
  RootModel             model = SmallModel();
  WriteRootSwc(folder.Path() / "a.swc", model);
  std::istringstream       file(ReadAll(folder.Path() / "a.swc"));
  std::vector<Vector3>     places(1);
  std::vector<std::size_t> children(1, 0);
  double                   length = 0;
  std::array<int, 2>       ofType{ 0, 0 };
  std::size_t              orphans = 0;
  for (std::string line; std::getline(file, line);)
  {
    if (line.starts_with("#"))
    {
      continue;
    }
    std::istringstream words(line);
    std::size_t        id = 0;
    int                type = 0;
    Vector3            at{};
    double             radius = 0;
    std::int64_t       parent = 0;
    ASSERT_TRUE(words >> id >> type >> at[0] >> at[1] >> at[2] >> radius >> parent) << line;
    ASSERT_EQ(id, places.size());
    ASSERT_LT(parent, static_cast<std::int64_t>(id));
    ASSERT_TRUE(type == 5 || type == 6) << line;
    EXPECT_EQ(radius, type == 5 ? 3000 : 1250) << line;
    ++ofType[static_cast<std::size_t>(type - 5)];
    places.push_back(at);
    children.push_back(0);
    if (parent < 0)
    {
      ++orphans;
      continue;
    }
    ++children[static_cast<std::size_t>(parent)];
    length += Distance(at, places[static_cast<std::size_t>(parent)]);
  }
  EXPECT_EQ(orphans, 1U);
  EXPECT_EQ(ofType, (std::array<int, 2>{ 61, 40 })) << "the lateral's first point is its parent's";
  EXPECT_DOUBLE_EQ(length, 100000); // micrometres
  EXPECT_EQ(std::ranges::count(children, 0U), 1 + 2) << "two tips; number 0 is none";
  EXPECT_EQ(std::ranges::count(children, 2U), 1);
  model.unit = SpatialUnit::Voxels;
  WriteRootSwc(folder.Path() / "b.swc", model);
  EXPECT_NE(ReadAll(folder.Path() / "b.swc").find("\n1 5 0 0 60 3 -1\n"), std::string::npos);
}

TEST(RootFiles, GraphMlIsATreeOfBasesOriginsAndTips)
{
  const TemporaryFolder folder;
  RootModel             model = SmallModel();
  model.roots.axes[1].name = "<b> & \"c\"";
  WriteRootGraphMl(folder.Path() / "a.graphml", model);
  const std::string text = ReadAll(folder.Path() / "a.graphml");
  EXPECT_EQ(Count(text, "<node "), 4U);
  EXPECT_EQ(Count(text, ">base<"), 1U);
  EXPECT_EQ(Count(text, ">junction<"), 1U);
  EXPECT_EQ(Count(text, ">tip<"), 2U);
  EXPECT_EQ(Count(text, "<edge "), 3U);
  EXPECT_EQ(Count(text, "<data key=\"length\">30<"), 2U) << "the stem, above and below its lateral";
  EXPECT_EQ(Count(text, "<data key=\"length\">40<"), 1U);
  EXPECT_NE(text.find("source=\"r0p30\" target=\"r1p40\"><data key=\"root\">1</data><data key=\"level\">1</data>"
                      "<data key=\"parent\">0</data><data key=\"name\">&lt;b&gt; &amp; &quot;c&quot;</data>"),
            std::string::npos)
    << text;
}

TEST(RootFiles, ALateralThatBeginsBesideItsParentIsTiedToIt)
{
  const TemporaryFolder folder;
  RootModel             model = SmallModel();
  model.roots.axes[1].points.erase(model.roots.axes[1].points.begin(), model.roots.axes[1].points.begin() + 3);
  model.traits = MeasureRoots(model.graph, model.roots);
  WriteRootSwc(folder.Path() / "a.swc", model);
  EXPECT_NE(ReadAll(folder.Path() / "a.swc").find("\n62 6 3000 0 30000 1250 31\n"), std::string::npos);
  WriteRootGraphMl(folder.Path() / "a.graphml", model);
  const std::string text = ReadAll(folder.Path() / "a.graphml");
  EXPECT_EQ(Count(text, "<node "), 5U);
  EXPECT_NE(text.find("source=\"r0p30\" target=\"r1p0\""), std::string::npos);
  EXPECT_EQ(Count(text, "<data key=\"length\">3<"), 1U);
}

TEST(RootFiles, TablesHaveARowForEachRootAndLevelAndEveryColumnExplained)
{
  const TemporaryFolder folder;
  RootModel             model = SmallModel();
  WriteRootCsv(folder.Path() / "roots.csv", model);
  WriteRootLevelCsv(folder.Path() / "levels.csv", model);
  WritePlantCsv(folder.Path() / "plant.csv", model, 1234);
  WriteRootProfileCsv(folder.Path() / "profile.csv", model);
  const auto columns = nlohmann::json::parse(RootColumnsJson(SpatialUnit::Millimetres));
  const std::vector<std::pair<std::string, std::size_t>> tables{ { "roots", 2 },
                                                                 { "levels", 4 },
                                                                 { "plant", 1 },
                                                                 { "profile", 20 } };
  for (const auto & [name, rows] : tables)
  {
    const std::string text = ReadAll(folder.Path() / (name + ".csv"));
    EXPECT_EQ(Count(text, "\n"), rows + 1) << name;
    const std::size_t commas = Count(text.substr(0, text.find('\n')), ",");
    EXPECT_EQ(Count(text, ","), commas * (rows + 1)) << name;
    EXPECT_EQ(columns.at(name).size(), commas + 1) << name;
  }
  EXPECT_NE(ReadAll(folder.Path() / "plant.csv").find(",1234,"), std::string::npos);
  EXPECT_EQ(columns.at("roots").at("length").at("Units"), "mm");
  EXPECT_EQ(nlohmann::json::parse(RootColumnsJson(SpatialUnit::Voxels)).at("roots").at("length").at("Units"), "vox");
}

} // namespace
} // namespace voxelcore::testing
