#include "Fringe.h"

#include "VertexPairs.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

double
WidestFringe(const Vector3 & spacing)
{
  return 2.5 * std::cbrt(spacing[0] * spacing[1] * spacing[2]);
}

CorePart
RemoveFringe(const RefinementInput & input, const FootPointFinder & finder, CorePart part)
{
  constexpr double      stays = std::numeric_limits<double>::infinity();
  const double          widest = WidestFringe(input.spacing);
  const MedialComplex & core = *input.core;
  const CellComplex &   cells = part.cells;
  auto                  pairs = PairsOfFaces(*input.edgePoints, cells, part.edges);
  const auto            meet = [&](const PointPair & pair, std::span<const ElementIndex> corners) {
    return std::all_of(corners.begin(), corners.end(), [&](ElementIndex corner) {
      return finder.Meet(Times(core.positions[part.vertices[corner]], input.spacing), pair);
    });
  };
  std::vector<double> vertexMeasure(cells.vertexCount, 0);
  std::vector<double> edgeMeasure(cells.edges.size(), -1);
  std::vector<double> faceMeasure(cells.FaceCount(), 0);
  const auto          faces = static_cast<std::ptrdiff_t>(faceMeasure.size());
#pragma omp parallel for schedule(dynamic, 256) if (faces > 4096)
  for (std::ptrdiff_t i = 0; i < faces; ++i)
  {
    const auto   face = static_cast<std::size_t>(i);
    const double lambda = core.faceLambda[part.faces[face]];
    faceMeasure[face] = lambda < widest && meet(pairs[face], cells.FaceVertices(face)) ? lambda : stays;
  }
  for (std::size_t face = 0; face < faceMeasure.size(); ++face)
  {
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      edgeMeasure[edge] = std::max(edgeMeasure[edge], faceMeasure[face]);
    }
  }
  std::vector<PointPair> around;
  for (std::size_t edge = 0; edge < edgeMeasure.size(); ++edge)
  {
    if (edgeMeasure[edge] < 0) // on no face
    {
      const double lambda = core.edgeLambda[part.edges[edge]];
      around.clear();
      AddPairsAround(input.edgePoints->Of(part.edges[edge]), around);
      const bool fringe = lambda < widest && std::all_of(around.begin(), around.end(), [&](const PointPair & pair) {
                            return meet(pair, cells.edges[edge]);
                          });
      edgeMeasure[edge] = fringe ? lambda : stays;
    }
    for (const ElementIndex end : cells.edges[edge])
    {
      vertexMeasure[end] = std::max(vertexMeasure[end], edgeMeasure[edge]);
    }
  }
  std::vector<PointPair>().swap(pairs);
  KeepLive(part, CollapsePart(part, std::move(vertexMeasure), std::move(edgeMeasure), std::move(faceMeasure), widest));
  return part;
}

} // namespace voxelcore
