#include "JpegFile.h"
#include "PieceStream.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/ScanFile.h"

#ifdef VOXELCORE_JPEG
#  include <cstdio>

#  include <jpeglib.h>

#  include <algorithm>
#  include <array>
#  include <csetjmp>
#  include <cstdlib>
#  include <cstring>
#  include <vector>
#endif

namespace voxelcore
{

#ifdef VOXELCORE_JPEG

namespace
{

/** libjpeg leaves its functions through a jump when something is wrong. No object with a destructor is made between. */
struct JpegErrors
{
  jpeg_error_mgr                    base{};
  std::jmp_buf                      back{};
  std::array<char, JMSG_LENGTH_MAX> text{};
};

void
OnError(j_common_ptr reader)
{
  auto * errors = reinterpret_cast<JpegErrors *>(reader->err);
  errors->base.format_message(reader, errors->text.data());
  std::longjmp(errors->back, 1);
}

class JpegReader
{
public:
  explicit JpegReader(const std::filesystem::path & path)
    : m_Path(path)
    , m_Bytes(static_cast<std::size_t>(FileSize(path)))
  {
    OpenBytes(path, 0, Packing::Plain)->Read(reinterpret_cast<std::byte *>(m_Bytes.data()), m_Bytes.size());
    m_Reader.err = jpeg_std_error(&m_Errors.base);
    m_Errors.base.error_exit = OnError;
    // A warning is an error: what libjpeg makes up for data that are damaged is no measurement.
    m_Errors.base.emit_message = [](j_common_ptr reader, int level) {
      if (level < 0)
      {
        OnError(reader);
      }
    };
    if (!Begin())
    {
      const std::string why = Printable(m_Errors.text.data(), 100);
      jpeg_destroy_decompress(&m_Reader);
      RefuseInput(path, Text("no JPEG picture (", why, ")"), "the file is damaged: write it anew, best as TIFF or PNG");
    }
    // A block of 64 pixels takes four bits at least.
    constexpr std::uint64_t mostPerByte = 128;
    const bool              isGrey = m_Reader.jpeg_color_space == JCS_GRAYSCALE;
    const bool isKnown = isGrey || m_Reader.jpeg_color_space == JCS_YCbCr || m_Reader.jpeg_color_space == JCS_RGB;
    const std::uint64_t pixels = std::uint64_t{ m_Reader.image_width } * m_Reader.image_height;
    if (!isKnown || pixels == 0 || pixels > mostPerByte * m_Bytes.size() + 4096)
    {
      const std::string what = isKnown ? Text("its header gives ",
                                              m_Reader.image_width,
                                              " x ",
                                              m_Reader.image_height,
                                              " pixels, its data cannot hold them")
                                       : std::string("a JPEG picture in colours of print");
      jpeg_destroy_decompress(&m_Reader);
      RefuseInput(path, what, "write it anew, best as TIFF or PNG");
    }
    m_Reader.out_color_space = isGrey ? JCS_GRAYSCALE : JCS_RGB;
  }
  JpegReader(const JpegReader &) = delete;
  JpegReader &
  operator=(const JpegReader &) = delete;
  ~JpegReader()
  {
    jpeg_destroy_decompress(&m_Reader);
  }

  GreyPage
  Page() const
  {
    return { m_Reader.image_width, m_Reader.image_height };
  }

  /** The next row; colours that differ by more than rounding are refused. */
  void
  NextRow(std::vector<std::byte> & row)
  {
    if (!m_IsOpen)
    {
      Require(Start());
      m_IsOpen = true;
      m_Row.resize(std::size_t{ m_Reader.image_width } * static_cast<std::size_t>(m_Reader.output_components));
    }
    Require(ReadRow());
    const auto each = static_cast<std::size_t>(m_Reader.output_components);
    for (std::size_t x = 0; x < row.size(); ++x)
    {
      const unsigned char * const at = m_Row.data() + each * x;
      if (each == 3 && std::max({ at[0], at[1], at[2] }) - std::min({ at[0], at[1], at[2] }) > 8)
      {
        RefuseInput(m_Path, "a colour picture", "save the slices as TIFF or PNG");
      }
      row[x] = static_cast<std::byte>(at[each == 3 ? 1 : 0]);
    }
  }

private:
  bool
  Begin()
  {
    if (setjmp(m_Errors.back) != 0)
    {
      return false;
    }
    jpeg_create_decompress(&m_Reader);
    jpeg_mem_src(&m_Reader, m_Bytes.data(), static_cast<unsigned long>(m_Bytes.size()));
    jpeg_read_header(&m_Reader, TRUE);
    return true;
  }
  bool
  Start()
  {
    if (setjmp(m_Errors.back) != 0)
    {
      return false;
    }
    jpeg_start_decompress(&m_Reader);
    return true;
  }
  bool
  ReadRow()
  {
    if (setjmp(m_Errors.back) != 0)
    {
      return false;
    }
    JSAMPROW row = m_Row.data();
    return jpeg_read_scanlines(&m_Reader, &row, 1) == 1;
  }
  void
  Require(bool good) const
  {
    if (!good)
    {
      RefuseInput(m_Path,
                  Text("its pixels cannot be read (", Printable(m_Errors.text.data(), 100), ")"),
                  "the file is damaged: write it anew, best as TIFF or PNG");
    }
  }

  std::filesystem::path      m_Path;
  std::vector<unsigned char> m_Bytes;
  std::vector<unsigned char> m_Row;
  JpegErrors                 m_Errors;
  jpeg_decompress_struct     m_Reader{};
  bool                       m_IsOpen = false;
};

class JpegStream : public PieceStream
{
public:
  explicit JpegStream(const std::filesystem::path & path)
    : PieceStream(path)
    , m_Reader(path)
    , m_Row(m_Reader.Page().width)
  {}

private:
  std::span<const std::byte>
  NextPiece() override
  {
    if (m_Next == m_Reader.Page().height)
    {
      return {};
    }
    m_Reader.NextRow(m_Row);
    ++m_Next;
    return m_Row;
  }

  JpegReader             m_Reader;
  std::vector<std::byte> m_Row;
  std::uint32_t          m_Next = 0;
};

} // namespace

GreyPage
InspectJpeg(const std::filesystem::path & path)
{
  return JpegReader(path).Page();
}

std::unique_ptr<ByteStream>
OpenJpegPage(const std::filesystem::path & path)
{
  return std::make_unique<JpegStream>(path);
}

#else

namespace
{

[[noreturn]] void
RefuseJpeg(const std::filesystem::path & path)
{
  RefuseInput(path, "a JPEG picture, which this build, without libjpeg, does not read", "save slices as TIFF or PNG");
}

} // namespace

GreyPage
InspectJpeg(const std::filesystem::path & path)
{
  RefuseJpeg(path);
}

std::unique_ptr<ByteStream>
OpenJpegPage(const std::filesystem::path & path)
{
  RefuseJpeg(path);
}

#endif

} // namespace voxelcore
