#include "voxelcore/Thickness/LocalThickness.h"

#include "BallsInSlab.h"
#include "BoundingBalls.h"
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
#include <span>

namespace voxelcore
{

namespace
{

constexpr double kBoundingStep = 1.0 / 32; ///< of a voxel's shortest side

/** Layers `first` to `end` - 1 of a box, from its lowest; the first one begins a tile. */
struct Slab
{
  std::int32_t first;
  std::int32_t end;
};

/** Which balls may touch which tile of rows. */
class BallsOfTiles
{
public:
  BallsOfTiles(const PaintingBalls & balls, const VoxelBox & box, const Slab & slab, const SpacingWeights & weights)
    : m_Balls(balls)
    , m_Box(box)
    , m_Slab(slab)
    , m_Unit(weights.unit)
    , m_Weights(WeightsOf(weights))
    , m_Across(static_cast<std::size_t>((box.size[1] + kTile - 1) / kTile))
    , m_Begin(m_Across * static_cast<std::size_t>((slab.end - slab.first + kTile - 1) / kTile) + 1, 0)
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
    return { static_cast<std::int32_t>(tile % m_Across) * kTile,
             m_Slab.first + static_cast<std::int32_t>(tile / m_Across) * kTile };
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
      const auto         range = rows(2);
      const std::int32_t firstZ = std::max(range[0], m_Slab.first) - m_Slab.first;
      const std::int32_t endZ = std::min(range[1], m_Slab.end) - m_Slab.first;
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
  Slab                       m_Slab;
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
           const Slab &             slab,
           VoxelField<T> &          map,
           const ProgressCallback & progress)
{
  ReportProgress(progress, "thickness", 0);
  const BallsOfTiles tiles(balls, shape.Box(), slab, weights);
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

Slab
AllOf(const VoxelShape & shape)
{
  return { 0, shape.Box().size[2] };
}

/** Adds the balls that owners name to those that are kept, and names them as they stand there. */
void
KeepNamed(const PaintingBalls & balls, std::span<std::uint32_t> owners, PaintingBalls & kept)
{
  std::vector<std::uint32_t> names(balls.Count() + 1, 0);
  for (const std::uint32_t owner : owners)
  {
    names[owner] = 1;
  }
  names[0] = 0;
  for (std::size_t i = 0; i < balls.Count(); ++i)
  {
    if (names[i + 1] != 0)
    {
      kept.Add(balls.centres[i], balls.radius[i], balls.value[i]);
      names[i + 1] = static_cast<std::uint32_t>(kept.Count());
    }
  }
  for (std::uint32_t & owner : owners)
  {
    owner = names[owner];
  }
}

/** Gives voxels the greatest balls that lie in the shape, of which those are kept that have one: slab by slab, so that
 *  not all are held. A ball that has voxels in two slabs is kept twice. */
void
PaintInscribed(const InscribedBalls &   inscribed,
               const VoxelShape &       asked,
               const SpacingWeights &   weights,
               ThicknessBracket &       bracket,
               const ProgressCallback & progress)
{
  constexpr std::int32_t mostSlabs = 16; // in each all of the core is looked at
  const VoxelBox &       box = asked.Box();
  const std::int32_t     layers = (box.size[2] / (kTile * mostSlabs) + 1) * kTile;
  for (Slab slab{ 0, 0 }; slab.end < box.size[2];)
  {
    slab = { slab.end, std::min(slab.end + layers, box.size[2]) };
    const auto          share = [&](std::int32_t layer) { return static_cast<double>(layer) / box.size[2]; };
    const PaintingBalls balls = inscribed.Find(box.lower[2] + slab.first, box.lower[2] + slab.end);
    PaintBalls(asked,
               weights,
               balls,
               slab,
               bracket.owners,
               PartOfProgress(progress, share(slab.first), share(slab.end)));
    const auto startOf = [&](std::int32_t layer) {
      return bracket.owners.rowStarts[static_cast<std::size_t>(layer) * static_cast<std::size_t>(box.size[1])];
    };
    KeepNamed(balls,
              std::span(bracket.owners.values).subspan(startOf(slab.first), startOf(slab.end) - startOf(slab.first)),
              bracket.balls);
  }
}

} // namespace

void
PaintThickness(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const PaintingBalls &    balls,
               VoxelValues &            map,
               const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, AllOf(shape), map, progress);
}

void
PaintOwners(const VoxelShape &       shape,
            const SpacingWeights &   weights,
            const PaintingBalls &    balls,
            VoxelOwners &            owners,
            const ProgressCallback & progress)
{
  PaintBalls(shape, weights, balls, AllOf(shape), owners, progress);
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
  PaintingBalls kept;
  KeepNamed(balls, owners.values, kept);
  balls = std::move(kept);
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
  StagePlan          plan(progress, { 0.1, upper ? 0.4 : 0.9, upper ? 0.5 : 0.0 });
  ThicknessBracket   bracket;
  ReportProgress(plan.Next("thickness"), "thickness", 0);
  const CoreBalls core = FindCoreBalls(points, cells, weights);
  for (const double radius : core.radius)
  {
    bracket.reach = std::max(bracket.reach, radius * core.unit);
  }
  bracket.owners = ZeroAtVoxels<std::uint32_t>(asked);
  PaintInscribed(InscribedBalls(shape, core, weights), asked, weights, bracket, plan.Next("thickness"));
  bracket.lower = DiametersOfOwners(bracket.balls, bracket.owners);
  FillWithOwnBalls(asked, weights, bracket.lower, &shape);
  if (upper)
  {
    bracket.upper = ZeroAtVoxels<float>(asked);
    PaintThickness(asked, weights, BoundingBalls(shape, core, kBoundingStep), bracket.upper, plan.Next("thickness"));
  }
  return bracket;
}

} // namespace voxelcore
