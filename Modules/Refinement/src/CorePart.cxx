#include "CorePart.h"

namespace voxelcore
{

CorePart
PartOf(const CellComplex & cells, const LiveElements & live)
{
  CorePart part;
  part.cells = ExtractLive(cells, live, part.vertices, part.edges, part.faces);
  return part;
}

CorePart
CollapsePart(const CorePart &            part,
             const std::vector<double> & vertexMeasure,
             const std::vector<double> & edgeMeasure,
             const std::vector<double> & faceMeasure,
             double                      threshold)
{
  SimplePairCollapse collapse(part.cells, vertexMeasure, edgeMeasure, faceMeasure);
  collapse.CollapseBelow(threshold);
  CorePart   left = PartOf(part.cells, collapse.Live());
  const auto ofWhole = [](const std::vector<ElementIndex> & ids, std::vector<ElementIndex> & some) {
    for (ElementIndex & id : some)
    {
      id = ids[id];
    }
  };
  ofWhole(part.vertices, left.vertices);
  ofWhole(part.edges, left.edges);
  ofWhole(part.faces, left.faces);
  return left;
}

} // namespace voxelcore
