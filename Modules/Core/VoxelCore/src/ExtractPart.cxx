#include "voxelcore/VoxelCore/ExtractPart.h"

#include "voxelcore/Base/SpentMemory.h"

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

namespace
{

/** take(from, ids, to) for each array of a core: `from` may be `to`. */
template <typename TFrom, typename TTake>
void
TakeArrays(TFrom & from, const PartElements & elements, bool withTolerances, MedialComplex & to, TTake take)
{
  const auto & [vertices, edges, faces] = elements;
  take(from.positions, vertices, to.positions);
  take(from.radius, vertices, to.radius);
  take(from.vertexLambda, vertices, to.vertexLambda);
  take(from.edgeLambda, edges, to.edgeLambda);
  take(from.faceLambda, faces, to.faceLambda);
  if (withTolerances)
  {
    take(from.tolerances.vertices, vertices, to.tolerances.vertices);
    take(from.tolerances.edges, edges, to.tolerances.edges);
    take(from.tolerances.faces, faces, to.tolerances.faces);
  }
}

} // namespace

MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live, PartElements & elements)
{
  MedialComplex part;
  part.cells = ExtractLive(core.cells, live, elements.vertices, elements.edges, elements.faces);
  const auto gather = [](const auto & from, const std::vector<ElementIndex> & ids, auto & to) {
    to.reserve(ids.size());
    for (const ElementIndex id : ids)
    {
      to.push_back(from[id]);
    }
  };
  TakeArrays(core, elements, core.HasTolerances(), part, gather);
  return part;
}

MedialComplex
KeepPart(MedialComplex && core, const LiveElements & live)
{
  const bool    hasTolerances = core.HasTolerances();
  MedialComplex part = std::move(core);
  PartElements  elements;
  KeepLive(part.cells, live, elements.vertices, elements.edges, elements.faces);
  const auto keep = [](auto & from, const std::vector<ElementIndex> & ids, auto & to) {
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      to[i] = from[ids[i]];
    }
    CutShort(to, ids.size());
  };
  TakeArrays(part, elements, hasTolerances, part, keep);
  return part;
}

MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live)
{
  PartElements elements;
  return ExtractPart(core, live, elements);
}

} // namespace voxelcore
