#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/RootFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

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
  model.roots = FindRoots(model.graph);
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
    EXPECT_EQ(columns.at(name).size() + (name == "plant" ? 1 : 0), commas + 1) << name;
  }
  EXPECT_NE(ReadAll(folder.Path() / "plant.csv").find(",1234,"), std::string::npos);
  EXPECT_EQ(columns.at("roots").at("length").at("Units"), "mm");
  EXPECT_EQ(nlohmann::json::parse(RootColumnsJson(SpatialUnit::Voxels)).at("roots").at("length").at("Units"), "vox");
}

} // namespace
} // namespace voxelcore::testing
