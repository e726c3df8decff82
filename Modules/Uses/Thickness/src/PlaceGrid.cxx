#include "PlaceGrid.h"

namespace voxelcore
{

namespace
{

constexpr std::size_t kFewBlocks = 4096; ///< as many may always be

/** From counts to where each begins. */
void
CountsToBegins(std::vector<std::uint32_t> & counts)
{
  std::uint32_t first = 0;
  for (std::uint32_t & one : counts)
  {
    const std::uint32_t count = one;
    one = first;
    first += count;
  }
}

} // namespace

PlaceGrid::PlaceGrid(std::size_t count, const std::function<Vector3(std::size_t)> & placeOf, double side)
  : m_Order(count)
{
  Vector3 high{};
  for (std::size_t i = 0; i < count; ++i)
  {
    const Vector3 place = placeOf(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Low[axis] = i == 0 ? place[axis] : std::min(m_Low[axis], place[axis]);
      high[axis] = i == 0 ? place[axis] : std::max(high[axis], place[axis]);
    }
  }
  double all = 0;
  for (m_PerSide = 1 / side; all == 0 || all > static_cast<double>(std::max(count, kFewBlocks)); m_PerSide /= 2)
  {
    all = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      all *= std::floor(CubesTo(high[axis], axis) / kEdge) + 1;
    }
  }
  m_PerSide *= 2;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Blocks[axis] = static_cast<std::int64_t>(CubesTo(high[axis], axis)) / kEdge + 1;
  }

  // By blocks, then those of a block by their cubes.
  const auto blockOf = [&](const Vector3 & place) {
    const auto cube = CubeOf(place);
    return static_cast<std::size_t>((cube[2] / kEdge * m_Blocks[1] + cube[1] / kEdge) * m_Blocks[0] + cube[0] / kEdge);
  };
  std::vector<std::uint32_t> next(static_cast<std::size_t>(m_Blocks[0] * m_Blocks[1] * m_Blocks[2]), 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    ++next[blockOf(placeOf(i))];
  }
  m_BlockAt.assign(next.size(), kNone);
  std::vector<std::uint32_t> sizes;
  for (std::size_t i = 0; i < next.size(); ++i)
  {
    if (next[i] > 0)
    {
      m_BlockAt[i] = static_cast<std::uint32_t>(sizes.size());
      sizes.push_back(next[i]);
    }
  }
  CountsToBegins(next);
  for (std::size_t i = 0; i < count; ++i)
  {
    m_Order[next[blockOf(placeOf(i))]++] = static_cast<std::uint32_t>(i);
  }
  m_Found.resize(sizes.size());
  std::vector<std::uint32_t> block;
  std::vector<std::uint16_t> cubes;
  std::uint32_t              first = 0;
  for (std::size_t found = 0; found < sizes.size(); ++found)
  {
    Block & one = m_Found[found];
    one.first = static_cast<std::uint32_t>(m_Begin.size());
    const auto begin = m_Order.begin() + first;
    block.assign(begin, begin + sizes[found]);
    cubes.clear();
    std::vector<std::uint32_t> of(kEdge * kEdge * kEdge, 0);
    for (const std::uint32_t index : block)
    {
      const auto cube = CubeOf(placeOf(index));
      cubes.push_back(
        static_cast<std::uint16_t>((cube[2] % kEdge * kEdge + cube[1] % kEdge) * kEdge + cube[0] % kEdge));
      ++of[cubes.back()];
    }
    for (std::size_t cube = 0; cube < of.size(); ++cube)
    {
      one.before[cube >> 6U] =
        static_cast<std::uint16_t>((cube & 63U) == 0 ? m_Begin.size() - one.first : one.before[cube >> 6U]);
      if (of[cube] > 0)
      {
        one.cubes[cube >> 6U] |= std::uint64_t{ 1 } << (cube & 63U);
        m_Begin.push_back(first);
      }
      const std::uint32_t places = of[cube];
      of[cube] = first;
      first += places;
    }
    for (std::size_t i = 0; i < block.size(); ++i)
    {
      m_Order[of[cubes[i]]++] = block[i];
    }
  }
  m_Begin.push_back(first);
}

std::array<std::int64_t, 3>
PlaceGrid::CubeOf(const Vector3 & place) const
{
  return { static_cast<std::int64_t>(CubesTo(place[0], 0)),
           static_cast<std::int64_t>(CubesTo(place[1], 1)),
           static_cast<std::int64_t>(CubesTo(place[2], 2)) };
}

} // namespace voxelcore
