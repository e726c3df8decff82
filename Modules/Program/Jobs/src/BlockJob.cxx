#include "voxelcore/Jobs/BlockJob.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Jobs/JobTools.h"
#include "PlannedBlock.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputStream.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Blocks/GridBlocks.h"
#include "voxelcore/Blocks/HaloBlocks.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Imaging/ScanRows.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <set>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** "<scan>_label-<value>[_component-<c>]_block-" */
std::string
Start(const fs::path & scan, std::int64_t label, std::int64_t component)
{
  return ScanName(scan) + "_label-" + std::to_string(label) +
         (component > 0 ? "_component-" + std::to_string(component) : std::string()) + "_block-";
}

/** K and N of "<start>K-of-N.vcb"; false for any other name. */
bool
ParseBlockName(std::string_view name, const std::string & start, std::size_t & block, std::size_t & blocks)
{
  constexpr std::string_view between = "-of-";
  if (!name.starts_with(start))
  {
    return false;
  }
  const char * at = name.data() + start.size();
  const char * end = name.data() + name.size();
  const auto   first = from_chars(at, end, block);
  const auto   left = std::string_view(first.ptr, static_cast<std::size_t>(end - first.ptr));
  if (first.ec != std::errc() || !left.starts_with(between))
  {
    return false;
  }
  const auto second = from_chars(first.ptr + between.size(), end, blocks);
  return second.ec == std::errc() && std::string_view(second.ptr, static_cast<std::size_t>(end - second.ptr)) == ".vcb";
}

/** The files of all blocks of a label, in order. */
std::vector<fs::path>
FindParts(const fs::path & folder, const std::string & start)
{
  std::map<std::size_t, std::map<std::size_t, fs::path>> byCount;
  if (!fs::is_directory(folder))
  {
    throw InputError(folder.string() + ": no such folder; give --join the folder that 'core --block' wrote into");
  }
  for (const auto & entry : fs::directory_iterator(folder))
  {
    std::size_t block = 0;
    std::size_t blocks = 0;
    if (ParseBlockName(entry.path().filename().string(), start, block, blocks))
    {
      byCount[blocks][block] = entry.path();
    }
  }
  if (byCount.size() != 1)
  {
    throw InputError(folder.string() + ": " + (byCount.empty() ? "holds no part " : "holds parts of different cuts, ") +
                     start +
                     (byCount.empty() ? "*.vcb; run 'core --blocks N --block K' for each K first"
                                      : "*.vcb; keep those of one --blocks"));
  }
  const auto & [count, parts] = *byCount.begin();
  std::vector<fs::path> files;
  constexpr std::size_t shown = 12;
  std::string           missing;
  for (std::size_t block = 1; block <= count; ++block)
  {
    const auto found = parts.find(block);
    if (found == parts.end())
    {
      const std::size_t before = block - 1 - files.size();
      missing += before < shown ? (before == 0 ? "" : ", ") + std::to_string(block) : before == shown ? ", ..." : "";
    }
    else
    {
      files.push_back(found->second);
    }
  }
  if (!missing.empty())
  {
    throw InputError(folder.string() + ": of the " + std::to_string(count) + " parts " + start +
                     "* these are missing: " + missing +
                     "; run 'core --block K' for them, with --blocks or --block-size as for the others");
  }
  return files;
}

/** Writes the share of a label under the name it gets in the end. */
BlockPart
WriteShare(const BlockShare &   share,
           std::int64_t         label,
           std::int64_t         component,
           const std::string &  name,
           const BlockOptions & options,
           OutputTransaction &  transaction)
{
  const fs::path target = BlockPath(options, label, component);
  OutputStream   file(transaction.Stage(target));
  try
  {
    WriteBlockShare(share, file);
  }
  catch (const OutputError &)
  {
    file.Finish(); // knows why
    throw;
  }
  file.Finish();
  const auto own = static_cast<std::uint64_t>(std::count(share.isOwn.begin(), share.isOwn.end(), 1));
  return { label, component, name, share.cells.tetrahedra.size(), share.boundaryVertices, own, share.subshapeVertices,
           target };
}

constexpr double kReadEnds = 0.2;

/** The progress of one label of several. */
ProgressCallback
ProgressOf(const JobContext & context, const std::string & name, std::size_t label, std::size_t count)
{
  const auto at = [&](std::size_t number) {
    return kReadEnds + (1 - kReadEnds) * static_cast<double>(number) / static_cast<double>(count);
  };
  return PartOfProgress(context.progress, name, at(label), at(label + 1));
}

/** The blocks of all labels, from the voxels around them. */
void
ComputeFrom(PlannedBlock &       found,
            const BlockOptions & options,
            OutputTransaction &  transaction,
            const JobContext &   context,
            BlockResult &        result)
{
  result.warnings = found.warnings;
  const std::size_t count = found.plan.labels.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const PlannedLabel & label = found.plan.labels[i];
    const BlockShare     share = ComputeBlockShare(found.shapes[i],
                                               found.weights,
                                               label.plan,
                                               label.regions[options.block - 1],
                                               options.block - 1,
                                               options.core.engine,
                                               ProgressOf(context, label.name, i, count));
    result.parts.push_back(WriteShare(share, label.value, 0, label.name, options, transaction));
    found.shapes[i] = VoxelShape();
  }
}

/** The blocks of all labels, from the whole scan; with a plan for the others, where they can do with less. */
std::optional<ScanPlan>
ComputeFromWhole(const BlockOptions & options,
                 OutputTransaction &  transaction,
                 const JobContext &   context,
                 BlockResult &        result)
{
  const CoreOptions & core = options.core;
  LabelMap            volume =
    ReadScanOrMesh(core.scan, core.reading, core.resolution, PartOfProgress(context.progress, "reading", 0, kReadEnds));
  EditedLabels            edited = EditLabels(std::move(volume.labels),
                                   volume.geometry,
                                   core.edits,
                                   core.reading.labels != "all",
                                   core.scan.string(),
                                   PartOfProgress(context.progress, kReadEnds, kReadEnds));
  const SpacingWeights    weights = ScanWeights(volume.geometry, core.scan);
  std::optional<ScanPlan> kept;
  if (CanReadBlockAlone(options))
  {
    kept = ScanPlan{ PlanSource(options), {} };
  }
  result.warnings = volume.warnings;
  for (std::string & warning : DiagnoseLabels(edited.labels, weights.weight))
  {
    result.warnings.push_back(std::move(warning));
  }
  for (std::size_t i = 0; i < edited.labels.size(); ++i)
  {
    EditedLabel &    one = edited.labels[i];
    const auto       progress = ProgressOf(context, one.label.name, i, edited.labels.size());
    const BlockPlan  plan = PlanBlocks(one.label.shape, weights, options.blocks);
    const BlockShare share =
      ComputeBlockShare(one.label.shape, weights, plan, options.block - 1, core.engine, progress);
    result.parts.push_back(WriteShare(share, one.label.value, one.component, one.label.name, options, transaction));
    if (kept)
    {
      auto regions = FindBlockRegions(one.label.shape, weights, plan, progress);
      kept->labels.push_back({ one.label.value, one.label.name, plan, std::move(regions) });
    }
    one.label.shape = VoxelShape();
  }
  return kept;
}

/** A scan that is cut by its size alone. */
struct ScanGrid
{
  SpacingWeights weights;
  VoxelBox       box; ///< of the scan, or of the part that is looked at
  BlockPlan      plan;
};

ScanGrid
GridOf(const BlockOptions & options)
{
  const CoreOptions & core = options.core;
  const auto          isNumber = [](const std::string & text) {
    return !text.empty() && ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
  };
  if (!core.reading.binary && !core.reading.threshold && !isNumber(core.reading.labels))
  {
    throw UsageError(
      "--block-size takes one shape at a time, as no block knows all labels: give --labels VALUE, "
      "--binary or --threshold LO:HI");
  }
  if (core.edits.AreAsked() || (IsMeshFile(core.scan) && !core.reading.raw))
  {
    throw UsageError("--block-size reads the blocks of a scan as they are: meshes and edits of shapes need --blocks");
  }
  const ImageGeometry geometry = ScanRows(core.scan, core.reading).Geometry();
  const CropRange     part = ResolveCrop(core.reading.crop, geometry.size, core.scan);
  ScanGrid            grid;
  grid.weights = ScanWeights(geometry, core.scan);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grid.box.lower[axis] = part.first[axis];
    grid.box.size[axis] = part.end[axis] - part.first[axis];
  }
  grid.plan = PlanGrid(grid.box, grid.weights, *options.side);
  return grid;
}

/** A block of the one shape, from what its balls can reach. */
void
ComputeFromGrid(const BlockOptions & options,
                OutputTransaction &  transaction,
                const JobContext &   context,
                BlockResult &        result)
{
  const CoreOptions & core = options.core;
  const ScanGrid      grid = GridOf(options);
  std::int64_t        value = 1;
  std::string         name = "label-1";
  if (!core.reading.binary && !core.reading.threshold)
  {
    value = std::stoll(core.reading.labels);
    name = "label-" + core.reading.labels;
  }
  const RegionReader read = [&](const VoxelBox & box) {
    ReadOptions reading = core.reading;
    reading.crop = CropRange{ box.lower, {} };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      reading.crop->end[axis] = box.lower[axis] + box.size[axis];
    }
    reading.mayBeMissing = true;
    reading.refuseGrey = false; // which one block cannot tell
    LabelMap map = ReadLabelVolume(core.scan, reading, PartOfProgress(context.progress, "reading", 0, kReadEnds));
    result.warnings = std::move(map.warnings);
    if (map.labels.empty())
    {
      return VoxelShape();
    }
    name = map.labels.front().name;
    return std::move(map.labels.front().shape);
  };
  const BlockShare share = ComputeBlockShare(read,
                                             grid.box,
                                             grid.weights,
                                             grid.plan,
                                             options.block - 1,
                                             core.engine,
                                             ProgressOf(context, name, 0, 1));
  result.parts.push_back(WriteShare(share, value, 0, name, options, transaction));
}

} // namespace

std::size_t
CountBlocks(const BlockOptions & options)
{
  return options.side ? GridOf(options).plan.blocks.size() : options.blocks;
}

fs::path
BlockPath(const BlockOptions & options, std::int64_t label, std::int64_t component)
{
  return options.core.output / (Start(options.core.scan, label, component) + std::to_string(options.block) + "-of-" +
                                std::to_string(options.blocks) + ".vcb");
}

BlockResult
RunBlockJob(const BlockOptions & asked, const JobContext & given)
{
  const JobContext context = ForwardOnly(given);
  BlockOptions     options = asked;
  options.blocks = CountBlocks(asked);
  const CoreOptions & core = options.core;
  if (options.block < 1 || options.block > options.blocks)
  {
    throw UsageError("--block " + std::to_string(options.block) + ": there are blocks 1 to " +
                     std::to_string(options.blocks));
  }
  if (!IsFolderOutput(core.output))
  {
    throw UsageError(core.output.string() + ": a block is written into a folder; end its name in /");
  }
  OutputTransaction transaction(core.force, context.temporaries);
  transaction.Protect(core.scan);
  transaction.MakeDirectory(core.output);
  BlockResult result;
  result.blocks = options.blocks;
  if (options.side)
  {
    ComputeFromGrid(options, transaction, context, result);
    Finish(transaction, context);
    return result;
  }
  if (CanReadBlockAlone(options))
  {
    if (auto found = ReadPlannedBlock(options, PartOfProgress(context.progress, "reading", 0, kReadEnds)))
    {
      ComputeFrom(*found, options, transaction, context, result);
      Finish(transaction, context);
      return result;
    }
  }
  const std::optional<ScanPlan> plan = ComputeFromWhole(options, transaction, context, result);
  Finish(transaction, context);
  if (plan)
  {
    KeepPlan(*plan, options, context);
  }
  return result;
}

DelaunayCells
JoinParts(const fs::path &                  folder,
          const fs::path &                  scan,
          std::int64_t                      label,
          std::int64_t                      component,
          const std::vector<LatticePoint> & points,
          const TopologyNumbers &           topology,
          const ProgressCallback &          progress)
{
  const std::vector<fs::path> files = FindParts(folder, Start(scan, label, component));
  const auto                  read = [&](std::size_t i) {
    std::ifstream file(files[i], std::ios::binary);
    if (!file)
    {
      throw InputError(files[i].string() + ": cannot read: " + std::strerror(errno));
    }
    return ReadBlockShare(file, files[i].string());
  };
  JoinedCells joined;
  try
  {
    joined = JoinBlockShares(files.size(), read, progress);
  }
  catch (const InputError & error)
  {
    // Of parts that do not go together it knows the number, and not where they lie.
    const std::string why = error.what();
    throw InputError(why.starts_with(folder.string()) ? why : folder.string() + ": " + why);
  }
  if (joined.points != points)
  {
    throw InputError(folder.string() + ": the parts of label " + std::to_string(label) +
                     " belong to another scan than " + scan.string() + ", or to other options; make them anew");
  }
  if (joined.topology.euler != topology.euler || joined.topology.betti != topology.betti)
  {
    throw CertificateError(folder.string() + ": the parts of label " + std::to_string(label) +
                           " add up to another topology than the scan's; compute them again");
  }
  return std::move(joined.cells);
}

std::string
BlockText(const BlockResult & result, const BlockOptions & options)
{
  std::string text;
  for (const BlockPart & part : result.parts)
  {
    const std::string own = part.boundaryVertices == kNotCounted
                              ? ", " + std::to_string(part.ownVertices) + " of its own"
                              : " of " + std::to_string(part.boundaryVertices);
    text += part.file.string() + ": block " + std::to_string(options.block) + " of " + std::to_string(result.blocks) +
            " of " + LabelText(part.label, part.name) + ": " + std::to_string(part.cells) + " cells; computed on " +
            std::to_string(part.subshapeVertices) + " boundary vertices" + own + "; peak memory " +
            std::to_string(static_cast<long>(PeakMemoryMb())) + " MB\n";
  }
  return text;
}

} // namespace voxelcore
