#include "Commands.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Cohort/Admission.h"
#include "voxelcore/Cohort/BatchJob.h"
#include "voxelcore/Cohort/Thumbnail.h"
#include "voxelcore/Report/ReportTable.h"

namespace voxelcore
{
namespace
{

void
PrintCore(const Run & run, const CoreResult & result)
{
  run.Warn(result.warnings);
  run.Print(ReportTable(result.report));
  if (result.report.skeleton)
  {
    run.Print(SkeletonTable(result.report));
  }
  run.PrintNotes(result.notes);
}

int
RunStudy(const Run & run, const CoreOptions & options, const std::vector<std::int64_t> & resolutions)
{
  const StudyResult result = RunStudyJob(options, resolutions, run.context);
  for (std::size_t i = 0; i < resolutions.size(); ++i)
  {
    run.Print("resolution " + std::to_string(resolutions[i]) + "\n");
    PrintCore(run, result.runs[i]);
  }
  return kDone;
}

int
RunVoxelize(const Run & run)
{
  const VoxelizeResult result = RunVoxelizeJob(VoxelizeOptionsFrom(run.line.values), run.context);
  run.Warn(result.warnings);
  for (const std::string & line : result.lines)
  {
    run.Print(line + "\n");
  }
  return kDone;
}

int
RunCore(const Run & run)
{
  if (const auto block = BlockOptionsFrom(run.line.values))
  {
    const BlockResult result = RunBlockJob(*block, run.context);
    run.Warn(result.warnings);
    run.Print(BlockText(result, *block));
    return kDone;
  }
  CoreOptions options = CoreOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  if (const auto resolutions = ResolutionsFrom(run.line.values, CommandId::Core); resolutions.size() > 1)
  {
    return RunStudy(run, options, resolutions);
  }
  const CoreResult result = RunCoreJob(options, run.context);
  if (run.context.admit)
  {
    PaintCase(result.report, run.context.temporaries); // for the batch's page
  }
  PrintCore(run, result);
  return kDone;
}

int
RunBatch(const Run & run)
{
  const BatchOptions options = BatchOptionsFrom(run.line.values);
  if (run.line.values.contains("list"))
  {
    run.Print(CaseList(options));
    return kDone;
  }
  const BatchResult result = RunBatchJob(options, run.context);
  run.Print(BatchText(result));
  if (!result.failed.empty())
  {
    run.console.PrintError(std::to_string(result.failed.size()) + " of " + std::to_string(result.cases) +
                           " cases failed, the first, " + result.failed.front().id + ": " +
                           result.failed.front().reason);
    return kFailed;
  }
  return kDone;
}

int
RunPrune(const Run & run)
{
  PruneOptions options = PruneOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  const PruneResult result = RunPruneJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(ReportTable(result.report));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunInfo(const Run & run)
{
  const ScanInfo info = RunInfoJob(InfoOptionsFrom(run.line.values), run.context);
  run.Warn(info.warnings);
  run.Print(run.line.values.contains("json") ? InfoJson(info) : InfoText(info));
  return kDone;
}

int
RunVerify(const Run & run)
{
  const VerifyOptions options = VerifyOptionsFrom(run.line.values);
  const VerifyResult  result = RunVerifyJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(VerifyText(result));
  if (!result.passed)
  {
    throw CertificateError(options.core.string() + ": does not agree with " + options.scan.string());
  }
  return kDone;
}

int
RunReconstruct(const Run & run)
{
  ReconstructOptions options = ReconstructOptionsFrom(run.line.values);
  options.command = run.line.whole;
  const ReconstructResult result = RunReconstructJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(ReconstructText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunPhantom(const Run & run)
{
  if (ValueOf(run.line.values, CommandId::Phantom, "kind") == "list")
  {
    run.Print(PhantomList());
    return kDone;
  }
  run.Print(RunPhantomJob(PhantomOptionsFrom(run.line.values), run.context) + "\n");
  return kDone;
}

int
PrintSkeleton(const Run & run, const SkeletonResult & result)
{
  run.Warn(result.warnings);
  run.Print(SkeletonTable(result.report));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunSkeleton(const Run & run)
{
  if (auto map = ProbabilityOptionsFrom(run.line.values))
  {
    map->making.threads = run.threads;
    map->making.command = run.line.whole;
    const ProbabilityResult result = RunProbabilityJob(*map, run.context);
    run.Print(ThresholdsText(result));
    return PrintSkeleton(run, result);
  }
  SkeletonOptions options = SkeletonOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  return PrintSkeleton(run, RunSkeletonJob(options, run.context));
}

int
RunRoots(const Run & run)
{
  RootsOptions options = RootsOptionsFrom(run.line.values);
  options.threads = run.threads;
  options.command = run.line.whole;
  const RootsResult result = RunRootsJob(options, run.context);
  if (run.context.admit)
  {
    PaintCase(result.report, run.context.temporaries); // for the batch's page
  }
  run.Warn(result.warnings);
  run.Print(RootsText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunThickness(const Run & run)
{
  ThicknessOptions options = ThicknessOptionsFrom(run.line.values);
  options.core.threads = run.threads;
  options.core.command = run.line.whole;
  const ThicknessResult result = RunThicknessJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(ThicknessText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunSheets(const Run & run)
{
  SheetsOptions options = SheetsOptionsFrom(run.line.values);
  options.core.threads = run.threads;
  options.core.command = run.line.whole;
  const SheetsResult result = RunSheetsJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(SheetsText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunStraighten(const Run & run)
{
  const StraightenResult result = RunStraightenJob(StraightenOptionsFrom(run.line.values), run.context);
  run.Warn(result.warnings);
  run.Print(StraightenText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunCompare(const Run & run)
{
  CompareOptions options = CompareOptionsFrom(run.line.values);
  options.command = run.line.whole;
  const CompareResult result = RunCompareJob(options, run.context);
  run.Warn(result.warnings);
  run.Print(CompareText(result));
  run.PrintNotes(result.notes);
  return kDone;
}

int
RunRender(const Run & run)
{
  const RenderResult result = RunRenderJob(RenderOptionsFrom(run.line.values), run.context);
  run.Warn(result.warnings);
  run.PrintNotes(result.notes);
  return kDone;
}

} // namespace

int
RunCommand(const Run & run)
{
  switch (*run.line.command)
  {
    case CommandId::Core:
      return RunCore(run);
    case CommandId::Info:
      return RunInfo(run);
    case CommandId::Verify:
      return RunVerify(run);
    case CommandId::Prune:
      return RunPrune(run);
    case CommandId::Batch:
      return RunBatch(run);
    case CommandId::Reconstruct:
      return RunReconstruct(run);
    case CommandId::Phantom:
      return RunPhantom(run);
    case CommandId::Voxelize:
      return RunVoxelize(run);
    case CommandId::Skeleton:
      return RunSkeleton(run);
    case CommandId::Roots:
      return RunRoots(run);
    case CommandId::Thickness:
      return RunThickness(run);
    case CommandId::Sheets:
      return RunSheets(run);
    case CommandId::Straighten:
      return RunStraighten(run);
    case CommandId::Compare:
      return RunCompare(run);
    case CommandId::Render:
      return RunRender(run);
    case CommandId::Measure:
      return PrintSkeleton(run, RunMeasureJob(MeasureOptionsFrom(run.line.values), run.context));
  }
  return kUsage;
}

} // namespace voxelcore
