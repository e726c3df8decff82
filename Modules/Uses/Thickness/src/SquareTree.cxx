#include "SquareTree.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::size_t kLeaf = 8; ///< squares

std::size_t
MiddleOf(std::size_t first, std::size_t last)
{
  return first + (last - first) / 2;
}

} // namespace

SquareTree::SquareTree(const VoxelShape & shape, const SpacingWeights & weights)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Weights[axis] = static_cast<double>(weights.weight[axis]);
  }
  const VoxelBox &  box = shape.Box();
  const std::size_t words = shape.WordsPerRow();
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
          m_Squares.push_back({ 2 * (box.lower[0] + x) + offset[0],
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
  if (!m_Squares.empty())
  {
    Build(0, 0, m_Squares.size());
  }
}

void
SquareTree::Build(std::size_t node, std::size_t first, std::size_t last)
{
  BoundarySquare least = m_Squares[first];
  BoundarySquare greatest = least;
  for (std::size_t i = first; i < last; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], m_Squares[i][axis]);
      greatest[axis] = std::max(greatest[axis], m_Squares[i][axis]);
    }
  }
  m_Bounds.resize(std::max(m_Bounds.size(), node + 1));
  std::size_t longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // From the first square's low side to the last one's high side; sides up to 2^23 are exact.
    const auto low = (least[axis] - (least[axis] & 1)) / 2;
    const auto high = (greatest[axis] + (greatest[axis] & 1)) / 2;
    m_Bounds[node].least[axis] = static_cast<float>(low);
    m_Bounds[node].greatest[axis] = static_cast<float>(high);
    if (m_Weights[axis] * (greatest[axis] - least[axis]) > m_Weights[longest] * (greatest[longest] - least[longest]))
    {
      longest = axis;
    }
  }
  if (last - first <= kLeaf)
  {
    return;
  }
  const std::size_t middle = MiddleOf(first, last);
  const auto        at = [&](std::size_t i) { return m_Squares.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [longest](const BoundarySquare & a, const BoundarySquare & b) {
    return a[longest] < b[longest];
  });
  Build(2 * node + 1, first, middle);
  Build(2 * node + 2, middle, last);
}

double
SquareTree::ToBounds(const Bounds & bounds, const Vector3 & place) const
{
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double beyond = std::max({ static_cast<double>(bounds.least[axis]) - place[axis],
                                     place[axis] - static_cast<double>(bounds.greatest[axis]),
                                     0.0 }) *
                          m_Weights[axis];
    squared += beyond * beyond;
  }
  return squared;
}

void
SquareTree::Descend(std::size_t node, std::size_t first, std::size_t last, const Vector3 & place, double & least) const
{
  if (last - first <= kLeaf)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      least = std::min(least, SquaredDistance(m_Squares[i], place, m_Weights));
    }
    return;
  }
  const std::size_t middle = MiddleOf(first, last);
  const double      left = ToBounds(m_Bounds[2 * node + 1], place);
  const double      right = ToBounds(m_Bounds[2 * node + 2], place);
  if (left <= right)
  {
    if (left < least)
    {
      Descend(2 * node + 1, first, middle, place, least);
    }
    if (right < least)
    {
      Descend(2 * node + 2, middle, last, place, least);
    }
    return;
  }
  if (right < least)
  {
    Descend(2 * node + 2, middle, last, place, least);
  }
  if (left < least)
  {
    Descend(2 * node + 1, first, middle, place, least);
  }
}

double
SquareTree::Distance(const Vector3 & place, double within) const
{
  double least = within * within;
  if (!m_Squares.empty())
  {
    Descend(0, 0, m_Squares.size(), place, least);
  }
  return std::min(std::sqrt(least), within);
}

} // namespace voxelcore
