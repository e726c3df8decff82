#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Models/TreeFiles.h"

#include "Program/Jobs/JobFolder.h"
#include "Uses/Compare/CompareGraphs.h"

#include <algorithm>
#include <numeric>

namespace voxelcore::testing
{
namespace
{

double
LengthOf(const SkeletonGraph & graph)
{
  double length = 0;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    length += graph.BranchLength(branch);
  }
  return length;
}

class TreeFiles : public JobFolder
{
protected:
  SkeletonGraph
  Read(const std::string & name, const std::string & text)
  {
    WriteAll(At(name), text);
    return ReadTreeFile(At(name)).parts.at(0).graph;
  }
  void
  ExpectRefused(const std::string & name, const std::string & text, const std::string & why)
  {
    try
    {
      Read(name, text);
      ADD_FAILURE() << text;
    }
    catch (const InputError & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  static std::string
  Rsml(const std::string & roots, const std::string & unit = "mm")
  {
    return "<rsml><metadata><unit>" + unit + "</unit><resolution>1</resolution></metadata><scene><plant>" + roots +
           "</plant></scene></rsml>";
  }
};

TEST_F(TreeFiles, SwcIsATreeInMicrometres)
{
  const SkeletonGraph graph = Read("a.swc",
                                   "# another program's\n"
                                   "1 2 0 0 0 500 -1\n2 2 4000 0 0 250 1\n"
                                   "3 2 8000 0 0 250 2\n 4 2 4000 3000 0 100 2\r\n\n9 2 0 0 9000 1 -1\n");
  EXPECT_EQ(graph.BranchCount(), 3U);
  EXPECT_DOUBLE_EQ(LengthOf(graph), 11);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Tip), 3);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Junction), 1);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Isolated), 1);
  EXPECT_DOUBLE_EQ(*std::ranges::max_element(graph.radius), 0.5);
}

TEST_F(TreeFiles, SwcOfASkeletonHasItsBranches)
{
  for (const SpatialUnit unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    SkeletonModel model;
    model.unit = unit;
    model.parts.resize(1);
    model.parts[0].graph = GraphOf(
      { { { 0, 0, 0 }, { 5, 0, 0 }, { 9, 1, 0 } }, { { 9, 1, 0 }, { 9, 8, 0 } }, { { 9, 1, 0 }, { 20, 1, 3 } } },
      0.75);
    model.parts[0].table = MeasureBranches(model.parts[0].graph);
    WriteSwc(At("own.swc"), model, {});
    const SkeletonModel read = ReadTreeFile(At("own.swc"));
    EXPECT_EQ(read.unit, unit);
    EXPECT_EQ(read.parts[0].graph.BranchCount(), 3U);
    EXPECT_NEAR(LengthOf(read.parts[0].graph), LengthOf(model.parts[0].graph), 1e-6);
    EXPECT_NEAR(read.parts[0].graph.radius[0], 0.75, 1e-9);
  }
}

TEST_F(TreeFiles, RsmlLateralsHangOnTheirParents)
{
  // The first lateral begins in a point of its parent, the second 1 mm beside one, and has a lateral of its own.
  const std::string text = Rsml(
    "<root><geometry><polyline><point x='0' y='0' z='0'/><point x='0' y='0' z='5'/><point x='0' y='0' z='10'/>"
    "</polyline></geometry><functions><function name='diameter' domain='polyline'><sample value='2'/><sample>2</sample>"
    "<sample value='1'/></function><function name='age'><sample value='-1'/></function></functions>"
    "<root><geometry><polyline><point x='0' y='0' z='5'/><point x='3' y='0' z='5'/></polyline></geometry></root>"
    "<root><geometry><polyline><point x='0' y='1' z='5'/><point x='0' y='4' z='5'/></polyline></geometry>"
    "<root><geometry><polyline><point x='0' y='4' z='5'/><point x='0' y='4' z='7'/></polyline></geometry></root>"
    "</root></root>");
  const SkeletonGraph graph = Read("a.rsml", text);
  EXPECT_DOUBLE_EQ(LengthOf(graph), 10 + 3 + 1 + 3 + 2);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Tip), 4);
  EXPECT_EQ(std::ranges::count(graph.nodeKinds, NodeKind::Junction), 1); // of four branches
  EXPECT_DOUBLE_EQ(*std::ranges::max_element(graph.radius), 1);
  std::string centimetres = text;
  centimetres.replace(centimetres.find("mm"), 2, "cm");
  EXPECT_DOUBLE_EQ(LengthOf(Read("b.rsml", centimetres)), 190);
  EXPECT_EQ(ReadTreeFile(At("a.rsml")).unit, SpatialUnit::Millimetres);
}

TEST_F(TreeFiles, CentreLinesOfAPhantomAreTheSameInBothForms)
{
  for (const char * form : { "swc", "rsml" })
  {
    RunPhantomJob(PhantomOptionsFrom({ { "kind", "root" },
                                       { "size", "48" },
                                       { "output", At(std::string(form) + ".nrrd") },
                                       { "spacing", "0.5,0.5,0.5" },
                                       { "centre-lines", At(std::string("lines.") + form) } }));
  }
  const SkeletonGraph swc = ReadTreeFile(At("lines.swc")).parts[0].graph;
  const SkeletonGraph rsml = ReadTreeFile(At("lines.rsml")).parts[0].graph;
  EXPECT_NEAR(LengthOf(swc), LengthOf(rsml), 1e-3 * LengthOf(swc));
  EXPECT_EQ(std::ranges::count(swc.nodeKinds, NodeKind::Tip), std::ranges::count(rsml.nodeKinds, NodeKind::Tip));
}

TEST_F(TreeFiles, GraphMlOfOursIsReadAgainWithItsCourse)
{
  for (const SpatialUnit unit : { SpatialUnit::Millimetres, SpatialUnit::Voxels })
  {
    SkeletonModel model;
    model.unit = unit;
    model.parts.resize(1);
    model.parts[0].graph = GraphOf({ { { 0, 0, 0 }, { 5, 2, 0 }, { 7, -1, 0 }, { 9, 1, 0 } },
                                     { { 9, 1, 0 }, { 9, 8, 0 } },
                                     { { 9, 1, 0 }, { 20, 1, 3 }, { 20, 9, 3 }, { 9, 1, 0 } } },
                                   0.75);
    model.parts[0].table = MeasureBranches(model.parts[0].graph);
    WriteGraphMl(At("own.graphml"), model);
    const SkeletonModel   read = ReadTreeFile(At("own.graphml"));
    const SkeletonGraph & graph = read.parts[0].graph;
    EXPECT_EQ(read.unit, unit);
    EXPECT_EQ(graph.BranchCount(), 3U);
    EXPECT_NEAR(LengthOf(graph), LengthOf(model.parts[0].graph), 1e-6);
    EXPECT_EQ(graph.positions.size(), model.parts[0].graph.positions.size());
    EXPECT_TRUE(std::ranges::all_of(graph.radius, [](double radius) { return std::abs(radius - 0.75) < 1e-9; }));
  }
}

TEST_F(TreeFiles, GraphMlOfOthersHasStraightEdgesBetweenNodesWithPlaces)
{
  // As networkx writes it: keys of any id, an edge before its nodes, data that means nothing here.
  const SkeletonGraph graph =
    Read("a.graphml",
         "<?xml version='1.0' encoding='utf-8'?><graphml xmlns='http://graphml.graphdrawing.org/xmlns'>"
         "<key id='d4' for='edge' attr.name='weight' attr.type='double'/><key id='d0' for='node' attr.name='x' "
         "attr.type='double'/><key id='d1' for='node' attr.name='y' attr.type='double'/><key id='d2' for='node' "
         "attr.name='radius' attr.type='double'/><graph edgedefault='undirected'><edge source='a b' target='c'>"
         "<data key='d4'>7</data></edge><node id='a b'><data key='d0'>1</data><data key='d1'>2</data><data key='d2'>.5"
         "</data></node><node id='c'><data key='d0'>4</data><data key='d1'>6</data></node></graph></graphml>");
  EXPECT_DOUBLE_EQ(LengthOf(graph), 5);
  EXPECT_EQ(graph.radius, (std::vector<double>{ 0.5, 0 }));
}

TEST_F(TreeFiles, WhatIsNoTreeIsRefused)
{
  ExpectRefused("a.swc", "", "no point");
  ExpectRefused("a.swc", "1 2 0 0 0 1\n", "line 1: expected seven numbers");
  ExpectRefused("a.swc", "1 2 0 0 0 1 -1\n2 2 0 nan 0 1 1\n", "line 2: expected seven numbers");
  ExpectRefused("a.swc", "1 2 0 0 0 1 -1\n1 2 0 0 1 1 1\n", "line 2: its id was given already");
  ExpectRefused("a.swc", "1 2 0 0 0 1 2\n2 2 0 0 1 1 -1\n", "line 1: its parent must come before it");
  ExpectRefused("a.swc", "1 2 0 0 0 -1 -1\n", "line 1: a radius is below 0");
  ExpectRefused("a.rsml", "<rsml><metadata>", "line 1");
  ExpectRefused("a.rsml", Rsml(""), "no root");
  ExpectRefused("a.rsml", Rsml("<root/>", "inch"), "its unit is 'inch'");
  ExpectRefused("a.rsml", "<!DOCTYPE rsml><rsml/>", "document type");
  const std::string point = "<root><geometry><polyline><point x='0' y='a'/></polyline></geometry></root>";
  ExpectRefused("a.rsml", Rsml(point), "a point of a polyline");
  const auto graphMl = [](const std::string & inner) {
    return "<graphml><key id='x' attr.name='x'/><key id='y' attr.name='y'/><key id='p' attr.name='points'/>"
           "<key id='r' attr.name='radius'/><key id='u' attr.name='unit'/><graph>" +
           inner + "</graph></graphml>";
  };
  const auto node = [](const std::string & id, const std::string & x) {
    return "<node id='" + id + "'><data key='x'>" + x + "</data><data key='y'>0</data></node>";
  };
  ExpectRefused("a.graphml", "<graphml>", "line 1");
  ExpectRefused("a.graphml", graphMl(""), "no node");
  ExpectRefused("a.graphml", graphMl("<node id='a'><data key='x'>1</data></node>"), "no data named x and y");
  ExpectRefused("a.graphml", graphMl(node("a", "1") + node("a", "2")), "two nodes have the id 'a'");
  ExpectRefused("a.graphml", graphMl(node("a", "nan")), "'nan'");
  ExpectRefused("a.graphml", graphMl(node("a", "1") + "<edge source='a' target='b'/>"), "no node's id: 'b'");
  ExpectRefused("a.graphml",
                graphMl(node("a", "1") + "<edge source='a' target='a'><data key='p'>1 2 3</data></edge>"),
                "not four numbers");
  ExpectRefused("a.graphml",
                graphMl(node("a", "1") + "<edge source='a' target='a'><data key='p'>1 2 3 -1</data></edge>"),
                "a radius is below 0");
  ExpectRefused("a.graphml", graphMl("<data key='u'>inch</data>" + node("a", "1")), "its unit is 'inch'");
  EXPECT_THROW(ReadTreeFile(At("none.swc")), InputError);
  EXPECT_FALSE(IsTreePath("a.vtp"));
}

TEST_F(TreeFiles, MergedLinesMeetWhereTheyDid)
{
  SkeletonModel model;
  model.parts.resize(2);
  model.parts[0].graph =
    GraphOf({ { { 0, 0, 0 }, { 5, 0, 0 } }, { { 5, 0, 0 }, { 9, 8, 0 } }, { { 5, 0, 0 }, { 20, 1, 3 } } }, 1);
  model.parts[1].graph = GraphOf({ { { 0, 50, 0 }, { 1, 50, 0 }, { 1, 51, 0 }, { 0, 50, 0 } } }, 1);
  const SkeletonGraph merged = MergedGraph(model);
  EXPECT_EQ(merged.BranchCount(), 4U);
  EXPECT_NEAR(LengthOf(merged), LengthOf(model.parts[0].graph) + LengthOf(model.parts[1].graph), 1e-12);
  EXPECT_EQ(std::ranges::count(merged.nodeKinds, NodeKind::Junction), 1);
  EXPECT_EQ(std::ranges::count(merged.nodeKinds, NodeKind::Loop), 1);
  // Without one of three branches, the other two go on as one.
  const SkeletonGraph chosen =
    MergedGraph(model, [](std::size_t part, std::size_t branch) { return part == 0 && branch != 2; });
  EXPECT_EQ(chosen.BranchCount(), 1U);
  EXPECT_EQ(chosen.nodePoints.size(), 2U);
}

} // namespace
} // namespace voxelcore::testing
