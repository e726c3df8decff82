#include "voxelcore/LocalThickness.h"

#include "SquareTree.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/StagePlan.h"

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

constexpr std::int32_t kAlong = 16; ///< rows of voxels of a rod along y and along z

/** A ball in lattice units whose centre is given from the lower corner of the box. */
struct Ball
{
  Vector3 centre;
  double  squared; ///< of the radius
  float   painted; ///< mm
};

/** The rods, of 16 x 16 rows each, of a slab that is 16 voxels high; each is painted by one thread. */
class RodPainter
{
public:
  RodPainter(const VoxelShape & shape, const Vector3 & weights, VoxelValues & map)
    : m_Shape(shape)
    , m_Weights(weights)
    , m_Map(map)
  {}

  /** `balls`, in the order they are painted, of which `chosen` may touch the rod that begins at row firstY, firstZ. */
  void
  Paint(std::int32_t firstY, std::int32_t firstZ, std::span<const Ball> balls, std::span<const std::uint32_t> chosen)
  {
    const auto & size = m_Shape.Box().size;
    m_FirstY = firstY;
    m_FirstZ = firstZ;
    m_EndY = std::min(firstY + kAlong, size[1]);
    m_EndZ = std::min(firstZ + kAlong, size[2]);
    Begin();
    for (std::size_t i = 0; i < chosen.size() && m_Left > 0; ++i)
    {
      PaintBall(balls[chosen[i]]);
    }
  }

private:
  /** The voxels of a row that are in have ranks; m_Next leads from each to the first one at or behind it that is not
   *  painted. */
  void
  Begin()
  {
    const std::size_t words = m_Shape.WordsPerRow();
    m_Ranks.clear();
    m_Next.clear();
    m_RowNext.clear();
    m_Left = 0;
    for (std::int32_t z = m_FirstZ; z < m_EndZ; ++z)
    {
      for (std::int32_t y = m_FirstY; y < m_EndY; ++y)
      {
        const auto    bits = m_Shape.Row(y, z);
        std::uint32_t rank = 0;
        for (std::size_t word = 0; word < words; ++word)
        {
          m_Ranks.push_back(rank);
          rank += static_cast<std::uint32_t>(std::popcount(bits[word]));
        }
        m_Ranks.push_back(rank);
        m_RowNext.push_back(m_Next.size());
        const auto values = m_Map.Row(y, z);
        for (std::uint32_t i = 0; i < rank; ++i)
        {
          const bool isPainted = values[i] != 0;
          m_Next.push_back(isPainted ? i + 1 : i);
          m_Left += isPainted ? 0 : 1;
        }
        m_Next.push_back(rank);
      }
    }
  }

  void
  PaintBall(const Ball & ball)
  {
    const auto range = [&](std::size_t axis, std::int32_t first, std::int32_t end) {
      const double reach = std::sqrt(ball.squared) / m_Weights[axis] + 1;
      const double low = std::clamp(ball.centre[axis] - reach, static_cast<double>(first), static_cast<double>(end));
      const double high = std::clamp(ball.centre[axis] + reach, static_cast<double>(first), static_cast<double>(end));
      return std::array<std::int32_t, 2>{ static_cast<std::int32_t>(low), static_cast<std::int32_t>(std::ceil(high)) };
    };
    const auto ys = range(1, m_FirstY, m_EndY);
    const auto zs = range(2, m_FirstZ, m_EndZ);
    for (std::int32_t z = zs[0]; z < zs[1]; ++z)
    {
      const double dz = (z + 0.5 - ball.centre[2]) * m_Weights[2];
      const double left = ball.squared - dz * dz;
      for (std::int32_t y = ys[0]; y < ys[1] && left >= 0; ++y)
      {
        const double dy = (y + 0.5 - ball.centre[1]) * m_Weights[1];
        const double squared = left - dy * dy;
        if (squared >= 0)
        {
          PaintRow(y, z, ball.centre[0], std::sqrt(squared) / m_Weights[0], ball.painted);
        }
      }
    }
  }

  /** How many voxels of a row that are in lie before x. */
  std::uint32_t
  RankOf(const ConstShapeRow & bits, const std::uint32_t * ranks, std::int32_t x) const
  {
    const auto word = static_cast<std::size_t>(x) >> 6U;
    const auto rest = static_cast<unsigned>(x) & 63U;
    return rest == 0
             ? ranks[word]
             : ranks[word] + static_cast<std::uint32_t>(std::popcount(bits[word] & ((std::uint64_t{ 1 } << rest) - 1)));
  }

  void
  PaintRow(std::int32_t y, std::int32_t z, double centre, double half, float value)
  {
    const double width = m_Shape.Box().size[0];
    const auto   first = static_cast<std::int32_t>(std::clamp(std::ceil(centre - half - 0.5), 0.0, width));
    const auto   end = static_cast<std::int32_t>(std::clamp(std::floor(centre + half - 0.5) + 1, 0.0, width));
    if (first >= end)
    {
      return;
    }
    const auto            row = static_cast<std::size_t>((z - m_FirstZ) * (m_EndY - m_FirstY) + (y - m_FirstY));
    const auto            bits = m_Shape.Row(y, z);
    const std::uint32_t * ranks = m_Ranks.data() + row * (m_Shape.WordsPerRow() + 1);
    const std::uint32_t   last = RankOf(bits, ranks, end);
    std::uint32_t *       next = m_Next.data() + m_RowNext[row];
    std::uint32_t         at = Follow(next, RankOf(bits, ranks, first));
    if (at >= last)
    {
      return;
    }
    float * values = m_Map.values.data() +
                     m_Map.rowStarts[static_cast<std::size_t>(z) * static_cast<std::size_t>(m_Shape.Box().size[1]) +
                                     static_cast<std::size_t>(y)];
    while (at < last)
    {
      values[at] = value;
      next[at] = at + 1;
      --m_Left;
      at = Follow(next, at + 1);
    }
  }

  /** Halves the way on the way (Tarjan, van Leeuwen 1984). */
  static std::uint32_t
  Follow(std::uint32_t * next, std::uint32_t at)
  {
    while (next[at] != at)
    {
      next[at] = next[next[at]];
      at = next[at];
    }
    return at;
  }

  const VoxelShape &         m_Shape;
  Vector3                    m_Weights;
  VoxelValues &              m_Map;
  std::int32_t               m_FirstY = 0;
  std::int32_t               m_FirstZ = 0;
  std::int32_t               m_EndY = 0;
  std::int32_t               m_EndZ = 0;
  std::uint64_t              m_Left = 0; ///< voxels not painted
  std::vector<std::uint32_t> m_Ranks;    ///< per row and word, and at the row's end
  std::vector<std::size_t>   m_RowNext;  ///< where each row begins in m_Next
  std::vector<std::uint32_t> m_Next;
};

Vector3
WeightsOf(const SpacingWeights & weights)
{
  return { static_cast<double>(weights.weight[0]),
           static_cast<double>(weights.weight[1]),
           static_cast<double>(weights.weight[2]) };
}

/** In the order they are painted: the greatest value first, of equal ones the first. */
std::vector<Ball>
InOrder(const PaintingBalls & balls, const VoxelBox & box, const SpacingWeights & weights)
{
  constexpr double           greater = 1 + 1e-10;
  std::vector<std::uint32_t> order(balls.Count());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return balls.value[a] != balls.value[b] ? balls.value[a] > balls.value[b] : a < b;
  });
  std::vector<Ball> sorted;
  sorted.reserve(order.size());
  for (const std::uint32_t i : order)
  {
    const double radius = balls.radius[i] / weights.unit * greater;
    Ball         ball{ balls.centres[i], radius * radius, static_cast<float>(2 * balls.value[i]) };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ball.centre[axis] -= box.lower[axis];
    }
    sorted.push_back(ball);
  }
  return sorted;
}

/** The blocks of 16 that a ball may touch along an axis: first and end. */
std::array<std::int32_t, 2>
BlocksOf(const Ball & ball, std::size_t axis, double weight, std::int32_t size)
{
  const double reach = std::sqrt(ball.squared) / weight + 1;
  const double blocks = (size + kAlong - 1) / kAlong;
  return { static_cast<std::int32_t>(std::clamp(std::floor((ball.centre[axis] - reach) / kAlong), 0.0, blocks)),
           static_cast<std::int32_t>(std::clamp(std::floor((ball.centre[axis] + reach) / kAlong) + 1, 0.0, blocks)) };
}

} // namespace

VoxelValues
ZeroAtVoxels(const VoxelShape & shape)
{
  VoxelValues   map;
  const auto &  size = shape.Box().size;
  std::uint64_t count = 0;
  map.box = shape.Box();
  map.rowStarts.reserve(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]) + 1);
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      for (const std::uint64_t word : shape.Row(y, z))
      {
        count += static_cast<std::uint64_t>(std::popcount(word));
      }
      map.rowStarts.push_back(count);
    }
  }
  map.values.assign(count, 0.0F);
  return map;
}

void
PaintThickness(const VoxelShape &       shape,
               const SpacingWeights &   weights,
               const PaintingBalls &    balls,
               VoxelValues &            map,
               const ProgressCallback & progress)
{
  const Vector3                            sides = WeightsOf(weights);
  const auto &                             size = shape.Box().size;
  const std::vector<Ball>                  sorted = InOrder(balls, shape.Box(), weights);
  std::vector<std::array<std::int32_t, 2>> slabsOf;
  slabsOf.reserve(sorted.size());
  for (const Ball & ball : sorted)
  {
    slabsOf.push_back(BlocksOf(ball, 2, sides[2], size[2]));
  }
  const auto rods = static_cast<std::size_t>((size[1] + kAlong - 1) / kAlong);
  for (std::int32_t slab = 0; slab * kAlong < size[2]; ++slab)
  {
    ReportProgress(progress, "thickness", static_cast<double>(slab) * kAlong / size[2]);
    std::vector<std::vector<std::uint32_t>> chosen(rods);
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      if (slabsOf[i][0] <= slab && slab < slabsOf[i][1])
      {
        const auto range = BlocksOf(sorted[i], 1, sides[1], size[1]);
        for (std::int32_t rod = range[0]; rod < range[1]; ++rod)
        {
          chosen[static_cast<std::size_t>(rod)].push_back(static_cast<std::uint32_t>(i));
        }
      }
    }
    RunEach(rods, [&](std::size_t rod) {
      RodPainter(shape, sides, map).Paint(static_cast<std::int32_t>(rod) * kAlong, slab * kAlong, sorted, chosen[rod]);
    });
  }
}

void
FillWithOwnBalls(const VoxelShape & shape, const SpacingWeights & weights, VoxelValues & map)
{
  if (std::find(map.values.begin(), map.values.end(), 0.0F) == map.values.end())
  {
    return;
  }
  const SquareTree tree(shape, weights);
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
            map.values[at] = static_cast<float>(2 * weights.unit * tree.Distance(centre, far));
          }
        }
      }
    }
  }
}

ThicknessBracket
BracketThickness(const VoxelShape &            shape,
                 std::span<const LatticePoint> points,
                 const DelaunayCells &         cells,
                 const SpacingWeights &        weights,
                 bool                          upper,
                 const ProgressCallback &      progress)
{
  StagePlan        plan(progress, { 0.4, upper ? 0.3 : 0.6, upper ? 0.3 : 0.0 });
  ThicknessBalls   balls = FindThicknessBalls(shape, points, cells, weights, upper, plan.Next("thickness"));
  ThicknessBracket bracket;
  bracket.lower = ZeroAtVoxels(shape);
  PaintThickness(shape, weights, balls.inscribed, bracket.lower, plan.Next("thickness"));
  FillWithOwnBalls(shape, weights, bracket.lower);
  if (upper)
  {
    balls.inscribed = PaintingBalls();
    bracket.upper = ZeroAtVoxels(shape);
    PaintThickness(shape, weights, balls.bounding, bracket.upper, plan.Next("thickness"));
  }
  return bracket;
}

} // namespace voxelcore
