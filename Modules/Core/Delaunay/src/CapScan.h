#pragma once
// The boundary vertices in the part of a ball beyond a plane, many rows at a time.

#include <array>
#include <cstddef>
#include <cstdint>

namespace voxelcore
{

/** A ball and a plane, in coordinates from the corner of a box of at most 16^3 lattice points that holds the part of
 *  the ball beyond the plane. The plane cuts the ball in the circle through which all spheres of a pencil go. */
struct Cap
{
  const std::uint64_t * rows = nullptr;  ///< of the vertices' bits at the box's corner; a layer on is 64 rows on
  unsigned              firstColumn = 0; ///< bit of the box's corner in its rows
  std::int32_t          rowCount = 0;    ///< up to 16; up to 7 more are read
  std::int32_t          layerCount = 0;  ///< up to 16
  std::array<float, 3>  centre{};        ///< of the ball
  std::array<float, 3>  weight{};
  float                 radius2 = 0.0F; ///< of the ball, a little grown
  std::array<float, 3>  normal{};       ///< integers: height = normal . q + cornerHeight
  float                 cornerHeight = 0.0F;
  std::array<float, 3>  middle{}; ///< of the circle
  float                 circle2 = 0.0F;
};

/** What a scan finds: vertex i is column x, row y and layer z of the box in place[i] = x + 16 y + 256 z. They are those
 *  beyond the plane that may have the least (|q - middle|^2 - circle2) / height of the cap, which orders the spheres of
 *  the pencil; and maybe some that are a rounding outside of it. */
struct CapVertices
{
  std::size_t                     count = 0;
  std::array<std::uint16_t, 4096> place;
};

void
ScanCap(const Cap & cap, CapVertices & found);

} // namespace voxelcore
