#pragma once
// Branches as balls close to each other, and which branch a place is nearest to by these.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"
#include "voxelcore/VoxelCore/BallTree.h"

#include <memory>
#include <vector>

namespace voxelcore
{

/** Side of the cube with a voxel's diagonal, mm. */
double
VoxelSide(const ImageGeometry & geometry);

/** A branch as places less than half a voxel apart, in mm along the axes of the grid. */
struct DenseBranch
{
  std::vector<Vector3> places;
  std::vector<double>  radius;
  std::vector<double>  wide; ///< radius of the circle with the area of the section, or of the ball if that is more
  std::vector<double>  arc;
  std::vector<double>  arcOfPoint; ///< of the graph's points
  bool                 isClosed = false;

  double
  Length() const
  {
    return arc.back();
  }
};

std::vector<DenseBranch>
DenseBranches(const SkeletonGraph & graph, const ImageGeometry & geometry);

/** Which branch a place is nearest to: by the surfaces of the balls along branches. Thread-safe. */
class NearestBranch
{
public:
  /** `margin`: by so much another branch must be nearer, mm. */
  NearestBranch(const std::vector<DenseBranch> & branches, double margin);

  /** The first of those that are nearest. `hint`, from 0 on, may be kept for places next to each other. */
  ElementIndex
  Of(const Vector3 & place, std::size_t & hint, std::vector<std::uint32_t> & scratch) const;

  /** The branch that most of `places` are nearer to than to their own, by the margin. */
  ElementIndex
  Other(ElementIndex own, const std::vector<Vector3> & places) const;

private:
  double                                 m_Margin;
  std::vector<ElementIndex>              m_BranchOf; ///< by ball
  std::vector<std::unique_ptr<BallTree>> m_Own;      ///< by branch
  std::unique_ptr<BallTree>              m_All;
};

} // namespace voxelcore
