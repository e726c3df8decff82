#include "ErosionPruning.h"

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Skeleton/ErosionThickness.h"

namespace voxelcore::evaluation
{

std::vector<MedialComplex>
PruneByErosionThickness(const MedialComplex &       core,
                        const SpacingWeights &      weights,
                        double                      voxel,
                        const std::vector<double> & thresholds)
{
  MedialComplex physical = core;
  for (auto & position : physical.positions)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      position[k] *= weights.unit * static_cast<double>(weights.weight[k]);
    }
  }
  BurnTimes  thickness = ComputeBurnTimes(physical, 1.5 * voxel);
  const auto subtract = [&core](double & value, const auto & corners) {
    for (const ElementIndex corner : corners)
    {
      value -= core.radius[corner] / static_cast<double>(corners.size());
    }
  };
  for (std::size_t vertex = 0; vertex < thickness.vertices.size(); ++vertex)
  {
    thickness.vertices[vertex] -= core.radius[vertex];
  }
  for (std::size_t edge = 0; edge < thickness.edges.size(); ++edge)
  {
    subtract(thickness.edges[edge], core.cells.edges[edge]);
  }
  for (std::size_t face = 0; face < thickness.faces.size(); ++face)
  {
    subtract(thickness.faces[face], core.cells.FaceVertices(face));
  }
  SimplePairCollapse         collapse(core.cells, thickness.vertices, thickness.edges, thickness.faces);
  std::vector<MedialComplex> pruned;
  for (const double threshold : thresholds)
  {
    collapse.CollapseBelow(threshold);
    std::vector<ElementIndex> vertices;
    std::vector<ElementIndex> edges;
    std::vector<ElementIndex> faces;
    MedialComplex             part;
    part.cells = ExtractLive(core.cells, collapse.Live(), vertices, edges, faces);
    for (const ElementIndex vertex : vertices)
    {
      part.positions.push_back(core.positions[vertex]);
      part.radius.push_back(core.radius[vertex]);
    }
    pruned.push_back(std::move(part));
  }
  return pruned;
}

} // namespace voxelcore::evaluation
