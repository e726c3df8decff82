#include "BmpFile.h"
#include "PieceStream.h"
#include "HeaderFields.h"
#include "voxelcore/Base/TextFields.h"

#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace voxelcore
{
namespace
{

constexpr std::size_t kFileHeader = 14;
constexpr std::size_t kShortestHeader = 40; ///< BITMAPINFOHEADER, which later ones begin with

[[noreturn]] void
RefuseBmp(const std::filesystem::path & path, std::string_view wrong)
{
  RefuseInput(path, wrong, "save the slices as TIFF or PNG");
}

struct BmpHeader
{
  GreyPage                   page;
  bool                       isUpwards = true; ///< the lowest row comes first
  std::uint32_t              bits = 8;
  std::uint64_t              offset = 0; ///< of the pixels
  std::uint64_t              rowBytes = 0;
  std::array<std::byte, 256> grey{}; ///< of each entry of the palette
};

BmpHeader
ReadHeader(const std::filesystem::path & path)
{
  const std::uint64_t    fileBytes = FileSize(path);
  const auto             stream = OpenBytes(path, 0, Packing::Plain);
  std::vector<std::byte> bytes(kFileHeader + kShortestHeader);
  bytes.resize(stream->ReadSome(bytes.data(), bytes.size()));
  if (bytes.size() < kFileHeader + kShortestHeader || bytes[0] != std::byte{ 'B' } || bytes[1] != std::byte{ 'M' })
  {
    RefuseInput(path, "not a BMP picture", "write it anew, or give it the extension of its kind");
  }
  const HeaderFields fields(bytes, std::endian::native != std::endian::little);
  BmpHeader          header;
  header.offset = fields.At<std::uint32_t>(10);
  const auto headerBytes = fields.At<std::uint32_t>(14);
  const auto width = fields.At<std::int32_t>(18);
  const auto height = fields.At<std::int32_t>(22);
  header.bits = fields.At<std::uint16_t>(28);
  auto colours = fields.At<std::uint32_t>(46);
  if (headerBytes < kShortestHeader || width <= 0 || height == 0 || height == INT32_MIN)
  {
    RefuseInput(path, "its header makes no sense", "the file is damaged: write it anew");
  }
  if (fields.At<std::uint32_t>(30) != 0 || (header.bits != 1 && header.bits != 8 && header.bits != 24))
  {
    RefuseBmp(path, Text("a BMP picture of ", header.bits, " bits a pixel, or packed"));
  }
  header.page = { static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(std::abs(height)) };
  header.isUpwards = height > 0;
  header.rowBytes = (std::uint64_t{ header.page.width } * header.bits + 31) / 32 * 4;
  if (header.offset < kFileHeader + kShortestHeader || header.offset > fileBytes ||
      header.rowBytes * header.page.height > fileBytes - header.offset)
  {
    RefuseInput(path,
                Text("its header gives ", width, " x ", std::abs(height), " pixels, its data cannot hold them"),
                "the file is truncated or its header damaged: fetch or write it anew");
  }
  if (header.bits <= 8)
  {
    const std::uint32_t most = 1U << header.bits;
    colours = colours == 0 ? most : colours;
    const std::uint64_t at = kFileHeader + std::uint64_t{ headerBytes };
    if (colours > most || at + 4ULL * colours > header.offset)
    {
      RefuseInput(path, "its palette makes no sense", "the file is damaged: write it anew");
    }
    std::vector<std::byte> palette(4ULL * colours);
    stream->Skip(at - bytes.size());
    stream->Read(palette.data(), palette.size());
    for (std::size_t c = 0; c < colours; ++c)
    {
      if (palette[4 * c] != palette[4 * c + 1] || palette[4 * c] != palette[4 * c + 2])
      {
        RefuseBmp(path, "a colour picture");
      }
      header.grey[c] = palette[4 * c];
    }
  }
  return header;
}

class BmpStream : public PieceStream
{
public:
  explicit BmpStream(const std::filesystem::path & path)
    : PieceStream(path)
    , m_Header(ReadHeader(path))
    , m_Rows(m_Header.rowBytes * m_Header.page.height)
    , m_Row(m_Header.page.width)
  {
    OpenBytes(path, m_Header.offset, Packing::Plain)->Read(m_Rows.data(), m_Rows.size());
  }

private:
  std::span<const std::byte>
  NextPiece() override
  {
    if (m_Next == m_Header.page.height)
    {
      return {};
    }
    const std::uint32_t     row = m_Header.isUpwards ? m_Header.page.height - 1 - m_Next : m_Next;
    const std::byte * const from = m_Rows.data() + row * m_Header.rowBytes;
    for (std::size_t x = 0; x < m_Row.size(); ++x)
    {
      if (m_Header.bits == 24)
      {
        if (from[3 * x] != from[3 * x + 1] || from[3 * x] != from[3 * x + 2])
        {
          RefuseBmp(m_Path, "a colour picture");
        }
        m_Row[x] = from[3 * x];
        continue;
      }
      const auto index = m_Header.bits == 8 ? from[x] : from[x / 8] >> (7 - x % 8) & std::byte{ 1 };
      m_Row[x] = m_Header.grey[static_cast<std::size_t>(index)];
    }
    ++m_Next;
    return m_Row;
  }

  BmpHeader              m_Header;
  std::vector<std::byte> m_Rows; ///< as they lie in the file
  std::vector<std::byte> m_Row;
  std::uint32_t          m_Next = 0;
};

} // namespace

GreyPage
InspectBmp(const std::filesystem::path & path)
{
  return ReadHeader(path).page;
}

std::unique_ptr<ByteStream>
OpenBmpPage(const std::filesystem::path & path)
{
  return std::make_unique<BmpStream>(path);
}

} // namespace voxelcore
