#pragma once
// Skeletons of neurons: the cell's body as one ball that branches begin at.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <optional>
#include <vector>

namespace voxelcore
{

struct Soma
{
  Vector3 centre{}; ///< mm
  double  radius = 0;
};

/** Where a soma is. */
struct SomaChoice
{
  std::optional<Vector3> place; ///< mm, within it; none: the greatest ball
};

/** The greatest ball of a skeleton that holds a place; where none does, the one whose middle is nearest to it. Without
 *  a place the greatest of all. Of equals the first. None where there are no points. */
std::optional<Soma>
FindSoma(const SkeletonGraph & graph, const std::optional<Vector3> & place);

/** A skeleton whose lines end where they meet the soma's ball, and are joined to its middle, a node of its own. */
struct SomaTree
{
  SkeletonGraph        graph;
  std::size_t          root = 0; ///< node of the soma
  std::vector<LoopCut> cuts;     ///< of cycles that the soma closes
};

/** What lies in the ball is left out, as is what leaves it and comes back without a ball that is clear of it. Cycles
 *  through the soma alone are cut at their thinnest point; for others see CutLoops(). Faces that stay are left out
 *  where they reach into the ball. */
SomaTree
CutAtSoma(const SkeletonGraph & graph, const Soma & soma);

} // namespace voxelcore
