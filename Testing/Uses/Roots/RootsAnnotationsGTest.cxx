#include "RootsFolder.h"

#include <nlohmann/json.hpp>

#include <array>
#include <fstream>
#include <sstream>
#include <string>

namespace voxelcore::testing
{
namespace
{

using RootsAnnotations = RootsFolder;

TEST_F(RootsAnnotations, EditedByHandAreReadBack)
{
  Scan("a.nrrd", 0, 3);
  const RootsResult found = Roots("a.nrrd", "out/");
  const auto &      axes = found.model.roots.axes;
  const auto        leaf = static_cast<ElementIndex>(axes.size() - 1);
  ElementIndex      side = 1;
  for (; axes[side].children > 0 || axes[side].level != 1; ++side)
  {}
  std::istringstream lines(Bytes("out/annotations.csv"));
  std::string        text;
  std::string        line;
  for (std::getline(lines, line); line.substr(0, 4) == "root" || !line.empty(); std::getline(lines, line))
  {
    const bool isLeaf = line.starts_with(std::to_string(leaf) + ",");
    const bool isSide = line.starts_with(std::to_string(side) + ",");
    EXPECT_TRUE(line.ends_with(",,") || text.empty()) << line;
    line.resize(line.size() - (isLeaf || isSide ? 2 : 0));
    text += line + (isLeaf ? ",remove," : isSide ? ",,\"<the \"\"1st\"\">, =1\"" : "") + "\n";
  }
  std::ofstream(At("edits.csv")) << text;
  const RootsResult edited = Roots("a.nrrd", "edited/", { { "edits", At("edits.csv") } });
  EXPECT_EQ(edited.model.roots.axes.size(), axes.size() - 1);
  EXPECT_EQ(edited.report.labels.at(0).shape.betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  EXPECT_NE(Bytes("edited/roots.csv").find("\"<the \"\"1st\"\">, =1\"\n"), std::string::npos);
  EXPECT_NE(Bytes("edited/roots.rsml").find("label=\"&lt;the "), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(Bytes("edited/report.json")).at("roots").at("edits").size(), 2U);
  // What is written then holds the same edits, in both forms.
  for (const char * again : { "edited/annotations.csv", "edited/annotations.mrk.json" })
  {
    Roots("a.nrrd", "again/", { { "edits", At(again) }, { "force", "true" } });
    for (const char * file : { "roots.csv", "annotations.csv", "annotations.mrk.json", "mask.nrrd" })
    {
      EXPECT_EQ(Bytes(std::string("again/") + file), Bytes(std::string("edited/") + file)) << again << " " << file;
    }
  }
  // Saved by Slicer in RAS, a point moved a little, a root hung elsewhere.
  auto   slicer = nlohmann::json::parse(Bytes("out/annotations.mrk.json"));
  auto & list = slicer.at("markups").at(0);
  list["coordinateSystem"] = "RAS";
  for (auto & point : list.at("controlPoints"))
  {
    point["position"][0] = -point["position"][0].get<double>() + 0.2;
    point["position"][1] = -point["position"][1].get<double>();
  }
  list["controlPoints"][leaf]["description"] = "parent 0";
  std::ofstream(At("slicer.mrk.json")) << slicer.dump();
  const RootsResult hung = Roots("a.nrrd", "hung/", { { "edits", At("slicer.mrk.json") } });
  EXPECT_EQ(hung.model.roots.axes.size(), axes.size());
  EXPECT_EQ(hung.model.roots.axes[0].children, axes[0].children + (axes[leaf].parent == 0 ? 0 : 1));
}

TEST_F(RootsAnnotations, ThatFitNoRootAreToldALineEachAndLeftOut)
{
  Scan("a.nrrd");
  std::ofstream(At("a.csv"))
    << "root,x,y,z,edit,name\n999,,,,remove,\n5,-500,0,0,remove,\n1,,,,parent 999,\n2,-500,0,0,,last\n";
  const RootsResult found = Roots("a.nrrd", "out/");
  const RootsResult edited = Roots("a.nrrd", "edited/", { { "edits", At("a.csv") } });
  EXPECT_EQ(edited.model.roots.axes.size(), found.model.roots.axes.size());
  std::vector<std::string> told;
  for (const std::string & warning : edited.warnings)
  {
    if (warning.find("' is left out: ") != std::string::npos)
    {
      told.push_back(warning.substr(warning.find(": line") + 2));
    }
  }
  EXPECT_EQ(told,
            (std::vector<std::string>{ "line 2: 'remove' is left out: there is no such root",
                                       "line 3: 'remove' is left out: no root ends there",
                                       "line 4: 'parent 999' is left out: the other root is not there",
                                       "line 5: 'last' is left out: no root ends there" }));
  EXPECT_EQ(Bytes("edited/roots.csv"), Bytes("out/roots.csv"));
}

TEST_F(RootsAnnotations, ThatAreUnfitAreRefused)
{
  Scan("a.nrrd");
  const auto refused = [&](const std::string & name, const std::string & text, const std::string & why) {
    std::ofstream(At(name)) << text;
    try
    {
      Roots("a.nrrd", "out/", { { "edits", At(name) } });
      ADD_FAILURE() << text;
    }
    catch (const InputError & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(At("out")));
  };
  refused("a.csv", "", "empty");
  refused("a.csv", "a,b\n1,2\n", "columns");
  refused("a.csv", "root,edit\n1,remove it\n", "line 2");
  refused("a.csv", "root,edit\n1,parent 1\n", "from itself");
  refused("a.csv", "root,x,y,z,edit\n1,nan,0,0,remove\n", "coordinate");
  refused("a.csv", "root,edit\n1,stem\n1,remove\n", "twice");
  refused("a.mrk.json", "{", "point list");
  refused("a.mrk.json", R"({"markups":[{"controlPoints":[{"position":[0,0]}]}]})", "point list");
  refused("a.mrk.json", R"({"markups":[{"controlPoints":[{"position":[0,0,0],"description":"x"}]}]})", "point 1");
}

} // namespace
} // namespace voxelcore::testing
