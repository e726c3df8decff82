#pragma once
// The nearest point on a set of triangles.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** A tree of boxes over triangles, eight to a node, and eight triangles to a leaf; degenerate ones stand for segments
 *  and points. O(n log n) to build, about 150 bytes a triangle. Thread-safe once built; of equally near triangles the
 *  one of smallest index is found. */
class TriangleTree
{
public:
  struct Nearest
  {
    Vector3       point{};
    double        squaredDistance = 0;
    std::uint32_t triangle = 0;
  };

  static constexpr std::uint32_t kNoTriangle = 0xFFFFFFFF;

  /** Below 2^32 triangles. */
  TriangleTree(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);

  std::size_t
  TriangleCount() const
  {
    return m_Corners.size();
  }

  /** The point nearest to `place`, of equally near triangles on the first; squaredDistance is `within`^2 when none is
   *  nearer than `within`. Sooner found when a triangle that is `likely` near is named; then it is the same. */
  Nearest
  FindNearest(const Vector3 & place, double within, std::uint32_t likely = kNoTriangle) const;

  /** Not normalised; (0,0,0) for a degenerate triangle. */
  Vector3
  Normal(std::uint32_t triangle) const;

private:
  static constexpr std::size_t kLanes = 8;
  using Lanes = std::array<float, kLanes>;

  // Single precision, relative to m_Middle. Nothing seems farther away than it is but by roundings.
  struct Boxes
  {
    std::array<Lanes, 3> lower; ///< by axis
    std::array<Lanes, 3> upper;
  };
  // Of each triangle the plane that it lies in and those through its sides at right angles to it, normals outwards: the
  // first three are a normal, the fourth what the middle is behind the plane. All 0 where it is no triangle.
  struct Leaf
  {
    std::array<std::array<Lanes, 4>, 4> planes;
    std::array<std::uint32_t, kLanes>   triangles; ///< kNoTriangle: none
  };
  struct Search;

  void
  Order(std::size_t first, std::size_t last, std::vector<std::uint32_t> & order) const;
  Leaf
  LeafOf(std::span<const std::uint32_t> triangles) const;
  void
  AddLevels();
  void
  LookAt(std::uint32_t triangle, const Vector3 & place, Nearest & best) const;

  std::vector<std::array<Vector3, 3>> m_Corners; ///< by index
  std::vector<Leaf>                   m_Leaves;
  std::vector<std::vector<Boxes>>     m_Levels; ///< of leaves, of what is in those boxes, and so on up to one of all
  Vector3                             m_Middle{};
  double                              m_Extent = 0; ///< along an axis from the middle to what is farthest
};

/** The point of a triangle that is nearest to `place` (Ericson, Real-Time Collision Detection, 5.1.5). */
Vector3
NearestOnTriangle(const Vector3 & place, const std::array<Vector3, 3> & corners);

} // namespace voxelcore
