#include "ChangeWindow.h"

#include "voxelcore/Base/Library.h"

#include <array>
#include <utility>

namespace voxelcore
{

ChangeWindow::ChangeWindow(const PaddedShape & shape, const std::vector<Voxel> & voxels, std::int32_t margin)
  : m_Lower(voxels.front())
{
  Voxel upper = m_Lower;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const Voxel & at : voxels)
    {
      m_Lower[axis] = std::min(m_Lower[axis], at[axis]);
      upper[axis] = std::max(upper[axis], at[axis]);
    }
    m_Lower[axis] = std::max(0, m_Lower[axis] - margin);
    upper[axis] = std::min(shape.Size()[axis] - 1, upper[axis] + margin);
    m_Size[axis] = upper[axis] - m_Lower[axis] + 1;
  }
}

std::vector<char>
ChangeWindow::Read(const PaddedShape & shape) const
{
  std::vector<char> is;
  is.reserve(Count());
  for (std::int32_t z = m_Lower[2]; z < m_Lower[2] + m_Size[2]; ++z)
  {
    for (std::int32_t y = m_Lower[1]; y < m_Lower[1] + m_Size[1]; ++y)
    {
      for (std::int32_t x = m_Lower[0]; x < m_Lower[0] + m_Size[0]; ++x)
      {
        is.push_back(shape.Contains({ x, y, z }) ? 1 : 0);
      }
    }
  }
  return is;
}

std::vector<std::int32_t>
ChangeWindow::StepsFrom(const VoxelNumbers & numbers, std::int32_t most) const
{
  std::vector<std::int32_t> steps(Count(), most + 1);
  VoxelNumbers              open = numbers;
  for (const std::size_t number : numbers)
  {
    steps[number] = 0;
  }
  for (std::size_t i = 0; i < open.size() && steps[open[i]] < most; ++i)
  {
    VisitAround(open[i], true, [&](std::size_t next) {
      if (steps[next] > most)
      {
        steps[next] = steps[open[i]] + 1;
        open.push_back(next);
      }
    });
  }
  return steps;
}

bool
ChangeWindow::IsBorder(std::size_t number) const
{
  const Voxel at = At(number);
  return ranges::any_of(std::array<std::size_t, 3>{ 0, 1, 2 }, [&](std::size_t axis) {
    return at[axis] == m_Lower[axis] || at[axis] == m_Lower[axis] + m_Size[axis] - 1;
  });
}

std::uint32_t
ChangeWindow::Flood(const std::vector<char> & is, char value, bool corners, Labels & labels) const
{
  labels.assign(Count(), kNone);
  std::uint32_t            count = 0;
  std::vector<std::size_t> open;
  for (std::size_t first = 0; first < is.size(); ++first)
  {
    if (is[first] != value || labels[first] != kNone)
    {
      continue;
    }
    labels[first] = count;
    open.push_back(first);
    while (!open.empty())
    {
      const std::size_t at = open.back();
      open.pop_back();
      VisitAround(at, corners, [&](std::size_t next) {
        if (is[next] == value && labels[next] == kNone)
        {
          labels[next] = count;
          open.push_back(next);
        }
      });
    }
    ++count;
  }
  return count;
}

ChangeWindow::Signature
ChangeWindow::Sign(const std::vector<char> & is) const
{
  Signature signature;
  for (const char value : { char{ 1 }, char{ 0 } })
  {
    Labels        labels;
    Labels        order;
    std::uint32_t next = 0;
    order.assign(Flood(is, value, value == 0, labels), kNone);
    signature.parts.push_back(static_cast<std::uint32_t>(order.size()));
    for (std::size_t number = 0; number < is.size(); ++number)
    {
      if (IsBorder(number) && labels[number] != kNone)
      {
        std::uint32_t & name = order[labels[number]];
        name = name == kNone ? next++ : name;
        signature.parts.push_back(name);
      }
    }
  }
  signature.euler = Euler(is, 0);
  return signature;
}

std::int64_t
ChangeWindow::Euler(std::vector<char> is, std::size_t axis) const
{
  if (axis == 3)
  {
    return ranges::count(is, char{ 1 });
  }
  const std::int64_t here = Euler(is, axis + 1);
  // What is there with the next along the axis, too.
  const std::array<std::size_t, 3> step{ 1,
                                         static_cast<std::size_t>(m_Size[0]),
                                         static_cast<std::size_t>(m_Size[0]) * static_cast<std::size_t>(m_Size[1]) };
  const auto                       side = static_cast<std::size_t>(m_Size[axis]);
  for (std::size_t number = 0; number < is.size(); ++number)
  {
    const bool isLast = number / step[axis] % side + 1 == side;
    is[number] = static_cast<char>(isLast ? 0 : is[number] & is[number + step[axis]]);
  }
  return here - Euler(std::move(is), axis + 1);
}

} // namespace voxelcore
