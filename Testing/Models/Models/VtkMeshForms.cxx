#include "Models/Models/VtkMeshForms.h"

#include "Models/Models/ModelFixtures.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkZLibDataCompressor.h>

namespace voxelcore::testing
{
namespace
{

constexpr vtkIdType kSide = kSheetSide;

/** A bent sheet of squares with a strip along one side, a loose vertex, a line, and arrays of many kinds. */
vtkSmartPointer<vtkPolyData>
Sheet(int pointType)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(pointType);
  for (vtkIdType i = 0; i < kSide * kSide; ++i)
  {
    const auto x = static_cast<double>(i % kSide);
    const auto y = static_cast<double>(i / kSide);
    points->InsertNextPoint(x / 4, y / 2, x * y / 64); // few digits: text holds them in full
  }
  vtkNew<vtkCellArray> verts;
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkCellArray> polys;
  vtkNew<vtkCellArray> strips;
  verts->InsertNextCell({ 3 });
  lines->InsertNextCell({ 0, 1, 2 });
  for (vtkIdType y = 0; y + 2 < kSide; ++y)
  {
    for (vtkIdType x = 0; x + 1 < kSide; ++x)
    {
      const vtkIdType at = y * kSide + x;
      polys->InsertNextCell({ at, at + 1, at + kSide + 1, at + kSide });
    }
  }
  strips->InsertNextCell({ 15, 20, 16, 21, 17, 22 });
  strips->InsertNextCell({ 17, 22, 18, 23 });
  auto sheet = vtkSmartPointer<vtkPolyData>::New();
  sheet->SetPoints(points);
  sheet->SetVerts(verts);
  sheet->SetLines(lines);
  sheet->SetPolys(polys);
  sheet->SetStrips(strips);
  const auto fill = [](auto array, const char * name, int components, vtkIdType tuples) {
    array->SetName(name);
    array->SetNumberOfComponents(components);
    for (vtkIdType i = 0; i < tuples * components; ++i)
    {
      array->InsertNextValue(static_cast<typename std::decay_t<decltype(*array)>::ValueType>(i % 100));
    }
    return array;
  };
  const vtkIdType count = points->GetNumberOfPoints();
  sheet->GetPointData()->SetScalars(fill(vtkSmartPointer<vtkFloatArray>::New(), "heat", 1, count));
  sheet->GetPointData()->SetNormals(fill(vtkSmartPointer<vtkFloatArray>::New(), "normals", 3, count));
  sheet->GetPointData()->SetTCoords(fill(vtkSmartPointer<vtkFloatArray>::New(), "places", 2, count));
  sheet->GetPointData()->SetTensors(fill(vtkSmartPointer<vtkDoubleArray>::New(), "stress", 9, count));
  sheet->GetPointData()->AddArray(fill(vtkSmartPointer<vtkDoubleArray>::New(), "more of it", 2, count));
  sheet->GetCellData()->SetScalars(
    fill(vtkSmartPointer<vtkUnsignedCharArray>::New(), "colour", 3, sheet->GetNumberOfCells()));
  vtkNew<vtkStringArray> words;
  words->SetName("words");
  words->InsertNextValue("one line");
  words->InsertNextValue(std::string(100, 'x'));
  sheet->GetFieldData()->AddArray(words);
  return sheet;
}

/** Polydata in one form of XML. LZMA takes a moment to set up: it has one block, the others several, the last
 *  short. */
std::string
XmlForm(vtkPolyData & data, const std::string & mode, vtkDataCompressor * compressor, bool isLarge)
{
  const TemporaryFolder        folder;
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&data);
  writer->SetFileName((folder / "a.vtp").c_str());
  mode == "ascii"    ? writer->SetDataModeToAscii()
  : mode == "base64" ? writer->SetDataModeToBinary()
                     : writer->SetDataModeToAppended();
  writer->SetEncodeAppendedData(mode == "appended64");
  const bool isSlow = vtkLZMADataCompressor::SafeDownCast(compressor) != nullptr;
  writer->SetCompressor(compressor);
  writer->SetBlockSize(isSlow ? 32768 : 64);
  isLarge ? writer->SetHeaderTypeToUInt64() : writer->SetHeaderTypeToUInt32();
  isLarge ? writer->SetByteOrderToBigEndian() : writer->SetByteOrderToLittleEndian();
  EXPECT_EQ(writer->Write(), 1);
  return ReadAll(folder / "a.vtp");
}

} // namespace

std::vector<std::array<std::uint32_t, 3>>
SheetTriangles()
{
  std::vector<std::array<std::uint32_t, 3>> triangles;
  constexpr std::uint32_t                   side = kSheetSide;
  for (std::uint32_t y = 0; y + 2 < side; ++y)
  {
    for (std::uint32_t x = 0; x + 1 < side; ++x)
    {
      const std::uint32_t at = y * side + x;
      triangles.push_back({ at, at + 1, at + side + 1 });
      triangles.push_back({ at, at + side + 1, at + side });
    }
  }
  for (const auto & triangle : std::vector<std::array<std::uint32_t, 3>>{ { 15, 20, 16 },
                                                                          { 16, 20, 21 },
                                                                          { 16, 21, 17 },
                                                                          { 17, 21, 22 },
                                                                          { 17, 22, 18 },
                                                                          { 18, 22, 23 } })
  {
    triangles.push_back(triangle);
  }
  return triangles;
}

std::map<std::string, std::string>
XmlFormsOf(vtkPolyData & data)
{
  std::map<std::string, std::string> forms;
  vtkNew<vtkLZMADataCompressor>      lzma;
  lzma->SetCompressionLevel(1);
  const std::vector<vtkSmartPointer<vtkDataCompressor>> compressors{ nullptr,
                                                                     vtkSmartPointer<vtkZLibDataCompressor>::New(),
                                                                     vtkSmartPointer<vtkLZ4DataCompressor>::New(),
                                                                     lzma.Get() };
  forms["ascii-32.vtp"] = XmlForm(data, "ascii", nullptr, false);
  forms["ascii-64.vtp"] = XmlForm(data, "ascii", nullptr, true);
  for (const std::string mode : { "base64", "raw", "appended64" })
  {
    for (const auto & compressor : compressors)
    {
      const std::string name = mode + (compressor ? compressor->GetClassName() : "");
      forms[name + "-32.vtp"] = XmlForm(data, mode, compressor, false);
      if (compressor != lzma.Get())
      {
        forms[name + "-64.vtp"] = XmlForm(data, mode, compressor, true);
      }
    }
  }
  return forms;
}

std::map<std::string, std::string>
LegacyFormsOf(vtkPolyData & data)
{
  const TemporaryFolder              folder;
  std::map<std::string, std::string> forms;
  for (const bool isText : { false, true })
  {
    for (const int version :
         { vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2, vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1 })
    {
      vtkNew<vtkPolyDataWriter> writer;
      writer->SetInputData(&data);
      writer->SetFileName((folder / "a.vtk").c_str());
      isText ? writer->SetFileTypeToASCII() : writer->SetFileTypeToBinary();
      writer->SetFileVersion(version);
      EXPECT_EQ(writer->Write(), 1);
      forms[std::string(isText ? "text-" : "binary-") + std::to_string(version) + ".vtk"] = ReadAll(folder / "a.vtk");
    }
  }
  return forms;
}

namespace
{

/** Of the sheet, in double precision and, with 64-bit headers where there are any, in single precision. */
template <typename FormsOf>
std::map<std::string, std::string>
InBothPrecisions(FormsOf && formsOf)
{
  std::map<std::string, std::string> all;
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    for (auto & [name, bytes] : formsOf(*Sheet(type)))
    {
      const bool isOther = name.ends_with(type == VTK_FLOAT ? "-32.vtp" : "-64.vtp");
      if (!isOther)
      {
        all[(type == VTK_FLOAT ? "float-" : "double-") + name] = std::move(bytes);
      }
    }
  }
  return all;
}

} // namespace

const std::map<std::string, std::string> &
XmlForms()
{
  static const std::map<std::string, std::string> all = InBothPrecisions(XmlFormsOf);
  return all;
}

const std::map<std::string, std::string> &
LegacyForms()
{
  static const std::map<std::string, std::string> all = InBothPrecisions(LegacyFormsOf);
  return all;
}

} // namespace voxelcore::testing
