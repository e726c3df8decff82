#include "ModelCells.h"
#include "VtkMessages.h"

#include "voxelcore/Error.h"
#include "voxelcore/MedialModel.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkXMLPolyDataReader.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <limits>
#include <map>
#include <new>

namespace voxelcore
{
namespace
{

/** Ends reading: damaged, or not one of ours. */
struct Unfit
{
  std::string reason;
};

void
Require(bool condition, const char * reason)
{
  if (!condition)
  {
    throw Unfit{ reason };
  }
}

/** The values of an array with the given type and shape; Unfit when it is missing or other. */
template <typename ArrayType>
std::span<const typename ArrayType::ValueType>
Values(vtkFieldData * fields, const char * name, std::int64_t tuples, int components = 1)
{
  auto * array = ArrayType::FastDownCast(fields->GetAbstractArray(name));
  if (!array || array->GetNumberOfComponents() != components || array->GetNumberOfTuples() != tuples)
  {
    throw Unfit{ std::string("its array ") + name + " is missing or has the wrong type or length" };
  }
  return { array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) };
}

std::string
Text(vtkFieldData * fields, const char * name)
{
  auto * array = vtkStringArray::SafeDownCast(fields->GetAbstractArray(name));
  return array && array->GetNumberOfValues() == 1 ? std::string(array->GetValue(0)) : std::string();
}

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
ReadCells(vtkCellArray * cells, std::int64_t pointCount, std::int64_t fewest, std::int64_t most)
{
  CellList   list;
  const auto take = [&](auto * offsets, auto * points) {
    list.offsets.assign(offsets->GetPointer(0), offsets->GetPointer(0) + offsets->GetNumberOfValues());
    list.points.assign(points->GetPointer(0), points->GetPointer(0) + points->GetNumberOfValues());
  };
  if (cells->IsStorage64Bit())
  {
    take(cells->GetOffsetsArray64(), cells->GetConnectivityArray64());
  }
  else
  {
    take(cells->GetOffsetsArray32(), cells->GetConnectivityArray32());
  }
  if (list.offsets.empty())
  {
    list.offsets.push_back(0);
  }
  Require(list.offsets.front() == 0 && list.offsets.back() == static_cast<std::int64_t>(list.points.size()),
          "the offsets of its cells do not match their points");
  for (std::size_t cell = 0; cell < list.Count(); ++cell)
  {
    Require(list.offsets[cell + 1] >= list.offsets[cell] &&
              list.offsets[cell + 1] <= static_cast<std::int64_t>(list.points.size()),
            "the offsets of its cells do not match their points");
    const std::int64_t size = list.offsets[cell + 1] - list.offsets[cell];
    Require(size >= fewest && size <= most, "a cell is neither a vertex, an edge nor a polygon");
  }
  for (const std::int64_t point : list.points)
  {
    Require(point >= 0 && point < pointCount, "a cell names a point that is not there");
  }
  return list;
}

/** The cells and points of one label. */
struct LabelRange
{
  std::array<std::size_t, 3> firstCell{ 0, 0, 0 }; ///< within verts, lines, polys
  std::array<std::size_t, 3> cells{ 0, 0, 0 };
  std::int64_t               firstPoint = std::numeric_limits<std::int64_t>::max();
  std::int64_t               lastPoint = -1;
};

std::map<std::int64_t, LabelRange>
FindLabels(const std::array<CellList, 3> & kinds, std::span<const vtkTypeInt64> labels, std::int64_t pointCount)
{
  std::map<std::int64_t, LabelRange> ranges;
  std::vector<std::uint8_t>          used(static_cast<std::size_t>(pointCount), 0);
  std::size_t                        index = 0;
  for (std::size_t kind = 0; kind < 3; ++kind)
  {
    LabelRange * range = nullptr;
    for (std::size_t cell = 0; cell < kinds[kind].Count(); ++cell, ++index)
    {
      if (cell == 0 || labels[index] != labels[index - 1])
      {
        Require(cell == 0 || labels[index] > labels[index - 1], "its cells are not sorted by label");
        range = &ranges[labels[index]];
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
  Require(std::find(used.begin(), used.end(), 0) == used.end(), "a point belongs to no cell");
  std::int64_t next = 0;
  for (const auto & [label, range] : ranges)
  {
    Require(range.firstPoint == next, "its points are not sorted by label");
    next = range.lastPoint + 1;
  }
  return ranges;
}

/** A label's complex, all but the measures of its edges. Checks vertex cells, lines and corners. */
CellComplex
ReadComplex(const std::array<CellList, 3> & kinds, const LabelRange & range)
{
  CellComplex cells;
  cells.vertexCount = static_cast<std::size_t>(range.lastPoint - range.firstPoint + 1);
  const auto local = [&](std::int64_t point) { return static_cast<ElementIndex>(point - range.firstPoint); };

  std::vector<std::array<ElementIndex, 2>> lines(range.cells[1]);
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    const auto line = kinds[1][range.firstCell[1] + i];
    lines[i] = { local(line[0]), local(line[1]) };
    Require(lines[i][0] < lines[i][1] && (i == 0 || lines[i - 1] < lines[i]), "its lines are not in canonical order");
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
    Require(std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end(), "a polygon has the same corner twice");
  }
  BuildEdges(cells, lines);

  const std::vector<std::uint8_t> onFace = EdgesOnFaces(cells);
  std::size_t                     loose = 0;
  for (std::size_t edge = 0; edge < onFace.size(); ++edge)
  {
    loose += onFace[edge] ? 0 : 1;
  }
  Require(loose == lines.size(), "a line lies on a polygon");
  const std::vector<ElementIndex> isolated = IsolatedVertices(cells);
  Require(isolated.size() == range.cells[0], "its vertex cells are not its isolated vertices");
  for (std::size_t i = 0; i < isolated.size(); ++i)
  {
    Require(kinds[0][range.firstCell[0] + i][0] - range.firstPoint == isolated[i],
            "its vertex cells are not its isolated vertices");
  }
  return cells;
}

MedialModel
ReadPolyData(vtkPolyData * data)
{
  vtkFieldData *     fields = data->GetFieldData();
  const std::int64_t pointCount = data->GetNumberOfPoints();
  const std::int64_t cellCount = data->GetNumberOfCells();
  Require(Text(fields, "SPACE") == "LPS" && Text(fields, "Units") == "mm",
          "its field data do not say SPACE = LPS and Units = mm");
  Require(data->GetNumberOfStrips() == 0, "it has triangle strips");
  constexpr std::int64_t        many = std::numeric_limits<std::int64_t>::max();
  const std::array<CellList, 3> kinds{ ReadCells(data->GetVerts(), pointCount, 1, 1),
                                       ReadCells(data->GetLines(), pointCount, 2, 2),
                                       ReadCells(data->GetPolys(), pointCount, 3, many) };
  Require(static_cast<std::int64_t>(kinds[0].Count() + kinds[1].Count() + kinds[2].Count()) == cellCount,
          "its cells do not add up");

  const auto              radius = Values<vtkDoubleArray>(data->GetPointData(), "Radius", pointCount);
  const auto              pointLambda = Values<vtkDoubleArray>(data->GetPointData(), "Lambda", pointCount);
  const auto              cellLambda = Values<vtkDoubleArray>(data->GetCellData(), "Lambda", cellCount);
  const auto              labels = Values<vtkTypeInt64Array>(data->GetCellData(), "Label", cellCount);
  std::span<const double> positions;
  if (pointCount > 0)
  {
    auto * array = vtkDoubleArray::FastDownCast(data->GetPoints()->GetData());
    Require(array && array->GetNumberOfComponents() == 3, "its points are not in double precision");
    positions = { array->GetPointer(0), static_cast<std::size_t>(array->GetNumberOfValues()) };
  }
  std::span<const vtkTypeInt64> edgeVertices;
  std::span<const double>       edgeLambda;
  const bool                    hasEdgeArrays = fields->HasArray("EdgeVertices") || fields->HasArray("EdgeLambda");
  if (hasEdgeArrays)
  {
    auto *             array = fields->GetAbstractArray("EdgeLambda");
    const std::int64_t edges = array ? array->GetNumberOfTuples() : 0;
    edgeVertices = Values<vtkTypeInt64Array>(fields, "EdgeVertices", edges, 2);
    edgeLambda = Values<vtkDoubleArray>(fields, "EdgeLambda", edges);
  }

  MedialModel model;
  model.provenance = Text(fields, "Provenance");
  std::size_t edgesRead = 0;
  bool        edgesMissing = false;
  for (const auto & [label, range] : FindLabels(kinds, labels, pointCount))
  {
    ModelPart       part{ label, {} };
    MedialComplex & core = part.core;
    core.cells = ReadComplex(kinds, range);
    const auto first = static_cast<std::size_t>(range.firstPoint);
    const auto count = core.cells.vertexCount;
    core.positions.resize(count);
    for (std::size_t v = 0; v < count; ++v)
    {
      std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(3 * (first + v)), 3, core.positions[v].begin());
    }
    const auto slice = [](auto values, std::size_t begin, std::size_t size) {
      const auto part_ = values.subspan(begin, size);
      return std::vector<double>(part_.begin(), part_.end());
    };
    core.radius = slice(radius, first, count);
    core.vertexLambda = slice(pointLambda, first, count);
    for (std::size_t i = 0; i < range.cells[0]; ++i)
    {
      const auto vertex = static_cast<std::size_t>(kinds[0][range.firstCell[0] + i][0]);
      Require(std::bit_cast<std::uint64_t>(cellLambda[range.firstCell[0] + i]) ==
                std::bit_cast<std::uint64_t>(pointLambda[vertex]),
              "an isolated vertex has two measures");
    }
    core.faceLambda = slice(cellLambda, kinds[0].Count() + kinds[1].Count() + range.firstCell[2], range.cells[2]);

    const std::vector<std::uint8_t> onFace = EdgesOnFaces(core.cells);
    std::size_t                     line = kinds[0].Count() + range.firstCell[1];
    core.edgeLambda.resize(onFace.size());
    for (std::size_t edge = 0; edge < onFace.size(); ++edge)
    {
      if (!onFace[edge])
      {
        core.edgeLambda[edge] = cellLambda[line++];
      }
      else if (!hasEdgeArrays)
      {
        core.edgeLambda[edge] = std::numeric_limits<double>::quiet_NaN();
        edgesMissing = true;
      }
      else
      {
        Require(edgesRead < edgeLambda.size() &&
                  edgeVertices[2 * edgesRead] == range.firstPoint + core.cells.edges[edge][0] &&
                  edgeVertices[2 * edgesRead + 1] == range.firstPoint + core.cells.edges[edge][1],
                "EdgeVertices are not the edges of its polygons");
        core.edgeLambda[edge] = edgeLambda[edgesRead++];
      }
    }
    model.parts.push_back(std::move(part));
  }
  Require(edgesRead == edgeLambda.size(), "EdgeVertices are not the edges of its polygons");
  model.hasEdges = !edgesMissing;
  return model;
}

} // namespace

MedialModel
ReadModel(const std::filesystem::path & path)
{
  const auto fail = [&](const std::string & reason) {
    return InputError("cannot read '" + path.string() + "': " + reason +
                      "; give a .vtp file that 'voxelcore core' wrote");
  };
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
  {
    throw InputError("cannot read '" + path.string() + "': there is no such file");
  }
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path))
  {
    throw InputError("cannot read '" + path.string() + "': it is not a file that can be opened");
  }
  const VtkMessages messages;
  try
  {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    if (!reader->CanReadFile(path.c_str()))
    {
      throw Unfit{ "it is no VTK polydata file in XML" };
    }
    reader->Update();
    if (const std::string message = messages.First(); !message.empty())
    {
      throw Unfit{ "it is damaged (" + message + ")" };
    }
    return ReadPolyData(reader->GetOutput());
  }
  catch (const Unfit & unfit)
  {
    throw fail(unfit.reason);
  }
  catch (const std::bad_alloc &)
  {
    throw fail("it is damaged, or larger than the memory");
  }
}

} // namespace voxelcore
