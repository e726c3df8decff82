#pragma once
// The nearest boundary square of a voxel shape.

#include "voxelcore/ImageGeometry.h"
#include "voxelcore/SpacingWeights.h"
#include "voxelcore/VoxelShape.h"

#include <array>
#include <cstdint>
#include <span>
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

  /** Adds the squares nearer than `within` to a list. */
  void
  Nearer(const Vector3 & place, double within, std::vector<std::uint32_t> & squares) const;

  /** Distance of a place to the nearest of some squares; `within` when none is nearer. */
  double
  DistanceTo(std::span<const std::uint32_t> squares, const Vector3 & place, double within) const;

private:
  /** Twice the lattice coordinates of its middle; the axis it is normal to has the even coordinate of the lattice, the
   *  others odd ones. */
  using Square = std::array<std::int32_t, 3>;
  struct Bounds
  {
    std::array<float, 3> least;
    std::array<float, 3> greatest;
  };

  void
  Build(std::size_t node, std::size_t first, std::size_t last);
  void
  Descend(std::size_t node, std::size_t first, std::size_t last, const Vector3 & place, double & least) const;
  void
  Collect(std::size_t                  node,
          std::size_t                  first,
          std::size_t                  last,
          const Vector3 &              place,
          double                       squared,
          std::vector<std::uint32_t> & squares) const;
  double
  ToBounds(const Bounds & bounds, const Vector3 & place) const;
  double
  ToSquare(const Square & square, const Vector3 & place) const;

  Vector3             m_Weights;
  std::vector<Square> m_Squares;
  std::vector<Bounds> m_Bounds; ///< of node n's children: 2 n + 1 and 2 n + 2
};

} // namespace voxelcore
