#include "ModelCells.h"
#include "ModelSource.h"
#include "UnfitFile.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/VoxelCore/SoundCore.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <span>
#include <utility>

namespace voxelcore
{
namespace
{

/** The cells of one kind, whatever width of index the file has. */
struct CellList
{
  std::vector<std::int64_t> offsets;
  std::vector<std::int64_t> points;

  std::size_t
  Count() const
  {
    return offsets.size() - 1;
  }
  std::span<const std::int64_t>
  operator[](std::size_t cell) const
  {
    return { points.data() + offsets[cell], points.data() + offsets[cell + 1] };
  }
};

CellList
ReadCells(ModelSource &       file,
          const std::string & section,
          std::int64_t        pointCount,
          std::int64_t        fewest,
          std::int64_t        most)
{
  CellList list;
  // The file gives the end of each cell, not the beginning of the first.
  list.offsets = file.ReadIndices(section, "offsets");
  list.offsets.insert(list.offsets.begin(), 0);
  list.points = file.ReadIndices(section, "connectivity");
  RequireFit(list.Count() == file.PieceCount("NumberOf" + section), "its numbers of cells do not add up");
  RequireFit(list.offsets.back() == static_cast<std::int64_t>(list.points.size()),
             "the offsets of its cells do not match their points");
  for (std::size_t cell = 0; cell < list.Count(); ++cell)
  {
    RequireFit(list.offsets[cell + 1] >= list.offsets[cell] &&
                 list.offsets[cell + 1] <= static_cast<std::int64_t>(list.points.size()),
               "the offsets of its cells do not match their points");
    const std::int64_t size = list.offsets[cell + 1] - list.offsets[cell];
    RequireFit(size >= fewest && size <= most,
               "a cell has a number of points that no vertex, edge or polygon of a medial surface has");
  }
  for (const std::int64_t point : list.points)
  {
    RequireFit(point >= 0 && point < pointCount, "a cell names a point that is not there");
  }
  return list;
}

/** Label and component. */
using PartKey = std::pair<std::int64_t, std::int64_t>;

/** The cells and points of one part. */
struct PartRange
{
  std::array<std::size_t, 3> firstCell{ 0, 0, 0 }; ///< within verts, lines, polys
  std::array<std::size_t, 3> cells{ 0, 0, 0 };
  std::int64_t               firstPoint = std::numeric_limits<std::int64_t>::max();
  std::int64_t               lastPoint = -1;
};

/** `keys`: one per cell. */
std::map<PartKey, PartRange>
FindParts(const std::array<CellList, 3> & kinds, const std::vector<PartKey> & keys, std::int64_t pointCount)
{
  std::map<PartKey, PartRange> ranges;
  std::vector<std::uint8_t>    used(static_cast<std::size_t>(pointCount), 0);
  std::size_t                  index = 0;
  for (std::size_t kind = 0; kind < 3; ++kind)
  {
    PartRange * range = nullptr;
    for (std::size_t cell = 0; cell < kinds[kind].Count(); ++cell, ++index)
    {
      if (cell == 0 || keys[index] != keys[index - 1])
      {
        RequireFit(cell == 0 || keys[index] > keys[index - 1], "its cells are not sorted by label");
        range = &ranges[keys[index]];
        range->firstCell[kind] = cell;
      }
      ++range->cells[kind];
      for (const std::int64_t point : kinds[kind][cell])
      {
        used[static_cast<std::size_t>(point)] = 1;
        range->firstPoint = std::min(range->firstPoint, point);
        range->lastPoint = std::max(range->lastPoint, point);
      }
    }
  }
  RequireFit(std::find(used.begin(), used.end(), 0) == used.end(), "a point belongs to no cell");
  std::int64_t next = 0;
  for (const auto & [key, range] : ranges)
  {
    RequireFit(range.firstPoint == next, "its points are not sorted by label");
    next = range.lastPoint + 1;
  }
  return ranges;
}

/** A part's complex, all but the measures of its edges. Checks vertex cells, lines and corners. */
CellComplex
ReadComplex(const std::array<CellList, 3> & kinds, const PartRange & range)
{
  CellComplex cells;
  cells.vertexCount = static_cast<std::size_t>(range.lastPoint - range.firstPoint + 1);
  const auto local = [&](std::int64_t point) { return static_cast<ElementIndex>(point - range.firstPoint); };

  std::vector<std::array<ElementIndex, 2>> lines(range.cells[1]);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const auto line = kinds[1][range.firstCell[1] + i];
    lines[i] = { local(line[0]), local(line[1]) };
    RequireFit(lines[i][0] < lines[i][1] && (i == 0 || lines[i - 1] < lines[i]),
               "its lines are not in canonical order");
  }
  std::vector<ElementIndex> sorted;
  cells.faceOffsets.reserve(range.cells[2] + 1);
  for (std::size_t i = 0; i < range.cells[2]; ++i)
  {
    for (const std::int64_t point : kinds[2][range.firstCell[2] + i])
    {
      cells.faceVertices.push_back(local(point));
    }
    cells.faceOffsets.push_back(cells.faceVertices.size());
    const auto corners = cells.FaceVertices(i);
    sorted.assign(corners.begin(), corners.end());
    std::sort(sorted.begin(), sorted.end());
    RequireFit(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(), "a polygon has the same corner twice");
  }
  BuildEdges(cells, lines);
  return cells;
}

/** The edges that are lines of the file. */
std::vector<ElementIndex>
LinesOf(const std::array<CellList, 3> & kinds, const PartRange & range, const CellComplex & cells)
{
  std::vector<ElementIndex> lines;
  for (std::size_t edge = 0; edge < cells.edges.size() && lines.size() < range.cells[1]; ++edge)
  {
    const auto line = kinds[1][range.firstCell[1] + lines.size()];
    if (line[0] == range.firstPoint + cells.edges[edge][0] && line[1] == range.firstPoint + cells.edges[edge][1])
    {
      lines.push_back(static_cast<ElementIndex>(edge));
    }
  }
  return lines;
}

/** Whether the cells of dimension 0 and 1 are those a core's file has. */
void
RequireCells(const std::array<CellList, 3> &   kinds,
             const PartRange &                 range,
             const MedialComplex &             core,
             const std::vector<ElementIndex> & lines)
{
  RequireFit(lines == LineCells(core), "a line lies on a polygon");
  const std::vector<ElementIndex> verts = VertexCells(core);
  bool                            fit = verts.size() == range.cells[0];
  for (std::size_t i = 0; fit && i < verts.size(); ++i)
  {
    fit = kinds[0][range.firstCell[0] + i][0] - range.firstPoint == verts[i];
  }
  RequireFit(fit, "its vertex cells are not its isolated vertices");
}

/** Tolerances of a part from those of its points and cells. Edges that are no cells go with the last of their faces. */
void
ReadTolerances(const std::array<CellList, 3> & kinds,
               const PartRange &               range,
               const std::vector<double> &     pointTolerance,
               const std::vector<double> &     cellTolerance,
               bool                            isRounded,
               MedialComplex &                 core)
{
  const CellComplex & cells = core.cells;
  const auto          firstPoint = pointTolerance.begin() + range.firstPoint;
  core.tolerances.vertices.assign(firstPoint, firstPoint + static_cast<std::ptrdiff_t>(cells.vertexCount));
  const std::size_t firstFace = kinds[0].Count() + kinds[1].Count() + range.firstCell[2];
  core.tolerances.faces.assign(cellTolerance.begin() + static_cast<std::ptrdiff_t>(firstFace),
                               cellTolerance.begin() + static_cast<std::ptrdiff_t>(firstFace + range.cells[2]));
  for (const auto * values : { &core.tolerances.vertices, &core.tolerances.faces })
  {
    RequireFit(std::all_of(values->begin(), values->end(), [](double value) { return value >= 0; }),
               "a tolerance is below 0");
  }
  core.tolerances.edges.assign(cells.edges.size(), 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      core.tolerances.edges[edge] = std::max(core.tolerances.edges[edge], core.tolerances.faces[face]);
    }
  }
  std::size_t line = 0;
  for (std::size_t edge = 0; edge < cells.edges.size() && line < range.cells[1]; ++edge)
  {
    const auto ends = kinds[1][range.firstCell[1] + line];
    if (ends[0] == range.firstPoint + cells.edges[edge][0] && ends[1] == range.firstPoint + cells.edges[edge][1])
    {
      core.tolerances.edges[edge] = cellTolerance[kinds[0].Count() + range.firstCell[1] + line];
      RequireFit(core.tolerances.edges[edge] >= 0, "a tolerance is below 0");
      ++line;
    }
  }
  for (std::size_t i = 0; i < range.cells[0]; ++i)
  {
    const std::size_t cell = range.firstCell[0] + i;
    RequireFit(isRounded || pointTolerance[static_cast<std::size_t>(kinds[0][cell][0])] == cellTolerance[cell],
               "an isolated vertex has two tolerances");
  }
}

/** An array that must have a value for each point or cell. */
template <typename Value>
std::vector<Value>
ReadValues(ModelSource & file, const char * section, const char * name, std::int64_t tuples, int components = 1)
{
  std::vector<Value> values = file.Read<Value>(section, name, components);
  if (values.size() != static_cast<std::size_t>(tuples) * static_cast<std::size_t>(components))
  {
    throw UnfitFile{ std::string("its array ") + section + "/" + name + " has the wrong length" };
  }
  return values;
}

/** Further numbers of a core: finite and, unless a direction, not below 0. */
void
RequireFinite(const std::vector<double> & values, double least, const char * reason)
{
  RequireFit(
    std::all_of(values.begin(), values.end(), [&](double value) { return std::isfinite(value) && value >= least; }),
    reason);
}

/** How far the places of a file that lost digits may be off: text may have kept three. */
double
RoundingOf(const std::vector<double> & positions)
{
  double largest = 0;
  for (const double x : positions)
  {
    largest = std::max(largest, std::abs(x));
  }
  return 1e-3 * largest;
}

/** Label and component of each cell. */
std::vector<PartKey>
ReadKeys(ModelSource & file, std::int64_t cellCount)
{
  const auto           labels = ReadValues<std::int64_t>(file, "CellData", "Label", cellCount);
  std::vector<PartKey> keys(labels.size());
  for (std::size_t cell = 0; cell < keys.size(); ++cell)
  {
    keys[cell].first = labels[cell];
  }
  if (file.Has("CellData", "Component"))
  {
    const auto components = ReadValues<std::int64_t>(file, "CellData", "Component", cellCount);
    for (std::size_t cell = 0; cell < keys.size(); ++cell)
    {
      RequireFit(components[cell] >= 0, "a component has a number below 0");
      keys[cell].second = components[cell];
    }
  }
  return keys;
}

} // namespace

MedialModel
ReadParts(ModelSource & file, bool anywhere)
{
  RequireFit(!file.Has("CellData", "BranchId"), "it is a skeleton");
  const bool inLps = !anywhere || file.Has("FieldData", "SPACE");
  const auto unit = UnitNamed(file.ReadText("FieldData", "Units"));
  RequireFit((!inLps || file.ReadText("FieldData", "SPACE") == "LPS") && unit,
             "its field data do not say SPACE = LPS and Units = mm or voxel");
  RequireFit(file.PieceCount("NumberOfStrips") == 0, "it has triangle strips");
  const std::vector<double> positions = file.Read<double>("Points", "Points", 3);
  const auto                pointCount = static_cast<std::int64_t>(positions.size() / 3);
  RequireFit(file.PieceCount("NumberOfPoints") == static_cast<std::uint64_t>(pointCount),
             "its number of points is damaged");
  constexpr std::int64_t        many = std::numeric_limits<std::int64_t>::max();
  const std::array<CellList, 3> kinds{ ReadCells(file, "Verts", pointCount, 1, 1),
                                       ReadCells(file, "Lines", pointCount, 2, 2),
                                       ReadCells(file, "Polys", pointCount, 3, many) };
  const auto cellCount = static_cast<std::int64_t>(kinds[0].Count() + kinds[1].Count() + kinds[2].Count());
  const auto radius = ReadValues<double>(file, "PointData", "Radius", pointCount);
  const auto pointLambda = ReadValues<double>(file, "PointData", "Lambda", pointCount);
  const auto cellLambda = ReadValues<double>(file, "CellData", "Lambda", cellCount);
  const auto keys = ReadKeys(file, cellCount);

  RequireFit(!file.Has("CellData", "Bump"), "VoxelCore 0.1 pruned it by bumps; make it anew with --tolerance");
  const bool                hasTolerance = file.Has("CellData", "Tolerance") || file.Has("PointData", "Tolerance");
  const std::vector<double> pointTolerance =
    hasTolerance ? ReadValues<double>(file, "PointData", "Tolerance", pointCount) : std::vector<double>();
  const std::vector<double> cellTolerance =
    hasTolerance ? ReadValues<double>(file, "CellData", "Tolerance", cellCount) : std::vector<double>();

  std::vector<std::int64_t> edgeVertices;
  std::vector<double>       edgeLambda;
  const bool hasEdgeArrays = file.Has("FieldData", "EdgeVertices") || file.Has("FieldData", "EdgeLambda");
  if (hasEdgeArrays)
  {
    edgeLambda = file.Read<double>("FieldData", "EdgeLambda");
    edgeVertices =
      ReadValues<std::int64_t>(file, "FieldData", "EdgeVertices", static_cast<std::int64_t>(edgeLambda.size()), 2);
  }

  MedialModel model;
  model.inLps = inLps;
  model.unit = *unit;
  if (file.Has("FieldData", "Provenance"))
  {
    model.provenance = file.ReadText("FieldData", "Provenance");
  }
  const bool hasDisplacement = file.Has("PointData", "Displacement");
  RequireFit(hasDisplacement == file.Has("FieldData", "Refined"), "of Refined and Displacement one is missing");
  std::vector<double> displacement;
  if (hasDisplacement)
  {
    model.refined = file.ReadText("FieldData", "Refined");
    RequireFit(model.refined == "labels" || model.refined == "grey" || model.refined == "mesh",
               "its field Refined names no surface");
    displacement = ReadValues<double>(file, "PointData", "Displacement", pointCount, 3);
  }
  const auto readIfThere = [&](const char * name) {
    return file.Has("PointData", name) ? ReadValues<double>(file, "PointData", name, pointCount)
                                       : std::vector<double>();
  };
  const std::vector<double> thickness = readIfThere("Thickness");
  const std::vector<double> margin = readIfThere("RadiusMargin");
  constexpr double          lowest = std::numeric_limits<double>::lowest();
  RequireFinite(displacement, lowest, "a Displacement is no finite number");
  RequireFinite(thickness, 0, "a Thickness is below 0 or no finite number");
  RequireFinite(margin, 0, "a RadiusMargin is below 0 or no finite number");
  const bool   isRounded = !file.Rounded().empty();
  const double rounding = isRounded ? RoundingOf(positions) : 0;
  std::size_t  edgesRead = 0;
  bool         edgesMissing = false;
  for (const auto & [key, range] : FindParts(kinds, keys, pointCount))
  {
    ModelPart       part{ key.first, {}, key.second };
    const auto      firstMove = displacement.begin() + (hasDisplacement ? 3 * range.firstPoint : 0);
    MedialComplex & core = part.core;
    core.cells = ReadComplex(kinds, range);
    const auto first = static_cast<std::size_t>(range.firstPoint);
    const auto count = core.cells.vertexCount;
    core.positions.resize(count);
    for (std::size_t v = 0; v < count; ++v)
    {
      std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(3 * (first + v)), 3, core.positions[v].begin());
    }
    part.displacement.resize(hasDisplacement ? count : 0);
    for (std::size_t v = 0; v < part.displacement.size(); ++v)
    {
      std::copy_n(firstMove + static_cast<std::ptrdiff_t>(3 * v), 3, part.displacement[v].begin());
    }
    const auto slice = [](const std::vector<double> & values, std::size_t begin, std::size_t size) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(begin);
      return std::vector<double>(from, from + static_cast<std::ptrdiff_t>(size));
    };
    core.radius = slice(radius, first, count);
    part.thickness = thickness.empty() ? std::vector<double>() : slice(thickness, first, count);
    part.radiusMargin = margin.empty() ? std::vector<double>() : slice(margin, first, count);
    core.vertexLambda = slice(pointLambda, first, count);
    for (std::size_t i = 0; i < range.cells[0]; ++i)
    {
      const auto vertex = static_cast<std::size_t>(kinds[0][range.firstCell[0] + i][0]);
      RequireFit(isRounded || bit_cast<std::uint64_t>(cellLambda[range.firstCell[0] + i]) ==
                                bit_cast<std::uint64_t>(pointLambda[vertex]),
                 "an isolated vertex has two measures");
    }
    core.faceLambda = slice(cellLambda, kinds[0].Count() + kinds[1].Count() + range.firstCell[2], range.cells[2]);

    if (hasTolerance)
    {
      ReadTolerances(kinds, range, pointTolerance, cellTolerance, isRounded, core);
    }
    const std::vector<ElementIndex> lines = LinesOf(kinds, range, core.cells);
    RequireFit(lines.size() == range.cells[1], "its lines are not in canonical order");
    if (!isRounded) // rounded tolerances say no longer which edges outlast their faces
    {
      RequireCells(kinds, range, core, lines);
    }
    const std::vector<std::uint8_t> onFace = EdgesOnFaces(core.cells);
    const std::size_t               firstLine = kinds[0].Count() + range.firstCell[1];
    core.edgeLambda.assign(onFace.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t line = 0; line < lines.size(); ++line)
    {
      core.edgeLambda[lines[line]] = cellLambda[firstLine + line];
    }
    for (std::size_t edge = 0; edge < onFace.size(); ++edge)
    {
      if (onFace[edge] && !hasEdgeArrays)
      {
        edgesMissing = edgesMissing || std::isnan(core.edgeLambda[edge]);
      }
      else if (onFace[edge])
      {
        RequireFit(
          edgesRead < edgeLambda.size() &&
            (isRounded || std::isnan(core.edgeLambda[edge]) || core.edgeLambda[edge] == edgeLambda[edgesRead]) &&
            edgeVertices[2 * edgesRead] == range.firstPoint + core.cells.edges[edge][0] &&
            edgeVertices[2 * edgesRead + 1] == range.firstPoint + core.cells.edges[edge][1],
          "EdgeVertices are not the edges of its polygons");
        core.edgeLambda[edge] = edgeLambda[edgesRead++];
      }
    }
    if (const std::string fault = FaultOfNumbers(core, { hasDisplacement, rounding, first }); !fault.empty())
    {
      throw UnfitFile{ fault };
    }
    model.parts.push_back(std::move(part));
  }
  RequireFit(edgesRead == edgeLambda.size(), "EdgeVertices are not the edges of its polygons");
  model.hasEdges = !edgesMissing;
  return model;
}

} // namespace voxelcore
