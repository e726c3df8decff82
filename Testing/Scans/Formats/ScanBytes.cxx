#include "ScanBytes.h"

#include <zlib.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace voxelcore::testing
{

std::filesystem::path
TempFolder::Write(const std::string & name, std::string_view bytes) const
{
  const auto path = *this / name;
  std::filesystem::create_directories(path.parent_path());
  std::filesystem::remove(path); // file systems wait for the disk when a file is truncated and written anew
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return path;
}

namespace
{

std::string
Deflated(std::string_view bytes, int windowBits)
{
  z_stream zlib{};
  deflateInit2(&zlib, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&zlib, bytes.size()) + 64, '\0');
  zlib.next_in = reinterpret_cast<Bytef *>(const_cast<char *>(bytes.data()));
  zlib.avail_in = static_cast<uInt>(bytes.size());
  zlib.next_out = reinterpret_cast<Bytef *>(out.data());
  zlib.avail_out = static_cast<uInt>(out.size());
  deflate(&zlib, Z_FINISH);
  out.resize(zlib.total_out);
  deflateEnd(&zlib);
  return out;
}

} // namespace

std::string
Gzip(std::string_view bytes)
{
  return Deflated(bytes, 15 + 16);
}

std::string
Zlib(std::string_view bytes)
{
  return Deflated(bytes, 15);
}

std::string
Nrrd(const std::vector<std::string> & lines, std::string_view data)
{
  std::string text = "NRRD0004\n# made by hand\n";
  for (const auto & line : lines)
  {
    text += line + "\n";
  }
  return text + "\n" + std::string(data);
}

std::vector<std::string>
NrrdLines(const std::string & type, const std::array<int, 3> & size)
{
  return { "type: " + type,
           "dimension: 3",
           "space: left-posterior-superior",
           "sizes: " + std::to_string(size[0]) + " " + std::to_string(size[1]) + " " + std::to_string(size[2]),
           "space directions: (1,0,0) (0,1,0) (0,0,1)",
           "kinds: domain domain domain",
           "endian: little",
           "encoding: raw",
           "space origin: (0,0,0)" };
}

std::string
NiftiHeaderBytes(const NiftiFields & f)
{
  const bool   two = f.version == 2;
  std::string  h(two ? 540 : 348, '\0');
  const auto   put = [&](std::size_t at, const std::string & bytes) { h.replace(at, bytes.size(), bytes); };
  const double offset = f.voxOffset >= 0 ? f.voxOffset : f.pair ? 0 : two ? 544 : 352;
  put(0, Raw<std::int32_t>(two ? 540 : 348, f.big));
  for (std::size_t i = 0; i < 8; ++i)
  {
    const std::int64_t side = i == 0 ? static_cast<std::int64_t>(f.dim.size()) : i <= f.dim.size() ? f.dim[i - 1] : 1;
    two ? put(16 + 8 * i, Raw<std::int64_t>(side, f.big))
        : put(40 + 2 * i, Raw<std::int16_t>(static_cast<std::int16_t>(side), f.big));
  }
  const auto real = [&](std::size_t at1, std::size_t at2, double value) {
    two ? put(at2, Raw<double>(value, f.big)) : put(at1, Raw<float>(static_cast<float>(value), f.big));
  };
  put(two ? 12 : 70, Raw<std::int16_t>(static_cast<std::int16_t>(f.datatype), f.big));
  put(two ? 14 : 72, Raw<std::int16_t>(static_cast<std::int16_t>(f.bitpix), f.big));
  for (std::size_t i = 0; i < 4; ++i)
  {
    real(76 + 4 * i, 104 + 8 * i, f.pixdim[i]);
  }
  two ? put(168, Raw<std::int64_t>(static_cast<std::int64_t>(offset), f.big))
      : put(108, Raw<float>(static_cast<float>(offset), f.big));
  real(112, 176, f.slope);
  real(116, 184, f.intercept);
  two ? put(500, Raw<std::int32_t>(f.units, f.big)) : put(123, Raw<std::int8_t>(static_cast<std::int8_t>(f.units)));
  if (two)
  {
    put(344, Raw<std::int32_t>(f.qformCode, f.big));
    put(348, Raw<std::int32_t>(f.sformCode, f.big));
    put(4, std::string(f.pair ? "ni2\0\r\n\032\n" : "n+2\0\r\n\032\n", 8));
  }
  else
  {
    put(252, Raw<std::int16_t>(static_cast<std::int16_t>(f.qformCode), f.big));
    put(254, Raw<std::int16_t>(static_cast<std::int16_t>(f.sformCode), f.big));
    put(344, std::string(f.pair ? "ni1\0" : "n+1\0", 4));
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    real(256 + 4 * i, 352 + 8 * i, f.quaternion[i]);
    real(268 + 4 * i, 376 + 8 * i, f.qoffset[i]);
  }
  for (std::size_t i = 0; i < 12; ++i)
  {
    real(280 + 4 * i, 400 + 8 * i, f.srow[i]);
  }
  return h;
}

std::string
Nifti(const NiftiFields & fields, std::string_view data)
{
  return NiftiHeaderBytes(fields) + std::string(4, '\0') + std::string(data);
}

std::string
Meta(const std::vector<std::string> & lines, std::string_view data)
{
  std::string text;
  for (const auto & line : lines)
  {
    text += line + "\n";
  }
  return text + "ElementDataFile = LOCAL\n" + std::string(data);
}

std::string
Tiff(const std::vector<TiffPage> & pages, const TiffLayout & layout)
{
  const bool  big = layout.big;
  const bool  wide = layout.bigTiff;
  std::string file = big ? "MM" : "II";
  const auto  offsetBytes = [&](std::uint64_t value) {
    return wide ? Raw<std::uint64_t>(value, big) : Raw<std::uint32_t>(static_cast<std::uint32_t>(value), big);
  };
  file += Raw<std::uint16_t>(wide ? 43 : 42, big);
  if (wide)
  {
    file += Raw<std::uint16_t>(8, big) + Raw<std::uint16_t>(0, big);
  }
  std::size_t link = file.size(); // where the next directory's offset goes
  file += offsetBytes(0);
  for (const TiffPage & page : pages)
  {
    std::vector<std::uint64_t> offsets;
    std::vector<std::uint64_t> counts;
    for (const std::string & part : page.parts)
    {
      offsets.push_back(file.size());
      counts.push_back(part.size());
      file += part;
      file.append(file.size() % 2, '\0');
    }
    struct Entry
    {
      std::uint16_t tag;
      std::uint16_t type;
      std::uint64_t count;
      std::string   bytes;
    };
    std::vector<Entry> entries;
    const auto         add = [&](std::uint16_t tag, std::uint32_t value) {
      entries.push_back({ tag, 4, 1, Raw<std::uint32_t>(value, big) });
    };
    const auto addShort = [&](std::uint16_t tag, int value) {
      entries.push_back({ tag, 3, 1, Raw<std::uint16_t>(static_cast<std::uint16_t>(value), big) });
    };
    const auto addOffsets = [&](std::uint16_t tag, const std::vector<std::uint64_t> & values) {
      entries.push_back({ tag,
                          static_cast<std::uint16_t>(wide ? 16 : 4),
                          values.size(),
                          wide ? RawAll<std::uint64_t>(values, big) : RawAll<std::uint32_t>(values, big) });
    };
    add(256, page.width);
    add(257, page.height);
    entries.push_back(
      { 258,
        3,
        static_cast<std::uint64_t>(page.samples),
        RawAll<std::uint16_t>(std::vector<int>(static_cast<std::size_t>(page.samples), page.bits), big) });
    addShort(259, page.compression);
    addShort(262, page.photometric);
    if (!page.description.empty())
    {
      entries.push_back({ 270, 2, page.description.size() + 1, page.description + std::string(1, '\0') });
    }
    addShort(277, page.samples);
    if (page.tileWidth > 0)
    {
      add(322, page.tileWidth);
      add(323, page.tileHeight);
      addOffsets(324, offsets);
      addOffsets(325, counts);
    }
    else
    {
      addOffsets(273, offsets);
      add(278, page.rowsPerStrip > 0 ? page.rowsPerStrip : page.height);
      addOffsets(279, counts);
    }
    addShort(339, page.sampleFormat);
    if (page.photometric == 3) // a palette needs its colours
    {
      const std::vector<int> colours(std::size_t{ 3 } << page.bits, 7);
      entries.push_back({ 320, 3, colours.size(), RawAll<std::uint16_t>(colours, big) });
    }
    for (const auto & [tag, value] : page.more)
    {
      add(tag, value);
    }
    for (const auto & [tag, value] : page.rationals)
    {
      const auto millionths = static_cast<std::uint32_t>(std::lround(value * 1e6));
      entries.push_back({ tag, 5, 1, Raw<std::uint32_t>(millionths, big) + Raw<std::uint32_t>(1000000, big) });
    }
    for (const auto & [tag, bytes] : page.blocks)
    {
      entries.push_back({ tag, 1, bytes.size(), bytes });
    }
    std::sort(entries.begin(), entries.end(), [](const Entry & a, const Entry & b) { return a.tag < b.tag; });
    const std::size_t inlineBytes = wide ? 8 : 4;
    for (Entry & entry : entries)
    {
      if (entry.bytes.size() > inlineBytes)
      {
        const std::uint64_t at = file.size();
        file += entry.bytes;
        file.append(file.size() % 2, '\0');
        entry.bytes = offsetBytes(at);
      }
      entry.bytes.resize(inlineBytes, '\0');
    }
    file.replace(link, wide ? 8 : 4, offsetBytes(file.size()));
    file += wide ? Raw<std::uint64_t>(entries.size(), big)
                 : Raw<std::uint16_t>(static_cast<std::uint16_t>(entries.size()), big);
    for (const Entry & entry : entries)
    {
      file += Raw<std::uint16_t>(entry.tag, big) + Raw<std::uint16_t>(entry.type, big);
      file += offsetBytes(entry.count) + entry.bytes;
    }
    link = file.size();
    file += offsetBytes(0);
  }
  return file;
}

std::string
PackBits(std::string_view bytes)
{
  std::string out;
  for (std::size_t at = 0; at < bytes.size(); at += 128)
  {
    const auto run = bytes.substr(at, 128);
    out += static_cast<char>(run.size() - 1);
    out += run;
  }
  return out;
}

std::string
Lzw(std::string_view bytes)
{
  constexpr unsigned clear = 256;
  constexpr unsigned end = 257;
  std::string        out;
  unsigned           pending = 0;
  int                have = 0;
  const auto         put = [&](unsigned code) {
    pending = pending << 9 | code;
    have += 9;
    while (have >= 8)
    {
      out += static_cast<char>(pending >> (have - 8) & 0xFFU);
      have -= 8;
    }
  };
  for (std::size_t at = 0; at < bytes.size(); ++at)
  {
    if (at % 200 == 0)
    {
      put(clear);
    }
    put(static_cast<unsigned char>(bytes[at]));
  }
  put(end);
  put(0);
  return out;
}

std::int64_t
ValueAt(const LabelMap & volume, int x, int y, int z)
{
  for (const LabelShape & label : volume.labels)
  {
    if (label.shape.Contains(x, y, z))
    {
      return label.value;
    }
  }
  return 0;
}

std::vector<std::int64_t>
AllValues(const LabelMap & volume)
{
  std::vector<std::int64_t> values;
  for (int z = 0; z < volume.geometry.size[2]; ++z)
  {
    for (int y = 0; y < volume.geometry.size[1]; ++y)
    {
      for (int x = 0; x < volume.geometry.size[0]; ++x)
      {
        values.push_back(ValueAt(volume, x, y, z));
      }
    }
  }
  return values;
}

void
ExpectRefused(const std::filesystem::path & path, const std::vector<std::string> & texts, const ReadOptions & options)
{
  try
  {
    const LabelMap volume = ReadLabelVolume(path, options);
    ADD_FAILURE() << path << (texts.empty() ? "" : " (" + texts[0] + ")") << " was read, with " << volume.labels.size()
                  << " labels";
  }
  catch (const InputError & error)
  {
    const std::string message = error.what();
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "says what to do: " << message;
    for (const std::string & text : texts)
    {
      EXPECT_NE(message.find(text), std::string::npos) << "'" << text << "' in: " << message;
    }
  }
  catch (const std::exception & error)
  {
    ADD_FAILURE() << path << ": " << error.what();
  }
}

Vector3
CentreOf(const LabelMap & volume, int x, int y, int z)
{
  return LatticeToPhysical(volume.geometry, { x + 0.5, y + 0.5, z + 0.5 });
}

void
ExpectNear(const Vector3 & a, const Vector3 & b, double tolerance)
{
  for (std::size_t c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(a[c], b[c], tolerance) << "coordinate " << c;
  }
}

bool
HasNote(const std::vector<std::string> & notes, const std::string & text)
{
  return std::any_of(notes.begin(), notes.end(), [&](const std::string & note) {
    return note.find(text) != std::string::npos;
  });
}

} // namespace voxelcore::testing
