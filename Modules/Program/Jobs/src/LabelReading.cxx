#include "voxelcore/Jobs/LabelReading.h"

#include "voxelcore/Base/Stopwatch.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Jobs/RefineStage.h"
#include "voxelcore/Report/Sha256.h"

#include <future>
#include <utility>

namespace voxelcore
{

ScanLabels
ReadScanLabels(const CoreOptions & options, StagePlan & plan, CoreReport & report)
{
  Stopwatch            watch;
  auto                 digest = std::async(Beside(), [&options] { return ScanSha256(options.scan, options.reading); });
  InputScan            volume = ReadScanOrMesh(options.scan, options.reading, options.resolution, plan.Next("reading"));
  const SpacingWeights weights = ScanWeights(volume.geometry, options.scan);
  ScanLabels           read;
  read.geometry = volume.geometry;
  read.edited = EditLabels(std::move(volume.labels),
                           volume.geometry,
                           options.edits,
                           options.reading.labels != "all",
                           options.scan.string(),
                           plan.Next());
  read.surface = MakeSurfaceSource(options.refine, options.scan, options.reading, volume);
  read.warnings = volume.warnings;
  for (std::string & warning : DiagnoseLabels(read.edited.labels, weights.weight))
  {
    read.warnings.push_back(std::move(warning));
  }
  report.command = options.command;
  report.input = { options.scan.string(), {}, volume.format, volume.geometry, volume.notes };
  report.parameters = DescribeParameters(options, volume, read.edited, weights);
  report.input.sha256 = digest.get();
  report.seconds.read = watch.Lap();
  return read;
}

ProgressCallback
ProgressOfLabel(const ProgressCallback & whole,
                const std::string &      name,
                std::size_t              index,
                std::size_t              count,
                double                   begin,
                double                   end)
{
  const std::string which = count == 1 ? "" : " (" + std::to_string(index + 1) + "/" + std::to_string(count) + ")";
  return NamedPartOfProgress(whole, name + which, begin, end);
}

void
AddComputing(StageSeconds & all, const StageSeconds & one)
{
  all.shape += one.shape;
  all.delaunay += one.delaunay;
  all.core += one.core;
  all.prune += one.prune;
}

} // namespace voxelcore
