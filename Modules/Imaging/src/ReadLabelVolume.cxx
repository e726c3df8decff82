#include "GuardedCollector.h"
#include "ScanFile.h"
#include "SlabReader.h"
#include "voxelcore/LabelVolume.h"

namespace voxelcore
{

LabelMap
ReadLabelVolume(const std::filesystem::path & path, const ReadOptions & options, const ProgressCallback & progress)
{
  ScanFile        scan = OpenScan(path, options);
  const CropRange part = ResolveCrop(options.crop, scan.geometry.size, path);
  if (options.crop)
  {
    scan.notes.push_back("only the voxels " + CropText(part) + " were looked at");
  }
  GuardedCollector collector(scan, options, part);
  const auto &     size = scan.geometry.size;
  ReportProgress(progress, "read", 0.0);
  {
    const CropRange whole{ { 0, 0, 0 },
                           { part.end[0], static_cast<std::int32_t>(size[1]), static_cast<std::int32_t>(size[2]) } };
    SlabReader      reader(scan, collector.NeedsAllRows() ? whole : part);
    while (const Slab * slab = reader.Next())
    {
      std::size_t at = 0;
      for (const RowSpan & span : slab->spans)
      {
        collector.AddRows(slab->bytes.data() + at, span.firstRow, span.rowCount);
        at += span.rowCount * reader.RowBytes();
      }
      collector.FinishSlab();
      ReportProgress(progress, "read", reader.Fraction());
    }
    reader.Finish(progress);
  }
  if (!scan.moreVolumes && scan.voxels->Finish())
  {
    scan.warnings.push_back("the file is longer than its header says; check that the header belongs to it");
  }
  scan.voxels.reset();

  LabelMap volume;
  volume.labels = collector.TakeShapes();
  volume.geometry = scan.geometry;
  if (options.crop)
  {
    volume.crop = part;
  }
  volume.format = scan.format;
  volume.pixelType = scan.storedType.empty() ? PixelName(scan.type) : scan.storedType;
  if (collector.IsRenumbered())
  {
    scan.notes.push_back("layers use a value more than once: segments are numbered anew");
  }
  volume.notes = std::move(scan.notes);
  volume.notes.insert(volume.notes.end(), scan.warnings.begin(), scan.warnings.end());
  volume.warnings = WarningsOf(scan);
  return volume;
}

} // namespace voxelcore
