#pragma once
// How far places in a shape are from the estimate of its surface.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/VoxelCore/BallTree.h"

#include <memory>
#include <span>
#include <vector>

namespace voxelcore
{

/** Each boundary vertex has the surface within half a voxel's diagonal, and the surface one of them. So the surface is
 *  nearest about where it passes the boundary vertex whose place on it is nearest, and is followed from there. A
 *  boundary vertex where there is no estimate stands for it. */
class SurfaceDistance
{
public:
  /** `spacing` in mm; `boundary`: all of the shape's boundary vertices, which need not outlive it. */
  SurfaceDistance(std::shared_ptr<const SurfaceEstimate> surface,
                  std::span<const LatticePoint>          boundary,
                  const Vector3 &                        spacing);

  /** mm, from a place in lattice coordinates; infinite without boundary vertices. Thread-safe, and the same bits for
   *  every number of threads. */
  double
  From(const Vector3 & place) const;

  /** The radius, mm, at a place in lattice coordinates, of a ball that had `radius` where its middle was before: it
   *  changes as the distance from the surface does. */
  double
  RadiusAt(const Vector3 & place, double radius, const Vector3 & before) const;

private:
  std::shared_ptr<const SurfaceEstimate> m_Surface;
  Vector3                                m_Spacing;
  double                                 m_Reach; ///< mm
  std::vector<SurfacePoint>              m_Feet;  ///< of the boundary vertices
  BallTree                               m_Tree;  ///< of these
};

} // namespace voxelcore
