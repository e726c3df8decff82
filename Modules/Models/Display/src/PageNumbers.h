#pragma once
// The numbers of a page's meshes, as bytes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace voxelcore
{

/** The numbers of a page, little endian, one array after the other, each at a multiple of 4. */
class PageNumbers
{
public:
  /** Gives the array's place, length and bytes a number. */
  template <typename T>
  std::array<std::size_t, 3>
  Add(const std::vector<T> & values)
  {
    m_Bytes.resize((m_Bytes.size() + 3) / 4 * 4);
    const std::size_t at = m_Bytes.size();
    m_Bytes.resize(at + values.size() * sizeof(T));
    if (!values.empty())
    {
      std::memcpy(m_Bytes.data() + at, values.data(), values.size() * sizeof(T));
    }
    return { at, values.size(), sizeof(T) };
  }
  const std::vector<std::uint8_t> &
  Bytes() const
  {
    return m_Bytes;
  }

private:
  std::vector<std::uint8_t> m_Bytes;
};

/** zlib's checksum: by it the page finds out whether its numbers are still what was written. */
std::uint32_t
Adler32(const std::vector<std::uint8_t> & bytes);

} // namespace voxelcore
