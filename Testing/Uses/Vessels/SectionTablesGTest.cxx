#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Vessels/SectionTables.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>
#include <sstream>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace voxelcore::testing
{

namespace
{

/** A square with sides of 2 and a place without a section. */
std::vector<SectionsOfPart>
SquareAndNothing()
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  BranchSection    square;
  square.arc = 1.5;
  square.place = { 10, 20, 30 };
  square.axis = { 0, 0, 1 };
  square.area = 4;
  square.perimeter = 8;
  square.leastDiameter = 2;
  square.leastWay = { 1, 0, 0 };
  square.greatestDiameter = 2.5;
  square.greatestWay = { 0, 1, 0 };
  square.centre = square.place;
  square.runsInto = 3;
  square.isCut = true;
  square.contours = { { { 9, 19, 30 }, { 11, 19, 30 }, { 11, 21, 30 }, { 9, 21, 30 } } };
  BranchSection nothing;
  nothing.axis = { 0, 1, 0 };
  nothing.area = nothing.perimeter = nothing.leastDiameter = nothing.greatestDiameter = none;
  SectionsOfPart part;
  part.sections = { square, nothing };
  part.labels = { 7 };
  part.names = { "=aorta, left" };
  part.component = 2;
  return { part };
}

std::vector<std::string>
Lines(const std::filesystem::path & path)
{
  std::ifstream            file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);)
  {
    lines.push_back(line);
  }
  return lines;
}

std::size_t
CountColumns(const std::string & head, const nlohmann::json & columns)
{
  std::stringstream line(head);
  std::size_t       count = 0;
  for (std::string column; std::getline(line, column, ',');)
  {
    EXPECT_TRUE(columns.contains(column)) << column;
    ++count;
  }
  return count;
}

} // namespace

TEST(SectionTables, HaveARowPerSectionAndSayWhatIsNotKnownByNothing)
{
  const TemporaryFolder folder;
  const auto            path = folder / "sections.csv";
  WriteSectionCsv(path, SquareAndNothing());
  const auto lines = Lines(path);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[1],
            "7,\"'=aorta, left\",2,0,1.5,10,20,30,0,0,1,4,2.256758,2,1,0,0,2.5,0,1,0,8,0.7853982,10,20,30,3,1");
  EXPECT_EQ(lines[2], "7,\"'=aorta, left\",2,0,0,0,0,0,0,1,0,,,,,,,,,,,,,0,0,0,,0");
  const auto columns = nlohmann::json::parse(SectionColumnsJson(SpatialUnit::Millimetres)).at("sections");
  EXPECT_EQ(columns.size(), CountColumns(lines[0], columns));
  EXPECT_EQ(columns.at("area").at("Units"), "mm^2");
}

TEST(SectionTables, LesionsHaveTheNumbersOfTheirKind)
{
  auto         parts = SquareAndNothing();
  VesselLesion stenosis;
  stenosis.arc = 12;
  stenosis.begin = 10;
  stenosis.end = 15.5;
  stenosis.place = { 1, 2, 3 };
  stenosis.diameter = 1;
  stenosis.reference = 4;
  VesselLesion bulge = stenosis;
  bulge.kind = LesionKind::Bulge;
  bulge.diameter = 6;
  VesselLesion dome;
  dome.kind = LesionKind::Dome;
  dome.diameter = 9;
  dome.reference = 4;
  dome.neckWidth = 5;
  dome.height = 8;
  dome.volume = 300;
  parts[0].lesions = { stenosis, bulge, dome };
  const TemporaryFolder folder;
  const auto            path = folder / "lesions.csv";
  WriteLesionCsv(path, parts);
  const auto        lines = Lines(path);
  const std::string start = "7,\"'=aorta, left\",2,0,";
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[1], start + "stenosis,12,1,2,3,5.5,1,4,75,93.75,,,,");
  EXPECT_EQ(lines[2], start + "bulge,12,1,2,3,5.5,6,4,50,125,,,,");
  EXPECT_EQ(lines[3], start + "dome,0,0,0,0,0,9,4,,,5,8,300,1.6");
  const auto columns = nlohmann::json::parse(SectionColumnsJson(SpatialUnit::Millimetres)).at("lesions");
  EXPECT_EQ(columns.size(), CountColumns(lines[0], columns));
}

TEST(SectionTables, ContoursAreClosedLinesThatCarryTheirNumbers)
{
  const TemporaryFolder folder;
  const auto            path = folder / "sections.vtp";
  WriteSectionVtp(path, SquareAndNothing(), SpatialUnit::Millimetres);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData * const lines = reader->GetOutput();
  ASSERT_EQ(lines->GetNumberOfLines(), 1);
  ASSERT_EQ(lines->GetNumberOfPoints(), 4);
  ASSERT_EQ(lines->GetCell(0)->GetNumberOfPoints(), 5);
  EXPECT_EQ(lines->GetCell(0)->GetPointId(0), lines->GetCell(0)->GetPointId(4));
  const auto number = [&](const char * name) { return lines->GetCellData()->GetArray(name)->GetTuple1(0); };
  EXPECT_EQ(number("Label"), 7);
  EXPECT_EQ(number("Component"), 2);
  EXPECT_EQ(number("RunsInto"), 3);
  EXPECT_EQ(number("CutByBorder"), 1);
  EXPECT_EQ(number("ArcLength"), 1.5);
  EXPECT_EQ(number("Area"), 4);
  EXPECT_EQ(number("LeastDiameter"), 2);
  EXPECT_EQ(number("GreatestDiameter"), 2.5);
}

} // namespace voxelcore::testing
