#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/FlowFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
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

} // namespace voxelcore::testing
