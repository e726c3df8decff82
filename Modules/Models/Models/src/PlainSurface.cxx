#include "voxelcore/Models/PlainSurface.h"

#include "ModelCells.h"
#include "ModelSource.h"
#include "UnfitFile.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/ReadMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

namespace voxelcore
{
namespace
{

using Cell = std::vector<ElementIndex>;

std::vector<Cell>
ReadCells(ModelSource & file, const std::string & section, std::size_t points)
{
  std::vector<Cell> cells;
  const auto        ends = file.ReadIndices(section, "offsets");
  const auto        corners = file.ReadIndices(section, "connectivity");
  std::int64_t      at = 0;
  for (const std::int64_t end : ends)
  {
    RequireFit(end >= at && end <= static_cast<std::int64_t>(corners.size()), "its cells are damaged");
    cells.emplace_back();
    for (; at < end; ++at)
    {
      const std::int64_t corner = corners[static_cast<std::size_t>(at)];
      RequireFit(corner >= 0 && static_cast<std::size_t>(corner) < points, "a cell names a point that is not there");
      cells.back().push_back(static_cast<ElementIndex>(corner));
    }
  }
  return cells;
}

/** Only points on cells, whose numbers are added to `taken`; polygons that name one twice, and edges from a point to
 *  itself, show nothing. */
PlainSurface
MakeSurface(const std::vector<Vector3> & points,
            const std::vector<double> &  radius,
            const std::vector<Cell> &    polygons,
            const std::vector<Cell> &    lines,
            std::vector<ElementIndex> *  taken = nullptr)
{
  PlainSurface              made;
  MedialComplex &           core = made.surface;
  CellComplex &             cells = core.cells;
  constexpr auto            none = std::numeric_limits<ElementIndex>::max();
  std::vector<ElementIndex> number(points.size(), none);
  const auto                take = [&](ElementIndex point) {
    if (number[point] == none)
    {
      number[point] = static_cast<ElementIndex>(core.positions.size());
      core.positions.push_back(points[point]);
      if (taken != nullptr)
      {
        taken->push_back(point);
      }
      core.radius.push_back(radius.empty() ? 0 : radius[point]);
    }
    return number[point];
  };
  for (const Cell & polygon : polygons)
  {
    Cell sorted = polygon;
    std::sort(sorted.begin(), sorted.end());
    if (polygon.size() >= 3 && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
    {
      std::transform(polygon.begin(), polygon.end(), std::back_inserter(cells.faceVertices), take);
      cells.faceOffsets.push_back(cells.faceVertices.size());
    }
  }
  std::vector<std::array<ElementIndex, 2>> edges;
  for (const Cell & line : lines)
  {
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      if (line[i] != line[i - 1])
      {
        edges.push_back({ take(line[i - 1]), take(line[i]) });
      }
    }
  }
  RequireFit(!cells.faceVertices.empty() || !edges.empty(), "it holds neither polygons nor lines");
  cells.vertexCount = core.positions.size();
  BuildEdges(cells, edges);
  core.vertexLambda.assign(cells.vertexCount, 0);
  core.edgeLambda.assign(cells.edges.size(), 0);
  core.faceLambda.assign(cells.FaceCount(), 0);
  made.hasRadius = !radius.empty();
  return made;
}

std::vector<Vector3>
ReadPoints(ModelSource & file)
{
  const std::vector<double> numbers = file.Read<double>("Points", "Points", 3);
  std::vector<Vector3>      points(numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2] };
  }
  RequireFit(std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }),
             "a coordinate is no finite number");
  RequireFit(points.size() == file.PieceCount("NumberOfPoints") &&
               points.size() < std::numeric_limits<ElementIndex>::max(),
             "its number of points is damaged");
  return points;
}

std::vector<double>
ReadOfPoints(ModelSource & file, const char * name, std::size_t points)
{
  std::vector<double> values = file.Read<double>("PointData", name);
  RequireFit(values.size() == points, "one of its point arrays has the wrong length");
  return values;
}

std::optional<PlainSurface>
SurfaceIn(ModelSource & file)
{
  if (file.Has("FieldData", "Provenance"))
  {
    return {};
  }
  const std::vector<Vector3> points = ReadPoints(file);
  std::vector<double>        radius;
  if (file.Has("PointData", "Radius"))
  {
    radius = ReadOfPoints(file, "Radius", points.size());
  }
  std::vector<Cell> polygons = ReadCells(file, "Polys", points.size());
  for (const Cell & strip :
       file.PieceCount("NumberOfStrips") > 0 ? ReadCells(file, "Strips", points.size()) : std::vector<Cell>())
  {
    for (std::size_t i = 2; i < strip.size(); ++i)
    {
      const std::size_t odd = i % 2; // every other triangle of a strip is turned over
      polygons.push_back({ strip[i - 2 + odd], strip[i - 1 - odd], strip[i] });
    }
  }
  return MakeSurface(points, radius, polygons, ReadCells(file, "Lines", points.size()));
}

std::vector<double>
TakenFrom(const std::vector<double> & values, const std::vector<ElementIndex> & taken)
{
  std::vector<double> some;
  some.reserve(taken.size());
  for (const ElementIndex point : taken)
  {
    some.push_back(values[point]);
  }
  return some;
}

std::optional<SheetSurfaces>
SheetsIn(ModelSource & file)
{
  if (!file.Has("CellData", "SheetId") || !file.Has("FieldData", "Provenance"))
  {
    return {};
  }
  const std::vector<Vector3> points = ReadPoints(file);
  const std::vector<double>  radius = ReadOfPoints(file, "Radius", points.size());
  const std::vector<double>  thickness = ReadOfPoints(file, "Thickness", points.size());
  std::vector<Cell>          lines = ReadCells(file, "Lines", points.size());
  std::vector<Cell>          polygons = ReadCells(file, "Polys", points.size());
  const auto                 ids = file.Read<std::int64_t>("CellData", "SheetId");
  const std::size_t          cells = lines.size() + polygons.size();
  RequireFit(ids.size() == file.PieceCount("NumberOfVerts") + cells, "its array CellData/SheetId has the wrong length");
  std::map<std::int64_t, std::pair<std::vector<Cell>, std::vector<Cell>>> pieces; // polygons and lines
  for (std::size_t i = 0; i < cells; ++i)
  {
    const bool isLine = i < lines.size();
    if (const std::int64_t id = ids[ids.size() - cells + i]; id != 0)
    {
      auto & piece = pieces[id];
      (isLine ? piece.second : piece.first).push_back(std::move(isLine ? lines[i] : polygons[i - lines.size()]));
    }
  }
  SheetSurfaces read;
  read.provenance = file.ReadText("FieldData", "Provenance");
  for (const auto & [id, piece] : pieces)
  {
    std::vector<ElementIndex> taken;
    PlainSurface              plain = MakeSurface(points, radius, piece.first, piece.second, &taken);
    read.sheets.push_back({ id, std::move(plain), TakenFrom(thickness, taken) });
  }
  return read;
}

std::optional<MeasuredSurfaces>
ThicknessIn(ModelSource & file)
{
  if (!file.Has("PointData", "Thickness") || file.Has("PointData", "Radius") || !file.Has("FieldData", "Provenance"))
  {
    return {};
  }
  const std::vector<Vector3> points = ReadPoints(file);
  const std::vector<double>  thickness = ReadOfPoints(file, "Thickness", points.size());
  std::vector<Cell>          polygons = ReadCells(file, "Polys", points.size());
  const auto                 labels = file.Read<std::int64_t>("CellData", "Label");
  const auto                 components = file.Read<std::int64_t>("CellData", "Component");
  RequireFit(labels.size() == polygons.size() && components.size() == polygons.size(),
             "its array CellData/Label or CellData/Component has the wrong length");
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Cell>> pieces;
  for (std::size_t i = 0; i < polygons.size(); ++i)
  {
    pieces[{ labels[i], components[i] }].push_back(std::move(polygons[i]));
  }
  MeasuredSurfaces read;
  read.provenance = file.ReadText("FieldData", "Provenance");
  for (const auto & [key, piece] : pieces)
  {
    std::vector<ElementIndex> taken;
    PlainSurface              plain = MakeSurface(points, {}, piece, {}, &taken);
    read.surfaces.push_back({ key.first, key.second, std::move(plain), TakenFrom(thickness, taken) });
  }
  return read;
}

bool
IsVtkPath(const std::filesystem::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  return extension == ".vtp" || extension == ".vtk";
}

/** Only .vtp and .vtk files can have what a kind of surfaces needs. */
template <typename Read>
auto
ReadOwn(const std::filesystem::path & path, const Read & read) -> decltype(read(std::declval<ModelSource &>()))
{
  decltype(read(std::declval<ModelSource &>())) surfaces;
  if (IsVtkPath(path))
  {
    ReadFrom(path, Precision::AsSaved, "core", [&](ModelSource & source) { surfaces = read(source); });
  }
  return surfaces;
}

} // namespace

std::optional<SheetSurfaces>
ReadSheetSurfaces(const std::filesystem::path & path)
{
  return ReadOwn(path, SheetsIn);
}

std::optional<MeasuredSurfaces>
ReadMeasuredSurfaces(const std::filesystem::path & path)
{
  return ReadOwn(path, ThicknessIn);
}

std::optional<PlainSurface>
ReadPlainSurface(const std::filesystem::path & path)
{
  if (IsVtkPath(path))
  {
    return ReadOwn(path, SurfaceIn);
  }
  const MeshFile    file = ReadMesh(path);
  std::vector<Cell> triangles;
  for (const auto & triangle : file.mesh.triangles)
  {
    triangles.emplace_back(triangle.begin(), triangle.end());
  }
  try
  {
    return MakeSurface(file.mesh.points, {}, triangles, {});
  }
  catch (const UnfitFile & unfit)
  {
    throw InputError("cannot read mesh '" + path.string() + "': " + unfit.reason + "; write it anew");
  }
}

} // namespace voxelcore
