#include "voxelcore/ReadMesh.h"

#include "LegacyCells.h"
#include "MeshText.h"
#include "VtkMessages.h"
#include "voxelcore/Error.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <vtkCellArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkXMLPolyDataReader.h>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

std::string
Extension(const fs::path & path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  return extension;
}

std::string
ReadBytes(const fs::path & path)
{
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  RequireFit(stream.is_open(), "it cannot be opened");
  std::string bytes(static_cast<std::size_t>(stream.tellg()), '\0');
  stream.seekg(0);
  RequireFit(bytes.empty() || bool(stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))),
             "it cannot be read");
  return bytes;
}

/** The number behind a keyword that begins a line of a legacy file, none where there is no such line. */
std::int64_t
PromisedCount(std::string_view bytes, std::string_view keyword)
{
  for (std::size_t at = bytes.find(keyword); at != std::string_view::npos; at = bytes.find(keyword, at + 1))
  {
    if (at > 0 && bytes[at - 1] == '\n')
    {
      MeshText line(bytes.substr(at + keyword.size(), 60));
      return line.NextLine('\0') ? line.Whole(line.Word()) : -1;
    }
  }
  return -1;
}

/** VTK takes a cell from wherever its offsets say. */
void
RequireOffsets(vtkCellArray & cells)
{
  const vtkIdType corners = cells.GetNumberOfConnectivityIds();
  const auto      check = [&](const auto * offsets) {
    for (vtkIdType i = 0; i < offsets->GetNumberOfValues(); ++i)
    {
      const auto end = static_cast<vtkIdType>(offsets->GetValue(i));
      RequireFit(end >= (i > 0 ? static_cast<vtkIdType>(offsets->GetValue(i - 1)) : 0) && end <= corners,
                 "its cells' offsets are damaged");
    }
  };
  cells.IsStorage64Bit() ? check(cells.GetOffsetsArray64()) : check(cells.GetOffsetsArray32());
}

MeshFile
FromPolyData(vtkPolyData & data)
{
  MeshFile        file;
  const vtkIdType points = data.GetNumberOfPoints();
  for (vtkIdType i = 0; i < points; ++i)
  {
    Vector3 point{};
    data.GetPoint(i, point.data());
    RequireFit(std::all_of(point.begin(), point.end(), [](double c) { return std::isfinite(c); }),
               "a coordinate is not a finite number");
    file.mesh.points.push_back(point);
  }
  vtkNew<vtkIdList>          ids;
  std::vector<std::uint32_t> corners;
  const auto                 read = [&] {
    corners.clear();
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      RequireFit(ids->GetId(i) >= 0 && ids->GetId(i) < points, "a polygon has a corner that is no point");
      corners.push_back(static_cast<std::uint32_t>(ids->GetId(i)));
    }
  };
  vtkCellArray * const polygons = data.GetPolys();
  RequireOffsets(*polygons);
  for (vtkIdType cell = 0; cell < polygons->GetNumberOfCells(); ++cell)
  {
    polygons->GetCellAtId(cell, ids);
    read();
    AddPolygon(file, corners);
  }
  vtkCellArray * const strips = data.GetStrips();
  RequireOffsets(*strips);
  for (vtkIdType cell = 0; cell < strips->GetNumberOfCells(); ++cell)
  {
    strips->GetCellAtId(cell, ids);
    read();
    for (std::size_t i = 2; i < corners.size(); ++i)
    {
      const std::size_t odd = i % 2; // every other triangle of a strip is turned over
      file.mesh.triangles.push_back({ corners[i - 2 + odd], corners[i - 1 - odd], corners[i] });
    }
  }
  return file;
}

MeshFile
ReadLegacy(const fs::path & path)
{
  const std::string bytes = ReadBytes(path);
  RequireFit(bytes.starts_with("# vtk DataFile"), "it does not begin with '# vtk DataFile'");
  for (const std::string_view keyword : { "VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS" })
  {
    CheckLegacyCells(bytes, keyword);
  }
  vtkNew<vtkPolyDataReader> reader;
  std::string               trouble;
  {
    const VtkMessages messages;
    reader->SetFileName(path.c_str());
    RequireFit(reader->IsFilePolyData() != 0, "it holds no polydata");
    reader->Update();
    trouble = messages.First();
  }
  if (!trouble.empty())
  {
    throw UnfitFile{ "VTK says: " + trouble };
  }
  vtkPolyData & data = *reader->GetOutput();
  const auto    check = [&](std::string_view keyword, std::int64_t found, const char * what) {
    const std::int64_t promised = PromisedCount(bytes, keyword);
    if (promised != found && !(promised == -1 && found == 0))
    {
      throw UnfitFile{ "it promises " + std::to_string(promised) + " " + what + " and has " + std::to_string(found) };
    }
  };
  check("POINTS ", data.GetNumberOfPoints(), "points");
  // Versions from 5 on count offsets, one more than there are polygons.
  const std::int64_t offsets = bytes.find("\nOFFSETS ") != std::string::npos ? 1 : 0;
  const auto         cells = [&](vtkCellArray & array) {
    return array.GetNumberOfCells() + (array.GetNumberOfCells() > 0 ? offsets : 0);
  };
  check("POLYGONS ", cells(*data.GetPolys()), "polygons");
  check("TRIANGLE_STRIPS ", cells(*data.GetStrips()), "strips");
  return FromPolyData(data);
}

MeshFile
ReadXml(const fs::path & path)
{
  std::string end = ReadBytes(path);
  RequireFit(end.starts_with("<?xml") || end.starts_with("<VTKFile"), "it is no VTK file in XML");
  end.erase(end.find_last_not_of(" \r\n\t") + 1);
  RequireFit(end.ends_with("</VTKFile>"), "it ends too early");
  vtkNew<vtkXMLPolyDataReader> reader;
  std::string                  trouble;
  bool                         isGood = false;
  {
    const VtkMessages messages;
    isGood = reader->CanReadFile(path.c_str()) != 0;
    if (isGood)
    {
      reader->SetFileName(path.c_str());
      reader->Update();
      isGood = reader->GetErrorCode() == 0 && reader->GetOutput() != nullptr;
    }
    trouble = messages.First();
  }
  if (!isGood || !trouble.empty())
  {
    throw UnfitFile{ trouble.empty() ? "it holds no polydata, or is damaged" : "VTK says: " + trouble };
  }
  return FromPolyData(*reader->GetOutput());
}

MeshFile
ReadByExtension(const fs::path & path)
{
  const std::string extension = Extension(path);
  if (extension == ".vtk" || extension == ".vtp")
  {
    MeshFile file = extension == ".vtk" ? ReadLegacy(path) : ReadXml(path);
    file.format = extension == ".vtk" ? "VTK" : "VTP";
    return file;
  }
  const std::string bytes = ReadBytes(path);
  RequireFit(!bytes.empty(), "it is empty");
  return extension == ".stl"   ? ParseStl(bytes)
         : extension == ".obj" ? ParseObj(bytes)
         : extension == ".ply" ? ParsePly(bytes)
                               : ParseOff(bytes);
}

} // namespace

bool
IsMeshPath(const fs::path & path)
{
  constexpr std::array<std::string_view, 6> known{ ".stl", ".obj", ".ply", ".off", ".vtk", ".vtp" };
  return std::find(known.begin(), known.end(), Extension(path)) != known.end();
}

MeshFile
ReadMesh(const fs::path & path)
{
  const auto fail = [&](const std::string & reason) {
    return InputError("cannot read mesh '" + path.string() + "': " + reason);
  };
  std::error_code ignored;
  if (!fs::exists(path, ignored))
  {
    throw fail("there is no such file");
  }
  if (!fs::is_regular_file(path, ignored))
  {
    throw fail("it is not a file");
  }
  if (!IsMeshPath(path))
  {
    throw fail("unknown extension; give .stl .obj .ply .off .vtk or .vtp");
  }
  try
  {
    MeshFile file = ReadByExtension(path);
    RequireFit(!file.mesh.triangles.empty(), "it has no triangles");
    return file;
  }
  catch (const UnfitFile & unfit)
  {
    throw fail(unfit.reason);
  }
  catch (const std::bad_alloc &)
  {
    throw fail("it is larger than the memory");
  }
  catch (const std::length_error &)
  {
    throw fail("it is larger than the memory");
  }
}

} // namespace voxelcore
