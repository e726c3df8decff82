#include "TiffFile.h"

#include "voxelcore/Formats/FormatOpeners.h"

#include "LsmInfo.h"
#include "TiffDescription.h"
#include "TiffHandle.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

/** The most bytes that one stored byte may stand for. */
std::uint64_t
Expansion(std::uint16_t compression, std::uint32_t width)
{
  switch (compression)
  {
    case COMPRESSION_NONE:
      return 1;
    case COMPRESSION_PACKBITS:
      return 128;
    case COMPRESSION_LZW:
    case COMPRESSION_DEFLATE:
    case COMPRESSION_ADOBE_DEFLATE:
      return 4096;
    case COMPRESSION_CCITTRLE:
    case COMPRESSION_CCITTRLEW:
    case COMPRESSION_CCITTFAX3:
    case COMPRESSION_CCITTFAX4:
      return std::uint64_t{ width } + 8; // an empty row of width / 8 bytes in one bit
    default:
      return 1U << 17;
  }
}

std::uint64_t
StoredBytes(const TiffHandle & tiff, std::uint64_t & largestPart)
{
  const std::uint32_t parts = TIFFIsTiled(tiff.Get()) ? TIFFNumberOfTiles(tiff.Get()) : TIFFNumberOfStrips(tiff.Get());
  std::uint64_t       bytes = 0;
  for (std::uint32_t part = 0; part < parts && !tiff.HasError(); ++part)
  {
    const std::uint64_t count = TIFFGetStrileByteCount(tiff.Get(), part);
    largestPart = std::max(largestPart, count);
    bytes += std::min<std::uint64_t>(count, std::uint64_t{ 1 } << 50);
  }
  return bytes;
}

/** One page's sizes and type. */
TiffPages
ReadPage(const std::filesystem::path & path,
         const TiffHandle &            tiff,
         std::uint64_t                 fileBytes,
         const ReadOptions &           options)
{
  TiffPages page;
  page.width = tiff.Field<std::uint32_t>(TIFFTAG_IMAGEWIDTH, 0);
  page.height = tiff.Field<std::uint32_t>(TIFFTAG_IMAGELENGTH, 0);
  page.bits = tiff.Field<std::uint16_t>(TIFFTAG_BITSPERSAMPLE, 1);
  page.samples = tiff.Field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1);
  page.planar =
    page.samples > 1 && tiff.Field<std::uint16_t>(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) == PLANARCONFIG_SEPARATE;
  const auto format = tiff.Field<std::uint16_t>(TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const auto photometric = tiff.Field<std::uint16_t>(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  const auto compression = tiff.Field<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  if (photometric == PHOTOMETRIC_PALETTE)
  {
    RefuseInput(path, "palette colour image", "save its labels as a grey-level image");
  }
  // Other kinds of colours (YCbCr, L*a*b) are not stored as values that stand for themselves.
  const bool isGrey = photometric == PHOTOMETRIC_MINISBLACK || photometric == PHOTOMETRIC_MINISWHITE;
  if (!isGrey && photometric != PHOTOMETRIC_RGB && photometric != PHOTOMETRIC_SEPARATED)
  {
    RefuseInput(path,
                Text("colour image or pixels of photometric kind ", photometric),
                "save it as a grey-level image of whole numbers");
  }
  if (page.samples < 1)
  {
    RefuseInput(path, "pixels without values", "the file is damaged: write it anew");
  }
  page.component = static_cast<std::uint16_t>(
    ChooseComponent(path, page.samples, isGrey ? "several values" : "colour image", options));
  page.minIsWhite = photometric == PHOTOMETRIC_MINISWHITE;
  page.lossy = compression == COMPRESSION_JPEG || compression == COMPRESSION_OJPEG || compression == COMPRESSION_WEBP;
  if (const auto orientation = tiff.Field<std::uint16_t>(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
      orientation != ORIENTATION_TOPLEFT)
  {
    RefuseInput(path,
                Text("pages are stored mirrored or turned (orientation ", orientation, ")"),
                "save it top row first");
  }

  const bool isSigned = format == SAMPLEFORMAT_INT;
  const bool isFloat = format == SAMPLEFORMAT_IEEEFP;
  const bool isWhole = format == SAMPLEFORMAT_UINT || isSigned || format == SAMPLEFORMAT_VOID;
  if (isWhole && !isSigned && (page.bits == 1 || page.bits == 2 || page.bits == 4))
  {
    page.type = PixelType::UInt8;
  }
  else if (isWhole && page.bits == 8)
  {
    page.type = isSigned ? PixelType::Int8 : PixelType::UInt8;
  }
  else if (isWhole && page.bits == 16)
  {
    page.type = isSigned ? PixelType::Int16 : PixelType::UInt16;
  }
  else if (isWhole && page.bits == 32)
  {
    page.type = isSigned ? PixelType::Int32 : PixelType::UInt32;
  }
  else if (isWhole && page.bits == 64)
  {
    page.type = isSigned ? PixelType::Int64 : PixelType::UInt64;
  }
  else if (isFloat && (page.bits == 32 || page.bits == 64))
  {
    page.type = page.bits == 32 ? PixelType::Float32 : PixelType::Float64;
  }
  else
  {
    RefuseInput(path,
                Text("pixels of ", page.bits, " bits (sample format ", format, ") cannot be read"),
                "save it with 8, 16 or 32 bits a pixel");
  }

  if (TIFFIsCODECConfigured(compression) == 0)
  {
    RefuseInput(path, Text("compression ", compression, " is not in this libtiff"), "save it with LZW or deflate");
  }
  std::uint64_t       largestPart = 0;
  const std::uint64_t stored = std::min(StoredBytes(tiff, largestPart), fileBytes);
  const std::uint64_t possible = stored * Expansion(compression, page.width) + 64;
  __extension__ using Wide = unsigned __int128; // two sides of 2^32 and 2^16 values of 64 bits
  const Wide          perRow = Wide{ page.width } * page.bits * (page.planar ? 1U : page.samples);
  const Wide          rows = (perRow + 7) / 8 * page.height * (page.planar ? page.samples : 1U);
  const std::uint64_t part = TIFFIsTiled(tiff.Get()) ? TIFFTileSize64(tiff.Get()) : TIFFStripSize64(tiff.Get());
  if (page.width == 0 || page.height == 0 || rows > possible || part == 0 ||
      part > std::min(largestPart, fileBytes) * Expansion(compression, page.width) + 64)
  {
    tiff.RefuseDamaged(
      Text("its header gives pages of ", page.width, " x ", page.height, ", its data cannot hold them"));
  }
  return page;
}

/** Of a stack of ImageJ's that lists its first page alone, where all of its pages lie, if they do. */
std::optional<TiffPages::Behind>
PagesBehind(const TiffHandle & tiff, const PageOrder & order, const TiffPages & first, std::uint64_t fileBytes)
{
  if (order.program != "ImageJ" || order.images < 2 || first.offsets.size() != 1 || order.channels != 1 ||
      order.frames != 1 || first.samples != 1 || first.bits < 8 || TIFFIsTiled(tiff.Get()) != 0 ||
      tiff.Field<std::uint16_t>(TIFFTAG_COMPRESSION, COMPRESSION_NONE) != COMPRESSION_NONE)
  {
    return std::nullopt;
  }
  TiffPages::Behind behind{ TIFFGetStrileOffset(tiff.Get(), 0),
                            order.images,
                            TIFFIsByteSwapped(tiff.Get()) != 0 && first.bits > 8 };
  std::uint64_t     next = behind.from;
  for (std::uint32_t strip = 0; strip < TIFFNumberOfStrips(tiff.Get()); ++strip)
  {
    if (TIFFGetStrileOffset(tiff.Get(), strip) != next)
    {
      return std::nullopt;
    }
    next += TIFFGetStrileByteCount(tiff.Get(), strip);
  }
  const std::uint64_t page = first.PageBytes();
  const bool          areThere = next - behind.from == page && behind.from <= fileBytes && order.images <= UINT32_MAX &&
                        (fileBytes - behind.from) / page >= order.images;
  return areThere ? std::optional(behind) : std::nullopt;
}

} // namespace

TiffPages
InspectTiff(const std::filesystem::path & path, const ReadOptions & options)
{
  const std::uint64_t fileBytes = FileSize(path);
  const TiffHandle    tiff(path);
  const std::string   description = tiff.Description();
  const auto          lsm = ReadLsmInfo(path, tiff);
  const PageOrder     order =
    lsm ? lsm->pages : ReadPageOrder(description, tiff.Field<std::uint16_t>(TIFFTAG_SAMPLESPERPIXEL, 1));
  ReadOptions ofPages = options;
  if (order.channels > 1)
  {
    ofPages.component.reset(); // chooses among pages, not among the values of a pixel
  }
  TiffPages pages = ReadPage(path, tiff, fileBytes, ofPages);
  pages.isLsm = lsm.has_value();
  pages.spacing = lsm ? lsm->spacing : ReadTiffSpacing(tiff, description);
  pages.offsets.push_back(TIFFCurrentDirOffset(tiff.Get()));
  if (lsm && (lsm->width != pages.width || lsm->height != pages.height))
  {
    tiff.RefuseDamaged("its block of LSM speaks of other pages");
  }
  std::uint64_t directories = 1;
  while (TIFFLastDirectory(tiff.Get()) == 0)
  {
    if (TIFFReadDirectory(tiff.Get()) == 0 || tiff.HasError())
    {
      tiff.RefuseDamaged(Text("the page after page ", pages.offsets.size(), " cannot be found"));
    }
    if (++directories * 8 > fileBytes)
    {
      tiff.RefuseDamaged("its pages go in circles");
    }
    if (lsm && (tiff.Field<std::uint32_t>(TIFFTAG_SUBFILETYPE, 0) & FILETYPE_REDUCEDIMAGE) != 0)
    {
      continue; // a thumbnail
    }
    const TiffPages page = ReadPage(path, tiff, fileBytes, ofPages);
    if (!AreAlike(page, pages))
    {
      RefuseInput(path,
                  Text("page ",
                       pages.offsets.size() + 1,
                       " (",
                       page.width,
                       " x ",
                       page.height,
                       ", ",
                       page.bits,
                       " bits) is not like the first (",
                       pages.width,
                       " x ",
                       pages.height,
                       ", ",
                       pages.bits,
                       " bits)"),
                  "a volume needs equal slices");
    }
    pages.lossy = pages.lossy || page.lossy;
    pages.offsets.push_back(TIFFCurrentDirOffset(tiff.Get()));
  }
  if (tiff.HasError())
  {
    tiff.RefuseDamaged("its directory is damaged");
  }
  if (lsm && order.images != pages.offsets.size())
  {
    RefuseInput(path,
                Text("LSM speaks of ", order.images, " slices, it has ", pages.offsets.size()),
                "the file is truncated: fetch it anew");
  }
  pages.frames = order.frames;
  pages.behind = PagesBehind(tiff, order, pages, fileBytes);
  if (pages.behind)
  {
    return pages;
  }
  pages.channelsAreSlices = !options.component && order.AreChannelsSlices(pages.offsets.size());
  pages.offsets = ChoosePages(path, order, pages.offsets, options);
  return pages;
}

ScanFile
OpenTiff(const std::filesystem::path & path, const ReadOptions & options)
{
  const TiffPages pages = InspectTiff(path, options);
  ScanFile        scan;
  scan.path = path;
  const std::uint64_t slices = pages.behind ? pages.behind->slices : pages.offsets.size();
  NoteOneSlice(slices, scan);
  scan.format = pages.isLsm ? "LSM" : "TIFF";
  DescribeTiff(pages, scan);
  scan.geometry.size = { pages.width, pages.height, static_cast<std::int64_t>(slices) };
  ChooseVolume(path, pages.frames, options);
  CheckSize(path, scan.geometry.size, PixelBytes(pages.type), ~std::uint64_t{ 0 });
  const Vector3 spacing = CompleteSpacing(pages.spacing, options, scan);
  SetGeometry(scan, { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, spacing, { 0, 0, 0 }, options);
  if (pages.behind)
  {
    ChooseComponent(path, 1, "stack", options);
    scan.voxels = OpenBytes(path, pages.behind->from, Packing::Plain);
    scan.swapBytes = pages.behind->swapBytes;
    scan.hasMore = true; // ImageJ's own notes on the stack
    return scan;
  }
  scan.voxels = OpenTiffPages(path, pages);
  return scan;
}

} // namespace voxelcore
