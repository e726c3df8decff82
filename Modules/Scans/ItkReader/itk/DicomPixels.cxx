#include "DicomPixels.h"

#include "DicomFields.h"
#include "voxelcore/Base/TextFields.h"

#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmVersion.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <sstream>
#include <type_traits>

namespace voxelcore::itkreader
{
namespace
{

/** GDCM fills up with zeros what is missing at the end of a file, so the bytes are looked for in the file itself: those
 *  of plain pixels, or the mark behind the last fragment of packed ones. */
bool
IsWhole(const std::filesystem::path & path, const gdcm::TransferSyntax & syntax, std::size_t bytes)
{
  if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian)
  {
    return true; // where zlib looks
  }
  std::ifstream         file(path, std::ios::binary);
  const auto            length = static_cast<std::size_t>(std::filesystem::file_size(path));
  constexpr std::size_t packedTail = 1U << 16;
  const std::size_t     tail = std::min(length, syntax.IsEncapsulated() ? packedTail : bytes + packedTail);
  std::string           text(tail, '\0');
  file.seekg(static_cast<std::streamoff>(length - tail));
  file.read(text.data(), static_cast<std::streamsize>(tail));
  using namespace std::string_view_literals;
  if (syntax.IsEncapsulated())
  {
    return text.find("\xfe\xff\xdd\xe0\0\0\0\0"sv) != std::string::npos;
  }
  // The element that has at least as many bytes as the pixels, and ends within the file.
  const bool             big = syntax == gdcm::TransferSyntax::ExplicitVRBigEndian;
  const std::string_view tag = big ? "\x7f\xe0\0\x10"sv : "\xe0\x7f\x10\0"sv;
  for (std::size_t at = text.find(tag); at != std::string::npos; at = text.find(tag, at + 1))
  {
    const std::size_t head = syntax.IsExplicit() ? 12 : 8;
    if (at + head > text.size())
    {
      break;
    }
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < 4; ++n)
    {
      const auto byte = static_cast<unsigned char>(text[at + head - 4 + n]);
      value |= static_cast<std::uint32_t>(byte) << (8 * (big ? 3 - n : n));
    }
    if (value >= bytes && value <= text.size() - at - head)
    {
      return true;
    }
  }
  return false;
}

/** GDCM unpacks pixels of the classes it knows: of another it is told that this is a multi-frame image. */
bool
ReadAsKnownClass(gdcm::Reader & file, std::stringstream & copy, gdcm::ImageReader & reader)
{
  gdcm::DataElement sopClass(gdcm::Tag(0x0008, 0x0016));
  // Multi-frame Grayscale Byte Secondary Capture, of an even length as all values.
  const std::string known("1.2.840.10008.5.1.4.1.1.7.2\0", 28);
  sopClass.SetVR(gdcm::VR::UI);
  sopClass.SetByteValue(known.data(), static_cast<std::uint32_t>(known.size()));
  file.GetFile().GetDataSet().Replace(sopClass);
  sopClass.SetTag(gdcm::Tag(0x0002, 0x0002));
  file.GetFile().GetHeader().Replace(sopClass);
  gdcm::Writer writer;
  writer.SetStream(copy);
  writer.SetFile(file.GetFile());
  writer.SetCheckFileMetaInformation(false);
  if (!writer.Write())
  {
    return false;
  }
  reader.SetStream(copy);
  return reader.Read();
}

/** Bits above those stored are none of the value. GDCM 3.0.21 clears them in 16 bits only, and ends the program at
 *  pixels of 8 or 32. */
template <typename T>
void
ClearUnusedBitsAs(int unused, std::vector<char> & bytes)
{
  for (std::size_t at = 0; at + sizeof(T) <= bytes.size(); at += sizeof(T))
  {
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    value = static_cast<T>(static_cast<T>(static_cast<std::make_unsigned_t<T>>(value) << unused) >> unused);
    std::memcpy(bytes.data() + at, &value, sizeof(T));
  }
}

void
ClearUnusedBits(const DicomPixels & pixels, std::vector<char> & bytes)
{
  const int unused = pixels.bitsAllocated - pixels.bitsStored;
  if (unused == 0)
  {
    return;
  }
  switch (pixels.bitsAllocated)
  {
    case 8:
      return pixels.isSigned ? ClearUnusedBitsAs<std::int8_t>(unused, bytes)
                             : ClearUnusedBitsAs<std::uint8_t>(unused, bytes);
    case 16:
      return pixels.isSigned ? ClearUnusedBitsAs<std::int16_t>(unused, bytes)
                             : ClearUnusedBitsAs<std::uint16_t>(unused, bytes);
    default:
      return pixels.isSigned ? ClearUnusedBitsAs<std::int32_t>(unused, bytes)
                             : ClearUnusedBitsAs<std::uint32_t>(unused, bytes);
  }
}

} // namespace

PixelType
DicomPixels::Type() const
{
  switch (bitsAllocated)
  {
    case 8:
      return isSigned ? PixelType::Int8 : PixelType::UInt8;
    case 16:
      return isSigned ? PixelType::Int16 : PixelType::UInt16;
    default:
      return isSigned ? PixelType::Int32 : PixelType::UInt32;
  }
}

void
TakeRescale(const gdcm::DataSet & set, DicomPixels & pixels)
{
  pixels.intercept = FieldReal(set, gdcm::Tag(0x0028, 0x1052)).value_or(pixels.intercept);
  pixels.slope = FieldReal(set, gdcm::Tag(0x0028, 0x1053)).value_or(pixels.slope);
}

DicomPixels
DescribePixels(const std::filesystem::path & path, const gdcm::DataSet & set)
{
  DicomPixels pixels;
  pixels.rows = FieldShort(set, gdcm::Tag(0x0028, 0x0010)).value_or(0);
  pixels.columns = FieldShort(set, gdcm::Tag(0x0028, 0x0011)).value_or(0);
  pixels.bitsAllocated = FieldShort(set, gdcm::Tag(0x0028, 0x0100)).value_or(0);
  pixels.bitsStored = FieldShort(set, gdcm::Tag(0x0028, 0x0101)).value_or(0);
  pixels.isSigned = FieldShort(set, gdcm::Tag(0x0028, 0x0103)).value_or(0) == 1;
  if (!FieldText(set, gdcm::Tag(0x0028, 0x0008)).empty())
  {
    const auto frames = FieldReal(set, gdcm::Tag(0x0028, 0x0008));
    pixels.frames = frames && *frames >= 1 && *frames < 1e9 ? static_cast<std::int64_t>(*frames) : 0;
  }
  if (pixels.rows < 1 || pixels.columns < 1 || pixels.frames < 1)
  {
    RefuseInput(path, "a DICOM file without an image", "give a file of a series of slices");
  }
  const std::string colours = FieldText(set, gdcm::Tag(0x0028, 0x0004));
  if (FieldShort(set, gdcm::Tag(0x0028, 0x0002)).value_or(1) != 1 ||
      (!colours.empty() && !colours.starts_with("MONOCHROME") && colours != "PALETTE COLOR"))
  {
    RefuseInput(path, Text("colour image (", Printable(colours, 30), ")"), "save it with one whole number a voxel");
  }
  const bool bits = pixels.bitsAllocated == 1;
  if ((!bits && pixels.bitsAllocated != 8 && pixels.bitsAllocated != 16 && pixels.bitsAllocated != 32) ||
      pixels.bitsStored < 1 || pixels.bitsStored > pixels.bitsAllocated)
  {
    RefuseInput(path,
                Text("pixels of ", pixels.bitsStored, " bits in ", pixels.bitsAllocated),
                "save it with whole numbers of 1, 8, 16 or 32 bits");
  }
  if (FieldShort(set, gdcm::Tag(0x0028, 0x0102)).value_or(static_cast<std::uint16_t>(pixels.bitsStored - 1)) !=
      pixels.bitsStored - 1)
  {
    RefuseInput(path, "pixels whose bits do not begin with the lowest", "load it in 3D Slicer and save it as .nrrd");
  }
  if (set.FindDataElement(gdcm::Tag(0x0028, 0x3000)))
  {
    RefuseInput(path, "pixels that stand for values of a table", "load it in 3D Slicer and save it as .nrrd");
  }
  TakeRescale(set, pixels);
  return pixels;
}

std::vector<char>
ReadPixels(const std::filesystem::path & path, const DicomPixels & pixels)
{
  const auto        values = pixels.FrameValues() * static_cast<std::size_t>(pixels.frames);
  const bool        bits = pixels.bitsAllocated == 1;
  const std::size_t bytes = bits ? (values + 7) / 8 : pixels.FrameBytes() * static_cast<std::size_t>(pixels.frames);
  gdcm::Reader      file;
  file.SetFileName(path.c_str());
  if (!file.Read())
  {
    RefuseInput(path, "GDCM cannot read it", "the file is damaged: fetch it anew");
  }
  const gdcm::TransferSyntax & syntax = file.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (!syntax.IsEncapsulated())
  {
    const std::string_view stored = FieldBytes(file.GetFile().GetDataSet(), gdcm::Tag(0x7fe0, 0x0010));
    if (stored.size() < bytes || !IsWhole(path, syntax, bytes))
    {
      RefuseInput(path, "its pixels are truncated", "fetch the file anew");
    }
    if (bits || syntax != gdcm::TransferSyntax::ExplicitVRBigEndian)
    {
      std::vector<char> plain(stored.begin(), stored.begin() + static_cast<std::ptrdiff_t>(bytes));
      ClearUnusedBits(pixels, plain);
      return plain;
    }
  }
  else if (bits)
  {
    RefuseInput(path, "compressed pixels of one bit", "decompress it with 'gdcmconv --raw'");
  }
  else if (!IsWhole(path, syntax, bytes))
  {
    RefuseInput(path, "its pixels are truncated", "fetch the file anew");
  }
  gdcm::ImageReader byName;
  gdcm::ImageReader byClass;
  std::stringstream copy;
  byName.SetFileName(path.c_str());
  const bool isKnown = byName.Read();
  if (!isKnown && !ReadAsKnownClass(file, copy, byClass))
  {
    RefuseInput(path, "GDCM cannot read its pixels", "convert it with 'gdcmconv --raw' or 'dcmdjpeg'");
  }
  const gdcm::Image & image = (isKnown ? byName : byClass).GetImage();
  if (image.GetBufferLength() != bytes)
  {
    RefuseInput(path, "its pixels are fewer or more than its header says", "the file is damaged: fetch it anew");
  }
  std::vector<char> buffer(bytes);
  if (!image.GetBuffer(buffer.data()))
  {
    RefuseInput(path, "GDCM cannot unpack its pixels", "convert it with 'gdcmconv --raw' or 'dcmdjpeg'");
  }
  return buffer;
}

std::string
GdcmName()
{
  return std::string("GDCM ") + gdcm::Version::GetVersion();
}

} // namespace voxelcore::itkreader
