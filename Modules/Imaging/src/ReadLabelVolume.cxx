#include "LabelCollector.h"
#include "ScanFile.h"
#include "voxelcore/LabelVolume.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

constexpr std::size_t kSlabBytes = 4U << 20;

template <std::size_t Width>
void
SwapValues(std::vector<std::byte> & bytes)
{
  for (std::size_t at = 0; at + Width <= bytes.size(); at += Width)
  {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                 bytes.begin() + static_cast<std::ptrdiff_t>(at + Width));
  }
}

void
SwapSlab(std::vector<std::byte> & bytes, PixelType type)
{
  switch (PixelBytes(type))
  {
    case 2:
      return SwapValues<2>(bytes);
    case 4:
      return SwapValues<4>(bytes);
    case 8:
      return SwapValues<8>(bytes);
    default:
      return;
  }
}

/** `count` bytes into the slab. It grows as they come: a row may be long, and a header may lie. */
void
ReadSlab(ByteStream & stream, std::vector<std::byte> & slab, std::size_t count)
{
  constexpr std::size_t step = 16U << 20;
  for (std::size_t have = 0; have < count;)
  {
    const std::size_t now = std::min(step, count - have);
    slab.resize(have + now);
    stream.Read(slab.data() + have, now);
    have += now;
  }
}

} // namespace

LabelVolume
ReadLabelVolume(const std::filesystem::path & path, const ReadOptions & options, const ProgressCallback & progress)
{
  ScanFile       scan = OpenScan(path, options);
  LabelCollector collector(scan, options);
  const auto &   size = scan.geometry.size;
  const auto     rows = static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]);
  const auto     rowBytes = static_cast<std::size_t>(size[0]) * scan.interleaved * PixelBytes(scan.type);
  const auto     slabRows = std::max<std::size_t>(1, kSlabBytes / rowBytes);
  ReportProgress(progress, "read", 0.0);
  std::vector<std::byte> slab;
  for (std::uint64_t row = 0; row < rows;)
  {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(slabRows, rows - row));
    ReadSlab(*scan.voxels, slab, now * rowBytes);
    if (scan.swapBytes)
    {
      SwapSlab(slab, scan.type);
    }
    collector.AddRows(slab.data(), row, now);
    row += now;
    ReportProgress(progress, "read", static_cast<double>(row) / static_cast<double>(rows));
  }
  if (!scan.moreVolumes && scan.voxels->Finish())
  {
    scan.warnings.push_back("the file holds more data than its header speaks of: its header may be wrong");
  }
  std::vector<std::byte>().swap(slab);
  scan.voxels.reset();

  LabelVolume volume;
  volume.labels = collector.TakeShapes();
  volume.geometry = scan.geometry;
  volume.format = scan.format;
  volume.pixelType = scan.storedType.empty() ? PixelName(scan.type) : scan.storedType;
  if (collector.Book().IsRenumbered())
  {
    scan.notes.push_back("layers use a value more than once: segments are numbered anew");
  }
  volume.notes = std::move(scan.notes);
  volume.notes.insert(volume.notes.end(), scan.warnings.begin(), scan.warnings.end());
  volume.warnings = std::move(scan.warnings);
  return volume;
}

} // namespace voxelcore
