#include "FieldReader.h"
#include "ParameterReader.h"
#include "SkeletonValues.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Options/Parameters.h"
#include "voxelcore/Report/SkeletonTexts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{

namespace
{

/** One length with its unit; a bare number is mm. */
Lambda
ParseLength(const std::string & text)
{
  Lambda length = ParseLambda(text, "length");
  if (length.value == 0)
  {
    length.text = "0";
  }
  else if (length.unit == Lambda::Unit::Millimetre && !length.text.ends_with("mm"))
  {
    length.text += "mm";
  }
  return length;
}

Lambda
LengthFrom(const ParameterValues & values, CommandId command, std::string_view name)
{
  return ParameterReader(values, command).Parsed(name, ParseLength);
}

/** Fills pruneLength or pruneRadii from "5mm", "8vox", "2%" or "1.5r". */
void
ParseBranchLimit(const std::string & text, BranchRequest & options)
{
  if (!text.empty() && text.back() == 'r')
  {
    const auto radii = ParseReal(std::string_view(text).substr(0, text.size() - 1));
    if (!radii || !(*radii >= 0 && std::isfinite(*radii)))
    {
      throw UsageError("--prune-branches " + text + ": expected a length such as 5mm or 8vox, or radii such as 1.5r");
    }
    options.pruneRadii = *radii;
    return;
  }
  try
  {
    options.pruneLength = ParseLength(text);
  }
  catch (const UsageError & error)
  {
    throw UsageError("--prune-branches: " + std::string(error.what()) + "; or radii such as 1.5r");
  }
}

BranchRequest
PruningFrom(const ParameterValues & values, CommandId command)
{
  BranchRequest options;
  if (const std::string limit = ValueOf(values, command, "prune-branches"); !limit.empty())
  {
    ParseBranchLimit(limit, options);
  }
  return options;
}

BranchRequest
BranchRequestFrom(const ParameterValues & values, CommandId command)
{
  BranchRequest options = PruningFrom(values, command);
  options.cutLoops = values.contains("cut-loops");
  options.splitAtJunctions = values.contains("split-at-junctions");
  options.root = ParseRoot(ValueOf(values, command, "root"));
  return options;
}

/** Curves cannot go around cavities: these are filled where nothing else is asked for. */
void
ReadCavities(const ParameterReader & reader, ShapeEditOptions & edits)
{
  const std::string cavities = reader.Text("cavities");
  if (cavities == "keep" && edits.fillCavities)
  {
    throw UsageError("give only one of --fill-cavities and --cavities keep");
  }
  edits.fillUnasked = cavities == "fill" && !edits.fillCavities;
  edits.fillCavities = edits.fillCavities || edits.fillUnasked;
}

/** What StageFrom() reads. */
constexpr std::array<const char *, 8> kStageOptions{ "stand-out",      "plates",    "smooth",
                                                     "prune-branches", "cut-loops", "split-at-junctions",
                                                     "root",           "also" };

/** All but lambda. */
SkeletonRequest
StageFrom(const ParameterValues & values, CommandId command)
{
  SkeletonRequest stage = BurningFrom(values, command);
  if (values.contains("plates"))
  {
    stage.plates = LengthFrom(values, command, "plates");
  }
  stage.branches = BranchRequestFrom(values, command);
  return stage;
}

} // namespace

void
RefuseScanOptions(const ParameterValues & values, const std::filesystem::path & input, CommandId command)
{
  for (const Parameter & parameter : Parameters())
  {
    const bool ofScans =
      BelongsTo(parameter, command) &&
      (BelongsTo(parameter, CommandId::Info) || parameter.name == "lambda" || parameter.name == "tolerance" ||
       parameter.name == "engine" || parameter.name == "refine" || parameter.name == "grey" ||
       parameter.name == "grey-range" || parameter.name == "border" || parameter.name == "cavities") &&
      parameter.name != "scan" && parameter.name != "threads" && parameter.name != "progress" &&
      parameter.name != "quiet";
    if (ofScans && values.contains(parameter.name))
    {
      throw UsageError("--" + std::string(parameter.name) + ": needs a scan, but " + input.string() +
                       " is a medial surface; give the option to 'voxelcore core', or the scan to 'voxelcore " +
                       std::string(ranges::find(Commands(), command, &Command::id)->name) + "'");
    }
  }
}

BorderEnds
BorderFrom(const ParameterReader & reader)
{
  return ParseBorder(reader.Choice("border"));
}

SkeletonRequest
BurningFrom(const ParameterValues & values, CommandId command)
{
  SkeletonRequest stage;
  stage.standOut = LengthFrom(values, command, "stand-out");
  stage.smooth = LengthFrom(values, command, "smooth");
  stage.branches = PruningFrom(values, command);
  return stage;
}

SkeletonTargets
TargetsFrom(const ParameterValues & values, CommandId command)
{
  SkeletonTargets targets;
  targets.units = values.contains("units");
  if (values.contains("also"))
  {
    targets.also = ParseAlso(ValueOf(values, command, "also"));
  }
  if (values.contains("sections"))
  {
    const std::string apart = ValueOf(values, command, "sections");
    targets.sections = apart == "all" ? Lambda() : LengthFrom(values, command, "sections");
    if (apart != "all" && !(targets.sections->value > 0))
    {
      throw UsageError("--sections " + apart + ": expected all, or a distance above 0 such as 1mm or 2vox");
    }
  }
  const ParameterReader reader(values, command);
  if (command == CommandId::Skeleton)
  {
    targets.branchMap = reader.FileIfGiven("branch-map");
    targets.orderMap = reader.FileIfGiven("order-map");
    targets.skeletonMap = reader.FileIfGiven("skeleton-map");
  }
  if (command != CommandId::Core)
  {
    targets.centerlines = reader.FileIfGiven("centerlines");
    targets.flow = reader.FileIfGiven("flow");
  }
  if (values.contains("soma"))
  {
    const std::string text = reader.Text("soma");
    const auto        places = text == "auto" ? std::vector<Vector3>() : reader.Parsed("soma", ParsePlaces);
    if (places.size() > 1)
    {
      reader.ThrowUsageError("soma", "auto, or one point, X,Y,Z in LPS mm");
    }
    targets.soma = { places.empty() ? std::optional<Vector3>() : places[0] };
    if (ranges::find(targets.also, "swc") == targets.also.end())
    {
      throw UsageError("--soma: needs --also swc");
    }
  }
  if (values.contains("inlet"))
  {
    targets.inlets = reader.Parsed("inlet", ParsePlaces);
    if (!targets.centerlines && !targets.flow)
    {
      throw UsageError("--inlet: needs --centerlines or --flow");
    }
  }
  return targets;
}

std::optional<SkeletonRequest>
CoreSkeletonFrom(const ParameterValues & values)
{
  if (values.contains("with-skeleton"))
  {
    SkeletonRequest stage = StageFrom(values, CommandId::Core);
    stage.lambda = ParseLength("0");
    const auto also = TargetsFrom(values, CommandId::Core).also;
    if (std::find(also.begin(), also.end(), "ma") != also.end())
    {
      throw UsageError("--also ma: use -o OUT.ma, or 'voxelcore skeleton' for a file of radii, too");
    }
    return stage;
  }
  for (const char * name : kStageOptions)
  {
    if (values.contains(name))
    {
      throw UsageError("--" + std::string(name) + ": needs --with-skeleton");
    }
  }
  return std::nullopt;
}

SkeletonRequest
SkeletonRequestFrom(const ParameterValues & values)
{
  SkeletonRequest stage = StageFrom(values, CommandId::Skeleton);
  stage.border = BorderFrom(ParameterReader(values, CommandId::Skeleton));
  return stage;
}

SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId   command = CommandId::Skeleton;
  const ParameterReader reader(values, command);
  SkeletonOptions       options;
  options.input = reader.Text("scan");
  if (options.input.extension() == ".vtp" && !reader.FirstResolution())
  {
    RefuseScanOptions(values, options.input, command);
  }
  ReadScanFields(reader, options);
  ReadCavities(reader, options.edits);
  options.further = FurtherOptions(reader);
  options.stage = SkeletonRequestFrom(values);
  options.stage.lambda = LengthFrom(values, command, "lambda");
  options.refine = RefineFrom(reader);
  options.stage.refined = !options.refine.surface.empty();
  options.targets = TargetsFrom(values, command);
  options.stage.network = values.contains("network");
  options.targets.network = options.stage.network;
  if (options.stage.network)
  {
    for (const char * other : { "binary", "threshold", "split-components", "plates" })
    {
      if (values.contains(other))
      {
        throw UsageError("--network takes the labels as one body and gives curves; it does not go with --" +
                         std::string(other));
      }
    }
  }
  if (values.contains("tolerance"))
  {
    const auto heights = ParseTolerances(ValueOf(values, command, "tolerance"));
    if (heights.size() > 1)
    {
      throw UsageError("--tolerance " + ValueOf(values, command, "tolerance") + ": expected one value");
    }
    options.stage.tolerance = heights.front().value > 0 ? std::optional(heights.front()) : std::nullopt;
  }
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.targets.table = reader.FileIfGiven("table");
  options.display = DisplayTargetsFrom(values, command);
  const std::string engine = ChoiceOf(values, command, "engine");
  options.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  options.threads = ThreadsFrom(values, command);
  options.force = values.contains("force");
  return options;
}

std::optional<ProbabilityOptions>
ProbabilityOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, CommandId::Skeleton);
  if (!reader.IsSet("probability"))
  {
    for (const char * option : { "thresholds", "persistence" })
    {
      if (reader.IsGiven(option))
      {
        throw UsageError("--" + std::string(option) + ": needs --probability");
      }
    }
    return std::nullopt;
  }
  for (const char * other : { "labels",
                              "binary",
                              "threshold",
                              "network",
                              "split-components",
                              "split-at-junctions",
                              "resolution",
                              "sections" })
  {
    if (reader.IsGiven(other))
    {
      throw UsageError("--probability takes a map at --thresholds; leave out --" + std::string(other));
    }
  }
  ProbabilityOptions options{ SkeletonOptionsFrom(values), ParseThresholds(reader.Text("thresholds")), 0 };
  const auto         persistence = ParseReal(reader.Text("persistence"));
  if (!persistence || !(*persistence >= 0 && *persistence <= 1))
  {
    reader.ThrowUsageError("persistence", "a number from 0 to 1");
  }
  options.persistence = *persistence;
  return options;
}

BranchRequest
MeasureBranchesFrom(const ParameterValues & values)
{
  return BranchRequestFrom(values, CommandId::Measure);
}

MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId command = CommandId::Measure;
  return { ValueOf(values, command, "skeleton"),
           BranchRequestFrom(values, command),
           TargetsFrom(values, command),
           ParameterReader(values, command).File("output"),
           values.contains("force") };
}

} // namespace voxelcore
