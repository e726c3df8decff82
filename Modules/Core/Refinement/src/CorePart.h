#pragma once
// A part of a core.

#include "voxelcore/VoxelCore/ExtractPart.h"

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

/** Keeps of a part, with the names of its elements, what is live of it. */
void
KeepLive(CorePart & part, const LiveElements & live);

/** What is left of a part when simple pairs below a threshold have gone, by measures of the part's own elements, which
 *  are freed. */
LiveElements
CollapsePart(const CorePart &    part,
             std::vector<double> vertexMeasure,
             std::vector<double> edgeMeasure,
             std::vector<double> faceMeasure,
             double              threshold);

} // namespace voxelcore
