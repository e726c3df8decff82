// The voxels of TIFF pages, page by page.

#include "PieceStream.h"
#include "TiffFile.h"
#include "TiffHandle.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

class TiffStream : public PieceStream
{
public:
  TiffStream(const std::filesystem::path & path, TiffPages pages)
    : PieceStream(path)
    , m_Tiff(path)
    , m_Pages(std::move(pages))
  {}

  void
  Skip(std::uint64_t count) override
  {
    const std::uint64_t pageBytes = m_Pages.PageBytes();
    while (count >= pageBytes && IsBetweenPieces() && m_Next < m_Pages.offsets.size())
    {
      ++m_Next;
      count -= pageBytes;
    }
    ByteStream::Skip(count);
  }

private:
  std::span<const std::byte>
  NextPiece() override
  {
    if (m_Next == m_Pages.offsets.size())
    {
      return {};
    }
    DecodePage(m_Pages.offsets[m_Next++]);
    return m_Page;
  }

  /** Values of a row of a strip or tile, from `fromX` on, into the page. */
  void
  PutRow(const std::byte * row, std::uint32_t x, std::uint32_t y, std::uint32_t count)
  {
    const std::size_t bytes = PixelBytes(m_Pages.type);
    std::byte *       to = m_Page.data() + (std::size_t{ y } * m_Pages.width + x) * bytes;
    const std::size_t samples = m_Pages.planar ? 1U : m_Pages.samples;
    if (m_Pages.bits >= 8)
    {
      if (samples == 1)
      {
        std::memcpy(to, row, count * bytes);
        return;
      }
      for (std::uint32_t i = 0; i < count; ++i)
      {
        std::memcpy(to + i * bytes, row + (i * samples + m_Pages.component) * bytes, bytes);
      }
      return;
    }
    const std::size_t perByte = 8U / m_Pages.bits;
    const unsigned    mask = (1U << m_Pages.bits) - 1U;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::size_t value = i * samples + (samples > 1 ? m_Pages.component : 0U);
      const auto        shift = 8U - m_Pages.bits * static_cast<unsigned>(value % perByte + 1U);
      to[i] = static_cast<std::byte>((std::to_integer<unsigned>(row[value / perByte]) >> shift) & mask);
    }
  }

  void
  DecodePage(std::uint64_t offset)
  {
    TIFF * tiff = m_Tiff.Get();
    if (TIFFSetSubDirectory(tiff, offset) == 0)
    {
      m_Tiff.RefuseDamaged(Text("page ", m_Next, " cannot be read"));
    }
    const std::uint32_t width = m_Pages.width;
    const std::uint32_t height = m_Pages.height;
    const auto          plane = static_cast<std::uint16_t>(m_Pages.planar ? m_Pages.component : 0U);
    m_Page.resize(static_cast<std::size_t>(m_Pages.PageBytes()));
    if (TIFFIsTiled(tiff) != 0)
    {
      const auto tileWidth = m_Tiff.Field<std::uint32_t>(TIFFTAG_TILEWIDTH, 0);
      const auto tileHeight = m_Tiff.Field<std::uint32_t>(TIFFTAG_TILELENGTH, 0);
      const auto size = static_cast<std::size_t>(TIFFTileSize64(tiff));
      const auto rowBytes = static_cast<std::size_t>(TIFFTileRowSize64(tiff));
      m_Part.resize(size);
      for (std::uint32_t y = 0; y < height; y += tileHeight)
      {
        for (std::uint32_t x = 0; x < width; x += tileWidth)
        {
          Decode(TIFFReadEncodedTile(tiff,
                                     TIFFComputeTile(tiff, x, y, 0, plane),
                                     m_Part.data(),
                                     static_cast<tmsize_t>(size)),
                 size);
          const std::uint32_t columns = std::min(tileWidth, width - x);
          for (std::uint32_t row = 0; row < std::min(tileHeight, height - y); ++row)
          {
            PutRow(m_Part.data() + row * rowBytes, x, y + row, columns);
          }
          if (width - x <= tileWidth)
          {
            break; // x + tileWidth might overflow
          }
        }
        if (height - y <= tileHeight)
        {
          break;
        }
      }
      return;
    }
    const std::uint32_t perStrip = std::min(m_Tiff.Field<std::uint32_t>(TIFFTAG_ROWSPERSTRIP, height), height);
    const auto          rowBytes = static_cast<std::size_t>(TIFFScanlineSize64(tiff));
    m_Part.resize(static_cast<std::size_t>(TIFFStripSize64(tiff)));
    for (std::uint32_t y = 0; y < height; y += perStrip)
    {
      const std::uint32_t rows = std::min(perStrip, height - y);
      const std::size_t   size = rows * rowBytes;
      Decode(TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, y, plane), m_Part.data(), static_cast<tmsize_t>(size)),
             size);
      for (std::uint32_t row = 0; row < rows; ++row)
      {
        PutRow(m_Part.data() + row * rowBytes, 0, y + row, width);
      }
      if (height - y <= perStrip)
      {
        break;
      }
    }
  }

  void
  Decode(tmsize_t got, std::size_t needed) const
  {
    // Some decoders report what is wrong and go on: what they give then is no measurement.
    if (got < 0 || static_cast<std::size_t>(got) != needed || m_Tiff.HasError())
    {
      m_Tiff.RefuseDamaged(Text("page ", m_Next, " cannot be read in full"));
    }
  }

  TiffHandle             m_Tiff;
  TiffPages              m_Pages;
  std::vector<std::byte> m_Page;
  std::vector<std::byte> m_Part;
  std::size_t            m_Next = 0;
};

} // namespace

std::unique_ptr<ByteStream>
OpenTiffPages(const std::filesystem::path & path, const TiffPages & pages)
{
  return std::make_unique<TiffStream>(path, pages);
}

} // namespace voxelcore
