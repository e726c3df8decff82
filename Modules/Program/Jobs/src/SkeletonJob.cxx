#include "voxelcore/Jobs/SkeletonJob.h"

#include "SkeletonNotes.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Jobs/CoreJobSteps.h"
#include "voxelcore/Jobs/DisplayFiles.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/LabelGroups.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/SkeletonFiles.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

namespace
{

SkeletonResult
FromScan(const SkeletonOptions & options, const JobContext & context)
{
  CoreResult result = RunCoreJob(CoreOptionsOf(options), context);
  return { std::move(result.report), std::move(result.warnings), std::move(result.notes) };
}

SkeletonResult
FromCore(const SkeletonOptions & options, const JobContext & given)
{
  if (options.stage.network)
  {
    throw UsageError("--network: needs a scan, but " + options.input.string() +
                     " is a medial surface; give the scan to 'voxelcore skeleton'");
  }
  if (const std::string option(options.targets.NeedsBodies()); !option.empty())
  {
    throw UsageError(option + ": needs a scan, but " + options.input.string() +
                     " is a medial surface, which does not hold the body; give the scan to 'voxelcore skeleton'");
  }
  const JobContext  context = ForwardOnly(given);
  Stopwatch         total;
  Stopwatch         watch;
  SkeletonResult    result;
  CoreReport &      report = result.report;
  OutputTransaction transaction(options.force, context.temporaries);
  SkeletonFiles     files(options.output, options.input, options.targets, transaction);
  if (options.report)
  {
    transaction.CheckTarget(*options.report);
  }
  DisplayFiles shown(options.display, options.input, transaction);
  ReportProgress(context.progress, "reading", 0);
  MedialModel model = ReadModel(options.input, Precision::AsSaved);
  WarnOfRounding(options.input, model.rounded, result.warnings);
  report = ParseProvenance(model.provenance, options.input.string());
  RequireFittingProvenance(report.labels.size() == model.parts.size() && report.parameters.lambda.size() == 1 &&
                             report.parameters.tolerances.size() <= 1,
                           options.input);
  report.command = options.command;
  report.input.path = options.input.string();
  report.parameters.engine = "none";
  report.parameters.threads = options.threads;
  report.skeleton = options.stage;
  report.skeleton->lambda = ParseLambda(report.parameters.lambda.front());
  report.skeleton->refined = !model.refined.empty();
  report.skeleton->border = BorderEnds::Closed;
  if (!report.parameters.tolerances.empty())
  {
    const Tolerance height = ParseTolerance(report.parameters.tolerances.front());
    report.skeleton->tolerance = height.value > 0 ? std::optional(height) : std::nullopt;
  }
  CertifiedRequest request;
  request.skeleton = report.skeleton;
  RequireLengthsOf(options.input, report.input.geometry.unit, request);
  files.RequireUnit(report.input.geometry.unit);
  report.seconds.read = watch.Lap();
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    const auto share = [&](std::size_t done) {
      return 0.05 + 0.9 * static_cast<double>(done) / static_cast<double>(model.parts.size());
    };
    Stopwatch            labelWatch;
    const CertifiedShape shape = RecordedShape(report, report.labels[i]);
    // Of a damaged file the skeleton would differ from the shape, and that would be told as a fault of the program.
    RequireFittingProvenance(ComputeComplexTopology(model.parts[i].core.cells) == shape.topology, options.input);
    SkeletonPart part = TakeSkeleton(
      SkeletonOf(model.parts[i], shape, *report.skeleton, PartOfProgress(context.progress, share(i), share(i + 1))),
      report.labels[i]);
    report.labels[i].seconds = labelWatch.Lap();
    report.seconds.skeleton += report.labels[i].seconds;
    shown.AddLabel(report.labels[i], model.parts[i], &part);
    files.Add(report, i, std::move(part), std::move(model.parts[i]), result.notes);
  }
  if (report.skeleton->lambda.value != 0)
  {
    result.notes.push_back(options.input.string() + " is pruned at lambda " + report.skeleton->lambda.text +
                           ": parts thinner than that have no branches; for these make the core with --lambda 0");
  }
  if (report.skeleton->tolerance)
  {
    result.notes.push_back(options.input.string() + " is pruned at tolerance " + report.skeleton->tolerance->text +
                           ": tips are that much shorter; for all of them make the core with --lambda 0");
  }
  TellConnectivity(options.input, report, result.notes);
  TellClosedBorder(report, result.notes);
  ReportProgress(context.progress, "writing", 0.95);
  files.Finish(report, result.notes);
  shown.Finish(report, result.notes, PartOfProgress(context.progress, 0.95, 1));
  report.seconds.total = total.Lap();
  report.seconds.write = report.seconds.total - report.seconds.read - report.seconds.skeleton;
  report.peakMemoryMb = PeakMemoryMb();
  if (options.report)
  {
    WriteTextFile(transaction.Stage(*options.report), ReportJson(report));
  }
  Finish(transaction, context);
  return result;
}

/** What was done to a skeleton when it was made and what is done to it now. */
BranchRequest
CombinedRequest(const BranchRequest & before, const BranchRequest & now)
{
  BranchRequest all = now;
  all.pruneLength = now.pruneLength ? now.pruneLength : before.pruneLength;
  all.pruneRadii = std::max(now.pruneRadii, before.pruneRadii);
  all.cutLoops = now.cutLoops || before.cutLoops;
  all.splitAtJunctions = now.splitAtJunctions || before.splitAtJunctions;
  all.realLoops = before.realLoops;
  return all;
}

} // namespace

CoreOptions
CoreOptionsOf(const SkeletonOptions & options)
{
  CoreOptions core;
  core.scan = options.input;
  core.reading = options.reading;
  core.resolution = options.resolution;
  core.edits = options.edits;
  core.further = options.further;
  core.lambdas = { options.stage.lambda };
  if (options.stage.tolerance)
  {
    core.tolerances = { *options.stage.tolerance };
  }
  core.refine = options.refine;
  core.skeleton = options.stage;
  core.skeletonOutput = options.output;
  core.skeletonTargets = options.targets;
  core.report = options.report;
  core.display = options.display;
  core.engine = options.engine;
  core.threads = options.threads;
  core.force = options.force;
  core.command = options.command;
  return core;
}

void
NameInFolder(SkeletonOptions & options, OutputTransaction & transaction)
{
  if (IsFolderOutput(options.output))
  {
    transaction.MakeDirectory(options.output);
    options.output = SkeletonTablesPath(options.output, options.input);
  }
}

SkeletonResult
RunSkeletonJob(const SkeletonOptions & options, const JobContext & context)
{
  return IsFinishedCore(options.input, options.reading, options.resolution) ? FromCore(options, context)
                                                                            : FromScan(options, context);
}

void
MeasureAgain(std::vector<SkeletonPart> &   parts,
             const BranchRequest &         now,
             CoreReport &                  report,
             const std::filesystem::path & name)
{
  RequireFittingProvenance(report.skeleton && report.labels.size() == parts.size(), name);
  CertifiedRequest request;
  request.skeleton = *report.skeleton;
  request.skeleton->branches = now;
  RequireLengthsOf(name, report.input.geometry.unit, request);
  BranchRequest cut = now;
  cut.realLoops = report.skeleton->branches.realLoops;
  report.skeleton->branches = CombinedRequest(report.skeleton->branches, now);
  const Vector3 & spacing = report.input.geometry.spacing;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    SkeletonPart & part = parts[i];
    LabelRecord &  record = report.labels[i];
    RequireFittingProvenance(part.label == record.label && part.component == record.component && record.skeleton, name);
    part.name = record.name;
    part.network = record.skeleton->network;
    RequireFittingProvenance(part.network.has_value() == !part.graph.labels.empty(), name);
    const auto & length = now.pruneLength;
    const auto   inMm = [&](const Lambda & of) {
      return LambdaInMillimetres(of, report.parameters.weights, spacing, record.box);
    };
    if (length || now.pruneRadii > 0 || now.cutLoops || now.splitAtJunctions)
    {
      part.lives.clear(); // they are those of other branches
      part.names.clear();
    }
    PruneBranches(part.graph, { length ? inMm(*length) : 0, now.pruneRadii });
    CertifiedSkeleton skeleton{ std::move(part), record.skeleton->topology, {}, std::move(record.skeleton->border) };
    CutAndMeasure(skeleton,
                  cut,
                  InMeanVoxels(report.skeleton->standOut, report.parameters.weights, spacing, record.box));
    part = TakeSkeleton(std::move(skeleton), record);
  }
}

SkeletonResult
RunMeasureJob(const MeasureJobOptions & options, const JobContext & given)
{
  const JobContext  context = ForwardOnly(given);
  SkeletonResult    result;
  OutputTransaction transaction(options.force, context.temporaries);
  const auto &      also = options.targets.also;
  if (std::find(also.begin(), also.end(), "ma") != also.end())
  {
    throw UsageError("--also ma: needs the medial surface; give it to 'voxelcore skeleton'");
  }
  if (IsFolderOutput(options.output))
  {
    throw UsageError(options.output.string() + ": give a file, .csv or .vtp");
  }
  ReportProgress(context.progress, "reading", 0);
  SkeletonModel model = ReadSkeletonVtp(options.skeleton);
  WarnOfRounding(options.skeleton, model.rounded, result.warnings);
  CoreReport & report = result.report;
  report = ParseProvenance(model.provenance, options.skeleton.string());
  SkeletonTargets targets = options.targets;
  targets.network = report.skeleton && report.skeleton->network;
  SkeletonFiles files(options.output, options.skeleton, targets, transaction);
  files.RequireUnit(report.input.geometry.unit);
  MeasureAgain(model.parts, options.branches, report, options.skeleton);
  for (std::size_t i = 0; i < model.parts.size(); ++i)
  {
    files.Add(report, i, std::move(model.parts[i]), {}, result.notes);
  }
  files.Finish(report, result.notes);
  Finish(transaction, context);
  return result;
}

std::vector<SkeletonPart>
SkeletonsOfMasks(std::vector<LabelShape>  masks,
                 const ImageGeometry &    geometry,
                 const SkeletonOptions &  making,
                 const std::string &      name,
                 const ProgressCallback & progress)
{
  CoreOptions core = CoreOptionsOf(making);
  core.scan = name;
  InputScan scan;
  scan.geometry = geometry;
  const auto                 surface = MakeSurfaceSource(core.refine, core.scan, core.reading, scan);
  std::vector<std::uint64_t> vertices;
  for (const LabelShape & mask : masks)
  {
    vertices.push_back(CountBoundaryVertices(mask.shape));
  }
  const LabelWork work = [&](std::size_t mask, const ProgressCallback & part) {
    if (vertices[mask] == 0)
    {
      return LabelOutcome();
    }
    std::vector<LabelShape> labels;
    labels.push_back(std::move(masks[mask]));
    EditedLabels edited = EditLabels(std::move(labels), geometry, making.edits, true, name);
    return ProcessLabel(std::move(edited.labels[0]), geometry, RequestOf(core, surface), part);
  };
  std::vector<SkeletonPart> parts(masks.size());
  for (std::size_t first = 0; first < masks.size();)
  {
    const bool        isPair = first + 1 < masks.size() && vertices[first] + vertices[first + 1] <= kGroupVertices;
    const std::size_t end = first + (isPair ? 2 : 1);
    const auto share = [&](std::size_t mask) { return static_cast<double>(mask) / static_cast<double>(masks.size()); };
    const auto part = PartOfProgress(progress, share(first), share(end));
    if (isPair)
    {
      auto outcomes = ProcessSideBySide(first, end, vertices, work, part);
      for (std::size_t mask = first; mask < end; ++mask)
      {
        parts[mask] = std::move(outcomes[mask - first].skeleton).value_or(SkeletonPart());
      }
    }
    else
    {
      parts[first] = work(first, part).skeleton.value_or(SkeletonPart());
    }
    first = end;
  }
  return parts;
}

} // namespace voxelcore
