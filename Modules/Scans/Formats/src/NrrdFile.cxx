// NRRD, its detached headers, and the segmentations 3D Slicer keeps in it.
//
// The header is read here and not by itk::NrrdImageIO, which drops space units (5 um becomes 5 mm), turns a leading
// list axis (layers of overlapping segments) into one grey value, and places the space LAS half a turn off.

#include "DataSource.h"
#include "NrrdGeometry.h"
#include "NrrdHeader.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

constexpr std::uint64_t kMostLayers = 4096;
constexpr std::uint64_t kMostVolumes = 1U << 30;

PixelType
NrrdTypeOf(const std::filesystem::path & path, std::string_view text)
{
  std::string type = LowerCase(text);
  for (const std::string_view noise : { "signed ", " int" })
  {
    // "unsigned" keeps its own "signed ".
    if (const std::size_t at = type.find(noise); at != std::string::npos && (at == 0 || noise[0] == ' '))
    {
      type.erase(at, noise.size());
    }
  }
  static constexpr std::array<std::pair<std::string_view, PixelType>, 34> known{ {
    { "char", PixelType::Int8 },           { "int8", PixelType::Int8 },
    { "int8_t", PixelType::Int8 },         { "uchar", PixelType::UInt8 },
    { "unsigned char", PixelType::UInt8 }, { "uint8", PixelType::UInt8 },
    { "uint8_t", PixelType::UInt8 },       { "short", PixelType::Int16 },
    { "int16", PixelType::Int16 },         { "int16_t", PixelType::Int16 },
    { "ushort", PixelType::UInt16 },       { "unsigned short", PixelType::UInt16 },
    { "uint16", PixelType::UInt16 },       { "uint16_t", PixelType::UInt16 },
    { "int", PixelType::Int32 },           { "int32", PixelType::Int32 },
    { "int32_t", PixelType::Int32 },       { "uint", PixelType::UInt32 },
    { "unsigned", PixelType::UInt32 },     { "unsigned int", PixelType::UInt32 },
    { "uint32", PixelType::UInt32 },       { "uint32_t", PixelType::UInt32 },
    { "long long", PixelType::Int64 },     { "longlong", PixelType::Int64 },
    { "int64", PixelType::Int64 },         { "int64_t", PixelType::Int64 },
    { "ulonglong", PixelType::UInt64 },    { "unsigned long long", PixelType::UInt64 },
    { "uint64", PixelType::UInt64 },       { "uint64_t", PixelType::UInt64 },
    { "float", PixelType::Float32 },       { "float32", PixelType::Float32 },
    { "double", PixelType::Float64 },      { "float64", PixelType::Float64 },
  } };
  for (const auto & [name, pixel] : known)
  {
    if (type == name)
    {
      return pixel;
    }
  }
  RefuseInput(path,
              Text("voxels of type '", Printable(text, 30), "' are no numbers"),
              "save it with a type of whole numbers");
}

bool
IsRangeKind(const std::string & kind)
{
  return !kind.empty() && kind != "domain" && kind != "space" && kind != "???" && kind != "none";
}

/** Values that make up one voxel (a vector, a colour, ...), not volumes that stand beside each other. */
bool
IsComponentKind(const std::string & kind)
{
  return IsRangeKind(kind) && kind != "list" && kind != "time";
}

/** What to call voxels of such an axis. */
std::string
ComponentsText(const std::string & kind)
{
  return kind.find("color") != std::string::npos ? "colour image" : Text("vectors of kind ", Printable(kind, 20));
}

NrrdAxes
SortAxes(const std::filesystem::path &                           path,
         const std::vector<std::int64_t> &                       sizes,
         const std::vector<std::string> &                        kinds,
         const std::vector<std::optional<std::vector<double>>> & directions)
{
  std::vector<std::size_t> spatial;
  for (std::size_t a = 0; a < sizes.size(); ++a)
  {
    const bool none = !directions.empty() && !directions[a];
    if (!none && !(a < kinds.size() && IsRangeKind(kinds[a])))
    {
      spatial.push_back(a);
    }
  }
  if (spatial.size() > 3)
  {
    spatial.resize(3); // a fourth axis without further word is that of a series
  }
  if (spatial.size() < 3)
  {
    RefuseInput(path, Text(spatial.size(), "-D image"), "save one volume with three axes in space");
  }
  NrrdAxes axes;
  std::copy(spatial.begin(), spatial.end(), axes.spatial.begin());
  for (std::size_t a = 0; a < sizes.size(); ++a)
  {
    if (std::find(spatial.begin(), spatial.end(), a) != spatial.end() || sizes[a] == 1)
    {
      continue;
    }
    const auto        size = static_cast<std::uint64_t>(sizes[a]);
    const std::string kind = a < kinds.size() ? kinds[a] : "";
    if (a < spatial[0] || a > spatial[2])
    {
      const bool      before = a < spatial[0];
      std::uint64_t & count = before ? axes.before : axes.after;
      std::string &   kindSoFar = before ? axes.kindBefore : axes.kindAfter;
      if (count > 1 && IsComponentKind(kindSoFar) != IsComponentKind(kind))
      {
        RefuseInput(path,
                    "values of a voxel and volumes lie on neighbouring axes",
                    "order its axes as values, space, time");
      }
      if (size > (before ? kMostLayers : kMostVolumes) / count)
      {
        RefuseInput(path,
                    Text("an axis of ", size, " values that is not in space"),
                    "save one volume of whole numbers");
      }
      count *= size;
      kindSoFar = kind;
    }
    else
    {
      RefuseInput(path, "its axes in space are interrupted by another axis", "order its axes: space first");
    }
  }
  return axes;
}

void
ReadSegments(const NrrdHeader & header, ScanFile & scan)
{
  for (std::size_t n = 0; n < 100000; ++n)
  {
    const std::string prefix = Text("Segment", n, "_");
    const auto        name = header.keys.find(prefix + "Name");
    const auto        value = header.keys.find(prefix + "LabelValue");
    const auto        layer = header.keys.find(prefix + "Layer");
    if (name == header.keys.end() && value == header.keys.end() && header.keys.count(prefix + "ID") == 0)
    {
      break;
    }
    Segment segment;
    segment.name = name == header.keys.end() ? "" : Printable(Trim(name->second), 200);
    // Files from before Slicer 4.11 say neither: there each segment has a layer of its own, of ones.
    const bool old = value == header.keys.end() && layer == header.keys.end() && scan.interleaved > 1;
    const auto number = value == header.keys.end() ? std::optional<std::int64_t>(1) : ParseInteger(Trim(value->second));
    const auto at = layer == header.keys.end() ? std::optional<std::int64_t>(old ? static_cast<std::int64_t>(n) : 0)
                                               : ParseInteger(Trim(layer->second));
    if (!number || !at || *at < 0 || static_cast<std::uint64_t>(*at) >= scan.interleaved)
    {
      RefuseInput(scan.path, Text("segment ", n, " has a label value or layer that makes no sense"), "mend the header");
    }
    segment.value = *number;
    if (const auto color = header.keys.find(prefix + "Color"); color != header.keys.end())
    {
      // It decides nothing: one that makes no sense is none.
      const auto parts = ParseReals(color->second);
      if (parts && parts->size() == 3 &&
          std::all_of(parts->begin(), parts->end(), [](double part) { return part >= 0 && part <= 1; }))
      {
        segment.color = { (*parts)[0], (*parts)[1], (*parts)[2] };
      }
    }
    segment.layer = static_cast<std::size_t>(*at);
    scan.segments.push_back(std::move(segment));
  }
}

/** Which of the values before the axes in space is read, and which of the blocks behind them: the latter is returned.
 *  Either may hold the components of a voxel, or volumes. */
std::uint64_t
ChooseParts(const NrrdAxes & axes, const ReadOptions & options, ScanFile & scan)
{
  const bool layers = !scan.segments.empty();
  const bool componentsBefore = !layers && axes.before > 1 && IsComponentKind(axes.kindBefore);
  const bool volumesBefore = !layers && axes.before > 1 && !componentsBefore;
  const bool componentsAfter = axes.after > 1 && IsComponentKind(axes.kindAfter);
  if ((componentsBefore && componentsAfter) || (volumesBefore && axes.after > 1 && !componentsAfter))
  {
    RefuseInput(scan.path, "values on axes both before and behind those in space", "save one volume");
  }
  if (layers && options.component)
  {
    throw UsageError("--component: of a segmentation choose with --labels");
  }
  const std::uint64_t volume =
    ChooseVolume(scan.path, volumesBefore ? axes.before : (componentsAfter ? 1 : axes.after), options);
  const std::uint64_t component = ChooseComponent(scan.path,
                                                  componentsBefore ? axes.before : (componentsAfter ? axes.after : 1),
                                                  ComponentsText(componentsBefore ? axes.kindBefore : axes.kindAfter),
                                                  options);
  if (componentsBefore || volumesBefore)
  {
    scan.component = static_cast<std::ptrdiff_t>(componentsBefore ? component : volume);
  }
  return componentsAfter ? component : (volumesBefore ? 0 : volume);
}

DataSource
FindData(const std::filesystem::path & path, const NrrdHeader & header)
{
  DataSource        source;
  const std::string encoding = LowerCase(header.Field("encoding"));
  if (encoding == "gzip" || encoding == "gz")
  {
    source.packing = Packing::Deflate;
  }
  else if (encoding == "bzip2" || encoding == "bz2")
  {
    source.packing = Packing::Bzip2;
  }
  else if (encoding == "hex")
  {
    source.packing = Packing::Hex;
  }
  else if (encoding == "ascii" || encoding == "text" || encoding == "txt")
  {
    source.ascii = true;
  }
  else if (encoding != "raw")
  {
    RefuseInput(path, Text("its encoding '", Printable(encoding, 20), "' is not known here"), "save it as raw or gzip");
  }
  const auto skips = [&](std::string_view name, std::int64_t least) -> std::int64_t {
    const auto text = header.Field(name);
    const auto value = text.empty() ? std::optional<std::int64_t>(0) : ParseInteger(text);
    if (!value || *value < least || *value > (std::int64_t{ 1 } << 50))
    {
      RefuseInput(path,
                  Text("the header field '", name, "' makes no sense ('", Printable(text, 20), "')"),
                  "mend the header");
    }
    return *value;
  };
  source.lineSkip = static_cast<std::uint64_t>(skips("lineskip", 0));
  source.byteSkip = skips("byteskip", -1);
  const auto name = header.Field("datafile");
  if (name.empty())
  {
    if (!header.ended)
    {
      RefuseInput(path, "its header ends without a blank line and names no data file", "the file is truncated");
    }
    source.files = { path };
    source.offset = header.dataOffset;
  }
  else
  {
    source.files = FilesNamed(path, name, header.dataFiles);
  }
  return source;
}

} // namespace

std::vector<std::filesystem::path>
NrrdDataFiles(const std::filesystem::path & path)
{
  const NrrdHeader header = ReadNrrdHeader(path);
  const auto       name = header.Field("datafile");
  return name.empty() ? std::vector<std::filesystem::path>() : FilesNamed(path, name, header.dataFiles);
}

ScanFile
OpenNrrd(const std::filesystem::path & path, const ReadOptions & options)
{
  const NrrdHeader header = ReadNrrdHeader(path);
  ScanFile         scan;
  scan.path = path;
  scan.format = "NRRD";
  for (const std::string_view needed : { "type", "dimension", "sizes", "encoding" })
  {
    if (header.Field(needed).empty())
    {
      RefuseInput(path,
                  Text("its header has no field '", needed, "'"),
                  "the file is damaged or no NRRD: write it anew");
    }
  }
  scan.type = NrrdTypeOf(path, header.Field("type"));

  std::vector<std::int64_t> sizes;
  for (const auto word : Words(header.Field("sizes")))
  {
    const auto size = ParseInteger(word);
    if (!size || *size < 1)
    {
      RefuseInput(path, Text("a side of ", Printable(word, 20), " voxels"), "the file is damaged: write it anew");
    }
    sizes.push_back(*size);
  }
  const auto dimension = ParseInteger(header.Field("dimension"));
  if (!dimension || *dimension != static_cast<std::int64_t>(sizes.size()) || sizes.size() > 16)
  {
    RefuseInput(path, "its header fields 'dimension' and 'sizes' contradict each other", "mend the header");
  }
  std::vector<std::string> kinds;
  for (const auto word : Words(header.Field("kinds")))
  {
    kinds.push_back(LowerCase(word));
  }
  const auto steps = ParseNrrdVectors(path, "space directions", header.Field("spacedirections"));
  if (!steps.empty() && steps.size() != sizes.size())
  {
    RefuseInput(path,
                Text("its header has ", steps.size(), " space directions for ", sizes.size(), " axes"),
                "mend the header");
  }
  const NrrdAxes axes = SortAxes(path, sizes, kinds, steps);
  for (std::size_t a = 0; a < 3; ++a)
  {
    scan.geometry.size[a] = sizes[axes.spatial[a]];
  }
  scan.interleaved = static_cast<std::size_t>(axes.before);
  ReadSegments(header, scan);
  const std::uint64_t volume = ChooseParts(axes, options, scan);

  const DataSource source = FindData(path, header);
  WarnOfFilesElsewhere(scan, source);
  const std::uint64_t bytesPerVoxel = PixelBytes(scan.type) * axes.before;
  const std::uint64_t possible = LargestData(source, scan.type);
  const std::uint64_t voxels = CheckSize(path, scan.geometry.size, bytesPerVoxel, possible);
  // CheckSize bounds the first factor by `possible`.
  if (axes.after > std::max<std::uint64_t>(1, possible / (voxels * bytesPerVoxel)))
  {
    RefuseInput(path, "its header gives more volumes than its data can hold", "the file is truncated: write it anew");
  }

  if (PixelBytes(scan.type) > 1 && !source.ascii)
  {
    const std::string endian = LowerCase(header.Field("endian"));
    if (endian != "little" && endian != "big")
    {
      RefuseInput(path, "its header does not say whether values are little or big endian", "mend the header");
    }
    scan.swapBytes = (endian == "big") != (std::endian::native == std::endian::big);
  }
  PlaceNrrd(header, steps, axes, sizes.size(), options, scan);
  scan.voxels = OpenData(path, source, scan.type, voxels * bytesPerVoxel * axes.after);
  scan.moreVolumes = axes.after > 1;
  scan.voxels->Skip(volume * voxels * bytesPerVoxel);
  return scan;
}

} // namespace voxelcore
