#pragma once
// A part of a core.

#include "voxelcore/ExtractPart.h"

namespace voxelcore
{

/** Elements of a complex as a complex of their own, and their indices in the other one. */
struct CorePart : PartElements
{
  CellComplex cells;
};

/** What `live` holds of a complex. */
CorePart
PartOf(const CellComplex & cells, const LiveElements & live);

/** What is left of a part when simple pairs below a threshold have gone, by measures of the part's own elements. */
CorePart
CollapsePart(const CorePart &            part,
             const std::vector<double> & vertexMeasure,
             const std::vector<double> & edgeMeasure,
             const std::vector<double> & faceMeasure,
             double                      threshold);

} // namespace voxelcore
