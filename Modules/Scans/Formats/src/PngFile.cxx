#include "PngFile.h"
#include "PieceStream.h"
#include "PlainStream.h"
#include "voxelcore/Base/TextFields.h"

#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>

namespace voxelcore
{
namespace
{

/** libpng's objects, and its way out of an error: OnError jumps to the setjmp in Guarded(). Only libpng's own frames
 *  and the lambda given to Guarded() are jumped over, and the latter holds nothing with a destructor. */
class PngHandle
{
public:
  explicit PngHandle(const std::filesystem::path & path)
    : m_Path(path)
    , m_File(path, 0)
  {
    m_Png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngHandle::OnError, &PngHandle::OnWarning);
    m_Info = m_Png == nullptr ? nullptr : png_create_info_struct(m_Png);
    if (m_Info == nullptr)
    {
      png_destroy_read_struct(&m_Png, nullptr, nullptr);
      throw std::bad_alloc();
    }
  }
  PngHandle(const PngHandle &) = delete;
  PngHandle &
  operator=(const PngHandle &) = delete;
  ~PngHandle()
  {
    png_destroy_read_struct(&m_Png, &m_Info, nullptr);
  }

  PngPage
  ReadHeader(const ReadOptions & options)
  {
    const std::uint64_t fileBytes = FileSize(m_Path);
    const bool          good = Guarded([this] {
      png_set_read_fn(m_Png, this, &PngHandle::OnRead);
      // A fault that libpng would let pass, such as surplus data, is one all the same.
      png_set_benign_errors(m_Png, 0);
      // Texts, colour profiles and the like are not even unpacked.
      png_set_keep_unknown_chunks(m_Png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
      png_set_user_limits(m_Png, 1U << 30, 1U << 30);
      png_set_compression_buffer_size(m_Png, 65536);
      png_read_info(m_Png, m_Info);
    });
    if (!good)
    {
      RefuseDamaged();
    }
    const int kind = png_get_color_type(m_Png, m_Info);
    if ((kind & PNG_COLOR_MASK_PALETTE) != 0)
    {
      RefuseInput(m_Path, "palette colour image", "save its labels as a grey-level image");
    }
    PngPage page;
    page.width = png_get_image_width(m_Png, m_Info);
    page.height = png_get_image_height(m_Png, m_Info);
    page.bits = png_get_bit_depth(m_Png, m_Info);
    page.samples = png_get_channels(m_Png, m_Info);
    page.component = static_cast<int>(
      ChooseComponent(m_Path,
                      static_cast<std::uint64_t>(page.samples),
                      (kind & PNG_COLOR_MASK_COLOR) != 0 ? "colour image" : "grey values and their opacity",
                      options));
    // Its rows must be able to come out of the file before anything is made for them.
    const std::uint64_t rowBytes =
      (std::uint64_t{ page.width } * static_cast<unsigned>(page.bits * page.samples) + 7) / 8 + 1;
    if (rowBytes * page.height > fileBytes * LargestExpansion(Packing::Deflate))
    {
      RefuseInput(m_Path,
                  Text("its header gives ", page.width, " x ", page.height, " pixels, its data cannot hold them"),
                  "the file is truncated or its header damaged: fetch or write it anew");
    }
    return page;
  }

  /** Prepares for rows: bytes or 16-bit words in this machine's order. Returns the bytes of a row. */
  std::size_t
  StartRows()
  {
    std::size_t rowBytes = 0;
    m_Interlaced = png_get_interlace_type(m_Png, m_Info) != PNG_INTERLACE_NONE;
    const bool good = Guarded([this, &rowBytes] {
      png_set_packing(m_Png);
      if (std::endian::native == std::endian::little)
      {
        png_set_swap(m_Png);
      }
      m_Passes = png_set_interlace_handling(m_Png);
      png_read_update_info(m_Png, m_Info);
      rowBytes = png_get_rowbytes(m_Png, m_Info);
    });
    if (!good)
    {
      RefuseDamaged();
    }
    return rowBytes;
  }

  bool
  IsInterlaced() const
  {
    return m_Interlaced;
  }

  /** The next row of an image that is not interlaced. */
  void
  ReadRow(std::byte * to)
  {
    if (!Guarded([this, to] { png_read_row(m_Png, reinterpret_cast<png_bytep>(to), nullptr); }))
    {
      RefuseDamaged();
    }
  }

  /** All rows of an interlaced one. */
  void
  ReadRows(std::byte * to, std::size_t rowBytes, std::uint32_t height)
  {
    const bool good = Guarded([=, this] {
      for (int pass = 0; pass < m_Passes; ++pass)
      {
        for (std::uint32_t y = 0; y < height; ++y)
        {
          png_read_row(m_Png, reinterpret_cast<png_bytep>(to + y * rowBytes), nullptr);
        }
      }
    });
    if (!good)
    {
      RefuseDamaged();
    }
  }

  /** The end of the image with its checksums. */
  void
  Finish()
  {
    if (!Guarded([this] { png_read_end(m_Png, nullptr); }))
    {
      RefuseDamaged();
    }
  }

private:
  template <typename Work>
  bool
  Guarded(const Work & work) // not noexcept: in WebAssembly a jump out is an exception of its own kind
  {
    // NOLINTNEXTLINE(cert-err52-cpp): the only way that libpng has to fail
    if (setjmp(m_Back) != 0)
    {
      return false;
    }
    work();
    return true;
  }

  [[noreturn]] void
  RefuseDamaged() const
  {
    RefuseInput(m_Path,
                Text("a PNG image that cannot be read (", Printable(m_Error.data(), 120), ")"),
                "the file is damaged, truncated or of another kind: write it anew");
  }

  [[noreturn]] static void
  OnError(png_structp png, png_const_charp text)
  {
    auto * const self = static_cast<PngHandle *>(png_get_error_ptr(png));
    std::strncpy(self->m_Error.data(), text, self->m_Error.size() - 1);
    std::longjmp(self->m_Back, 1); // libpng's own call of it goes through a pointer, which WebAssembly has not
  }
  static void
  OnWarning(png_structp, png_const_charp)
  {}
  static void
  OnRead(png_structp png, png_bytep to, std::size_t count)
  {
    auto * const self = static_cast<PngHandle *>(png_get_io_ptr(png));
    std::size_t  got = 0;
    try
    {
      got = self->m_File.ReadSome(reinterpret_cast<std::byte *>(to), count);
    }
    catch (const std::exception &)
    {
      got = 0; // no exception may pass through libpng
    }
    if (got != count)
    {
      png_error(png, "the file ends too early or cannot be read");
    }
  }

  std::filesystem::path m_Path;
  PlainStream           m_File;
  png_structp           m_Png = nullptr;
  png_infop             m_Info = nullptr;
  int                   m_Passes = 1;
  bool                  m_Interlaced = false;
  std::jmp_buf          m_Back{};
  std::array<char, 200> m_Error{};
};

class PngStream : public PieceStream
{
public:
  PngStream(const std::filesystem::path & path, const ReadOptions & options)
    : PieceStream(path)
    , m_Png(path)
    , m_Page(m_Png.ReadHeader(options))
  {
    m_RowBytes = m_Png.StartRows();
    if (m_Png.IsInterlaced())
    {
      m_Rows.resize(m_RowBytes * m_Page.height);
      m_Png.ReadRows(m_Rows.data(), m_RowBytes, m_Page.height);
    }
    else
    {
      m_Rows.resize(m_RowBytes);
    }
    m_Width = m_Page.width * PixelBytes(m_Page.Type());
    m_Values.resize(m_Page.samples > 1 ? m_Width : 0);
  }

  bool
  Finish() override
  {
    while (!NextPiece().empty())
    {}
    m_Png.Finish();
    return false;
  }

private:
  std::span<const std::byte>
  NextPiece() override
  {
    if (m_Next == m_Page.height)
    {
      return {};
    }
    const std::byte * row = m_Rows.data();
    if (m_Png.IsInterlaced())
    {
      row += m_Next * m_RowBytes;
    }
    else
    {
      m_Png.ReadRow(m_Rows.data());
    }
    ++m_Next;
    if (m_Page.samples > 1)
    {
      const std::size_t bytes = PixelBytes(m_Page.Type());
      const auto        samples = static_cast<std::size_t>(m_Page.samples);
      for (std::size_t x = 0; x < m_Page.width; ++x)
      {
        std::memcpy(m_Values.data() + x * bytes,
                    row + (x * samples + static_cast<std::size_t>(m_Page.component)) * bytes,
                    bytes);
      }
      row = m_Values.data();
    }
    return { row, m_Width };
  }

  PngHandle              m_Png;
  PngPage                m_Page;
  std::size_t            m_RowBytes = 0;
  std::vector<std::byte> m_Rows;      ///< as libpng gives them: one, or all of an interlaced image
  std::vector<std::byte> m_Values;    ///< a row of the component chosen
  std::size_t            m_Width = 0; ///< bytes a row
  std::uint32_t          m_Next = 0;
};

} // namespace

PngPage
InspectPng(const std::filesystem::path & path, const ReadOptions & options)
{
  return PngHandle(path).ReadHeader(options);
}

std::unique_ptr<ByteStream>
OpenPngPage(const std::filesystem::path & path, const ReadOptions & options)
{
  return std::make_unique<PngStream>(path, options);
}

} // namespace voxelcore
