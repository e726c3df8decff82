#pragma once
// The first point that the growing balls through a facet's circle meet, among points of which none lies in a ball so
// far: a tree of boxes, eight at a time.

#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** The spheres through the circle of a facet a, b, c, counter-clockwise seen from where is looked. With q from a and
 *  the weighted metric: height = (b - a) x (c - a) . q, which is exact, and q > 0 beyond the facet lies on the sphere
 *  whose centre is (|q|^2 - 2 m . q) / height * scale from m, the circle's centre. */
struct FacetSpheres
{
  LatticePoint          a{};
  std::array<double, 3> normal{};    ///< of height
  std::array<double, 3> twice{};     ///< of 2 m . q
  std::array<double, 3> squared{};   ///< squared weights
  std::array<double, 3> middle{};    ///< the circle's centre from a, in units of length
  std::array<double, 3> along{};     ///< the direction of growth, of length 1, in units of length
  double                circle2 = 0; ///< squared radius of the circle
  double                scale = 0;

  FacetSpheres(LatticePoint pa, LatticePoint pb, LatticePoint pc, const SpacingWeights & weights);

  /** Of the sphere through a point beyond the facet. */
  double
  SquaredRadius(const LatticePoint & q) const;
};

/** Boundary vertices, each with the direction in which the surface faces outwards there. */
class GrowingBallTree
{
public:
  struct Direction
  {
    std::array<float, 3> to{};
  };

  /** The points of a list, near ones side by side; outwards[i] belongs to the i-th and may be of any length, or 0.
   *  In a shape that surrounds its deep balls, directions let a branch be left out where its points lie in a thin layer
   *  that a ball only comes near. */
  void
  Build(const std::vector<LatticePoint> & points,
        std::span<const std::uint32_t>    chosen,
        std::span<const Direction>        outwards,
        const SpacingWeights &            weights);

  std::size_t
  Size() const
  {
    return m_Size;
  }

  /** The first point that is met beyond the facet, or all that are met at once, and maybe some that are met so little
   *  later that rounding does not tell; none where no point lies beyond. Looks first beside the points at some places
   *  of the list, and in the ball of the given radius. */
  void
  Find(const FacetSpheres &                 spheres,
       double                               radius,
       const std::array<std::uint32_t, 3> & near,
       std::vector<std::uint32_t> &         first);

private:
  static constexpr std::uint32_t lanes = 8;
  struct Boxes // of eight branches; in units of length, from the tree's origin
  {
    std::array<std::array<float, lanes>, 3> low;
    std::array<std::array<float, lanes>, 3> high;
    std::array<std::array<float, lanes>, 3> outwards; // of length 1, or 0
    std::array<float, lanes>                begin;    // no point lies below this along it
  };
  struct Leaf
  {
    std::array<std::array<std::int32_t, lanes>, 3> place; // from the tree's origin
    std::array<std::uint32_t, lanes>               point;
  };
  struct Look;

  void
  Descend(const std::array<std::uint32_t, 3> & near, Look & look) const;
  void
  SetBox(Boxes & boxes, std::size_t lane, std::size_t from, std::size_t to, std::span<const Direction> outwards);

  std::size_t                     m_Size = 0;
  LatticePoint                    m_Origin{};
  std::array<double, 3>           m_Weight{};
  double                          m_Extent = 0;  // of the box of all, in units of length
  double                          m_Longest = 0; // side of it, in lattice steps
  std::vector<Leaf>               m_Leaves;
  std::vector<std::vector<Boxes>> m_Levels; // the lowest has a box a leaf
  std::vector<std::uint32_t>      m_Met;
  std::vector<double>             m_Low;
};

} // namespace voxelcore
