#include "OpenScan.h"
#include "LabelList.h"
#include "SlabReader.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Labels/LabelAssembler.h"

namespace voxelcore
{
namespace
{

/** What the header says. */
LabelMap
Described(const ScanFile & scan, const ReadOptions & options, const CropRange & part)
{
  LabelMap map;
  map.geometry = scan.geometry;
  if (options.crop)
  {
    map.crop = part;
  }
  map.format = scan.format;
  map.pixelType = scan.storedType.empty() ? PixelName(scan.type) : scan.storedType;
  map.notes = scan.notes;
  map.notes.insert(map.notes.end(), scan.warnings.begin(), scan.warnings.end());
  map.warnings = WarningsOf(scan);
  return map;
}

} // namespace

LabelMap
ReadLabelVolume(const std::filesystem::path & path, const ReadOptions & options, const ProgressCallback & progress)
{
  ScanFile scan = OpenScan(path, options);
  if (scan.segments.empty() && scan.listed.empty())
  {
    scan.listed = ReadLabelList(path);
  }
  LabelAssembler  assembler(scan, options);
  const CropRange part = assembler.Part();
  if (options.crop)
  {
    scan.notes.push_back("only the voxels " + CropText(part) + " were looked at");
  }
  const auto & size = scan.geometry.size;
  ReportProgress(progress, "read", 0.0);
  {
    const CropRange whole{
      { 0, 0, 0 },
      { static_cast<std::int32_t>(size[0]), static_cast<std::int32_t>(size[1]), static_cast<std::int32_t>(size[2]) }
    };
    SlabReader reader(scan, assembler.NeedsAllRows() ? whole : part);
    while (const Slab * slab = reader.Next())
    {
      std::size_t at = 0;
      for (const RowSpan & span : slab->spans)
      {
        assembler.AddRows(slab->bytes.data() + at, span.firstRow, span.rowCount);
        at += span.rowCount * reader.RowBytes();
      }
      ReportProgress(progress, "read", reader.Fraction());
    }
    reader.Finish(progress);
  }
  if (!scan.moreVolumes && scan.voxels->Finish() && !scan.hasMore)
  {
    scan.warnings.push_back("the file is longer than its header says; check that the header belongs to it");
  }
  scan.voxels.reset();
  try
  {
    std::vector<LabelShape> labels = assembler.TakeShapes();
    if (assembler.IsRenumbered())
    {
      scan.notes.push_back("layers use a value more than once: segments are numbered anew");
    }
    for (const double value : assembler.PassedOver())
    {
      scan.notes.push_back(Text("the value ", Number(value), " is no label and counts as background"));
    }
    LabelMap map = Described(scan, options, part);
    map.labels = std::move(labels);
    return map;
  }
  catch (GreyScanError & error)
  {
    error.scan = Described(scan, options, part);
    throw;
  }
}

} // namespace voxelcore
