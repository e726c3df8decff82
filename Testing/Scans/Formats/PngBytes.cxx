#include "PngBytes.h"

#include "ScanBytes.h"

#include <array>

namespace voxelcore::testing
{
namespace
{

std::size_t
Samples(int colour)
{
  return colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
}

/** The checksum of chunks, a bit at a time. */
std::uint32_t
Crc(std::string_view bytes)
{
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes)
  {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

/** Pixels x0, x0 + dx, ... of rows y0, y0 + dy, ... */
std::string
PassRows(const PngImage & image, std::uint32_t x0, std::uint32_t dx, std::uint32_t y0, std::uint32_t dy)
{
  const std::size_t samples = Samples(image.colour);
  std::string       all;
  std::string       above;
  for (std::uint32_t y = y0; y < image.height && x0 < image.width; y += dy)
  {
    std::string   row;
    unsigned      bitsIn = 0;
    std::uint32_t last = 0;
    for (std::uint32_t x = x0; x < image.width; x += dx)
    {
      for (std::size_t s = 0; s < samples; ++s)
      {
        const unsigned value = image.values[(std::size_t{ y } * image.width + x) * samples + s];
        if (image.bits == 16)
        {
          row += Raw<std::uint16_t>(static_cast<std::uint16_t>(value), true);
          continue;
        }
        last = (last << image.bits) | value;
        bitsIn += static_cast<unsigned>(image.bits);
        if (bitsIn == 8)
        {
          row += static_cast<char>(last);
          bitsIn = 0;
          last = 0;
        }
      }
    }
    if (bitsIn > 0)
    {
      row += static_cast<char>(last << (8 - bitsIn));
    }
    above.resize(row.size(), '\0');
    const std::size_t back = std::max<std::size_t>(1, samples * static_cast<std::size_t>(image.bits) / 8);
    std::string       filtered = row;
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      const char before =
        image.filter == 1 ? (i >= back ? row[i - back] : '\0') : (image.filter == 2 ? above[i] : '\0');
      filtered[i] = static_cast<char>(row[i] - before);
    }
    all += static_cast<char>(image.filter) + filtered;
    above = row;
  }
  return all;
}

} // namespace

std::string
PngChunk(std::string_view name, std::string_view data)
{
  const std::string body = std::string(name) + std::string(data);
  return Raw<std::uint32_t>(static_cast<std::uint32_t>(data.size()), true) + body + Raw<std::uint32_t>(Crc(body), true);
}

std::string
PngRows(const PngImage & image)
{
  if (!image.interlaced)
  {
    return PassRows(image, 0, 1, 0, 1);
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 7> passes{
    { { 0, 8, 0, 8 }, { 4, 8, 0, 8 }, { 0, 4, 4, 8 }, { 2, 4, 0, 4 }, { 0, 2, 2, 4 }, { 1, 2, 0, 2 }, { 0, 1, 1, 2 } }
  };
  std::string all;
  for (const auto & [x0, dx, y0, dy] : passes)
  {
    all += PassRows(image, x0, dx, y0, dy);
  }
  return all;
}

std::string
Png(const PngImage & image, const std::string & packed, const std::string & more)
{
  std::string header = Raw<std::uint32_t>(image.width, true) + Raw<std::uint32_t>(image.height, true);
  header +=
    { static_cast<char>(image.bits), static_cast<char>(image.colour), 0, 0, static_cast<char>(image.interlaced) };
  return "\x89PNG\r\n\x1A\n" + PngChunk("IHDR", header) + more +
         PngChunk("IDAT", packed.empty() ? Zlib(PngRows(image)) : packed) + PngChunk("IEND", "");
}

} // namespace voxelcore::testing
