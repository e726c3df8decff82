#include "voxelcore/Shape/BoundaryVertices.h"

#include "CornerRows.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Shape/ShapeBits.h"

#include <array>
#include <bit>
#include <numeric>

namespace voxelcore
{

namespace
{

// Calls visit(y, z, word, bits) for every word of lattice corners in layers firstZ to lastZ - 1 that holds boundary
// vertices, in scan order; y and z are box-relative lattice rows, bit b of word w is the corner at box-relative
// x = 64 w + b.
template <typename TVisit>
void
VisitBoundaryWords(const VoxelShape & shape, std::int32_t firstZ, std::int32_t lastZ, TVisit visit)
{
  const auto &      size = shape.Box().size;
  const std::size_t words = shape.WordsPerRow();
  if (words == 0 || size[1] == 0 || size[2] == 0)
  {
    return;
  }
  CornerRows around(shape);
  for (std::int32_t z = firstZ; z < lastZ; ++z)
  {
    for (std::int32_t y = 0; y <= size[1]; ++y)
    {
      around.MoveTo(y, z);
      for (const std::uint32_t word : around.Words())
      {
        const std::uint64_t boundary = MixedCorners(around.rows, word);
        if (boundary != 0)
        {
          visit(y, z, word, boundary);
        }
      }
      // Only when the box is a multiple of 64 wide: the corner behind its last voxel.
      if (MixedCorners(around.rows, words) != 0)
      {
        visit(y, z, words, std::uint64_t{ 1 });
      }
    }
  }
}

std::uint64_t
CountInLayers(const VoxelShape & shape, std::int32_t firstZ, std::int32_t lastZ)
{
  std::uint64_t count = 0;
  VisitBoundaryWords(shape, firstZ, lastZ, [&](std::int32_t, std::int32_t, std::size_t, std::uint64_t bits) {
    count += CountBits(bits);
  });
  return count;
}

} // namespace

std::uint64_t
CountBoundaryVertices(const VoxelShape & shape)
{
  return CountInLayers(shape, 0, shape.Box().size[2] + 1);
}

std::vector<LatticePoint>
BoundaryVertices(const VoxelShape & shape)
{
  constexpr std::size_t     slabs = 64;
  const auto &              lower = shape.Box().lower;
  const auto &              size = shape.Box().size;
  std::vector<LatticePoint> points;
  const bool                worthIt =
    shape.WordsPerRow() * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) > 10000;
  const auto firstLayer = [&](std::size_t slab) {
    return static_cast<std::int32_t>((static_cast<std::size_t>(size[2]) + 1) * slab / slabs);
  };
  std::array<std::size_t, slabs + 1> start{}; // of each slab's points
  RunInParts(worthIt, slabs, [&](std::size_t first, std::size_t last) {
    for (std::size_t slab = first; slab < last; ++slab)
    {
      start[slab + 1] = CountInLayers(shape, firstLayer(slab), firstLayer(slab + 1));
    }
  });
  std::partial_sum(start.begin(), start.end(), start.begin());
  points.resize(start.back());
  RunInParts(worthIt, slabs, [&](std::size_t first, std::size_t last) {
    LatticePoint * to = points.data() + start[first];
    VisitBoundaryWords(shape,
                       firstLayer(first),
                       firstLayer(last),
                       [&](std::int32_t y, std::int32_t z, std::size_t word, std::uint64_t bits) {
                         for (; bits != 0; bits &= bits - 1)
                         {
                           const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits);
                           *to++ = { lower[0] + x, lower[1] + y, lower[2] + z };
                         }
                       });
  });
  return points;
}

} // namespace voxelcore
