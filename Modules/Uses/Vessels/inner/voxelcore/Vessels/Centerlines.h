#pragma once
// Lines from inlets to all tips, split into tracts and grouped as VMTK has it: Antiga and Steinman, IEEE Trans Med
// Imaging 23 (2004), page 704; www.vmtk.org/tutorials/BranchSplitting.html.

#include "voxelcore/Vessels/FlowTree.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A piece of a centerline. A centerline leads from an inlet along the tree of thickest branches (FlowTree) to a tip.
 *  Where others part from it there is a bifurcation: it ends where the line has left the tubes of all of these, a tube
 *  being the balls along a line. It begins one ball upstream, which is where the ball reaches as far as that place, but
 *  at the junction at the latest. Bifurcations that overlap on a line are one. So each line is cut into tracts, in turn
 *  outside bifurcations and in them.
 *
 *  A group is a branch, with the tracts of all lines that run through it, or a bifurcation, with those of all that pass
 *  it. */
struct CenterlineTract
{
  std::int64_t centerline = 0;    ///< VMTK's CenterlineIds: lines from 0, by component and tip
  std::int64_t tract = 0;         ///< TractIds: along the line from 0
  std::int64_t group = 0;         ///< GroupIds: from 0, in the order of their first tracts
  bool         isBlanked = false; ///< Blanking: in a bifurcation
  std::int64_t label = 0;         ///< of the line's branch at the tip

  std::vector<Vector3> places; ///< LPS mm, from the inlet on; the next tract begins where this one ends
  std::vector<double>  radius; ///< of balls: MaximumInscribedSphereRadius
};

/** Those of all skeletons; `inlets` as FindInlets() gives them. */
std::vector<CenterlineTract>
SplitCenterlines(const std::vector<MeasuredSkeleton> & parts, const std::vector<std::vector<ElementIndex>> & inlets);

} // namespace voxelcore
