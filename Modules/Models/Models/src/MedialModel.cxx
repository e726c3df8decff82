#include "voxelcore/Models/MedialModel.h"

#include "ModelCells.h"
#include "ModelFormats.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <algorithm>
#include <tuple>

namespace voxelcore
{
namespace
{

std::string
FormatOf(const std::filesystem::path & path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return extension;
}

void
CheckModel(const MedialModel & model, bool keepEdges)
{
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const MedialComplex & core = model.parts[i].core;
    const CellComplex &   cells = core.cells;
    if (i > 0 && std::tie(model.parts[i - 1].label, model.parts[i - 1].component) >=
                   std::tie(model.parts[i].label, model.parts[i].component))
    {
      throw Error("the parts of a model must be sorted by label and component, each once");
    }
    if (core.positions.size() != cells.vertexCount || core.radius.size() != cells.vertexCount ||
        core.vertexLambda.size() != cells.vertexCount || core.edgeLambda.size() != cells.edges.size() ||
        core.faceLambda.size() != cells.FaceCount() ||
        model.parts[i].displacement.size() != (model.refined.empty() ? 0 : cells.vertexCount) ||
        cells.faceEdges.size() != cells.faceVertices.size() || !std::is_sorted(cells.edges.begin(), cells.edges.end()))
    {
      throw Error("a part of a model is incomplete or not in canonical order");
    }
    if (keepEdges)
    {
      RequireEdgeMeasures(core);
    }
  }
}

} // namespace

bool
IsModelPath(const std::filesystem::path & path)
{
  const std::string format = FormatOf(path);
  return format == ".vtp" || format == ".vtk" || format == ".ply" || format == ".obj" || format == ".stl" ||
         format == ".ma";
}

ModelOmissions
WriteModel(const std::filesystem::path & path,
           const std::filesystem::path & formatOf,
           const MedialModel &           model,
           const ModelOptions &          options)
{
  const std::string format = FormatOf(formatOf);
  if (!IsModelPath(formatOf))
  {
    throw UsageError("cannot write '" + formatOf.string() +
                     "': the extension must be .vtp, .vtk, .ply, .obj, .stl or .ma");
  }
  CheckModel(model, options.keepEdges);
  if (options.triangles || format == ".stl" || format == ".ma")
  {
    MedialModel triangles{ {}, model.provenance, model.hasEdges, model.refined, model.inLps, model.unit };
    for (const ModelPart & part : model.parts)
    {
      triangles.parts.push_back(
        { part.label, Triangulated(part.core), part.component, part.displacement, part.thickness, part.radiusMargin });
    }
    if (format == ".stl")
    {
      return WriteStl(path, triangles);
    }
    if (format == ".ma")
    {
      return WriteMa(path, triangles);
    }
    return WriteModel(path, formatOf, triangles, { false, options.keepEdges });
  }
  if (format == ".ply")
  {
    return WritePly(path, model);
  }
  if (format == ".obj")
  {
    return WriteObj(path, model);
  }
  if (format == ".vtk")
  {
    WriteVtk(path, model, options.keepEdges);
  }
  else
  {
    WriteVtp(path, model, options.keepEdges);
  }
  return {};
}

} // namespace voxelcore
