// OME-Zarr stores on a local disk, chunk by chunk: of a part only the chunks it lies in are read.

#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/StatedSpacing.h"
#include "ZarrStream.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace voxelcore
{
namespace
{

// Of a part of more bytes or chunks than this, one in kSparsest chunks must be there: what is missing takes time, too.
constexpr double kNoQuestion = 1 << 30;
constexpr double kMostLooks = 100000;
constexpr double kSparsest = 1024;

std::array<std::int64_t, 3>
SizeOf(const std::filesystem::path & path, const ZarrImage & image)
{
  std::array<std::int64_t, 3> size{};
  for (std::size_t n = 0; n < 3; ++n)
  {
    size[2 - n] = static_cast<std::int64_t>(image.array.shape[image.spatial[n]]);
  }
  CheckSize(path, size, PixelBytes(image.array.type), UINT64_MAX);
  return size;
}

/** Time point and channel. */
ZarrVolume
ChooseZarrVolume(const std::filesystem::path & path, ZarrImage image, const ReadOptions & options)
{
  ZarrVolume                 volume;
  std::vector<std::uint64_t> place(image.array.shape.size(), 0);
  const auto                 sides = [&](const std::optional<std::size_t> & axis) {
    return axis ? image.array.shape[*axis] : std::uint64_t{ 1 };
  };
  const std::uint64_t time = ChooseVolume(path, sides(image.time), options);
  const std::uint64_t channel = ChooseComponent(path, sides(image.channel), "image of several channels", options);
  if (image.time)
  {
    place[*image.time] = time;
  }
  if (image.channel)
  {
    place[*image.channel] = channel;
  }
  return { std::move(image), std::move(place) };
}

void
PlaceZarr(const ZarrImage & image, const ReadOptions & options, ScanFile & scan)
{
  Vector3                spacing{ 1, 1, 1 };
  Vector3                origin{ 0, 0, 0 };
  std::array<Vector3, 3> axes{};
  std::size_t            unknown = 0;
  std::string            scale;
  for (std::size_t n = 0; n < 3; ++n)
  {
    const std::size_t axis = image.spatial[n];
    const auto &      unit = image.units[axis];
    const auto        millimetres = MillimetresIn(unit);
    if (!unit.empty() && !IsVoxelUnit(unit) && !millimetres && !options.spacing)
    {
      RefuseInput(scan.path,
                  Text("lengths in '", Printable(unit, 20), "', which is no unit known here"),
                  "give the voxel spacing with --spacing X,Y,Z in mm");
    }
    unknown += millimetres ? 0 : 1;
    axes[2 - n] = image.axes[n];
    spacing[2 - n] = image.scale[axis] * millimetres.value_or(1);
    for (std::size_t c = 0; c < 3; ++c)
    {
      origin[c] += image.axes[n][c] * image.translation[axis] * millimetres.value_or(1);
    }
    scale.insert(0, Number(image.scale[axis]) + (scale.empty() ? "" : ","));
  }
  if (unknown > 0 && !options.spacing)
  {
    // A scale without a unit tells the shape of a voxel at most, and whose unit would it be?
    if (!image.version.empty())
    {
      scan.notes.push_back(Text("the scale ", scale, " has no unit: not taken for a voxel size"));
    }
    spacing = SpacingInVoxels(scan);
    origin = { 0, 0, 0 };
  }
  else if (!options.spacing && !image.version.empty())
  {
    scan.notes.push_back("the voxel size is the scale of OME-Zarr");
  }
  if (!image.isPlaced)
  {
    scan.notes.push_back("the file names no anatomical space: its axes are taken as LPS");
  }
  SetGeometry(scan, axes, spacing, origin, options);
}

} // namespace

void
RequireSomeZarrChunks(const std::filesystem::path & path, const ZarrVolume & volume, const CropRange & part)
{
  const ZarrGrid grid(volume.image, part);
  const double   count = grid.Count();
  const double   bytes = count * static_cast<double>(volume.image.array.ChunkBytes());
  if (bytes <= kNoQuestion && count <= kMostLooks)
  {
    return;
  }
  // Looks at chunks spread evenly.
  const double        looks = std::min(count, kMostLooks);
  const double        needed = looks / kSparsest;
  double              there = 0;
  const std::uint64_t sideJ = grid.end[1] - grid.first[1];
  const std::uint64_t sideI = grid.end[2] - grid.first[2];
  // NOLINTNEXTLINE(cert-flp30-c): whole numbers below 2^53
  for (double look = 0; look < looks && there < needed; ++look)
  {
    const double number = std::floor(look * (count / looks));
    const double row = std::floor(number / static_cast<double>(sideI));
    const double layer = std::floor(row / static_cast<double>(sideJ));
    const auto   within = [](double place, std::uint64_t side) {
      return std::min(static_cast<std::uint64_t>(std::max(0.0, place)), side - 1);
    };
    const ZarrTriple at{ grid.first[0] + within(layer, grid.end[0] - grid.first[0]),
                         grid.first[1] + within(row - layer * static_cast<double>(sideJ), sideJ),
                         grid.first[2] + within(number - row * static_cast<double>(sideI), sideI) };
    std::error_code  ignored;
    there += std::filesystem::exists(volume.image.array.ChunkFile(volume.ChunkIndex(at)), ignored) ? 1 : 0;
  }
  if (there < needed)
  {
    RefuseInput(path,
                Text("it should have ", Number(count), " chunks, and nearly all of them are not there"),
                "the store is not whole or its metadata are damaged; with --crop a part of it is read");
  }
}

std::vector<std::filesystem::path>
ZarrFiles(const std::filesystem::path & path, const ReadOptions & options)
{
  const ZarrImage                    image = ReadZarrImage(path, options);
  const auto &                       folder = image.array.folder;
  const bool                         all = !options.crop && !options.volume && !options.component;
  std::vector<std::filesystem::path> files;
  for (const auto & group : { path, folder.parent_path(), folder })
  {
    for (const char * name : { ".zattrs", ".zgroup", ".zarray", "zarr.json" })
    {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(group / name, ignored) &&
          std::find(files.begin(), files.end(), group / name) == files.end())
      {
        files.push_back(group / name);
      }
    }
  }
  if (all)
  {
    for (const auto & entry : std::filesystem::recursive_directory_iterator(folder))
    {
      if (entry.is_regular_file())
      {
        files.push_back(entry.path());
      }
    }
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    return files;
  }
  const ZarrVolume volume = ChooseZarrVolume(path, image, options);
  const CropRange  part = ResolveCrop(options.crop, SizeOf(path, volume.image), path);
  RequireSomeZarrChunks(path, volume, part);
  ZarrGrid(volume.image, part).Each([&](const ZarrTriple & at) {
    const auto      file = volume.image.array.ChunkFile(volume.ChunkIndex(at));
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && (files.empty() || files.back() != file))
    {
      files.push_back(file);
    }
    return true;
  });
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

ScanFile
OpenZarr(const std::filesystem::path & path, const ReadOptions & options)
{
  ZarrVolume volume = ChooseZarrVolume(path, ReadZarrImage(path, options), options);
  ScanFile   scan;
  scan.path = path;
  scan.format = volume.image.version.empty() ? "Zarr" : "OME-Zarr";
  scan.type = volume.image.array.type;
  scan.geometry.size = SizeOf(path, volume.image);
  scan.swapBytes = volume.image.array.bigEndian != (std::endian::native == std::endian::big);
  scan.listed = volume.image.labels;
  if (volume.image.levels > 1)
  {
    scan.notes.push_back(Text("level ", options.level.value_or(0), " of ", volume.image.levels, " resolutions"));
  }
  const CropRange part = ResolveCrop(options.crop, scan.geometry.size, path);
  RequireSomeZarrChunks(path, volume, part);
  PlaceZarr(volume.image, options, scan);
  const auto & size = scan.geometry.size;
  const auto   side = [&](std::size_t a) { return static_cast<std::uint64_t>(size[a]); };
  scan.voxels = std::make_unique<ZarrStream>(path, std::move(volume), ZarrTriple{ side(2), side(1), side(0) }, part);
  return scan;
}

} // namespace voxelcore
