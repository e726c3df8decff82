#pragma once
// The nearest point on a set of triangles.

#include "voxelcore/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace voxelcore
{

/** A tree of boxes over triangles; degenerate ones stand for segments and points. O(n log n) to build, about 100 bytes
 *  a triangle. Thread-safe once built; of equally near triangles the one of smallest index is found. */
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
  struct Box
  {
    Vector3 lower;
    Vector3 upper;
  };

  void
  Build(std::size_t node, std::size_t first, std::size_t last, const std::map<std::size_t, std::size_t> & nodes);
  void
  LookAt(std::uint32_t triangle, const Vector3 & place, Nearest & best) const;
  void
  Descend(std::size_t node, std::size_t first, std::size_t last, const Vector3 & place, Nearest & best) const;

  std::vector<std::array<Vector3, 3>> m_Corners; ///< by index
  std::vector<std::uint32_t>          m_Order;   ///< of the leaves
  std::vector<Box>                    m_Boxes;   ///< pre-order; the right child follows the left one's subtree
  std::vector<std::uint32_t>          m_Right;   ///< node of the right child
};

/** The point of a triangle that is nearest to `place` (Ericson, Real-Time Collision Detection, 5.1.5). */
Vector3
NearestOnTriangle(const Vector3 & place, const std::array<Vector3, 3> & corners);

} // namespace voxelcore
