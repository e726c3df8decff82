#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Sheets/SheetFiles.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <regex>
#include <random>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

/** Three squares about an edge, and a rod of two edges at its end. */
SheetPart
Part()
{
  SheetPart       part;
  MedialComplex & core = part.core.core;
  core.positions = { { 0, 0, 0 }, { 0, 0, 1 },  { 1, 0, 0 },  { 1, 0, 1 }, { 0, 1, 0 },
                     { 0, 1, 1 }, { -2, 0, 0 }, { -2, 0, 1 }, { 0, 0, 2 }, { 0, 0, 4 } };
  core.cells.vertexCount = core.positions.size();
  core.radius.assign(core.positions.size(), 0.25);
  core.cells.edges = { { 0, 1 }, { 0, 2 }, { 2, 3 }, { 1, 3 }, { 0, 4 }, { 4, 5 },
                       { 1, 5 }, { 0, 6 }, { 6, 7 }, { 1, 7 }, { 1, 8 }, { 8, 9 } };
  core.cells.faceVertices = { 0, 1, 3, 2, 0, 1, 5, 4, 0, 1, 7, 6 };
  core.cells.faceEdges = { 0, 3, 2, 1, 0, 6, 5, 4, 0, 9, 8, 7 };
  core.cells.faceOffsets = { 0, 4, 8, 12 };
  part.core.label = 7;
  part.name = "foam";
  part.sheets = CutIntoSheets(core, 0.1);
  part.voxels.assign(part.sheets.sheets.size() + part.sheets.curves.size(), 5);
  part.voxels[3] = 0; // the seam
  part.voxelVolume = 2;
  return part;
}

SheetModel
Model()
{
  SheetModel model;
  model.parts = { Part(), Part() };
  model.parts[1].core.label = 9;
  return model;
}

TEST(SheetFiles, NumbersRunOverAllPartsAndRodsComeBehindTheSheets)
{
  const SheetModel   model = Model();
  const SheetNumbers numbers(model);
  ASSERT_EQ(model.parts[0].sheets.sheets.size(), 3U);
  ASSERT_EQ(model.parts[0].sheets.curves.size(), 2U);
  EXPECT_EQ(numbers.SheetId(0, 0), 1);
  EXPECT_EQ(numbers.SheetId(1, 2), 6);
  EXPECT_EQ(numbers.SheetId(0, 4), 7);
  EXPECT_EQ(numbers.SheetId(1, 4), 8);
  EXPECT_EQ(numbers.SeamId(1, 0), 3);
  EXPECT_EQ(numbers.JunctionId(1, 0), 2);
}

// One by one, as they stand in tables: a number is found from its part alone, so each of many rods is no more work than
// the only one.
TEST(SheetFiles, NumbersAreThoseCountedOneByOne)
{
  std::mt19937_64 random(20261128);
  SheetModel      model;
  for (int p = 0; p < 40; ++p)
  {
    SheetPart & part = model.parts.emplace_back();
    part.sheets.sheets.resize(random() % 5);
    part.sheets.curves.resize(random() % 7);
    const std::size_t seams = part.sheets.curves.empty() ? 0 : random() % (part.sheets.curves.size() + 1);
    for (std::size_t c = seams; c < part.sheets.curves.size(); ++c)
    {
      part.sheets.curves[c].isRod = true;
    }
    part.sheets.junctions.resize(random() % 4);
  }
  const SheetNumbers numbers(model);
  std::int64_t       sheet = 0;
  std::int64_t       seam = 0;
  std::int64_t       junction = 0;
  for (std::size_t p = 0; p < model.parts.size(); ++p)
  {
    for (std::uint32_t i = 0; i < model.parts[p].sheets.sheets.size(); ++i)
    {
      EXPECT_EQ(numbers.SheetId(p, i), ++sheet);
    }
    for (std::uint32_t i = 0; i < model.parts[p].sheets.curves.size(); ++i)
    {
      EXPECT_EQ(numbers.SeamId(p, i), ++seam);
    }
    for (std::uint32_t i = 0; i < model.parts[p].sheets.junctions.size(); ++i)
    {
      EXPECT_EQ(numbers.JunctionId(p, i), ++junction);
    }
  }
  for (std::size_t p = 0; p < model.parts.size(); ++p) // rods behind the sheets of all parts
  {
    const MedialSheets & cut = model.parts[p].sheets;
    for (std::uint32_t i = 0; i < cut.curves.size(); ++i)
    {
      if (cut.curves[i].isRod)
      {
        EXPECT_EQ(numbers.SheetId(p, static_cast<std::uint32_t>(cut.sheets.size()) + i), ++sheet);
      }
    }
  }
}

TEST(SheetFiles, VtkReadsFacesSeamsAndRodsWithTheirNumbers)
{
  const TemporaryFolder folder;
  const std::string     path = (folder.Path() / "a.vtp").string();
  WriteSheetsVtp(path, Model());
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData * const data = reader->GetOutput();
  EXPECT_EQ(data->GetNumberOfPoints(), 20);
  EXPECT_EQ(data->GetNumberOfPolys(), 6);
  EXPECT_EQ(data->GetNumberOfLines(), 6);
  EXPECT_EQ(data->GetNumberOfVerts(), 2);
  vtkDataArray * const sheets = data->GetCellData()->GetArray("SheetId");
  vtkDataArray * const seams = data->GetCellData()->GetArray("SeamId");
  ASSERT_TRUE(sheets != nullptr && seams != nullptr);
  EXPECT_EQ(sheets->GetRange()[1], 8);
  EXPECT_EQ(seams->GetRange()[1], 4);
  EXPECT_EQ(data->GetPointData()->GetArray("Thickness")->GetRange()[1], 0.5);
}

TEST(SheetFiles, TablesHaveTheirColumnsAndVoxelsAddUp)
{
  const TemporaryFolder folder;
  WriteSheetCsv(folder.Path() / "a.csv", Model());
  WriteSeamCsv(folder.Path() / "b.csv", Model());
  const auto columns = nlohmann::json::parse(SheetColumnsJson(SpatialUnit::Millimetres));
  for (const auto & [file, part, rows] : { std::tuple("a.csv", "sheets", 8), std::tuple("b.csv", "seams", 4) })
  {
    std::istringstream text(ReadAll(folder.Path() / file));
    std::string        head;
    std::getline(text, head);
    EXPECT_EQ(static_cast<std::size_t>(std::count(head.begin(), head.end(), ',')) + 1, columns[part].size());
    int count = 0;
    for (std::string line; std::getline(text, line); ++count)
    {
      EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(head.begin(), head.end(), ',')) << line;
    }
    EXPECT_EQ(count, rows);
  }
  const SheetTotals totals = TotalsOf(Part());
  EXPECT_EQ(totals.sheetVoxels, 15U);
  EXPECT_EQ(totals.rodVoxels, 5U);
  EXPECT_EQ(totals.seams, 1U);
  EXPECT_EQ(totals.rods, 1U);
  EXPECT_DOUBLE_EQ(totals.rodLength, 3);
  EXPECT_DOUBLE_EQ(totals.area, 4);
}

TEST(SheetFiles, TheGraphsEdgesNameItsNodes)
{
  const TemporaryFolder folder;
  WriteSheetGraphMl(folder.Path() / "a.graphml", Model());
  const std::string text = ReadAll(folder.Path() / "a.graphml");
  const std::regex  edge("source=\"([^\"]+)\" target=\"([^\"]+)\"");
  std::size_t       edges = 0;
  for (std::sregex_iterator i(text.begin(), text.end(), edge), end; i != end; ++i, ++edges)
  {
    for (const int which : { 1, 2 })
    {
      EXPECT_NE(text.find("<node id=\"" + (*i)[which].str() + "\""), std::string::npos);
    }
  }
  EXPECT_EQ(edges, 2U * (3 + 1 + 1)) << "a seam of three sheets and one junction, a rod with one";
}

} // namespace
} // namespace voxelcore::testing
