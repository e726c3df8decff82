#pragma once
// The balls of a whole voxel core that lie in the shape (voxelcore/Thickness/InscribedBalls.h), slab by slab: there are
// ten times as many as core vertices, so that only those of a slab are held at a time.

#include "CoreBalls.h"
#include "NearSquares.h"

#include "voxelcore/Thickness/InscribedBalls.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** `core` and the shape must outlive it. */
class InscribedBalls
{
public:
  InscribedBalls(const VoxelShape & shape, const CoreBalls & core, const SpacingWeights & weights);

  /** Those that meet z = `low` to `high` in lattice coordinates, in mm: of the same ones in the same order for every
   *  slab. */
  PaintingBalls
  Find(double low, double high) const;

private:
  class Squares;

  int
  PiecesOfEdge(const std::array<std::uint32_t, 2> & ends) const;
  double
  SticksOut(const Vector3 & centre, double radius, const Vector3 & otherCentre, double otherRadius) const;
  bool
  HoldsMiddle(const Vector3 & centre, double radius) const;
  template <typename TMeets>
  void
  AddAlongEdge(std::size_t facet, const Squares & squares, const TMeets & meets, PaintingBalls & balls) const;

  const CoreBalls &   m_Core;
  NearSquares         m_NearSquares;
  std::vector<double> m_Radius;     ///< r of each core vertex
  std::vector<char>   m_IsNeedless; ///< whether its ball lies in a neighbour's
};

} // namespace voxelcore
