#pragma once
// The nearest of many places.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

struct NearPlace
{
  std::uint32_t index = 0; ///< of equally near ones the smallest
  double        squared = 0;
};

/** A k-d tree without nodes of its own (Bentley 1975): the middle place of each part parts the rest, by x, then y, then
 *  z. What it finds does not depend on how it is parted. Borrows the places. */
class PlaceTree
{
public:
  explicit PlaceTree(std::span<const Vector3> places);

  /** There must be one. */
  NearPlace
  Nearest(const Vector3 & to) const;

  /** Those nearer than `reach`, ascending. */
  void
  Within(const Vector3 & of, double reach, std::vector<std::uint32_t> & found) const;

private:
  void
  Build(std::size_t first, std::size_t last, std::size_t axis);
  void
  Descend(std::size_t first, std::size_t last, std::size_t axis, const Vector3 & to, NearPlace & least) const;
  void
  Gather(std::size_t                  first,
         std::size_t                  last,
         std::size_t                  axis,
         const Vector3 &              of,
         double                       squared,
         std::vector<std::uint32_t> & found) const;

  std::span<const Vector3>   m_Places;
  std::vector<std::uint32_t> m_Order;
};

} // namespace voxelcore
