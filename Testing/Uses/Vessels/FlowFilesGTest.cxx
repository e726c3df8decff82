#include "VoxelCoreTesting/TemporaryFolder.h"

#include "Uses/Vessels/MeasuredGraphs.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Vessels/FlowFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace voxelcore::testing
{

namespace
{

/** A pipe of radius 2 and length 20 that forks into two of radius 1 and length 10. */
std::vector<MeasuredSkeleton>
PipesThatFork()
{
  MeasuredSkeleton part;
  part.label = 3;
  part.name = "aorta";
  part.graph.positions = { { 0, 0, 0 }, { 20, 0, 0 }, { 20, 10, 0 }, { 20, -10, 0 }, { 10, 0, 0 } };
  part.graph.radius = { 2, 2, 1, 1, 2 };
  SortBranches(part.graph, { { 0, 4, 1 }, { 1, 2 }, { 1, 3 } }, false);
  part.table = MeasureBranches(part.graph);
  return { part };
}

std::vector<std::string>
RowsOf(const std::filesystem::path & path)
{
  std::ifstream            file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

} // namespace

TEST(FlowFiles, CenterlinesAreReadByVtkWithTheArraysOfVmtk)
{
  const TemporaryFolder folder;
  const auto            parts = PipesThatFork();
  const auto            path = folder / "lines.vtp";
  const auto            tracts = SplitCenterlines(parts, FindInlets(parts, {}));
  WriteCenterlineVtp(path, tracts, SpatialUnit::Millimetres);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData * const lines = reader->GetOutput();
  ASSERT_EQ(lines->GetNumberOfLines(), static_cast<vtkIdType>(tracts.size()));
  ASSERT_EQ(tracts.size(), 6U);
  vtkDataArray * const radius = lines->GetPointData()->GetArray("MaximumInscribedSphereRadius");
  ASSERT_NE(radius, nullptr);
  vtkIdType point = 0;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfLines(); ++cell)
  {
    const CenterlineTract & tract = tracts[static_cast<std::size_t>(cell)];
    const auto number = [&](const char * name) { return lines->GetCellData()->GetArray(name)->GetTuple1(cell); };
    EXPECT_EQ(number("CenterlineIds"), tract.centerline);
    EXPECT_EQ(number("TractIds"), tract.tract);
    EXPECT_EQ(number("GroupIds"), tract.group);
    EXPECT_EQ(number("Blanking"), tract.isBlanked ? 1 : 0);
    EXPECT_EQ(number("Label"), 3);
    ASSERT_EQ(lines->GetCell(cell)->GetNumberOfPoints(), static_cast<vtkIdType>(tract.places.size()));
    for (const double one : tract.radius)
    {
      EXPECT_EQ(lines->GetCell(cell)->GetPointId(0) <= point, true);
      EXPECT_EQ(radius->GetTuple1(point++), one);
    }
  }
  // Both lines pass the fork: one group each of stem and bifurcation, one each of arms.
  EXPECT_EQ(tracts[0].group, tracts[3].group);
  EXPECT_EQ(tracts[1].group, tracts[4].group);
  EXPECT_NE(tracts[2].group, tracts[5].group);
}

TEST(FlowFiles, TablesHaveSegmentsAndNodes)
{
  const TemporaryFolder folder;
  const auto            parts = PipesThatFork();
  WriteFlowCsv(folder / "pipes.csv", folder / "pipes_nodes.csv", MakeFlowNetwork(parts, FindInlets(parts, {})), parts);
  const auto pipes = RowsOf(folder / "pipes.csv");
  const auto nodes = RowsOf(folder / "pipes_nodes.csv");
  ASSERT_EQ(pipes.size(), 4U);
  ASSERT_EQ(nodes.size(), 5U);
  EXPECT_EQ(pipes[1].substr(0, 17), "0,3,aorta,0,0,0,1");
  EXPECT_NE(pipes[1].find(",20,2,2,2,2,3.18309"), std::string::npos) << pipes[1]; // 8 * 20 / (pi 2^4)
  EXPECT_EQ(nodes[1], "0,inlet,0,0,0,2");
  EXPECT_EQ(nodes[2], "1,inner,20,0,0,2");
  EXPECT_EQ(nodes[3].substr(0, 8), "2,outlet");
  const auto columns = nlohmann::json::parse(FlowColumnsJson(SpatialUnit::Millimetres));
  for (const auto & [table, head] : { std::pair("segments", pipes[0]), std::pair("nodes", nodes[0]) })
  {
    std::stringstream line(head);
    std::size_t       count = 0;
    for (std::string column; std::getline(line, column, ',');)
    {
      EXPECT_TRUE(columns.at(table).contains(column)) << column;
      ++count;
    }
    EXPECT_EQ(columns.at(table).size(), count);
  }
}

TEST(FlowFiles, JsonIsInputOfSvZeroDInCentimetres)
{
  const TemporaryFolder folder;
  const auto            parts = PipesThatFork();
  WriteFlowJson(folder / "pipes.json", MakeFlowNetwork(parts, FindInlets(parts, {})), parts);
  std::ifstream file(folder / "pipes.json");
  const auto    json = nlohmann::json::parse(file);
  ASSERT_EQ(json.at("vessels").size(), 3U);
  const auto & stem = json.at("vessels").at(0);
  EXPECT_EQ(stem.at("vessel_id"), 0);
  EXPECT_EQ(stem.at("zero_d_element_type"), "BloodVessel");
  EXPECT_NEAR(stem.at("vessel_length").get<double>(), 2, 1e-12);
  EXPECT_NEAR(stem.at("zero_d_element_values").at("R_poiseuille").get<double>(),
              8 * 0.04 * 2 / (std::numbers::pi * std::pow(0.2, 4)),
              1e-9);
  EXPECT_NEAR(stem.at("zero_d_element_values").at("L").get<double>(), 1.06 * 2 / (std::numbers::pi * 0.2 * 0.2), 1e-9);
  EXPECT_EQ(stem.at("branch_id"), 0);
  EXPECT_EQ(stem.at("label"), 3);
  ASSERT_EQ(json.at("junctions").size(), 1U);
  EXPECT_EQ(json.at("junctions").at(0).at("inlet_vessels"), (std::vector<int>{ 0 }));
  EXPECT_EQ(json.at("junctions").at(0).at("outlet_vessels"), (std::vector<int>{ 1, 2 }));
  // Each end of a vessel that is at no junction has a condition that is there.
  std::size_t used = 0;
  for (const auto & vessel : json.at("vessels"))
  {
    for (const auto & [side, name] : vessel.at("boundary_conditions").items())
    {
      const auto & all = json.at("boundary_conditions");
      const auto   one =
        std::ranges::find_if(all, [&](const nlohmann::json & condition) { return condition.at("bc_name") == name; });
      ASSERT_NE(one, all.end());
      EXPECT_EQ(one->at("bc_type"), side == "inlet" ? "FLOW" : "PRESSURE");
      ++used;
    }
  }
  EXPECT_EQ(used, 3U);
  EXPECT_EQ(json.at("boundary_conditions").size(), 3U);
}

TEST(FlowFiles, JsonHasTheFieldsThatSvZeroDReadsAndNoOthers)
{
  // Its reader (SimulationParameters.cpp) looks up the fields of required(), and refuses values of elements that are
  // not among those below.
  const TemporaryFolder folder;
  GraphOfLines          graph;
  const auto            first = graph.Point({ 0, 0, 0 }, 2);
  const auto            fork = graph.Point({ 20, 0, 0 }, 2);
  const auto            meet = graph.Point({ 40, 0, 0 }, 2);
  graph.Line(first, fork, 9);
  graph.Line(fork, meet, 9);
  const auto corner = graph.Point({ 30, 15, 0 }, 1);
  graph.Line(fork, corner, 9);
  graph.Line(corner, meet, 9);
  graph.Line(meet, graph.Point({ 60, 0, 0 }, 1.5), 9);
  graph.Line(meet, graph.Point({ 60, 30, 0 }, 1), 9);
  const std::vector<MeasuredSkeleton> parts{ graph.Measured() };
  WriteFlowJson(folder / "pipes.json", MakeFlowNetwork(parts, FindInlets(parts, {})), parts);
  std::ifstream file(folder / "pipes.json");
  const auto    json = nlohmann::json::parse(file);
  const auto    required = [](const nlohmann::json & in, const std::vector<const char *> & names) {
    for (const char * name : names)
    {
      EXPECT_TRUE(in.contains(name)) << name << " in " << in;
    }
  };
  const auto only = [](const nlohmann::json & in, const std::set<std::string> & names) {
    for (const auto & [name, value] : in.items())
    {
      EXPECT_TRUE(names.contains(name)) << name;
      EXPECT_TRUE(value.is_number() || (value.is_array() && value.size() == 2)) << value;
    }
  };
  required(json, { "simulation_parameters", "vessels", "junctions", "boundary_conditions" });
  required(json.at("simulation_parameters"), { "number_of_cardiac_cycles", "number_of_time_pts_per_cardiac_cycle" });
  std::map<int, int>         insideOf; // connections of each vessel's ends
  std::map<int, int>         outsideOf;
  std::map<std::string, int> conditions;
  std::set<std::string>      names;
  for (const auto & vessel : json.at("vessels"))
  {
    required(vessel, { "vessel_id", "vessel_name", "zero_d_element_type", "zero_d_element_values" });
    only(vessel.at("zero_d_element_values"), { "R_poiseuille", "C", "L", "stenosis_coefficient" });
    EXPECT_TRUE(names.insert(vessel.at("vessel_name")).second);
    const int id = vessel.at("vessel_id");
    EXPECT_EQ(insideOf.count(id), 0U);
    insideOf[id] = 0;
    outsideOf[id] = 0;
    const auto ends = vessel.value("boundary_conditions", nlohmann::json::object());
    for (const auto & [side, name] : ends.items())
    {
      ++(side == "inlet" ? insideOf : outsideOf)[id];
      ++conditions[name];
    }
  }
  for (const auto & junction : json.at("junctions"))
  {
    required(junction, { "junction_name", "junction_type", "inlet_vessels", "outlet_vessels" });
    EXPECT_EQ(junction.at("junction_type"), "NORMAL_JUNCTION");
    EXPECT_TRUE(names.insert(junction.at("junction_name")).second);
    for (const int id : junction.at("inlet_vessels"))
    {
      ++outsideOf.at(id);
    }
    for (const int id : junction.at("outlet_vessels"))
    {
      ++insideOf.at(id);
    }
  }
  EXPECT_EQ(insideOf.size(), 5U);
  for (const auto & [id, count] : insideOf)
  {
    EXPECT_EQ(count, 1) << "begin of " << id;
    EXPECT_EQ(outsideOf.at(id), 1) << "end of " << id;
  }
  for (const auto & condition : json.at("boundary_conditions"))
  {
    required(condition, { "bc_name", "bc_type", "bc_values" });
    only(condition.at("bc_values"), { condition.at("bc_type") == "FLOW" ? "Q" : "P", "t" });
    EXPECT_EQ(conditions[condition.at("bc_name")], 1);
  }
  EXPECT_EQ(conditions.size(), json.at("boundary_conditions").size());
}

namespace
{

/** Vessels of a file of openBF, each with its fields as they stand there. */
std::vector<std::map<std::string, std::string>>
OpenBfVessels(const std::vector<std::string> & rows)
{
  std::vector<std::map<std::string, std::string>> vessels;
  for (auto row = std::ranges::find(rows, "network:"); row != rows.end(); ++row)
  {
    if (row->starts_with("  - "))
    {
      vessels.emplace_back();
    }
    if (row->size() > 4 && !vessels.empty())
    {
      const std::size_t colon = row->find(": ");
      vessels.back()[row->substr(4, colon - 4)] = row->substr(colon + 2);
    }
  }
  return vessels;
}

} // namespace

TEST(FlowFiles, YamlIsAConfigurationOfOpenBfInMetres)
{
  const TemporaryFolder folder;
  const auto            parts = PipesThatFork();
  const auto            network = MakeFlowNetwork(parts, FindInlets(parts, {}));
  WriteFlowYaml(folder / "a.yaml", folder / "a_inlet.dat", "a \"b\"", network, parts);
  const auto rows = RowsOf(folder / "a.yaml");
  for (const char * row : { "project_name: \"a \\\"b\\\"\"",
                            "inlet_file: \"a \\\"b\\\"_inlet.dat\"",
                            "solver:",
                            "  Ccfl: 0.9",
                            "  cycles: 100",
                            "  convergence_tolerance: 1.0",
                            "  jump: 100",
                            "blood:",
                            "  rho: 1060.0",
                            "  mu: 0.0040",
                            "network:" })
  {
    EXPECT_NE(std::ranges::find(rows, row), rows.end()) << row;
  }
  const auto vessels = OpenBfVessels(rows);
  ASSERT_EQ(vessels.size(), 3U);
  std::map<std::string, int> at;
  for (const auto & vessel : vessels)
  {
    for (const char * name : { "label", "sn", "tn", "L", "R0", "E" })
    {
      ASSERT_TRUE(vessel.contains(name)) << name;
    }
    EXPECT_EQ(vessel.at("L").find('e'), std::string::npos) << "1e-3 is a text in YAML 1.1";
    ++at[vessel.at("sn")];
    EXPECT_EQ(vessel.contains("Rt"), vessel.at("sn") != "1") << "outlets alone have conditions";
  }
  EXPECT_EQ(at["1"], 1) << "the inlet's vessel begins at node 1";
  EXPECT_NEAR(std::stod(vessels[0].at("L")), .02, 1e-9);
  EXPECT_NEAR(std::stod(vessels[0].at("R0")), network.segments[0].PoiseuilleRadius() / 1000, 1e-9);
  EXPECT_EQ(RowsOf(folder / "a_inlet.dat").size(), 2U);
}

TEST(FlowFiles, VesselsBetweenTheSameNodesGetNodesOfTheirOwnInOpenBf)
{
  const TemporaryFolder folder;
  GraphOfLines          graph;
  const auto            fork = graph.Point({ 20, 0, 0 }, 2);
  const auto            meet = graph.Point({ 40, 0, 0 }, 2);
  graph.Line(graph.Point({ 0, 0, 0 }, 3), fork, 9);
  graph.Line(fork, meet, 4);
  graph.Line(fork, meet, 8);
  graph.Line(meet, graph.Point({ 60, 0, 0 }, 1), 9);
  const std::vector<MeasuredSkeleton> parts{ graph.Measured() };
  const auto                          network = MakeFlowNetwork(parts, FindInlets(parts, {}));
  WriteFlowYaml(folder / "a.yaml", folder / "a_inlet.dat", "a", network, parts);
  std::set<std::pair<std::string, std::string>> ways;
  double                                        length = 0;
  for (const auto & vessel : OpenBfVessels(RowsOf(folder / "a.yaml")))
  {
    EXPECT_TRUE(ways.insert({ vessel.at("sn"), vessel.at("tn") }).second);
    length += std::stod(vessel.at("L"));
  }
  EXPECT_EQ(ways.size(), 5U);
  EXPECT_NEAR(length, .08, 1e-8);
}

TEST(FlowFiles, WhatOpenBfCannotTakeIsRefusedWithThePlace)
{
  const TemporaryFolder folder;
  GraphOfLines          graph;
  const auto            fork = graph.Point({ 20, 0, 0 }, 2);
  graph.Line(graph.Point({ 0, 0, 0 }, 3), fork, 9);
  for (const double y : { -10., 0., 10. })
  {
    graph.Line(fork, graph.Point({ 40, y, 0 }, 1), 9);
  }
  std::vector<MeasuredSkeleton> parts{ graph.Measured() };
  const auto                    message = [&]() -> std::string {
    try
    {
      const auto network = MakeFlowNetwork(parts, FindInlets(parts, {}));
      WriteFlowYaml(folder / "a.yaml", folder / "a_inlet.dat", "a", network, parts);
    }
    catch (const InputError & error)
    {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message().find("1 in and 3 out at 20.00, 0.00, 0.00"), std::string::npos) << message();
  parts = { PipesThatFork()[0], PipesThatFork()[0] };
  EXPECT_NE(message().find("one inlet, and this one has 2"), std::string::npos) << message();
  EXPECT_FALSE(std::filesystem::exists(folder / "a.yaml"));
}

} // namespace voxelcore::testing
