#pragma once
// The voxels around a cut or fill.

#include "voxelcore/Shape/PaddedShape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Numbers of voxels in a window. */
using VoxelNumbers = std::vector<std::size_t>;

/** A box of a padded shape, its voxels counted along x, then y, then z. */
class ChangeWindow
{
public:
  using Labels = std::vector<std::uint32_t>;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /** The box of some voxels grown by `margin`, as far as there are voxels. */
  ChangeWindow(const PaddedShape & shape, const std::vector<Voxel> & voxels, std::int32_t margin);

  const Voxel &
  Size() const
  {
    return m_Size;
  }

  std::size_t
  Count() const
  {
    return static_cast<std::size_t>(m_Size[0]) * static_cast<std::size_t>(m_Size[1]) *
           static_cast<std::size_t>(m_Size[2]);
  }

  /** In padded indices. */
  Voxel
  At(std::size_t number) const
  {
    const auto at = static_cast<std::uint32_t>(number); // windows are small: labels have as many bits
    const auto x = static_cast<std::uint32_t>(m_Size[0]);
    const auto y = static_cast<std::uint32_t>(m_Size[1]);
    const auto row = at / x;
    return { static_cast<std::int32_t>(at - row * x) + m_Lower[0],
             static_cast<std::int32_t>(row % y) + m_Lower[1],
             static_cast<std::int32_t>(row / y) + m_Lower[2] };
  }

  std::size_t
  NumberOf(const Voxel & at) const
  {
    return (static_cast<std::size_t>(at[2] - m_Lower[2]) * static_cast<std::size_t>(m_Size[1]) +
            static_cast<std::size_t>(at[1] - m_Lower[1])) *
             static_cast<std::size_t>(m_Size[0]) +
           static_cast<std::size_t>(at[0] - m_Lower[0]);
  }

  /** Neighbours in the window over faces, or over corners, too. */
  template <typename TVisit>
  void
  VisitAround(std::size_t number, bool corners, const TVisit & visit) const
  {
    const Voxel at = At(number);
    Voxel       first;
    Voxel       last;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = at[axis] > m_Lower[axis] ? -1 : 0;
      last[axis] = at[axis] + 1 < m_Lower[axis] + m_Size[axis] ? 1 : 0;
    }
    const auto sizeX = static_cast<std::ptrdiff_t>(m_Size[0]);
    const auto plane = sizeX * m_Size[1];
    const auto here = static_cast<std::ptrdiff_t>(number);
    if (!corners)
    {
      const std::array<std::ptrdiff_t, 3> step{ 1, sizeX, plane };
      for (const std::size_t axis : { 2U, 1U, 0U })
      {
        if (first[axis] < 0)
        {
          visit(static_cast<std::size_t>(here - step[axis]));
        }
      }
      for (const std::size_t axis : { 0U, 1U, 2U })
      {
        if (last[axis] > 0)
        {
          visit(static_cast<std::size_t>(here + step[axis]));
        }
      }
      return;
    }
    for (std::int32_t z = first[2]; z <= last[2]; ++z)
    {
      for (std::int32_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::int32_t x = first[0]; x <= last[0]; ++x)
        {
          if (x != 0 || y != 0 || z != 0)
          {
            visit(static_cast<std::size_t>(here + x + y * sizeX + z * plane));
          }
        }
      }
    }
  }

  /** 1 where the shape has a voxel, 0 elsewhere. */
  std::vector<char>
  Read(const PaddedShape & shape) const;

  /** How many steps over corners each voxel is from the nearest of some, up to `most`; of others one more. */
  std::vector<std::int32_t>
  StepsFrom(const VoxelNumbers & numbers, std::int32_t most) const;

  /** The components of the voxels that are `value`; returns how many there are. */
  std::uint32_t
  Flood(const std::vector<char> & is, char value, bool corners, Labels & labels) const;

  /** All by which the window's content acts on topology numbers as long as its outermost voxels stay. */
  struct Signature
  {
    std::int64_t euler = 0;
    Labels       parts; ///< of object and background: how many, and which border voxels hang together

    bool
    operator==(const Signature &) const = default;
  };

  Signature
  Sign(const std::vector<char> & is) const;

private:
  bool
  IsBorder(std::size_t number) const;

  /** Voxels, inner faces, edges and corners, all of them within the window, along axes from `axis` on. */
  std::int64_t
  Euler(std::vector<char> is, std::size_t axis) const;

  Voxel m_Lower;
  Voxel m_Size{};
};

} // namespace voxelcore
