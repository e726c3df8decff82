#pragma once
// The surface that the balls about all places of a core have together, those between its vertices included.

#include "voxelcore/BallTree.h"
#include "voxelcore/CellComplex.h"
#include "voxelcore/InscribedBalls.h"
#include "voxelcore/SpacingWeights.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** What lies nearest to a place; lengths in mm. */
struct NearestBall
{
  std::uint32_t vertex = 0;     ///< whose ball is the nearest of those about vertices
  double        gap = 0;        ///< to the ball's surface, below 0 inside
  double        distance = 0;   ///< from the ball's centre
  Vector3       way{ 0, 0, 0 }; ///< unit length, from the ball's centre to the place; zero there
};

/** Balls of the vertices of a complex whose faces are triangles, all borrowed; between vertices centres and radii
 *  change evenly. Looks at the edges and faces of the vertex with the nearest ball, not at others. Thread-safe. */
class BallEnvelope
{
public:
  BallEnvelope(const CellComplex & cells, const PaintingBalls & balls, const SpacingWeights & weights);

  /** `likely` is kept from one place to the next, 0 to begin with. Places in lattice coordinates. */
  NearestBall
  Find(const Vector3 & place, std::size_t & likely) const;

private:
  const CellComplex &        m_Cells;
  const PaintingBalls &      m_Balls;
  Vector3                    m_Sides{}; ///< mm a lattice unit
  BallTree                   m_Tree;
  std::vector<std::uint64_t> m_Begin; ///< per vertex, of what is at it
  std::vector<ElementIndex>  m_At;    ///< faces or, behind them, edges without faces: their number + edge
};

} // namespace voxelcore
