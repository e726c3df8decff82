// FreeSurfer's volumes: .mgh, and .mgz packed by gzip. ITK has no reader of them.
//
// The layout is that of FreeSurfer's mri.c (mghRead): 284 bytes of header, big endian; the voxels of all frames; then
// what nobody needs here (echo times, the commands that made the file).

#include "HeaderFields.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/StatedSpacing.h"

namespace voxelcore
{
namespace
{

constexpr std::size_t kHeaderBytes = 284;

PixelType
MghTypeOf(const std::filesystem::path & path, std::int32_t type)
{
  switch (type)
  {
    case 0:
      return PixelType::UInt8;
    case 1:
      return PixelType::Int32;
    case 3:
      return PixelType::Float32;
    case 4:
      return PixelType::Int16;
    case 10:
      return PixelType::UInt16;
    default:
      RefuseInput(path,
                  Text("its voxel type ", type, " is not known here"),
                  "save it as uchar, short or int ('mri_convert -odt int')");
  }
}

/** From axes in RAS and the place of the middle, (width, height, depth) / 2 voxels from the first voxel's centre. */
void
PlaceMgh(const HeaderFields & header, const ReadOptions & options, ScanFile & scan)
{
  // FreeSurfer's own choice where a file says nothing: coronal slices.
  std::array<Vector3, 3> axes{ { { -1, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 } } };
  Vector3                middle{ 0, 0, 0 };
  Vector3                spacing{ 1, 1, 1 };
  if (header.At<std::int16_t>(28) > 0)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      spacing[a] = header.At<float>(30 + 4 * a);
      middle[a] = header.At<float>(78 + 4 * a);
      for (std::size_t c = 0; c < 3; ++c)
      {
        axes[a][c] = header.At<float>(42 + 12 * a + 4 * c);
      }
    }
  }
  else
  {
    scan.notes.push_back(
      "the file says that it has no place in space: its axes are taken as LPS of coronal slices, as FreeSurfer does");
    spacing = CompleteSpacing({}, options, scan);
  }
  const Vector3 steps = options.spacing.value_or(spacing);
  Vector3       origin = middle;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      origin[c] -= axes[a][c] * steps[a] * static_cast<double>(scan.geometry.size[a]) / 2;
    }
  }
  // RAS -> LPS.
  for (const std::size_t c : { 0, 1 })
  {
    origin[c] = -origin[c];
    for (Vector3 & axis : axes)
    {
      axis[c] = -axis[c];
    }
  }
  SetGeometry(scan, axes, spacing, origin, options);
}

} // namespace

ScanFile
OpenMgh(const std::filesystem::path & path, const ReadOptions & options)
{
  const Packing                       packing = DetectGzip(path);
  std::array<std::byte, kHeaderBytes> bytes{};
  ScanFile                            scan;
  scan.path = path;
  scan.format = "MGH";
  scan.voxels = OpenBytes(path, 0, packing);
  if (scan.voxels->ReadSome(bytes.data(), bytes.size()) < bytes.size())
  {
    RefuseInput(path,
                "too short for the header of a FreeSurfer volume",
                "the file is truncated or of another kind: fetch it anew");
  }
  scan.swapBytes = std::endian::native != std::endian::big;
  const HeaderFields header(bytes, scan.swapBytes);
  if ((header.At<std::int32_t>(0) & 0xFF) != 1) // what stands above is what the volume is meant for
  {
    RefuseInput(path, "no FreeSurfer volume (its version is not 1)", "check what kind of file it is");
  }
  for (std::size_t a = 0; a < 3; ++a)
  {
    scan.geometry.size[a] = header.At<std::int32_t>(4 + 4 * a);
  }
  scan.type = MghTypeOf(path, header.At<std::int32_t>(20));
  const std::int32_t frames = header.At<std::int32_t>(16);
  if (frames < 1)
  {
    RefuseInput(path, Text("its header gives ", frames, " frames"), "the file is damaged: write it anew");
  }
  const std::uint64_t volume = ChooseVolume(path, static_cast<std::uint64_t>(frames), options);
  ChooseComponent(path, 1, "volume of vectors", options);
  const std::uint64_t possible =
    packing == Packing::Plain ? FileSize(path) - kHeaderBytes : FileSize(path) * LargestExpansion(packing);
  const std::uint64_t bytesPerVoxel = PixelBytes(scan.type);
  const std::uint64_t volumeBytes = bytesPerVoxel * CheckSize(path, scan.geometry.size, bytesPerVoxel, possible);
  if (static_cast<std::uint64_t>(frames) > possible / volumeBytes)
  {
    RefuseInput(path,
                Text("its header gives ", frames, " frames, more than its data can hold"),
                "the file is truncated: fetch or write it anew");
  }
  PlaceMgh(header, options, scan);
  scan.voxels->Skip(volume * volumeBytes);
  scan.moreVolumes = volume + 1 < static_cast<std::uint64_t>(frames);
  scan.hasMore = true;
  return scan;
}

} // namespace voxelcore
