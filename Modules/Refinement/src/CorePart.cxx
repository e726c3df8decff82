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
  CorePart left = PartOf(part.cells, collapse.Live());
  NameInWhole(part, left);
  return left;
}

} // namespace voxelcore
