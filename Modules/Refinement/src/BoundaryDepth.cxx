#include "BoundaryDepth.h"

#include "DistanceTile.h"

#include "voxelcore/EightLanes.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kVoxelsAlong = 2 * BrickGrid::kSide; ///< of a brick
constexpr std::int32_t kDeepest = 16;
constexpr std::int32_t kDepthTile = 2 * kVoxelsAlong;
using DepthRows = tile::Rows<kDepthTile, kDeepest>;

VOXELCORE_EIGHT_LANES void
FindDistances(const DepthRows & rows, const std::array<float, 3> & squares, tile::Squared<kDepthTile> & least)
{
  tile::FindSquaredDistances(rows, squares, least);
}

// Whether a box of so many voxels on either side fits in the shape about a voxel of a brick of cells.
bool
FitsIn(const VoxelShape & shape, const BrickGrid::Brick & at, const BrickGrid::Brick & beside)
{
  constexpr std::int32_t side = kVoxelsAlong;
  constexpr std::int32_t most = 8;
  const BrickGrid::Brick first{ side * at[0] - beside[0], side * at[1] - beside[1], side * at[2] - beside[2] };
  std::array<std::uint64_t, (side + 2 * most) * (side + 2 * most)> rows;
  const std::int32_t                                               ny = side + 2 * beside[1];
  const std::int32_t                                               nz = side + 2 * beside[2];
  const auto row = [&](std::int32_t y, std::int32_t z) -> std::uint64_t & {
    return rows[static_cast<std::size_t>(z * ny + y)];
  };
  std::uint64_t any = 0;
  for (std::int32_t z = 0; z < nz; ++z)
  {
    for (std::int32_t y = 0; y < ny; ++y)
    {
      const std::uint64_t bits = BitsOfRow(shape, first[0], first[1] + y, first[2] + z);
      std::uint64_t       all = bits;
      for (std::int32_t k = 1; k <= 2 * beside[0]; ++k)
      {
        all &= bits >> k;
      }
      row(y, z) = all & 0xFFFF;
      any |= row(y, z);
    }
  }
  if (any == 0)
  {
    return false;
  }
  for (std::int32_t z = 0; z < nz; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      for (std::int32_t k = 1; k <= 2 * beside[1]; ++k)
      {
        row(y, z) &= row(y + k, z);
      }
    }
  }
  for (std::int32_t z = 0; z < side; ++z)
  {
    for (std::int32_t y = 0; y < side; ++y)
    {
      std::uint64_t all = row(y, z);
      for (std::int32_t k = 1; k <= 2 * beside[2]; ++k)
      {
        all &= row(y, z + k);
      }
      if (all != 0)
      {
        return true;
      }
    }
  }
  return false;
}

// A ball of `radius` units has a box about its centre.
std::vector<std::uint8_t>
NearBalls(const VoxelShape & shape, const BrickGrid & grid, const Vector3 & sides, double radius)
{
  constexpr int    rings = 4; // two that zones ask for what is in, and two more for what is out
  BrickGrid::Brick beside{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    beside[axis] = std::min(8, static_cast<std::int32_t>(0.99 * radius / (std::sqrt(3.0) * sides[axis])));
  }
  const auto                count = static_cast<std::ptrdiff_t>(grid.Count());
  std::vector<std::uint8_t> near(grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    near[brick] = FitsIn(shape, grid.At(brick), beside) ? 1 : 0;
  }
  for (int ring = 0; ring < rings; ++ring)
  {
    near = grid.AndAround(near);
  }
  return near;
}

} // namespace

BoundaryDepth::BoundaryDepth(const VoxelShape &            shape,
                             std::span<const LatticePoint> points,
                             const Vector3 &               sides,
                             double                        reach,
                             double                        radius)
  : m_Grid(shape, points, 1, static_cast<std::int32_t>(std::ceil(reach)))
  , m_Squares(AddScaled({ 0, 0, 0 }, 4, Times(sides, sides)))
  , m_Depths(m_Grid.Count() * BrickGrid::kCells)
{
  const auto  squares = tile::AsFloats(Times(sides, sides));
  const float half = 0.5F * static_cast<float>(std::min({ sides[0], sides[1], sides[2] }));
  tile::ForTiles(m_Grid, NearBalls(shape, m_Grid, sides, radius), [&](const BrickGrid::Brick & tile, auto forBricks) {
    auto in = std::make_unique<DepthRows>();
    auto out = std::make_unique<DepthRows>();
    ReadRows(shape,
             { kDepthTile * tile[0] - kDeepest, kDepthTile * tile[1] - kDeepest, kDepthTile * tile[2] - kDeepest },
             *in,
             *out);
    auto toIn = std::make_unique<tile::Squared<kDepthTile>>();
    auto toOut = std::make_unique<tile::Squared<kDepthTile>>();
    FindDistances(*in, squares, *toIn);
    FindDistances(*out, squares, *toOut);
    forBricks([&](std::size_t brick, const BrickGrid::Brick & part) {
      for (std::size_t cell = 0; cell < BrickGrid::kCells; ++cell)
      {
        Depth & depth = m_Depths[brick * BrickGrid::kCells + cell];
        for (std::size_t corner = 0; corner < 8; ++corner)
        {
          const std::size_t x = 16 * part[0] + 2 * (cell & 7) + (corner & 1);
          const std::size_t y = 16 * part[1] + 2 * (cell >> 3 & 7) + (corner >> 1 & 1);
          const std::size_t z = 16 * part[2] + 2 * (cell >> 6) + (corner >> 2);
          const std::size_t voxel = x + kDepthTile * (y + kDepthTile * z);
          const bool        inside = (*toIn)[voxel] == 0;
          const float       distance = std::sqrt(inside ? (*toOut)[voxel] : (*toIn)[voxel]) - half;
          depth.mean += (inside ? distance : -distance) / 8;
          float & deepest = inside ? depth.inside : depth.outside;
          deepest = std::max(deepest, distance);
        }
      }
    });
  });
}

} // namespace voxelcore
