#pragma once
// The nearest boundary square of a voxel shape.

#include "NearSquares.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <vector>

namespace voxelcore
{

/** A balanced tree of boxes over the squares between a voxel that is in and one that is out. */
class SquareTree
{
public:
  SquareTree(const VoxelShape & shape, const SpacingWeights & weights);

  /** Distance of a place in lattice coordinates to the nearest square, in units of the weights' lattice; `within` when
   *  none is nearer. */
  double
  Distance(const Vector3 & place, double within) const;

private:
  struct Bounds
  {
    std::array<float, 3> least;
    std::array<float, 3> greatest;
  };

  void
  Build(std::size_t node, std::size_t first, std::size_t last);
  void
  Descend(std::size_t node, std::size_t first, std::size_t last, const Vector3 & place, double & least) const;
  double
  ToBounds(const Bounds & bounds, const Vector3 & place) const;

  Vector3                     m_Weights;
  std::vector<BoundarySquare> m_Squares;
  std::vector<Bounds>         m_Bounds; ///< of node n's children: 2 n + 1 and 2 n + 2
};

} // namespace voxelcore
