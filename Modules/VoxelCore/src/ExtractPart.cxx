#include "voxelcore/ExtractPart.h"

#include "voxelcore/SpentMemory.h"

#include <utility>

namespace voxelcore
{

void
NameInWhole(const PartElements & part, PartElements & ofPart)
{
  const auto name = [](const std::vector<ElementIndex> & whole, std::vector<ElementIndex> & indices) {
    for (ElementIndex & index : indices)
    {
      index = whole[index];
    }
  };
  name(part.vertices, ofPart.vertices);
  name(part.edges, ofPart.edges);
  name(part.faces, ofPart.faces);
}

MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live, PartElements & elements)
{
  auto & [vertices, edges, faces] = elements;
  MedialComplex part;
  part.cells = ExtractLive(core.cells, live, vertices, edges, faces);
  const auto gather = [](const auto & from, const std::vector<ElementIndex> & ids, auto & to) {
    to.reserve(ids.size());
    for (const ElementIndex id : ids)
    {
      to.push_back(from[id]);
    }
  };
  gather(core.positions, vertices, part.positions);
  gather(core.radius, vertices, part.radius);
  gather(core.vertexLambda, vertices, part.vertexLambda);
  gather(core.edgeLambda, edges, part.edgeLambda);
  gather(core.faceLambda, faces, part.faceLambda);
  if (core.HasTolerances())
  {
    gather(core.tolerances.vertices, vertices, part.tolerances.vertices);
    gather(core.tolerances.edges, edges, part.tolerances.edges);
    gather(core.tolerances.faces, faces, part.tolerances.faces);
  }
  return part;
}

MedialComplex
KeepPart(MedialComplex && core, const LiveElements & live)
{
  const bool                hasTolerances = core.HasTolerances();
  MedialComplex             part = std::move(core);
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
  KeepLive(part.cells, live, vertices, edges, faces);
  const auto keep = [](auto & values, const std::vector<ElementIndex> & ids) {
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      values[i] = values[ids[i]];
    }
    CutShort(values, ids.size());
  };
  keep(part.positions, vertices);
  keep(part.radius, vertices);
  keep(part.vertexLambda, vertices);
  keep(part.edgeLambda, edges);
  keep(part.faceLambda, faces);
  if (hasTolerances)
  {
    keep(part.tolerances.vertices, vertices);
    keep(part.tolerances.edges, edges);
    keep(part.tolerances.faces, faces);
  }
  return part;
}

MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live)
{
  PartElements elements;
  return ExtractPart(core, live, elements);
}

} // namespace voxelcore
