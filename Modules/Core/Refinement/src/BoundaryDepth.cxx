#include "BoundaryDepth.h"

#include "DistanceTile.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kVoxelsAlong = 2 * BrickGrid::kSide; ///< of a brick
constexpr std::int32_t kDeepest = 16;
constexpr std::int32_t kDepthTile = BoundaryDepth::kTile;
static_assert(kDepthTile == 2 * kVoxelsAlong);
using DepthCube = tile::Cube<kDepthTile, kDeepest>;

VOXELCORE_EIGHT_LANES void
FindDistances(DepthCube & cube, const std::array<float, 3> & squares)
{
  tile::FindSquaredDistances(cube.in, squares, cube.toIn);
  tile::FindSquaredDistances(cube.out, squares, cube.toOut);
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
                             const std::array<double, 2> & radii,
                             const UseDistances &          use)
  : m_Grid(shape, points, 1, static_cast<std::int32_t>(std::ceil(radii[1])))
  , m_Squares(AddScaled({ 0, 0, 0 }, 4, Times(sides, sides)))
  , m_Places(m_Grid.Count(), kNone)
{
  constexpr double                steps = 0.5; // what distances to centres are off by
  const auto                      squares = tile::AsFloats(Times(sides, sides));
  const float                     half = 0.5F * static_cast<float>(std::min({ sides[0], sides[1], sides[2] }));
  const std::vector<std::uint8_t> near = NearBalls(shape, m_Grid, sides, radii[0]);
  std::uint32_t                   count = 0;
  for (std::size_t brick = 0; brick < near.size(); ++brick)
  {
    m_Places[brick] = near[brick] != 0 ? count++ : kNone;
  }
  m_Means.resize(count);
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    m_Centres[i].inside.resize(m_Grid.Count());
    m_Centres[i].outside.resize(m_Grid.Count());
  }
  tile::ForTiles<DepthCube>(m_Grid, near, [&](const BrickGrid::Brick & tile, DepthCube & cube, auto forBricks) {
    ReadRows(shape,
             { kDepthTile * tile[0] - kDeepest, kDepthTile * tile[1] - kDeepest, kDepthTile * tile[2] - kDeepest },
             cube.in,
             cube.out);
    FindDistances(cube, squares);
    forBricks([&](std::size_t brick, const BrickGrid::Brick & part) {
      for (std::size_t cell = 0; cell < BrickGrid::kCells; ++cell)
      {
        float mean = 0;
        float inside = 0;
        float outside = 0;
        for (std::size_t corner = 0; corner < 8; ++corner)
        {
          const std::size_t x = 16 * part[0] + 2 * (cell & 7) + (corner & 1);
          const std::size_t y = 16 * part[1] + 2 * (cell >> 3 & 7) + (corner >> 1 & 1);
          const std::size_t z = 16 * part[2] + 2 * (cell >> 6) + (corner >> 2);
          const std::size_t voxel = x + kDepthTile * (y + kDepthTile * z);
          const bool        in = cube.toIn[voxel] == 0;
          const float       distance = std::sqrt(in ? cube.toOut[voxel] : cube.toIn[voxel]) - half;
          mean += (in ? distance : -distance) / 8;
          float & deepest = in ? inside : outside;
          deepest = std::max(deepest, distance);
        }
        m_Means[m_Places[brick]][cell] = mean;
        for (std::size_t i = 0; i < radii.size(); ++i)
        {
          const auto bit = static_cast<std::uint8_t>(1U << (cell & 7));
          const auto least = static_cast<float>(radii[i] - steps);
          m_Centres[i].inside[brick][cell >> 3] |= inside >= least ? bit : std::uint8_t{ 0 };
          m_Centres[i].outside[brick][cell >> 3] |= outside >= least ? bit : std::uint8_t{ 0 };
        }
      }
    });
    use(tile, cube.toIn, cube.toOut);
  });
}

} // namespace voxelcore
