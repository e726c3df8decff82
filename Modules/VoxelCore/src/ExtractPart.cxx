#include "voxelcore/ExtractPart.h"

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
ExtractPart(const MedialComplex & core, const LiveElements & live)
{
  PartElements elements;
  return ExtractPart(core, live, elements);
}

} // namespace voxelcore
