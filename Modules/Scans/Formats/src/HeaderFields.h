#pragma once
// Headers of fixed layout.

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace voxelcore
{

/** Fields of a header by their offset. `swapped`: their byte order is not this machine's. */
class HeaderFields
{
public:
  HeaderFields(std::span<const std::byte> bytes, bool swapped)
    : m_Bytes(bytes)
    , m_Swapped(swapped)
  {}

  template <typename T>
  T
  At(std::size_t offset) const
  {
    std::array<std::byte, sizeof(T)> raw;
    std::copy_n(m_Bytes.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (m_Swapped)
    {
      std::reverse(raw.begin(), raw.end());
    }
    return bit_cast<T>(raw);
  }

private:
  std::span<const std::byte> m_Bytes;
  bool                       m_Swapped;
};

} // namespace voxelcore
