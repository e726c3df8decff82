#include "ContactPlaces.h"

#include "CornerRows.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <bit>

namespace voxelcore
{

namespace
{

using Corner = std::array<std::int32_t, 3>;

/** 64 corners at a time: bits where the eight are not well-composed. `at[j + 2 k]` are voxels x of the four rows,
 *  `before[j + 2 k]` those at x - 1. */
std::uint64_t
ContactBits(const std::array<std::uint64_t, 4> & before, const std::array<std::uint64_t, 4> & at)
{
  // Two that face each other over the middle of a face are alike, and the other two of that face are not.
  const auto diagonal = [](std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
    return (a ^ b) & (a ^ c) & ~(a ^ d);
  };
  std::uint64_t bad = diagonal(before[0], before[1], before[2], before[3]) | diagonal(at[0], at[1], at[2], at[3]) |
                      diagonal(before[0], at[0], before[1], at[1]) | diagonal(before[2], at[2], before[3], at[3]) |
                      diagonal(before[0], at[0], before[2], at[2]) | diagonal(before[1], at[1], before[3], at[3]);
  // Or two across the corner differ from the six others.
  std::array<std::uint64_t, 4> both;
  std::array<std::uint64_t, 4> none;
  for (std::size_t i = 0; i < 4; ++i)
  {
    both[i] = before[i] & at[3 - i];
    none[i] = ~before[i] & ~at[3 - i];
  }
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::size_t a = (i + 1) % 4;
    const std::size_t b = (i + 2) % 4;
    const std::size_t c = (i + 3) % 4;
    bad |= (both[i] & none[a] & none[b] & none[c]) | (none[i] & both[a] & both[b] & both[c]);
  }
  return bad;
}

} // namespace

std::vector<std::array<std::int32_t, 3>>
FindContacts(const VoxelShape & shape)
{
  const auto &                     size = shape.Box().size;
  std::vector<std::vector<Corner>> layers(static_cast<std::size_t>(size[2]));
  RunInParts(shape.WordsPerRow() * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) > 10000,
             layers.size(),
             [&](std::size_t first, std::size_t last) {
               CornerRows around(shape);
               for (std::size_t layer = first; layer < last; ++layer)
               {
                 const auto z = static_cast<std::int32_t>(layer);
                 // Corners on the box's far sides need no look: two voxels that meet there over an edge do so at its
                 // other end, too.
                 for (std::int32_t y = 0; y < size[1]; ++y)
                 {
                   around.MoveTo(y, z);
                   for (const std::uint32_t word : around.Words())
                   {
                     std::array<std::uint64_t, 4> at;
                     std::array<std::uint64_t, 4> before;
                     for (std::size_t i = 0; i < 4; ++i)
                     {
                       at[i] = around.rows[i][word];
                       before[i] = at[i] << 1 | (word > 0 ? around.rows[i][word - 1] >> 63 : 0);
                     }
                     for (std::uint64_t bad = ContactBits(before, at); bad != 0; bad &= bad - 1)
                     {
                       layers[layer].push_back({ static_cast<std::int32_t>(64 * word) + std::countr_zero(bad), y, z });
                     }
                   }
                 }
               }
             });
  std::vector<Corner> places;
  for (const std::vector<Corner> & layer : layers)
  {
    places.insert(places.end(), layer.begin(), layer.end());
  }
  return places;
}

} // namespace voxelcore
