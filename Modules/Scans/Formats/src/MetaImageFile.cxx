// MetaImage: .mha (data behind the header) and .mhd (data in files of their own).
//
// Read here and not by itk::MetaImageIO: MetaIO copies header words into fixed buffers, believes any size, and takes
// missing data for zeros.

#include "DataSource.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/StatedSpacing.h"

#include <algorithm>
#include <bit>
#include <map>
#include <optional>

namespace voxelcore
{
namespace
{

constexpr std::size_t  kLongestMetaHeader = 1U << 20;
constexpr std::int64_t kMostChannels = 4096;

struct MetaHeader
{
  std::map<std::string, std::string> fields; ///< by name in lower case
  std::vector<std::string>           list;   ///< lines after ElementDataFile = LIST
  std::uint64_t                      end = 0;

  std::string
  Field(std::initializer_list<const char *> names) const
  {
    for (const char * name : names)
    {
      if (const auto found = fields.find(name); found != fields.end())
      {
        return found->second;
      }
    }
    return {};
  }
};

/** `isBeside`: of a text beside the data, which need not name them. */
MetaHeader
ReadMetaHeader(const std::filesystem::path & path, bool isBeside = false)
{
  std::string text(kLongestMetaHeader, '\0');
  text.resize(OpenBytes(path, 0, Packing::Plain)->ReadSome(reinterpret_cast<std::byte *>(text.data()), text.size()));
  MetaHeader header;
  bool       inList = false;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t      newline = std::min(text.find('\n', at), text.size());
    const std::string_view line = Trim(std::string_view(text).substr(at, newline - at));
    at = newline + 1;
    if (inList)
    {
      if (!line.empty())
      {
        header.list.emplace_back(line);
      }
      continue;
    }
    if (line.empty())
    {
      continue;
    }
    const std::size_t equals = line.find('=');
    if (isBeside && equals == std::string_view::npos)
    {
      continue;
    }
    if (equals == std::string_view::npos || line.size() > 65536 || line.find('\0') != std::string_view::npos)
    {
      RefuseInput(path, Text("not a MetaImage header ('", Printable(line, 30), "')"), "check what kind of file it is");
    }
    const std::string name = LowerCase(Trim(line.substr(0, equals)));
    header.fields[name] = std::string(Trim(line.substr(equals + 1)));
    if (name == "elementdatafile")
    {
      header.end = std::min(at, text.size());
      inList = LowerCase(header.fields[name]).starts_with("list");
      if (!inList)
      {
        return header;
      }
    }
  }
  if (!inList && !isBeside)
  {
    RefuseInput(path,
                "not a MetaImage header: it has no ElementDataFile",
                "write it anew, or give it the extension of its kind");
  }
  return header;
}

PixelType
MetaTypeOf(const std::filesystem::path & path, const std::string & text)
{
  static const std::map<std::string, PixelType> known{
    { "MET_UCHAR", PixelType::UInt8 },
    { "MET_CHAR", PixelType::Int8 },
    { "MET_USHORT", PixelType::UInt16 },
    { "MET_SHORT", PixelType::Int16 },
    { "MET_UINT", PixelType::UInt32 },
    { "MET_INT", PixelType::Int32 },
    { "MET_ULONG_LONG", PixelType::UInt64 },
    { "MET_LONG_LONG", PixelType::Int64 },
    { "MET_FLOAT", PixelType::Float32 },
    { "MET_DOUBLE", PixelType::Float64 },
    // MetaIO stores its "long" in four bytes whatever the machine's has.
    { "MET_ULONG", PixelType::UInt32 },
    { "MET_LONG", PixelType::Int32 },
  };
  const auto found = known.find(text);
  if (found == known.end())
  {
    const bool colour = text.find("ARRAY") != std::string::npos;
    RefuseInput(path,
                colour ? Text("several values a voxel (", Printable(text, 30), ")")
                       : Text("voxels of type '", Printable(text, 30), "' are no whole numbers"),
                "save it with one whole number a voxel");
  }
  return found->second;
}

std::vector<double>
MetaReals(const std::filesystem::path & path, const char * name, const std::string & text, std::size_t count)
{
  const auto values = ParseReals(text);
  if (!values || values->size() != count)
  {
    RefuseInput(path, Text(name, " should have ", count, " numbers ('", Printable(text), "')"), "mend the header");
  }
  return *values;
}

bool
IsTrue(const std::string & text)
{
  return !text.empty() && (text[0] == 'T' || text[0] == 't' || text[0] == '1');
}

void
ReadGeometry(const MetaHeader & header, std::size_t dimensions, const ReadOptions & options, ScanFile & scan)
{
  std::array<Vector3, 3> directions{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  Vector3                spacing{ 1, 1, 1 };
  Vector3                origin{ 0, 0, 0 };
  if (const auto text = header.Field({ "elementspacing", "elementsize" }); !text.empty())
  {
    const auto values = MetaReals(scan.path, "ElementSpacing", text, dimensions);
    std::copy_n(values.begin(), 3, spacing.begin());
  }
  else
  {
    spacing = CompleteSpacing({}, options, scan);
  }
  if (const auto text = header.Field({ "offset", "position", "origin" }); !text.empty())
  {
    const auto values = MetaReals(scan.path, "Offset", text, dimensions);
    std::copy_n(values.begin(), 3, origin.begin());
  }
  if (const auto text = header.Field({ "transformmatrix", "rotation", "orientation" }); !text.empty())
  {
    // One axis after the other: the direction of i in space, that of j, that of k.
    const auto values = MetaReals(scan.path, "TransformMatrix", text, dimensions * dimensions);
    for (std::size_t a = 0; a < 3; ++a)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        directions[a][c] = values[a * dimensions + c];
      }
    }
  }
  if (const auto unit = header.Field({ "distanceunits" }); !unit.empty())
  {
    const auto millimetres = MillimetresIn(unit);
    if (IsVoxelUnit(unit) && !options.spacing)
    {
      if (scan.geometry.unit != SpatialUnit::Voxels)
      {
        SpacingInVoxels(scan);
      }
    }
    else if (!millimetres && unit != "?" && !options.spacing)
    {
      RefuseInput(scan.path,
                  Text("lengths in '", Printable(unit, 20), "', which is no unit known here"),
                  "give the voxel spacing with --spacing X,Y,Z in mm");
    }
    if (millimetres && *millimetres != 1.0)
    {
      for (std::size_t a = 0; a < 3; ++a)
      {
        spacing[a] *= *millimetres;
        origin[a] *= *millimetres;
      }
      scan.notes.push_back(Text("lengths were converted to mm from ", Printable(unit, 20)));
    }
  }
  SetGeometry(scan, directions, spacing, origin, options);
}

DataSource
FindData(const std::filesystem::path & path, const MetaHeader & header)
{
  DataSource source;
  source.packing = IsTrue(header.Field({ "compresseddata" })) ? Packing::Deflate : Packing::Plain;
  const auto binary = header.Field({ "binarydata" });
  source.ascii = !binary.empty() && !IsTrue(binary);
  const auto        name = header.Field({ "elementdatafile" });
  const std::string lower = LowerCase(name);
  if (lower == "local")
  {
    source.files = { path };
    source.offset = header.end;
  }
  else
  {
    source.files = FilesNamed(path, name, header.list);
  }
  if (const auto text = header.Field({ "headersize" }); !text.empty())
  {
    const auto skip = ParseInteger(text);
    if (!skip || *skip < -1 || *skip > (std::int64_t{ 1 } << 50))
    {
      RefuseInput(path, Text("HeaderSize = ", Printable(text, 20), " makes no sense"), "mend the header");
    }
    if (lower != "local")
    {
      if (*skip > 0)
      {
        source.offset = static_cast<std::uint64_t>(*skip);
      }
      source.byteSkip = *skip == -1 ? -1 : 0;
    }
  }
  return source;
}

} // namespace

std::vector<std::filesystem::path>
MetaImageDataFiles(const std::filesystem::path & path)
{
  const MetaHeader header = ReadMetaHeader(path);
  const auto       name = header.Field({ "elementdatafile" });
  return LowerCase(name) == "local" ? std::vector<std::filesystem::path>() : FilesNamed(path, name, header.list);
}

bool
IsMetaText(const std::filesystem::path & path)
{
  std::string text(4096, '\0');
  text.resize(OpenBytes(path, 0, Packing::Plain)->ReadSome(reinterpret_cast<std::byte *>(text.data()), text.size()));
  text = LowerCase(text);
  return text.find('\0') == std::string::npos && text.find("dimsize") != std::string::npos &&
         text.find("elementtype") != std::string::npos;
}

namespace
{

/** `data`: the voxels, where the header does not say where they are. */
ScanFile
OpenMeta(const std::filesystem::path & path,
         const MetaHeader &            header,
         const std::filesystem::path & data,
         const ReadOptions &           options)
{
  ScanFile scan;
  scan.path = path;
  scan.format = "MetaImage";
  const auto dimensions = ParseInteger(header.Field({ "ndims" }));
  if (!dimensions || *dimensions < 1 || *dimensions > 10)
  {
    RefuseInput(path, Text("NDims = ", Printable(header.Field({ "ndims" }), 20), " makes no sense"), "mend the header");
  }
  const auto n = static_cast<std::size_t>(*dimensions);
  if (n < 3)
  {
    RefuseInput(path, Text(n, "-D image"), "save one volume with three axes in space");
  }
  const std::string         dimSize = header.Field({ "dimsize" });
  const auto                words = Words(dimSize);
  std::vector<std::int64_t> sizes;
  sizes.reserve(words.size());
  for (const auto word : words)
  {
    sizes.push_back(ParseInteger(word).value_or(0));
  }
  if (sizes.size() != n)
  {
    RefuseInput(path, Text("DimSize should have ", n, " numbers ('", Printable(dimSize), "')"), "mend the header");
  }
  std::copy_n(sizes.begin(), 3, scan.geometry.size.begin());
  std::uint64_t volumes = 1;
  for (std::size_t a = 3; a < n; ++a)
  {
    if (sizes[a] < 1 || sizes[a] > (1 << 30) || volumes > (1U << 30))
    {
      RefuseInput(path, Text("DimSize = ", Printable(dimSize), " makes no sense"), "mend the header");
    }
    volumes *= static_cast<std::uint64_t>(sizes[a]);
  }
  const std::string channels = header.Field({ "elementnumberofchannels" });
  const auto        components = channels.empty() ? std::optional<std::int64_t>(1) : ParseInteger(channels);
  if (!components || *components < 1 || *components > kMostChannels)
  {
    RefuseInput(path,
                Text("ElementNumberOfChannels = ", Printable(channels, 20), " makes no sense"),
                "mend the header");
  }
  scan.type = MetaTypeOf(path, header.Field({ "elementtype" }));
  const std::uint64_t volume = ChooseVolume(path, volumes, options);
  const std::uint64_t component =
    ChooseComponent(path, static_cast<std::uint64_t>(*components), "colour image or vectors", options);
  if (*components > 1)
  {
    scan.interleaved = static_cast<std::size_t>(*components);
    scan.component = static_cast<std::ptrdiff_t>(component);
  }

  DataSource source = FindData(data.empty() ? path : data, header);
  if (!data.empty())
  {
    source.files = { data };
  }
  else
  {
    WarnOfFilesElsewhere(scan, source);
  }
  const std::uint64_t possible = LargestData(source, scan.type);
  const std::uint64_t bytesPerVoxel = PixelBytes(scan.type) * scan.interleaved;
  const std::uint64_t bytes = bytesPerVoxel * CheckSize(path, scan.geometry.size, bytesPerVoxel, possible);
  if (volumes > std::max<std::uint64_t>(1, possible / bytes))
  {
    RefuseInput(path, "its header gives more volumes than its data can hold", "the file is truncated: write it anew");
  }
  const bool big = IsTrue(header.Field({ "binarydatabyteordermsb", "elementbyteordermsb" }));
  scan.swapBytes = !source.ascii && big != (std::endian::native == std::endian::big);
  ReadGeometry(header, n, options, scan);
  scan.voxels = OpenData(path, source, scan.type, bytes * volumes);
  scan.moreVolumes = volumes > 1;
  scan.voxels->Skip(volume * bytes);
  return scan;
}

} // namespace

ScanFile
OpenMetaImage(const std::filesystem::path & path, const ReadOptions & options)
{
  return OpenMeta(path, ReadMetaHeader(path), {}, options);
}

ScanFile
OpenMetaText(const std::filesystem::path & data, const std::filesystem::path & text, const ReadOptions & options)
{
  MetaHeader header = ReadMetaHeader(text, true);
  header.fields.try_emplace("ndims", "3");
  header.fields["elementdatafile"] = data.filename().string();
  header.fields.erase("compresseddata");
  ScanFile scan = OpenMeta(data, header, data, options);
  scan.format = "raw";
  scan.notes.push_back(Text("bare voxels, as '", Printable(text.filename().string(), 100), "' says"));
  const std::uint64_t skipped =
    static_cast<std::uint64_t>(std::max<std::int64_t>(0, ParseInteger(header.Field({ "headersize" })).value_or(0)));
  std::uint64_t bytes = PixelBytes(scan.type) * scan.interleaved;
  for (const std::int64_t side : scan.geometry.size)
  {
    bytes *= static_cast<std::uint64_t>(side);
  }
  if (!scan.moreVolumes && FileSize(data) != skipped + bytes && header.Field({ "headersize" }) != "-1")
  {
    RefuseInput(data,
                Text("it has ", FileSize(data), " bytes, but its text describes ", skipped + bytes),
                Text("mend '", Printable(text.filename().string(), 100), "'"));
  }
  return scan;
}

} // namespace voxelcore
