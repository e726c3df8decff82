// Means of cells of 2^3 voxels, and what passes over them change.

#include "BandField.h"

#include <algorithm>
#include <functional>

namespace voxelcore
{

BandField::BandField(BrickGrid grid, const Vector3 & sides, float far)
  : m_Grid(std::move(grid))
  , m_Sides(sides)
  , m_Level(1)
  , m_In(m_Grid.Count())
  , m_Out(m_Grid.Count())
  , m_Values(m_Grid.Count() * kVoxels)
{
  SetFar(far);
  FindRowStarts();
}

// Flags of a brick of cells must be none before.
void
BandField::HalveBrick(const VoxelShape &       shape,
                      const BrickGrid::Brick & at,
                      float *                  means,
                      BrickGrid::Flags &       in,
                      BrickGrid::Flags &       out) const
{
  for (std::int32_t octant = 0; octant < 8; ++octant)
  {
    const BrickGrid::Brick part{ 2 * at[0] + (octant & 1), 2 * at[1] + (octant >> 1 & 1), 2 * at[2] + (octant >> 2) };
    const std::int32_t     found = m_Grid.Find(part);
    const bool             inside = found < 0 && shape.Contains(kSide * part[0], kSide * part[1], kSide * part[2]);
    const auto             source = found >= 0 ? found : inside ? BrickGrid::kInside : BrickGrid::kOutside;
    const float * const    values = Block(m_Values, source);
    for (std::size_t cell = 0; cell < kVoxels / 8; ++cell)
    {
      const std::size_t x = cell & 3;
      const std::size_t y = cell >> 2 & 3;
      const std::size_t z = cell >> 4;
      float             sum = 0;
      unsigned          count = 0;
      for (std::size_t corner = 0; corner < 8; ++corner)
      {
        const std::size_t row = 2 * y + (corner >> 1 & 1) + kSide * (2 * z + (corner >> 2));
        const std::size_t column = 2 * x + (corner & 1);
        sum += values[kSide * row + column];
        count += found >= 0 ? m_In[static_cast<std::size_t>(found)][row] >> column & 1U : inside ? 1U : 0U;
      }
      const std::size_t column = x + 4 * static_cast<std::size_t>(octant & 1);
      const std::size_t row =
        y + 4 * static_cast<std::size_t>(octant >> 1 & 1) + kSide * (z + 4 * static_cast<std::size_t>(octant >> 2));
      means[kSide * row + column] = sum / 8;
      in[row] |= static_cast<std::uint8_t>((count == 8 ? 1U : 0U) << column);
      out[row] |= static_cast<std::uint8_t>((count == 0 ? 1U : 0U) << column);
    }
  }
}

BandField
BandField::Halved(const VoxelShape & shape, const BoundaryDepth & depth, const SmoothingZones & zones) const
{
  std::vector<std::uint8_t> wanted(depth.Grid().Count());
  for (std::size_t brick = 0; brick < wanted.size(); ++brick)
  {
    wanted[brick] = zones.AnyIn(1, depth.Grid().At(brick)) ? 1 : 0;
  }
  BandField  halved(BrickGrid(shape, depth.Grid(), depth.Grid().AndAround(wanted)),
                   { 2 * m_Sides[0], 2 * m_Sides[1], 2 * m_Sides[2] },
                   m_Far);
  const auto count = static_cast<std::ptrdiff_t>(halved.m_Grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto brick = static_cast<std::size_t>(i);
    HalveBrick(shape,
               halved.m_Grid.At(brick),
               halved.m_Values.data() + brick * kVoxels,
               halved.m_In[brick],
               halved.m_Out[brick]);
  }
  return halved;
}

// By cubic interpolation: voxels are a quarter of a cell off its centre.
void
BandField::AddChange(const VoxelShape & shape, BandField halved)
{
  const auto cells = static_cast<std::ptrdiff_t>(halved.m_Grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (cells > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < cells; ++i)
  {
    const auto       brick = static_cast<std::size_t>(i);
    BrickValues      former;
    BrickGrid::Flags in{};
    BrickGrid::Flags out{};
    HalveBrick(shape, halved.m_Grid.At(brick), former.data(), in, out);
    float * const values = halved.m_Values.data() + brick * kVoxels;
    std::transform(values, values + kVoxels, former.begin(), values, std::minus<>());
  }
  constexpr std::array<float, 4> weights{ -9.0F / 128, 111.0F / 128, 29.0F / 128, -3.0F / 128 };
  const auto                     count = static_cast<std::ptrdiff_t>(m_Grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto             brick = static_cast<std::size_t>(i);
    const auto &           at = m_Grid.At(brick);
    const BrickGrid::Brick home{ at[0] >> 1, at[1] >> 1, at[2] >> 1 };
    const std::int32_t     found = halved.m_Grid.Find(home);
    if (found < 0)
    {
      continue;
    }
    const auto & around = halved.m_Grid.Neighbours(static_cast<std::size_t>(found));
    // The change of 8^3 cells, two beyond the brick's own on each side; then along x, y and z.
    std::array<std::array<float, kVoxels>, 2> change;
    bool                                      any = false;
    for (std::int32_t cell = 0; cell < static_cast<std::int32_t>(kVoxels); ++cell)
    {
      const std::array<std::int32_t, 3> p{ 4 * (at[0] & 1) + (cell & 7) - 2,
                                           4 * (at[1] & 1) + (cell >> 3 & 7) - 2,
                                           4 * (at[2] & 1) + (cell >> 6) - 2 };
      const auto         neighbour = static_cast<std::size_t>(13 + (p[0] >> 3) + 3 * (p[1] >> 3) + 9 * (p[2] >> 3));
      const std::int32_t source = around[neighbour];
      float              value = 0;
      if (source >= 0)
      {
        const std::size_t from = static_cast<std::size_t>(source) * kVoxels +
                                 static_cast<std::size_t>((p[0] & 7) + kSide * ((p[1] & 7) + kSide * (p[2] & 7)));
        value = halved.m_Values[from];
      }
      any = any || value != 0;
      change[0][static_cast<std::size_t>(cell)] = value;
    }
    if (!any)
    {
      continue;
    }
    std::size_t turn = 0;
    for (const std::size_t stride : { std::size_t{ 1 }, std::size_t{ 8 }, std::size_t{ 64 } })
    {
      const auto & from = change[turn];
      auto &       to = change[1 - turn];
      for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
      {
        const std::size_t along = voxel / stride & 7;
        const std::size_t line = voxel - along * stride;
        // Towards the cell that the voxel lies in the half of.
        const std::size_t cell = along / 2 + 2;
        const bool        upper = (along & 1) != 0;
        float             sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
        {
          sum += weights[k] * from[line + stride * (upper ? cell + k - 1 : cell + 1 - k)];
        }
        to[voxel] = sum;
      }
      turn = 1 - turn;
    }
    for (std::size_t voxel = 0; voxel < kVoxels; ++voxel)
    {
      m_Values[brick * kVoxels + voxel] += change[turn][voxel];
    }
  }
}

} // namespace voxelcore
