#include "ModelCells.h"
#include "ModelSink.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

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
  double                    never; ///< tolerance of what never goes
};

std::vector<PartCells>
FindCells(const MedialModel & model)
{
  std::vector<PartCells> all;
  std::uint64_t          points = 0;
  for (const ModelPart & part : model.parts)
  {
    all.push_back({ &part, points, VertexCells(part.core), LineCells(part.core), GreatestTolerance(part.core) });
    points += part.core.cells.vertexCount;
  }
  return all;
}

bool
HaveTolerances(const std::vector<PartCells> & parts)
{
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(), [](const PartCells & one) { return one.part->core.HasTolerances(); });
}

/** In a file what never goes has one tolerance in all parts, so that no label goes before another one's branches do. */
class CommonTolerance
{
public:
  explicit CommonTolerance(const std::vector<PartCells> & parts)
  {
    for (const PartCells & one : parts)
    {
      m_Never = std::max(m_Never, one.never);
    }
  }

  double
  operator()(const PartCells & part, double value) const
  {
    return value == part.never ? m_Never : value;
  }

private:
  double m_Never = 0;
};

std::uint64_t
PointCount(const std::vector<PartCells> & parts)
{
  return parts.empty() ? 0 : parts.back().firstPoint + parts.back().part->core.cells.vertexCount;
}

void
AddPoints(ModelSink & sink, const std::vector<PartCells> & parts)
{
  const std::uint64_t count = PointCount(parts);
  double *            p = sink.Reals("Points", "Points", count, 3);
  double *            r = sink.Reals("PointData", "Radius", count);
  double *            l = sink.Reals("PointData", "Lambda", count);
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
  if (HaveTolerances(parts))
  {
    double *              b = sink.Reals("PointData", "Tolerance", count);
    const CommonTolerance inFile(parts);
    for (const PartCells & one : parts)
    {
      for (const double value : one.part->core.tolerances.vertices)
      {
        *b++ = inFile(one, value);
      }
    }
  }
}

/** Where every part has it. */
void
AddOfVertices(ModelSink &                    sink,
              const std::vector<PartCells> & parts,
              const char *                   name,
              std::vector<double> ModelPart::*values)
{
  const bool areMeasured = !parts.empty() && std::all_of(parts.begin(), parts.end(), [&](const PartCells & one) {
    return (one.part->*values).size() == one.part->core.cells.vertexCount && !(one.part->*values).empty();
  });
  if (!areMeasured)
  {
    return;
  }
  double * t = sink.Reals("PointData", name, PointCount(parts));
  for (const PartCells & one : parts)
  {
    t = std::copy((one.part->*values).begin(), (one.part->*values).end(), t);
  }
}

void
AddDisplacements(ModelSink & sink, const std::vector<PartCells> & parts)
{
  double * d = sink.Reals("PointData", "Displacement", PointCount(parts), 3);
  for (const PartCells & one : parts)
  {
    for (const Vector3 & move : one.part->displacement)
    {
      d = std::copy(move.begin(), move.end(), d);
    }
  }
}

/** Verts, lines and polys with 32 or 64 bit indices. */
template <typename Index>
void
AddCells(ModelSink & sink, const std::vector<PartCells> & parts)
{
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
  const auto makeCells = [&](const char * section, std::uint64_t cells, std::uint64_t size, auto && fill) {
    auto [offset, point] = sink.Cells<Index>(section, cells, size);
    *offset = 0;
    for (const PartCells & one : parts)
    {
      fill(one, static_cast<Index>(one.firstPoint), offset, point);
    }
  };
  makeCells("Verts", verts, verts, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
    for (const ElementIndex vertex : one.verts)
    {
      *point++ = first + static_cast<Index>(vertex);
      offset[1] = offset[0] + 1;
      ++offset;
    }
  });
  makeCells("Lines", lines, 2 * lines, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
    for (const ElementIndex edge : one.lines)
    {
      for (const ElementIndex vertex : one.part->core.cells.edges[edge])
      {
        *point++ = first + static_cast<Index>(vertex);
      }
      offset[1] = offset[0] + 2;
      ++offset;
    }
  });
  makeCells("Polys", polys, corners, [](const PartCells & one, Index first, Index *& offset, Index *& point) {
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
  });
}

std::uint64_t
CellCount(const std::vector<PartCells> & parts)
{
  std::uint64_t count = 0;
  for (const PartCells & one : parts)
  {
    count += one.verts.size() + one.lines.size() + one.part->core.cells.FaceCount();
  }
  return count;
}

/** One number per element. */
struct Measures
{
  const std::vector<double> & vertices;
  const std::vector<double> & edges;
  const std::vector<double> & faces;
};

template <typename MeasuresOf, typename InFile>
void
AddMeasure(ModelSink &                    sink,
           const std::vector<PartCells> & parts,
           const char *                   name,
           MeasuresOf &&                  measuresOf,
           InFile &&                      inFile)
{
  double * value = sink.Reals("CellData", name, CellCount(parts));
  for (const PartCells & one : parts)
  {
    for (const ElementIndex vertex : one.verts)
    {
      *value++ = inFile(one, measuresOf(one.part->core).vertices[vertex]);
    }
  }
  for (const PartCells & one : parts)
  {
    for (const ElementIndex edge : one.lines)
    {
      *value++ = inFile(one, measuresOf(one.part->core).edges[edge]);
    }
  }
  for (const PartCells & one : parts)
  {
    for (const double face : measuresOf(one.part->core).faces)
    {
      *value++ = inFile(one, face);
    }
  }
}

/** Visits the cells in the order of the file: how many of a kind a part has, and the part. */
template <typename Visit>
void
ForCells(const std::vector<PartCells> & parts, Visit && visit)
{
  for (const PartCells & one : parts)
  {
    visit(one.verts.size(), *one.part);
  }
  for (const PartCells & one : parts)
  {
    visit(one.lines.size(), *one.part);
  }
  for (const PartCells & one : parts)
  {
    visit(one.part->core.cells.FaceCount(), *one.part);
  }
}

void
AddCellArrays(ModelSink & sink, const std::vector<PartCells> & parts)
{
  const auto lambdas = [](const MedialComplex & core) {
    return Measures{ core.vertexLambda, core.edgeLambda, core.faceLambda };
  };
  AddMeasure(sink, parts, "Lambda", lambdas, [](const PartCells &, double value) { return value; });
  if (HaveTolerances(parts))
  {
    const auto tolerances = [](const MedialComplex & core) {
      return Measures{ core.tolerances.vertices, core.tolerances.edges, core.tolerances.faces };
    };
    AddMeasure(sink, parts, "Tolerance", tolerances, CommonTolerance(parts));
  }
  const std::uint64_t count = CellCount(parts);
  std::int64_t *      label = sink.Wholes("CellData", "Label", count);
  ForCells(parts, [&](std::size_t cells, const ModelPart & part) { label = std::fill_n(label, cells, part.label); });
  if (std::any_of(parts.begin(), parts.end(), [](const PartCells & one) { return one.part->component != 0; }))
  {
    std::int64_t * component = sink.Wholes("CellData", "Component", count);
    ForCells(parts, [&](std::size_t cells, const ModelPart & part) {
      component = std::fill_n(component, cells, part.component);
    });
  }
}

void
AddEdgeArrays(ModelSink & sink, const std::vector<PartCells> & parts)
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
  std::int64_t * vertex = sink.Wholes("FieldData", "EdgeVertices", count, 2);
  double *       measure = sink.Reals("FieldData", "EdgeLambda", count);
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
}

} // namespace

void
WriteParts(const MedialModel & model, bool keepEdges, ModelSink & sink)
{
  const std::vector<PartCells> parts = FindCells(model);
  AddPoints(sink, parts);
  std::uint64_t corners = 0;
  for (const PartCells & one : parts)
  {
    corners += one.part->core.cells.faceVertices.size() + 2 * one.lines.size();
  }
  if (std::max(PointCount(parts), corners) < static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max()))
  {
    AddCells<std::int32_t>(sink, parts); // half the size of what VTK would take by itself
  }
  else
  {
    AddCells<std::int64_t>(sink, parts);
  }
  AddCellArrays(sink, parts);
  AddOfVertices(sink, parts, "Thickness", &ModelPart::thickness);
  AddOfVertices(sink, parts, "RadiusMargin", &ModelPart::radiusMargin);
  if (model.inLps)
  {
    sink.Text("SPACE", "LPS");
  }
  sink.Text("Units", UnitName(model.unit));
  if (!model.refined.empty())
  {
    sink.Text("Refined", model.refined);
    AddDisplacements(sink, parts);
  }
  if (!model.provenance.empty())
  {
    sink.Text("Provenance", model.provenance);
  }
  if (keepEdges)
  {
    for (const ModelPart & part : model.parts)
    {
      RequireEdgeMeasures(part.core);
    }
    AddEdgeArrays(sink, parts);
  }
}

} // namespace voxelcore
