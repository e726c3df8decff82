#include "voxelcore/Thickness/LocalThickness.h"

#include "SquareGrid.h"
#include "TilePainter.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/StagePlan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr double kBoundingStep = 1.0 / 32; ///< of a voxel's shortest side

/** Which balls may touch which tile of rows. */
class BallsOfTiles
{
public:
  BallsOfTiles(const PaintingBalls & balls, const VoxelBox & box, const SpacingWeights & weights)
    : m_Balls(balls)
    , m_Box(box)
    , m_Unit(weights.unit)
    , m_Weights(WeightsOf(weights))
    , m_Across(static_cast<std::size_t>((box.size[1] + kTile - 1) / kTile))
    , m_Begin(m_Across * static_cast<std::size_t>((box.size[2] + kTile - 1) / kTile) + 1, 0)
  {
    ForTiles([&](std::size_t tile, std::uint32_t /* ball */) { ++m_Begin[tile + 1]; });
    std::partial_sum(m_Begin.begin(), m_Begin.end(), m_Begin.begin());
    m_Indices.resize(m_Begin.back());
    std::vector<std::size_t> next(m_Begin.begin(), m_Begin.end() - 1);
    ForTiles([&](std::size_t tile, std::uint32_t ball) { m_Indices[next[tile]++] = ball; });
  }

  std::size_t
  TileCount() const
  {
    return m_Begin.size() - 1;
  }
  /** Of a tile its first row along y and along z. */
  std::array<std::int32_t, 2>
  FirstRow(std::size_t tile) const
  {
    return { static_cast<std::int32_t>(tile % m_Across) * kTile, static_cast<std::int32_t>(tile / m_Across) * kTile };
  }
  /** In the order they are painted: the greatest value first, of equal ones the first. */
  std::vector<PaintedBall>
  InOrder(std::size_t tile) const
  {
    // Single precision keeps the order but for equals, and is sorted as whole numbers: values are not negative.
    std::vector<std::uint64_t> order;
    order.reserve(m_Begin[tile + 1] - m_Begin[tile]);
    for (std::size_t i = m_Begin[tile]; i < m_Begin[tile + 1]; ++i)
    {
      const auto bits = bit_cast<std::uint32_t>(static_cast<float>(m_Balls.value[m_Indices[i]]));
      order.push_back(std::uint64_t{ ~bits } << 32U | m_Indices[i]);
    }
    std::sort(order.begin(), order.end());
    const auto valueOf = [&](std::uint64_t key) { return m_Balls.value[static_cast<std::uint32_t>(key)]; };
    const auto isBefore = [&](std::uint64_t a, std::uint64_t b) { return valueOf(a) > valueOf(b); };
    for (auto first = order.begin(); first != order.end();)
    {
      const auto end = std::find_if(first, order.end(), [&](std::uint64_t key) { return key >> 32U != *first >> 32U; });
      if (!std::is_sorted(first, end, isBefore))
      {
        std::stable_sort(first, end, isBefore);
      }
      first = end;
    }
    std::vector<PaintedBall> balls;
    balls.reserve(order.size());
    for (const std::uint64_t key : order)
    {
      const auto      index = static_cast<std::uint32_t>(key);
      const Vector3 & at = m_Balls.centres[index];
      balls.push_back({ { at[0] - m_Box.lower[0], at[1] - m_Box.lower[1], at[2] - m_Box.lower[2] },
                        RadiusOf(index),
                        m_Balls.value[index],
                        index });
    }
    return balls;
  }

private:
  double
  RadiusOf(std::size_t ball) const
  {
    constexpr double greater = 1 + 1e-10;
    return m_Balls.radius[ball] / m_Unit * greater;
  }
  template <typename TVisit>
  void
  ForTiles(TVisit && visit) const
  {
    for (std::size_t i = 0; i < m_Balls.Count(); ++i)
    {
      const double radius = RadiusOf(i);
      const auto   rows = [&](std::size_t axis) {
        return RowsOf(m_Balls.centres[i][axis] - m_Box.lower[axis], radius, m_Weights[axis], m_Box.size[axis]);
      };
      const auto [firstY, endY] = rows(1);
      const auto [firstZ, endZ] = rows(2);
      for (std::int32_t z = firstZ / kTile; z * kTile < endZ && firstY < endY; ++z)
      {
        for (std::int32_t y = firstY / kTile; y * kTile < endY; ++y)
        {
          visit(static_cast<std::size_t>(z) * m_Across + static_cast<std::size_t>(y), static_cast<std::uint32_t>(i));
        }
      }
    }
  }

  const PaintingBalls &      m_Balls;
  VoxelBox                   m_Box;
  double                     m_Unit;
  Vector3                    m_Weights;
  std::size_t                m_Across; ///< tiles along y
  std::vector<std::size_t>   m_Begin;  ///< per tile, of its balls among the indices
  std::vector<std::uint32_t> m_Indices;
};

template <typename T>
void
PaintBalls(const VoxelShape &       shape,
           const SpacingWeights &   weights,
           const PaintingBalls &    balls,
           VoxelField<T> &          map,
           const ProgressCallback & progress)
{
  ReportProgress(progress, "thickness", 0);
  const BallsOfTiles tiles(balls, shape.Box(), weights);
  RunEach(
    tiles.TileCount(),
    [&](std::size_t tile) {
      const auto [firstY, firstZ] = tiles.FirstRow(tile);
      TilePainter<T>(shape, WeightsOf(weights), map).Paint(firstY, firstZ, tiles.InOrder(tile));
    },
    [&](std::size_t done) {
      ReportProgress(progress, "thickness", static_cast<double>(done) / static_cast<double>(tiles.TileCount()));
    });
}

} // namespace

void
PaintThickness(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const PaintingBalls &    balls,
               VoxelValues &            map,
               const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, map, progress);
}

void
PaintOwners(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const PaintingBalls &    balls,
            VoxelOwners &            owners,
            const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, owners, progress);
}

void
FillWithOwnBalls(const VoxelShape & shape, const SpacingWeights & weights, VoxelValues & map, const VoxelShape * around)
{
  if (std::find(map.values.begin(), map.values.end(), 0.0F) == map.values.end())
  {
    return;
  }
  const SquareGrid grid(around != nullptr ? *around : shape, weights);
  const auto &     box = shape.Box();
  const double     far = std::numeric_limits<double>::infinity();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y);
      std::size_t at = map.rowStarts[row];
      const auto  bits = shape.Row(y, z);
      for (std::size_t word = 0; word < bits.size(); ++word)
      {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1, ++at)
        {
          if (map.values[at] == 0)
          {
            const auto    x = static_cast<std::int32_t>(64 * word) + std::countr_zero(rest);
            const Vector3 centre{ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 };
            map.values[at] = static_cast<float>(2 * weights.unit * grid.Distance(centre, far));
          }
        }
      }
    }
  }
}

void
KeepOwners(PaintingBalls & balls, VoxelOwners & owners)
{
  std::vector<std::uint32_t> names(balls.Count() + 1, 0);
  for (const std::uint32_t owner : owners.values)
  {
    names[owner] = 1;
  }
  PaintingBalls kept;
  names[0] = 0;
  for (std::size_t i = 0; i < balls.Count(); ++i)
  {
    if (names[i + 1] != 0)
    {
      kept.Add(balls.centres[i], balls.radius[i], balls.value[i]);
      names[i + 1] = static_cast<std::uint32_t>(kept.Count());
    }
  }
  balls = std::move(kept);
  for (std::uint32_t & owner : owners.values)
  {
    owner = names[owner];
  }
}

VoxelValues
DiametersOfOwners(const PaintingBalls & balls, const VoxelOwners & owners)
{
  VoxelValues map{ owners.box, owners.rowStarts, std::vector<float>(owners.values.size(), 0.0F) };
  for (std::size_t i = 0; i < map.values.size(); ++i)
  {
    if (const std::uint32_t owner = owners.values[i]; owner != 0)
    {
      map.values[i] = static_cast<float>(2 * balls.value[owner - 1]);
    }
  }
  return map;
}

ThicknessBracket
BracketThickness(const VoxelShape &            shape,
                 std::span<const LatticePoint> points,
                 const DelaunayCells &         cells,
                 const SpacingWeights &        weights,
                 bool                          upper,
                 const ProgressCallback &      progress,
                 const VoxelShape *            part)
{
  const VoxelShape & asked = part != nullptr ? *part : shape;
  StagePlan          plan(progress, { 0.4, upper ? 0.3 : 0.6, upper ? 0.3 : 0.0 });
  ThicknessBalls     balls =
    FindThicknessBalls(shape, points, cells, weights, upper ? kBoundingStep : 0, plan.Next("thickness"));
  ThicknessBracket bracket;
  bracket.reach = balls.reach;
  bracket.owners = ZeroAtVoxels<std::uint32_t>(asked);
  PaintOwners(asked, weights, balls.inscribed, bracket.owners, plan.Next("thickness"));
  bracket.balls = std::move(balls.inscribed);
  KeepOwners(bracket.balls, bracket.owners);
  bracket.lower = DiametersOfOwners(bracket.balls, bracket.owners);
  FillWithOwnBalls(asked, weights, bracket.lower, &shape);
  if (upper)
  {
    bracket.upper = ZeroAtVoxels<float>(asked);
    PaintThickness(asked, weights, balls.bounding, bracket.upper, plan.Next("thickness"));
  }
  return bracket;
}

} // namespace voxelcore
