#include "Deflate.h"

#include <zlib.h>

#include <new>

namespace voxelcore
{

namespace
{

std::string
DeflateBy(int strategy, std::string_view bytes)
{
  // Of a root system's core level 6 makes 8 % less, in five times the time.
  constexpr int level = 1;
  constexpr int window = 15;
  constexpr int memory = 8; // zlib's own default
  z_stream      stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, window, memory, strategy) != Z_OK)
  {
    throw std::bad_alloc();
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<z_const Bytef *>(const_cast<char *>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef *>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int end = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END)
  {
    throw std::bad_alloc(); // there is room, so that nothing else can be wrong
  }
  return packed;
}

} // namespace

// In lengths and places of a refined core hardly anything recurs. Where samples say so only runs are looked for: radii,
// measures and moves of a gyroid come out 0.5 % longer, in 0.4 of the time.
std::string
Deflate(std::string_view bytes)
{
  constexpr std::size_t sample = std::size_t{ 1 } << 13;
  constexpr double      hardly = 0.85; // of it is left
  const auto            recursAt = [&](std::size_t first) {
    const std::string_view some = bytes.substr(first, sample);
    return static_cast<double>(DeflateBy(Z_DEFAULT_STRATEGY, some).size()) < hardly * static_cast<double>(some.size());
  };
  const bool recurs = bytes.size() <= 4 * sample || recursAt(0) || recursAt(bytes.size() / 2);
  return DeflateBy(recurs ? Z_DEFAULT_STRATEGY : Z_RLE, bytes);
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
