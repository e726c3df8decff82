#include "BandField.h"

#include "DistanceTile.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kMargin = 6; // voxels
constexpr std::int32_t kTile = 2 * BrickGrid::kSide;
using LabelCube = tile::Cube<kTile, kMargin>;

VOXELCORE_EIGHT_LANES void
FindDistances(LabelCube & cube, const std::array<float, 3> & squares)
{
  tile::FindSquaredDistances(cube.in, squares, cube.toIn);
  tile::FindSquaredDistances(cube.out, squares, cube.toOut);
}

// Of a brick of a cube of distances, from its first voxel on: to the nearest centre of the other kind less half a side.
template <std::int32_t Count>
void
FillBrick(const tile::Squared<Count> & toIn,
          const tile::Squared<Count> & toOut,
          std::size_t                  first,
          float                        half,
          float                        far,
          float *                      values)
{
  for (std::size_t row = 0; row < BrickGrid::kCells / 8; ++row)
  {
    const std::size_t from = first + Count * ((row & 7) + Count * (row >> 3));
    for (std::size_t x = 0; x < 8; ++x)
    {
      const bool  inside = toIn[from + x] == 0;
      const float distance = std::min(std::sqrt(inside ? toOut[from + x] : toIn[from + x]) - half, far);
      *values++ = inside ? distance : -distance;
    }
  }
}

} // namespace

BandField::BandField(const VoxelShape &            shape,
                     std::span<const LatticePoint> points,
                     const Vector3 &               sides,
                     double                        sigma,
                     std::int32_t                  reach)
  : m_Grid(shape, points, 0, reach)
  , m_Sides(sides)
  , m_In(m_Grid.Count())
  , m_Out(m_Grid.Count())
  , m_Values(m_Grid.Count() * kVoxels)
{
  SetWidth(sigma);
  SetFar(0);
  FillFlags(shape);
  FindRowStarts();
}

BandField::BandField(const VoxelShape & shape, const BandField & other, const std::vector<std::uint8_t> & wanted)
  : m_Grid(shape, other.m_Grid, wanted)
  , m_Sides(other.m_Sides)
  , m_Gauss(other.m_Gauss)
  , m_Binomial(other.m_Binomial)
  , m_GaussToSpline(other.m_GaussToSpline)
  , m_In(m_Grid.Count())
  , m_Out(m_Grid.Count())
  , m_Values(m_Grid.Count() * kVoxels)
{
  SetFar(other.m_Far);
  FillFlags(shape);
  FindRowStarts();
}

void
BandField::FillFlags(const VoxelShape & shape)
{
  const auto count = static_cast<std::ptrdiff_t>(m_Grid.Count());
#pragma omp parallel for schedule(static) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto & at = m_Grid.At(static_cast<std::size_t>(i));
    for (std::int32_t row = 0; row < kSide * kSide; ++row)
    {
      const std::uint64_t bits = BitsOfRow(shape, at[0] * kSide, at[1] * kSide + (row & 7), at[2] * kSide + (row >> 3));
      m_In[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)] = static_cast<std::uint8_t>(bits);
      m_Out[static_cast<std::size_t>(i)][static_cast<std::size_t>(row)] = static_cast<std::uint8_t>(~bits);
    }
  }
}

void
BandField::FindRowStarts()
{
  for (std::size_t brick = 0; brick < m_Grid.Count(); ++brick)
  {
    const auto next = static_cast<std::uint32_t>(brick);
    if (brick == 0 || m_Grid.At(brick)[2] != m_Grid.At(brick - 1)[2])
    {
      m_Planes.push_back({ next, static_cast<std::uint32_t>(m_RowStarts.size()) });
    }
    if (m_Grid.Neighbours(brick)[BrickGrid::kSelf - 1] < 0)
    {
      m_RowStarts.push_back(next);
    }
  }
  m_Planes.push_back({ static_cast<std::uint32_t>(m_Grid.Count()), static_cast<std::uint32_t>(m_RowStarts.size()) });
}

void
BandField::SetFar(float far)
{
  m_Far = far;
  m_FarBlocks[0].fill(-far);
  m_FarBlocks[1].fill(far);
}

float
BandField::HalfSide() const
{
  return 0.5F * static_cast<float>(std::min({ m_Sides[0], m_Sides[1], m_Sides[2] }));
}

void
BandField::FillDistances(const VoxelShape & shape, double clip, const std::vector<std::uint8_t> & filled)
{
  SetFar(static_cast<float>(clip));
  const std::array<float, 3> squares = tile::AsFloats(Times(m_Sides, m_Sides));
  std::vector<std::uint8_t>  needed(m_Grid.Count(), 1);
  std::transform(filled.begin(), filled.end(), needed.begin(), [](std::uint8_t flag) {
    return static_cast<std::uint8_t>(flag == 0 ? 1 : 0);
  });
  tile::ForTiles<LabelCube>(m_Grid, needed, [&](const BrickGrid::Brick & tile, LabelCube & cube, auto forBricks) {
    ReadRows(shape,
             { kTile * tile[0] - kMargin, kTile * tile[1] - kMargin, kTile * tile[2] - kMargin },
             cube.in,
             cube.out);
    FindDistances(cube, squares);
    forBricks([&](std::size_t brick, const BrickGrid::Brick & part) {
      FillBrick<kTile>(cube.toIn,
                       cube.toOut,
                       tile::Place<kTile>(part, 0),
                       HalfSide(),
                       m_Far,
                       m_Values.data() + brick * kVoxels);
    });
  });
}

void
BandField::TakeDistances(const BrickGrid::Brick &         tile,
                         const BoundaryDepth::Distances & toIn,
                         const BoundaryDepth::Distances & toOut,
                         double                           clip,
                         std::vector<std::uint8_t> &      filled)
{
  constexpr std::int32_t side = BoundaryDepth::kTile;
  constexpr std::int32_t along = side / kSide; // bricks
  for (std::int32_t n = 0; n < along * along * along; ++n)
  {
    const BrickGrid::Brick part{ n % along, n / along % along, n / along / along };
    const std::int32_t     found =
      m_Grid.Find({ along * tile[0] + part[0], along * tile[1] + part[1], along * tile[2] + part[2] });
    if (found >= 0)
    {
      const auto brick = static_cast<std::size_t>(found);
      const auto first = static_cast<std::size_t>(kSide * (part[0] + side * (part[1] + side * part[2])));
      FillBrick<side>(toIn, toOut, first, HalfSide(), static_cast<float>(clip), m_Values.data() + brick * kVoxels);
      filled[brick] = 1;
    }
  }
}

void
BandField::FindBlocks(Spot & spot) const
{
  const auto & neighbours = m_Grid.Neighbours(static_cast<std::size_t>(spot.brick));
  // Eight along x from the half of a brick on that the first of the four lies in.
  const std::size_t half = spot.corner >> 3;
  const auto        block = [&](std::int32_t source) {
    return source >= 0 ? m_Coefficients.data() + (static_cast<std::size_t>(source) - m_FirstCoefficient) * kVoxels
                              : m_FarBlocks[source == BrickGrid::kInside ? 1 : 0].data();
  };
  const std::size_t low = (spot.corner & 1) + 3 * (spot.corner >> 1 & 1) + 9 * (spot.corner >> 2 & 1);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const std::size_t beside = low + 3 * (i & 1) + 9 * (i >> 1);
    spot.low[i] = block(neighbours[beside]) + 4 * half;
    spot.high[i] = block(neighbours[beside + half]) + 4 * (1 - half);
  }
}

} // namespace voxelcore
