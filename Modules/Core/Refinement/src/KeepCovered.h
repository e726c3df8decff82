#pragma once
// What pruning by tolerance promises of the boundary, kept when what is left is refined.

#include "PointTree.h"

#include "voxelcore/Refinement/Refinement.h"
#include "voxelcore/VoxelCore/BallTree.h"

#include <cstddef>
#include <vector>

namespace voxelcore
{

/** Where the balls of a part were before they were refined. */
struct FormerBalls
{
  std::vector<Vector3> positions; ///< lattice coordinates
  std::vector<double>  radius;    ///< mm
};

/** How far each boundary vertex may lie from the balls, mm. */
class ToleranceAt
{
public:
  /** `weights`: ToleranceWeights() of the boundary vertices, which must outlive the object. */
  ToleranceAt(double height, const std::vector<double> & weights)
    : m_Height(height)
    , m_Weights(weights)
  {}

  double
  operator()(std::size_t point) const
  {
    return m_Weights.empty() ? m_Height : m_Height / m_Weights[point];
  }

private:
  double                      m_Height;
  const std::vector<double> & m_Weights;
};

/** The balls of a refined core, and which one of them covers each boundary vertex. */
struct CoveredBoundary
{
  static constexpr std::uint32_t kOpen = 0xFFFFFFFF; ///< none does

  BallTree                   balls;
  std::vector<std::uint32_t> ball;
  std::vector<ElementIndex>  back; ///< the vertices that have gone back, ascending
};

/** Takes back of moves and radii what leaves a boundary vertex farther than its tolerance from all balls that lay
 *  within it of a ball before. Of the balls that kept it the one goes back that has least to, in sixteenths of its way;
 *  radii stay within half a voxel's diagonal of the distance of the nearest boundary vertex, vertices in the shape,
 *  triangles unturned. The same bits for every number of threads. */
CoveredBoundary
KeepBoundaryCovered(const RefinementInput & input,
                    const PointTree &       boundary,
                    const ToleranceAt &     tolerance,
                    const FormerBalls &     former,
                    RefinedCore &           refined);

} // namespace voxelcore
