#include "SquareGrid.h"

#include "voxelcore/Lattice/Vectors.h"

#include <bit>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr double kSide = 2;        ///< of a cube of the grid, in mean sides of a voxel
constexpr double kMostRows = 1024; ///< of voxels: to look at more takes longer than to look squares up, 3 microseconds

std::vector<BoundarySquare>
SquaresOf(const VoxelShape & shape)
{
  std::vector<BoundarySquare> squares;
  const VoxelBox &            box = shape.Box();
  const std::size_t           words = shape.WordsPerRow();
  for (std::int32_t z = 0; z <= box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y <= box.size[1]; ++y)
    {
      const auto    here = shape.RowAnywhere(y, z);
      const auto    before = shape.RowAnywhere(y - 1, z);
      const auto    below = shape.RowAnywhere(y, z - 1);
      std::uint64_t carry = 0;
      const auto    add = [&](std::uint64_t bits, std::size_t word, const BoundarySquare & offset) {
        for (; bits != 0; bits &= bits - 1)
        {
          const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits);
          squares.push_back({ 2 * (box.lower[0] + x) + offset[0],
                              2 * (box.lower[1] + y) + offset[1],
                              2 * (box.lower[2] + z) + offset[2] });
        }
      };
      for (std::size_t word = 0; word < words; ++word)
      {
        add(here[word] ^ (here[word] << 1 | carry), word, { 0, 1, 1 });
        add(here[word] ^ before[word], word, { 1, 0, 1 });
        add(here[word] ^ below[word], word, { 1, 1, 0 });
        carry = here[word] >> 63;
      }
      add(carry, words, { 0, 1, 1 });
    }
  }
  return squares;
}

/** Whether voxels first to last of a row are in. */
bool
IsFull(const ConstShapeRow & row, std::size_t first, std::size_t last)
{
  for (std::size_t word = first / 64; word <= last / 64; ++word)
  {
    std::uint64_t asked = ~std::uint64_t{ 0 };
    if (word == first / 64)
    {
      asked &= ~std::uint64_t{ 0 } << first % 64;
    }
    if (word == last / 64)
    {
      asked &= ~std::uint64_t{ 0 } >> (63 - last % 64);
    }
    if ((row[word] & asked) != asked)
    {
      return false;
    }
  }
  return true;
}

} // namespace

SquareGrid::SquareGrid(const VoxelShape & shape, const SpacingWeights & weights)
  : m_Shape(shape)
  , m_Weights(WeightsOf(weights))
  , m_Squares(SquaresOf(shape))
  , m_Middles(
      m_Squares.size(),
      [this](std::size_t i) {
        const BoundarySquare & square = m_Squares[i];
        return Times({ 0.5 * square[0], 0.5 * square[1], 0.5 * square[2] }, m_Weights);
      },
      kSide * Length(m_Weights) / std::sqrt(3.0))
{
  m_Middles.Arrange(m_Squares);
}

double
SquareGrid::Distance(const Vector3 & place, double within) const
{
  double       least = within * within;
  const double half = 0.5 * Length(m_Weights); // no place of a square is farther from its middle
  bool         isFound = m_Squares.empty();
  for (double reach = std::isfinite(within) ? within : 2 * half; !isFound; reach *= 2)
  {
    Ball ball{ Times(place, m_Weights), reach + half };
    m_Middles.Visit(ball, [&](std::uint32_t i) {
      const double squared = SquaredDistance(m_Squares[i], place, m_Weights);
      const bool   isNearer = squared < least;
      if (isNearer)
      {
        least = squared;
        ball.radius = std::min(ball.radius, std::sqrt(squared) + half);
      }
      return isNearer;
    });
    isFound = least <= reach * reach;
  }
  return std::min(std::sqrt(least), within);
}

bool
SquareGrid::IsFree(const Vector3 & place, double within) const
{
  const VoxelBox & box = m_Shape.Box();
  const auto       rows = [&](std::size_t axis) { return 2 * within / m_Weights[axis] + 1; };
  if (rows(1) * rows(2) > kMostRows)
  {
    return Distance(place, within) >= within;
  }
  // So it is where all voxels are in that the ball meets.
  Vector3                     middle{};
  std::array<std::int32_t, 3> first{};
  std::array<std::int32_t, 3> last{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    middle[axis] = place[axis] - box.lower[axis];
    first[axis] = static_cast<std::int32_t>(std::floor(middle[axis] - within / m_Weights[axis]));
    last[axis] = static_cast<std::int32_t>(std::floor(middle[axis] + within / m_Weights[axis]));
    if (first[axis] < 0 || last[axis] >= box.size[axis])
    {
      return Distance(place, within) >= within;
    }
  }
  const auto beyond = [&](std::int32_t voxel, std::size_t axis) {
    const double gap = std::max({ voxel - middle[axis], middle[axis] - voxel - 1, 0.0 }) * m_Weights[axis];
    return gap * gap;
  };
  for (std::int32_t z = first[2]; z <= last[2]; ++z)
  {
    for (std::int32_t y = first[1]; y <= last[1]; ++y)
    {
      const double rest = within * within - beyond(y, 1) - beyond(z, 2);
      if (rest > 0)
      {
        const double half = std::sqrt(rest) / m_Weights[0];
        if (!IsFull(m_Shape.Row(y, z),
                    static_cast<std::size_t>(std::max(middle[0] - half, 0.0)),
                    static_cast<std::size_t>(middle[0] + half)))
        {
          return Distance(place, within) >= within;
        }
      }
    }
  }
  return true;
}

} // namespace voxelcore
