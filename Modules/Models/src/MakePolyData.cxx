#include "ModelCells.h"
#include "voxelcore/ModelPolyData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <limits>

namespace voxelcore
{
namespace
{

/** One part's place in the file and its cells of dimension 0 and 1. */
struct PartCells
{
  const ModelPart *         part;
  std::uint64_t             firstPoint;
  std::vector<ElementIndex> verts; ///< vertices that are cells
  std::vector<ElementIndex> lines; ///< edges that are cells
};

std::vector<PartCells>
FindCells(const MedialModel & model)
{
  std::vector<PartCells> all;
  std::uint64_t          points = 0;
  for (const ModelPart & part : model.parts)
  {
    all.push_back({ &part, points, VertexCells(part.core), LineCells(part.core) });
    points += part.core.cells.vertexCount;
  }
  return all;
}

void
AddString(vtkFieldData * fields, const char * name, const std::string & value)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  array->InsertNextValue(value);
  fields->AddArray(array);
}

/** An array of `tuples` with `components`; its values are written through the pointer. */
template <typename ArrayType>
auto *
Allocate(ArrayType & array, const char * name, std::uint64_t tuples, int components = 1)
{
  array.SetName(name);
  array.SetNumberOfComponents(components);
  array.SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array.GetPointer(0);
}

bool
HaveTolerances(const std::vector<PartCells> & parts)
{
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(), [](const PartCells & one) { return one.part->core.HasTolerances(); });
}

void
AddPoints(vtkPolyData * data, const std::vector<PartCells> & parts)
{
  const std::uint64_t count = parts.empty() ? 0 : parts.back().firstPoint + parts.back().part->core.cells.vertexCount;
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkDoubleArray> radius;
  vtkNew<vtkDoubleArray> lambda;
  double *               p = Allocate(*positions, "Points", count, 3);
  double *               r = Allocate(*radius, "Radius", count);
  double *               l = Allocate(*lambda, "Lambda", count);
  for (const PartCells & one : parts)
  {
    const MedialComplex & core = one.part->core;
    for (const auto & position : core.positions)
    {
      p = std::copy(position.begin(), position.end(), p);
    }
    r = std::copy(core.radius.begin(), core.radius.end(), r);
    l = std::copy(core.vertexLambda.begin(), core.vertexLambda.end(), l);
  }
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  data->SetPoints(points);
  data->GetPointData()->AddArray(radius);
  data->GetPointData()->AddArray(lambda);
  if (HaveTolerances(parts))
  {
    vtkNew<vtkDoubleArray> tolerance;
    double *               b = Allocate(*tolerance, "Tolerance", count);
    for (const PartCells & one : parts)
    {
      b = std::copy(one.part->core.tolerances.vertices.begin(), one.part->core.tolerances.vertices.end(), b);
    }
    data->GetPointData()->AddArray(tolerance);
  }
}

void
AddDisplacements(vtkPolyData * data, const std::vector<PartCells> & parts)
{
  vtkNew<vtkDoubleArray> array;
  double *               d = Allocate(*array, "Displacement", static_cast<std::uint64_t>(data->GetNumberOfPoints()), 3);
  for (const PartCells & one : parts)
  {
    for (const Vector3 & move : one.part->displacement)
    {
      d = std::copy(move.begin(), move.end(), d);
    }
  }
  data->GetPointData()->AddArray(array);
}

/** Verts, lines and polys with 32 or 64 bit indices. */
template <typename ArrayType>
void
AddCells(vtkPolyData * data, const std::vector<PartCells> & parts)
{
  using Index = typename ArrayType::ValueType;
  std::uint64_t verts = 0;
  std::uint64_t lines = 0;
  std::uint64_t polys = 0;
  std::uint64_t corners = 0;
  for (const PartCells & one : parts)
  {
    verts += one.verts.size();
    lines += one.lines.size();
    polys += one.part->core.cells.FaceCount();
    corners += one.part->core.cells.faceVertices.size();
  }
  const auto makeCells = [&](std::uint64_t cells, std::uint64_t size, auto && fill) {
    vtkNew<ArrayType> offsets;
    vtkNew<ArrayType> connectivity;
    Index *           offset = Allocate(*offsets, "offsets", cells + 1);
    Index *           point = Allocate(*connectivity, "connectivity", size);
    *offset = 0;
    for (const PartCells & one : parts)
    {
      fill(one, static_cast<Index>(one.firstPoint), offset, point);
    }
    vtkNew<vtkCellArray> array;
    array->SetData(offsets.Get(), connectivity.Get());
    return vtkSmartPointer<vtkCellArray>(array);
  };
  data->SetVerts(makeCells(verts, verts, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
    for (const ElementIndex vertex : one.verts)
    {
      *point++ = first + static_cast<Index>(vertex);
      offset[1] = offset[0] + 1;
      ++offset;
    }
  }));
  data->SetLines(makeCells(lines, 2 * lines, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
    for (const ElementIndex edge : one.lines)
    {
      for (const ElementIndex vertex : one.part->core.cells.edges[edge])
      {
        *point++ = first + static_cast<Index>(vertex);
      }
      offset[1] = offset[0] + 2;
      ++offset;
    }
  }));
  data->SetPolys(makeCells(polys, corners, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
    const CellComplex & cells = one.part->core.cells;
    for (std::size_t face = 0; face < cells.FaceCount(); ++face)
    {
      const auto vertices = cells.FaceVertices(face);
      for (const ElementIndex vertex : vertices)
      {
        *point++ = first + static_cast<Index>(vertex);
      }
      offset[1] = offset[0] + static_cast<Index>(vertices.size());
      ++offset;
    }
  }));
}

/** One number per element. */
struct Measures
{
  const std::vector<double> & vertices;
  const std::vector<double> & edges;
  const std::vector<double> & faces;
};

template <typename MeasuresOf>
void
AddMeasure(vtkPolyData * data, const std::vector<PartCells> & parts, const char * name, MeasuresOf && measuresOf)
{
  vtkNew<vtkDoubleArray> array;
  double *               value = Allocate(*array, name, static_cast<std::uint64_t>(data->GetNumberOfCells()));
  for (const PartCells & one : parts)
  {
    for (const ElementIndex vertex : one.verts)
    {
      *value++ = measuresOf(one.part->core).vertices[vertex];
    }
  }
  for (const PartCells & one : parts)
  {
    for (const ElementIndex edge : one.lines)
    {
      *value++ = measuresOf(one.part->core).edges[edge];
    }
  }
  for (const PartCells & one : parts)
  {
    const auto & faces = measuresOf(one.part->core).faces;
    value = std::copy(faces.begin(), faces.end(), value);
  }
  data->GetCellData()->AddArray(array);
}

void
AddCellArrays(vtkPolyData * data, const std::vector<PartCells> & parts)
{
  const auto                count = static_cast<std::uint64_t>(data->GetNumberOfCells());
  vtkNew<vtkTypeInt64Array> label;
  auto *                    value = Allocate(*label, "Label", count);
  std::vector<std::int64_t> components; // per cell
  const bool                hasComponents =
    std::any_of(parts.begin(), parts.end(), [](const PartCells & one) { return one.part->component != 0; });
  const auto identify = [&](std::uint64_t cells, const ModelPart & part) {
    value = std::fill_n(value, cells, part.label);
    components.insert(components.end(), hasComponents ? cells : 0, part.component);
  };
  for (const PartCells & one : parts)
  {
    identify(one.verts.size(), *one.part);
  }
  for (const PartCells & one : parts)
  {
    identify(one.lines.size(), *one.part);
  }
  for (const PartCells & one : parts)
  {
    identify(one.part->core.cells.FaceCount(), *one.part);
  }
  AddMeasure(data, parts, "Lambda", [](const MedialComplex & core) {
    return Measures{ core.vertexLambda, core.edgeLambda, core.faceLambda };
  });
  if (HaveTolerances(parts))
  {
    AddMeasure(data, parts, "Tolerance", [](const MedialComplex & core) {
      return Measures{ core.tolerances.vertices, core.tolerances.edges, core.tolerances.faces };
    });
  }
  data->GetCellData()->AddArray(label);
  if (hasComponents)
  {
    vtkNew<vtkTypeInt64Array> component;
    std::copy(components.begin(), components.end(), Allocate(*component, "Component", count));
    data->GetCellData()->AddArray(component);
  }
}

void
AddEdgeArrays(vtkPolyData * data, const std::vector<PartCells> & parts)
{
  std::uint64_t                          count = 0;
  std::vector<std::vector<std::uint8_t>> onFace;
  for (const PartCells & one : parts)
  {
    onFace.push_back(EdgesOnFaces(one.part->core.cells));
    count += static_cast<std::uint64_t>(std::count(onFace.back().begin(), onFace.back().end(), std::uint8_t{ 1 }));
  }
  if (count == 0)
  {
    return; // nothing is missing, with or without --keep-edges: the file should not depend on it
  }
  vtkNew<vtkTypeInt64Array> vertices;
  vtkNew<vtkDoubleArray>    lambda;
  auto *                    vertex = Allocate(*vertices, "EdgeVertices", count, 2);
  double *                  measure = Allocate(*lambda, "EdgeLambda", count);
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const PartCells &     one = parts[i];
    const MedialComplex & core = one.part->core;
    for (std::size_t edge = 0; edge < onFace[i].size(); ++edge)
    {
      if (onFace[i][edge] != 0)
      {
        *vertex++ = static_cast<std::int64_t>(one.firstPoint + core.cells.edges[edge][0]);
        *vertex++ = static_cast<std::int64_t>(one.firstPoint + core.cells.edges[edge][1]);
        *measure++ = core.edgeLambda[edge];
      }
    }
  }
  data->GetFieldData()->AddArray(vertices);
  data->GetFieldData()->AddArray(lambda);
}

} // namespace

vtkSmartPointer<vtkPolyData>
MakePolyData(const MedialModel & model, bool keepEdges)
{
  const std::vector<PartCells> parts = FindCells(model);
  vtkNew<vtkPolyData>          data;
  AddPoints(data, parts);
  std::uint64_t largest = static_cast<std::uint64_t>(data->GetNumberOfPoints());
  std::uint64_t corners = 0;
  for (const PartCells & one : parts)
  {
    corners += one.part->core.cells.faceVertices.size() + 2 * one.lines.size();
  }
  largest = std::max(largest, corners);
  if (largest < static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
  {
    AddCells<vtkTypeInt32Array>(data, parts); // half the size of what VTK would take by itself
  }
  else
  {
    AddCells<vtkTypeInt64Array>(data, parts);
  }
  AddCellArrays(data, parts);
  if (model.inLps)
  {
    AddString(data->GetFieldData(), "SPACE", "LPS");
  }
  AddString(data->GetFieldData(), "Units", UnitName(model.unit));
  if (!model.refined.empty())
  {
    AddString(data->GetFieldData(), "Refined", model.refined);
    AddDisplacements(data, parts);
  }
  if (!model.provenance.empty())
  {
    AddString(data->GetFieldData(), "Provenance", model.provenance);
  }
  if (keepEdges)
  {
    for (const ModelPart & part : model.parts)
    {
      RequireEdgeMeasures(part.core);
    }
    AddEdgeArrays(data, parts);
  }
  return data;
}

} // namespace voxelcore
