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

void
KeepLive(CorePart & part, const LiveElements & live)
{
  PartElements kept;
  KeepLive(part.cells, live, kept.vertices, kept.edges, kept.faces);
  NameInWhole(part, kept);
  static_cast<PartElements &>(part) = std::move(kept);
}

// NOLINTBEGIN(performance-unnecessary-value-param): taken, so that they are gone before more is made of what is left
LiveElements
CollapsePart(const CorePart &    part,
             std::vector<double> vertexMeasure,
             std::vector<double> edgeMeasure,
             std::vector<double> faceMeasure,
             double              threshold)
// NOLINTEND(performance-unnecessary-value-param)
{
  SimplePairCollapse collapse(part.cells, vertexMeasure, edgeMeasure, faceMeasure);
  collapse.CollapseBelow(threshold);
  return std::move(collapse).TakeLive();
}

} // namespace voxelcore
