// Bare voxels: a file of nothing else, and what a user or a text beside it says of them.

#include "DataSource.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/RawLayout.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <optional>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

constexpr std::array kTypes{ PixelType::UInt8,   PixelType::Int8,   PixelType::UInt16, PixelType::Int16,
                             PixelType::UInt32,  PixelType::Int32,  PixelType::UInt64, PixelType::Int64,
                             PixelType::Float32, PixelType::Float64 };

std::optional<PixelType>
TypeNamed(std::string_view name)
{
  const auto found =
    std::find_if(kTypes.begin(), kTypes.end(), [&](PixelType type) { return LowerCase(name) == PixelName(type); });
  return found == kTypes.end() ? std::nullopt : std::optional(*found);
}

/** "512 x 512 x 300 values of uint16 are 157286400 bytes". */
std::string
SizeText(const RawLayout & layout, std::uint64_t bytes)
{
  return Text(layout.size[0],
              " x ",
              layout.size[1],
              " x ",
              layout.size[2],
              " values of ",
              PixelName(layout.type),
              " are ",
              bytes,
              " bytes");
}

ScanFile
OpenVoxels(const fs::path & path, const fs::path & data, const RawLayout & layout, std::string_view saidBy)
{
  ScanFile scan;
  scan.path = path;
  scan.format = "raw";
  scan.type = layout.type;
  scan.geometry.size = layout.size;
  scan.swapBytes = layout.isBig != (std::endian::native == std::endian::big);
  const std::uint64_t length = FileSize(data);
  const std::uint64_t each = PixelBytes(layout.type);
  const std::uint64_t bytes = each * CheckSize(path, layout.size, each, ~std::uint64_t{ 0 });
  if (length != bytes)
  {
    RefuseInput(data, Text("it has ", length, " bytes, but ", SizeText(layout, bytes)), Text("mend ", saidBy));
  }
  scan.notes.push_back(Text("bare voxels of ", PixelName(layout.type), ", as ", saidBy, " says"));
  scan.voxels = OpenBytes(data, 0, Packing::Plain);
  return scan;
}

void
PlaceVoxels(const StatedSpacing & stated, const ReadOptions & options, ScanFile & scan)
{
  SetGeometry(scan,
              { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } },
              CompleteSpacing(stated, options, scan),
              { 0, 0, 0 },
              options);
}

/** Lines "Name: value" of a .dat, names in lower case; empty when it is none. */
std::map<std::string, std::string>
DatFields(const fs::path & path)
{
  constexpr std::size_t              longest = 65536;
  std::map<std::string, std::string> fields;
  std::error_code                    ignored;
  if (!fs::is_regular_file(path, ignored) || fs::file_size(path, ignored) > longest)
  {
    return fields;
  }
  std::ifstream file(path, std::ios::binary);
  for (std::string line; std::getline(file, line);)
  {
    if (line.find('\0') != std::string::npos)
    {
      return {};
    }
    if (const std::size_t colon = line.find(':'); colon != std::string::npos)
    {
      fields[LowerCase(Trim(std::string_view(line).substr(0, colon)))] =
        std::string(Trim(std::string_view(line).substr(colon + 1)));
    }
  }
  return fields.contains("resolution") ? fields : std::map<std::string, std::string>();
}

ScanFile
OpenDat(const fs::path & path, const fs::path & data, const fs::path & dat, const ReadOptions & options)
{
  auto      fields = DatFields(dat);
  RawLayout layout;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto words = Words(fields["resolution"]);
    const auto side = words.size() == 3 ? ParseInteger(words[axis]) : std::nullopt;
    if (!side)
    {
      RefuseInput(dat, Text("Resolution: ", Printable(fields["resolution"], 30), " makes no sense"), "mend it");
    }
    layout.size[axis] = *side;
  }
  static const std::map<std::string, PixelType> formats{
    { "uchar", PixelType::UInt8 },   { "byte", PixelType::UInt8 },    { "char", PixelType::Int8 },
    { "ushort", PixelType::UInt16 }, { "short", PixelType::Int16 },   { "uint", PixelType::UInt32 },
    { "int", PixelType::Int32 },     { "float", PixelType::Float32 }, { "double", PixelType::Float64 },
  };
  const auto format = formats.find(LowerCase(fields["format"]));
  if (format == formats.end())
  {
    RefuseInput(dat, Text("Format: ", Printable(fields["format"], 30), " is not known here"), "give --raw I,J,K,TYPE");
  }
  layout.type = format->second;
  ScanFile      scan = OpenVoxels(path, data, layout, Text("'", Printable(dat.filename().string(), 100), "'"));
  StatedSpacing stated;
  const auto    thickness = ParseReals(fields["slicethickness"]);
  // Programs write 1 1 1 where they know nothing.
  if (thickness && thickness->size() == 3 && *thickness != std::vector<double>{ 1, 1, 1 })
  {
    stated.source = "SliceThickness, taken as mm";
    stated.mm = { (*thickness)[0], (*thickness)[1], (*thickness)[2] };
  }
  PlaceVoxels(stated, options, scan);
  return scan;
}

/** The file of voxels that a .dat names, else one of its own name. */
fs::path
DataOf(const fs::path & dat)
{
  std::error_code   ignored;
  const std::string name = DatFields(dat)["objectfilename"];
  if (!name.empty() && fs::is_regular_file(dat.parent_path() / name, ignored))
  {
    return dat.parent_path() / name;
  }
  for (const char * extension : { ".raw", ".vol", ".bin" })
  {
    if (fs::path data = fs::path(dat).replace_extension(extension); fs::is_regular_file(data, ignored))
    {
      return data;
    }
  }
  RefuseInput(dat, "the file of voxels it describes is not there", "lay it beside, with the same name and .raw");
}

/** A text beside bare voxels that says what they are; empty where there is none. */
fs::path
TextBeside(const fs::path & path)
{
  std::error_code ignored;
  for (const char * extension : { ".mhd", ".dat", ".txt", ".info" })
  {
    for (const fs::path & text : { fs::path(path).replace_extension(extension), fs::path(path.string() + extension) })
    {
      if (text == path || !fs::is_regular_file(text, ignored))
      {
        continue;
      }
      if (std::string_view(extension) == ".dat" ? !DatFields(text).empty() : IsMetaText(text))
      {
        return text;
      }
    }
  }
  return {};
}

} // namespace

RawLayout
ParseRawLayout(std::string_view text)
{
  std::vector<std::string_view> words;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    words.push_back(Trim(text.substr(at, comma - at)));
    at = comma + 1;
  }
  RawLayout  layout;
  const bool counts = words.size() == 4 || words.size() == 5;
  const auto type = counts ? TypeNamed(words[3]) : std::nullopt;
  const auto order = words.size() == 5 ? LowerCase(words[4]) : std::string("little");
  bool       right = type && (order == "little" || order == "big");
  for (std::size_t axis = 0; right && axis < 3; ++axis)
  {
    const auto side = ParseInteger(words[axis]);
    right = side && *side > 0 && *side <= (std::int64_t{ 1 } << 30);
    layout.size[axis] = side.value_or(0);
  }
  if (!right)
  {
    throw UsageError("--raw " + Printable(text) +
                     ": expected the sides and the type, such as 512,512,300,uint16, and ',big' for big endian; types "
                     "are uint8 int8 uint16 int16 uint32 int32 uint64 int64 float32 float64");
  }
  layout.type = *type;
  layout.isBig = order == "big";
  return layout;
}

std::string
RawLayoutText(const RawLayout & layout)
{
  return Text(layout.size[0],
              ",",
              layout.size[1],
              ",",
              layout.size[2],
              ",",
              PixelName(layout.type),
              layout.isBig ? ",big" : "");
}

bool
IsRawFile(const fs::path & path)
{
  const std::string extension = LowerCase(path.extension().string());
  return extension == ".dat"
           ? !DatFields(path).empty() || !TextBeside(path).empty()
           : (extension == ".raw" || extension == ".vol" || extension == ".bin") && !TextBeside(path).empty();
}

ScanFile
OpenRaw(const fs::path & path, const ReadOptions & options)
{
  ChooseVolume(path, 1, options);
  ChooseComponent(path, 1, "", options);
  if (options.raw)
  {
    ScanFile scan = OpenVoxels(path, path, *options.raw, "--raw");
    PlaceVoxels({}, options, scan);
    return scan;
  }
  if (!DatFields(path).empty())
  {
    return OpenDat(path, DataOf(path), path, options);
  }
  const fs::path text = TextBeside(path);
  return LowerCase(text.extension().string()) == ".dat" ? OpenDat(path, path, text, options)
                                                        : OpenMetaText(path, text, options);
}

std::vector<fs::path>
RawFileTexts(const fs::path & path)
{
  if (!DatFields(path).empty())
  {
    return { DataOf(path) };
  }
  const fs::path text = TextBeside(path);
  return text.empty() ? std::vector<fs::path>() : std::vector<fs::path>{ text };
}

} // namespace voxelcore
