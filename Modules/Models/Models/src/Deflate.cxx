#include "Deflate.h"

#include <zlib.h>

#include <new>

namespace voxelcore
{

std::string
Deflate(std::string_view bytes)
{
  // Of a root system's core level 6 makes 8 % less, in five times the time.
  constexpr int level = 1;
  auto          length = compressBound(static_cast<uLong>(bytes.size()));
  std::string   packed(length, '\0');
  const auto    from = reinterpret_cast<const Bytef *>(bytes.data());
  if (compress2(reinterpret_cast<Bytef *>(packed.data()), &length, from, static_cast<uLong>(bytes.size()), level) !=
      Z_OK)
  {
    throw std::bad_alloc(); // there is room, so that nothing else can be wrong
  }
  packed.resize(length);
  return packed;
}

bool
Inflate(std::string_view packed, char * to, std::size_t size)
{
  auto       room = static_cast<uLongf>(size);
  const auto from = reinterpret_cast<const Bytef *>(packed.data());
  return uncompress(reinterpret_cast<Bytef *>(to), &room, from, static_cast<uLong>(packed.size())) == Z_OK &&
         room == size;
}

} // namespace voxelcore
