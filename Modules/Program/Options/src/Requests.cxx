#include "voxelcore/Options/Requests.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Jobs/ReadInput.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"
#include "voxelcore/Report/ReportTable.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <vector>

namespace voxelcore
{

namespace
{

/** `--lambda` and `--tolerance`, of which the latter makes the former a floor. */
void
ReadPruning(const ParameterReader & reader, std::vector<Lambda> & lambdas, std::vector<Tolerance> & tolerances)
{
  if (reader.IsGiven("tolerance"))
  {
    tolerances = ParseTolerances(reader.Text("tolerance"));
  }
  if (reader.IsGiven("lambda"))
  {
    lambdas = ParseLambdas(reader.Text("lambda"));
  }
  CompletePruning(lambdas, tolerances);
  if (!tolerances.empty() && lambdas.size() > 1)
  {
    throw UsageError("--lambda " + reader.Text("lambda") + ": expected one value, the floor of --tolerance");
  }
}

} // namespace

DisplayTargets
DisplayTargetsFrom(const ParameterValues & values)
{
  static constexpr auto rows = table::Joined(table::kDisplayRows, table::kTriangleRows);
  const ParameterReader reader(values, rows);
  DisplayTargets        targets;
  targets.scene = reader.FileIfGiven("scene");
  targets.html = reader.FileIfGiven("html");
  targets.htmlTriangles = static_cast<std::size_t>(reader.Whole("html-triangles", 1000, 20000000));
  return targets;
}

Outcome
OutcomeOf(const CoreResult & result)
{
  return { .warnings = result.warnings,
           .text = ReportTable(result.report) + (result.report.skeleton ? SkeletonTable(result.report) : ""),
           .notes = result.notes,
           .saysTime = true };
}

std::vector<std::int64_t>
ResolutionsFrom(const ParameterValues & values)
{
  const auto given = values.find("resolution");
  return given != values.end() ? ParseResolutions(given->second) : std::vector<std::int64_t>();
}

RefineOptions
RefineFrom(const ParameterReader & reader, const std::string & usual)
{
  RefineOptions     refine;
  const std::string surface = reader.Choice("refine");
  refine.surface = surface == "off" ? std::string() : surface == "auto" ? usual : surface;
  if (reader.IsGiven("grey") != reader.IsGiven("grey-range"))
  {
    throw UsageError("give --grey SCAN and --grey-range LO:HI together");
  }
  if (reader.IsGiven("grey"))
  {
    if (surface != "grey")
    {
      throw UsageError("--grey needs --refine grey");
    }
    refine.grey = reader.Text("grey");
    refine.greyRange = reader.Range("grey-range");
  }
  return refine;
}

Engine
EngineFrom(const ParameterReader & reader)
{
  const std::string engine = reader.Choice("engine");
  return engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
}

CoreOptions
MapOptionsFrom(const ParameterReader & reader)
{
  CoreOptions core;
  ReadScanFields(reader, core);
  core.tolerances = ParseTolerances(reader.Text("tolerance"));
  if (core.tolerances.size() > 1)
  {
    reader.ThrowUsageError("tolerance", "one value");
  }
  CompletePruning(core.lambdas, core.tolerances);
  core.refine = RefineFrom(reader);
  core.engine = EngineFrom(reader);
  core.threads = ThreadsFrom(reader.Values());
  core.further = FurtherOptions(reader);
  return core;
}

void
ReadMapFiles(const ParameterReader & reader, CoreOptions & core)
{
  core.scan = reader.Text("scan");
  core.report = reader.FileIfGiven("report");
  core.force = reader.IsSet("force");
}

CoreOptions
CoreOptionsWithoutFiles(const ParameterValues & values)
{
  const ParameterReader reader(values, kCoreCommand);
  CoreOptions           options;
  ReadScanFields(reader, options);
  ReadPruning(reader, options.lambdas, options.tolerances);
  options.refine = RefineFrom(reader, RefinesUsually(options.tolerances) ? "labels" : "");
  VisitModelFields(options.model, FieldReader(reader));
  options.engine = EngineFrom(reader);
  options.crossCheck = reader.IsSet("cross-check");
  options.threads = ThreadsFrom(values);
  options.further = FurtherOptions(reader);
  return options;
}

CoreOptions
CoreOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kCoreCommand);
  CoreOptions           options = CoreOptionsWithoutFiles(values);
  options.scan = reader.Text("scan");
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.table = reader.FileIfGiven("table");
  options.display = DisplayTargetsFrom(values);
  options.skeleton = CoreSkeletonFrom(values);
  if (options.skeleton)
  {
    // Where nothing is said it is the one that `skeleton` gives.
    options.skeleton->refined = !options.refine.surface.empty() && reader.Choice("refine") != "auto";
  }
  options.skeletonTargets = TargetsFrom(values, kCoreCommand);
  options.skeletonOutput = options.skeleton ? SkeletonBesideCore(options.output) : std::filesystem::path();
  options.join = reader.Text("join");
  if (options.crossCheck && !options.join.empty())
  {
    throw UsageError("give only one of --cross-check and --join");
  }
  if (reader.IsGiven("memory"))
  {
    options.memory = ParseMemory(reader.Text("memory"));
  }
  options.force = reader.IsSet("force");
  return options;
}

std::optional<BlockOptions>
BlockOptionsFrom(const ParameterValues & values)
{
  constexpr std::int64_t most = std::int64_t{ 1 } << 20U;
  const ParameterReader  reader(values, kCoreCommand);
  const bool             isGrid = reader.IsGiven("block-size");
  if (isGrid && reader.IsGiven("blocks"))
  {
    throw UsageError("give only one of --blocks and --block-size");
  }
  if ((isGrid || reader.IsGiven("blocks")) != reader.IsGiven("block"))
  {
    throw UsageError("give --blocks N and --block K together, or --block-size N and --block K");
  }
  if (!reader.IsGiven("block"))
  {
    return std::nullopt;
  }
  if (ResolutionsFrom(values).size() > 1)
  {
    throw UsageError("--resolution " + reader.Text("resolution") + ": expected one value with --blocks");
  }
  if (reader.IsGiven("join"))
  {
    throw UsageError("give only one of --block and --join");
  }
  BlockOptions options;
  options.core = CoreOptionsFrom(values);
  if (const std::string refine = reader.Choice("refine"); refine != "auto" && refine != "off")
  {
    throw UsageError("--refine " + refine + " does not work with --block: blocks are exact; give it with --join");
  }
  options.core.refine = RefineOptions();
  if (isGrid)
  {
    options.side = static_cast<std::int32_t>(reader.Whole("block-size", 8, most));
  }
  else
  {
    options.blocks = static_cast<std::size_t>(reader.Whole("blocks", 1, most));
  }
  options.block = static_cast<std::size_t>(reader.Whole("block", 1, most));
  return options;
}

InfoOptions
InfoOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kInfoCommand);
  InfoOptions           options;
  options.scan = reader.Text("scan");
  ReadScanFields(reader, options);
  ReadPruning(ParameterReader({}, kCoreCommand), options.coreLambdas, options.coreTolerances);
  options.coreRefined = RefinesUsually(options.coreTolerances);
  options.skeletonLambdas = ParseLambdas(ValueOf({}, kSkeletonCommand, "lambda"));
  options.skeletonBorder = ParseBorder(ValueOf({}, kSkeletonCommand, "border"));
  return options;
}

VerifyOptions
VerifyOptionsFrom(const ParameterValues & values)
{
  return { ValueOf(values, kVerifyCommand, "scan"), ValueOf(values, kVerifyCommand, "core") };
}

PruneOptions
PruneOptionsWithoutFiles(const ParameterValues & values)
{
  const ParameterReader reader(values, kPruneCommand);
  PruneOptions          options;
  if (reader.IsGiven("tolerance") == reader.IsGiven("lambda"))
  {
    throw UsageError("give either --lambda or --tolerance, such as --lambda 1.5mm or --tolerance 1.2diag");
  }
  if (reader.IsGiven("tolerance"))
  {
    options.tolerances = ParseTolerances(reader.Text("tolerance"));
  }
  else
  {
    options.lambdas = ParseLambdas(reader.Text("lambda"));
  }
  VisitModelFields(options.model, FieldReader(reader));
  options.threads = ThreadsFrom(values);
  return options;
}

PruneOptions
PruneOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kPruneCommand);
  PruneOptions          options = PruneOptionsWithoutFiles(values);
  options.core = reader.Text("core");
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.force = reader.IsSet("force");
  return options;
}

ReconstructOptions
ReconstructOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kReconstructCommand);
  ReconstructOptions    options;
  options.core = reader.Text("core");
  for (auto [name, path] : { std::pair("like", &options.like), std::pair("scan", &options.scan) })
  {
    if (reader.IsGiven(name))
    {
      *path = reader.Text(name);
    }
  }
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.force = reader.IsSet("force");
  return options;
}

} // namespace voxelcore
