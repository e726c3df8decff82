#include "ForeignBytes.h"

#include "ScanBytes.h"

#include <cstdio>

namespace voxelcore::testing
{
namespace
{

constexpr std::size_t kI = 6;
constexpr std::size_t kJ = 5;
constexpr std::size_t kK = 4;

std::string
Short(int value)
{
  return Raw<std::uint16_t>(static_cast<std::uint16_t>(value));
}

/** The fields of an image of grey pixels. */
std::string
PixelFields(int bits)
{
  return DicomElement(0x0028, 0x0010, "US", Short(kJ)) + DicomElement(0x0028, 0x0011, "US", Short(kI)) +
         DicomElement(0x0028, 0x0100, "US", Short(bits)) + DicomElement(0x0028, 0x0101, "US", Short(bits)) +
         DicomElement(0x0028, 0x0102, "US", Short(bits - 1)) + DicomElement(0x0028, 0x0103, "US", Short(0));
}

std::string
Place(std::size_t k)
{
  return DicomElement(0x0020, 0x0032, "DS", "-1\\2\\" + std::to_string(2 * k));
}

} // namespace

std::vector<int>
ForeignValues()
{
  std::vector<int> values(kI * kJ * kK, 0);
  for (std::size_t n = 0; n < values.size(); n += 3)
  {
    values[n] = static_cast<int>(n % 7);
  }
  return values;
}

std::string
MrcBytes()
{
  std::string header(1024, '\0');
  const auto  word = [&header](std::size_t number, const std::string & bytes) {
    header.replace(4 * (number - 1), bytes.size(), bytes);
  };
  const std::int32_t sides[]{ kI, kJ, kK };
  const float        cell[]{ 60, 100, 120 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    word(1 + axis, Raw<std::int32_t>(sides[axis]));
    word(8 + axis, Raw<std::int32_t>(sides[axis]));
    word(11 + axis, Raw<float>(cell[axis]));
    word(14 + axis, Raw<float>(90));
    word(17 + axis, Raw<std::int32_t>(static_cast<std::int32_t>(axis) + 1));
  }
  word(21, Raw<float>(6));
  word(23, Raw<std::int32_t>(1));
  word(28, Raw<std::int32_t>(20140));
  word(53, "MAP ");
  word(54, "\x44\x44");
  return header + RawAll<std::int8_t>(ForeignValues());
}

std::string
LsmBytes(const LsmLayout & layout)
{
  std::string block = Raw<std::uint32_t>(layout.magic) + Raw<std::int32_t>(512);
  for (const int side : { layout.width, static_cast<int>(kJ), layout.slices, layout.channels, layout.frames, 1, 8, 8 })
  {
    block += Raw<std::int32_t>(side);
  }
  for (const double metres : layout.metres)
  {
    block += Raw<double>(metres);
  }
  block += std::string(24, '\0') + Raw<std::uint16_t>(static_cast<std::uint16_t>(layout.kind));
  block.resize(layout.blockBytes, '\0');
  constexpr std::uint16_t kNewSubfileType = 254;
  constexpr std::uint16_t kPlanarConfig = 284;
  const std::string       values = RawAll<std::uint8_t>(ForeignValues());
  std::vector<TiffPage>   pages;
  for (int number = 0; number < (layout.frames == 2 ? 2 : 1) * static_cast<int>(kK); ++number)
  {
    TiffPage page;
    page.width = kI;
    page.height = kJ;
    page.samples = layout.channels;
    page.more = { { kNewSubfileType, 0 } };
    page.parts.push_back(values.substr(static_cast<std::size_t>(number) % kK * kI * kJ, kI * kJ));
    if (layout.channels == 2)
    {
      page.more.push_back({ kPlanarConfig, 2 });
      page.parts.emplace_back(kI * kJ, '\0');
    }
    if (number == 0)
    {
      page.blocks = { { 34412, block } };
    }
    pages.push_back(page);
    if (layout.thumbnails)
    {
      TiffPage small;
      small.width = 8;
      small.height = 8;
      small.more = { { kNewSubfileType, 1 } };
      small.parts = { std::string(64, 'c') };
      pages.push_back(small);
    }
  }
  return Tiff(pages);
}

std::string
GiplBytes()
{
  std::string header;
  for (const std::size_t side : { kI, kJ, kK, std::size_t{ 1 } })
  {
    header += Raw<std::uint16_t>(static_cast<std::uint16_t>(side), true);
  }
  header += Raw<std::uint16_t>(8, true);
  for (const float side : { 0.5F, 0.75F, 2.0F, 1.0F })
  {
    header += Raw<float>(side, true);
  }
  header.resize(252, '\0');
  return header + Raw<std::uint32_t>(719555000, true) + RawAll<std::uint8_t>(ForeignValues());
}

std::string
VtkBytes(bool text)
{
  std::string bytes = std::string("# vtk DataFile Version 3.0\na scan\n") + (text ? "ASCII" : "BINARY") +
                      "\nDATASET STRUCTURED_POINTS\nDIMENSIONS 6 5 4\nSPACING 0.5 0.75 2\nORIGIN 1 2 3\n"
                      "POINT_DATA 120\nSCALARS labels short 1\nLOOKUP_TABLE default\n";
  if (!text)
  {
    return bytes + RawAll<std::int16_t>(ForeignValues(), true) + "\n";
  }
  for (const int value : ForeignValues())
  {
    bytes += std::to_string(value) + " ";
  }
  return bytes + "\n";
}

std::string
DicomElement(std::uint16_t group, std::uint16_t element, const char * vr, std::string value)
{
  const std::string name = vr;
  const bool        isLong = name == "OB" || name == "OW" || name == "SQ" || name == "UN";
  if (value.size() % 2 != 0)
  {
    value += name == "UI" || name == "OB" ? '\0' : ' ';
  }
  const std::string length = isLong
                               ? std::string(2, '\0') + Raw<std::uint32_t>(static_cast<std::uint32_t>(value.size()))
                               : Raw<std::uint16_t>(static_cast<std::uint16_t>(value.size()));
  return Raw<std::uint16_t>(group) + Raw<std::uint16_t>(element) + name + length + value;
}

std::string
DicomSequence(std::uint16_t group, std::uint16_t element, const std::vector<std::string> & items)
{
  std::string value;
  for (const std::string & item : items)
  {
    value += Raw<std::uint16_t>(0xfffe) + Raw<std::uint16_t>(0xe000) +
             Raw<std::uint32_t>(static_cast<std::uint32_t>(item.size())) + item;
  }
  return DicomElement(group, element, "SQ", value);
}

std::string
DicomFile(const std::string & sopClass, const std::string & dataSet)
{
  const std::string meta =
    DicomElement(0x0002, 0x0001, "OB", std::string("\0\1", 2)) + DicomElement(0x0002, 0x0002, "UI", sopClass) +
    DicomElement(0x0002, 0x0003, "UI", "1.2.3.4") + DicomElement(0x0002, 0x0010, "UI", "1.2.840.10008.1.2.1");
  return std::string(128, '\0') + "DICM" +
         DicomElement(0x0002, 0x0000, "UL", Raw<std::uint32_t>(static_cast<std::uint32_t>(meta.size()))) + meta +
         dataSet;
}

std::string
WithDicomElement(const std::string & file, std::uint16_t group, std::uint16_t element, const std::string & encoded)
{
  const auto number = [&file](std::size_t at, std::size_t bytes) {
    std::size_t value = 0;
    for (std::size_t n = bytes; n-- > 0;)
    {
      value = value << 8 | static_cast<unsigned char>(file.at(at + n));
    }
    return value;
  };
  const std::size_t wanted = std::size_t{ group } << 16 | element;
  for (std::size_t at = 132;;)
  {
    const std::size_t tag = at < file.size() ? number(at, 2) << 16 | number(at + 2, 2) : SIZE_MAX;
    if (tag > wanted)
    {
      return file.substr(0, at) + encoded + file.substr(at);
    }
    const std::string vr = file.substr(at + 4, 2);
    const bool        isLong = vr == "OB" || vr == "OW" || vr == "SQ" || vr == "UN";
    const std::size_t end = isLong ? at + 12 + number(at + 8, 4) : at + 8 + number(at + 6, 2);
    if (tag == wanted)
    {
      return file.substr(0, at) + encoded + file.substr(end);
    }
    at = end;
  }
}

std::map<std::string, std::string>
DicomSeriesBytes()
{
  const std::string                  ct = "1.2.840.10008.5.1.4.1.1.2";
  const std::vector<int>             values = ForeignValues();
  std::map<std::string, std::string> files;
  for (std::size_t k = 0; k < kK; ++k)
  {
    const auto             begin = values.begin() + static_cast<std::ptrdiff_t>(k * kI * kJ);
    const std::vector<int> slice(begin, begin + kI * kJ);
    files["IM" + std::to_string(k)] =
      DicomFile(ct,
                DicomElement(0x0008, 0x0016, "UI", ct) + DicomElement(0x0008, 0x0018, "UI", "1.2.3.4") +
                  DicomElement(0x0008, 0x0060, "CS", "CT") + DicomElement(0x0020, 0x000e, "UI", "1.2.5") +
                  DicomElement(0x0020, 0x0013, "IS", std::to_string(k)) + Place(k) +
                  DicomElement(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0") +
                  DicomElement(0x0028, 0x0002, "US", Short(1)) + DicomElement(0x0028, 0x0004, "CS", "MONOCHROME2") +
                  PixelFields(16).insert(40 - 20, DicomElement(0x0028, 0x0030, "DS", "0.75\\0.5")) +
                  DicomElement(0x7fe0, 0x0010, "OW", RawAll<std::uint16_t>(slice)));
  }
  return files;
}

std::string
DicomSegmentationBytes()
{
  const std::string        seg = "1.2.840.10008.5.1.4.1.1.66.4";
  const std::vector<int>   values = ForeignValues();
  std::vector<std::string> segments;
  std::vector<std::string> frames;
  std::string              bits;
  std::size_t              bit = 0;
  for (int number = 1; number <= 6; ++number)
  {
    segments.push_back(DicomElement(0x0062, 0x0004, "US", Short(number)) +
                       DicomElement(0x0062, 0x0005, "LO", "segment " + std::to_string(number)));
    for (std::size_t k = 0; k < kK; ++k)
    {
      frames.push_back(DicomSequence(0x0020, 0x9113, { Place(k) }) +
                       DicomSequence(0x0062, 0x000a, { DicomElement(0x0062, 0x000b, "US", Short(number)) }));
      for (std::size_t n = k * kI * kJ; n < (k + 1) * kI * kJ; ++n, ++bit)
      {
        bits.resize(bit / 8 + 1, '\0');
        bits[bit / 8] =
          static_cast<char>(static_cast<unsigned char>(bits[bit / 8]) | (values[n] == number ? 1U << (bit % 8) : 0U));
      }
    }
  }
  const std::string measures =
    DicomElement(0x0018, 0x0088, "DS", "2") + DicomElement(0x0028, 0x0030, "DS", "0.75\\0.5");
  return DicomFile(
    seg,
    DicomElement(0x0008, 0x0016, "UI", seg) + DicomElement(0x0008, 0x0018, "UI", "1.2.3.4") +
      DicomElement(0x0008, 0x0060, "CS", "SEG") + DicomElement(0x0020, 0x000e, "UI", "1.2.6") +
      DicomElement(0x0028, 0x0002, "US", Short(1)) + DicomElement(0x0028, 0x0004, "CS", "MONOCHROME2") +
      DicomElement(0x0028, 0x0008, "IS", std::to_string(frames.size())) + PixelFields(1) +
      DicomElement(0x0062, 0x0001, "CS", "BINARY") + DicomSequence(0x0062, 0x0002, segments) +
      DicomSequence(0x5200,
                    0x9229,
                    { DicomSequence(0x0020, 0x9116, { DicomElement(0x0020, 0x0037, "DS", "1\\0\\0\\0\\1\\0") }) +
                      DicomSequence(0x0028, 0x9110, { measures }) }) +
      DicomSequence(0x5200, 0x9230, frames) + DicomElement(0x7fe0, 0x0010, "OB", bits));
}

} // namespace voxelcore::testing
