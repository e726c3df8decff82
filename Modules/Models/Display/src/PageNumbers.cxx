#include "PageNumbers.h"

namespace voxelcore
{

std::uint32_t
Adler32(const std::vector<std::uint8_t> & bytes)
{
  std::uint32_t a = 1;
  std::uint32_t b = 0;
  for (const std::uint8_t byte : bytes)
  {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

} // namespace voxelcore
