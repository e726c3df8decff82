#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Options/FieldReader.h"
#include "voxelcore/Options/SharedRows.h"
#include "voxelcore/Options/SharedValues.h"
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
LengthFrom(const ParameterReader & reader, std::string_view name)
{
  return reader.Parsed(name, ParseLength);
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
PruningFrom(const ParameterReader & reader)
{
  BranchRequest options;
  if (const std::string limit = reader.Text("prune-branches"); !limit.empty())
  {
    ParseBranchLimit(limit, options);
  }
  return options;
}

BranchRequest
BranchRequestFrom(const ParameterReader & reader)
{
  BranchRequest options = PruningFrom(reader);
  options.cutLoops = reader.IsGiven("cut-loops");
  options.splitAtJunctions = reader.IsGiven("split-at-junctions");
  options.root = ParseRoot(reader.Text("root"));
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
StageFrom(const ParameterReader & reader)
{
  SkeletonRequest stage = BurningFrom(reader);
  if (reader.IsGiven("plates"))
  {
    stage.plates = LengthFrom(reader, "plates");
  }
  stage.branches = BranchRequestFrom(reader);
  return stage;
}

} // namespace

void
RefuseScanOptions(const ParameterValues & values, const std::filesystem::path & input, const Command & command)
{
  constexpr std::array<std::string_view, 7> others{ "lambda", "tolerance",  "engine", "refine",
                                                    "grey",   "grey-range", "border" };
  for (const Parameter & parameter : command.rows)
  {
    const bool ofScans = (FindParameter(kInfoCommand.rows, parameter.name) != nullptr ||
                          ranges::find(others, parameter.name) != others.end()) &&
                         parameter.name != "scan" && FindParameter(table::kRunRows, parameter.name) == nullptr;
    if (ofScans && values.contains(parameter.name))
    {
      throw UsageError("--" + std::string(parameter.name) + ": needs a scan, but " + input.string() +
                       " is a medial surface; give the option to 'voxelcore core', or the scan to 'voxelcore " +
                       std::string(command.name) + "'");
    }
  }
}

BorderEnds
BorderFrom(const ParameterReader & reader)
{
  return ParseBorder(reader.Choice("border"));
}

SkeletonRequest
BurningFrom(const ParameterReader & reader)
{
  SkeletonRequest stage;
  stage.standOut = LengthFrom(reader, "stand-out");
  stage.smooth = LengthFrom(reader, "smooth");
  stage.branches = PruningFrom(reader);
  return stage;
}

SkeletonTargets
TargetsFrom(const ParameterValues & values, const Command & command)
{
  const ParameterReader reader(values, command);
  SkeletonTargets       targets;
  targets.units = values.contains("units");
  if (values.contains("also"))
  {
    targets.also = ParseAlso(reader.Text("also"));
  }
  if (values.contains("sections"))
  {
    const std::string apart = reader.Text("sections");
    targets.sections = apart == "all" ? Lambda() : LengthFrom(reader, "sections");
    if (apart != "all" && !(targets.sections->value > 0))
    {
      throw UsageError("--sections " + apart + ": expected all, or a distance above 0 such as 1mm or 2vox");
    }
  }
  targets.branchMap = reader.FileIfGiven("branch-map");
  targets.orderMap = reader.FileIfGiven("order-map");
  targets.skeletonMap = reader.FileIfGiven("skeleton-map");
  targets.centerlines = reader.FileIfGiven("centerlines");
  targets.flow = reader.FileIfGiven("flow");
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
    SkeletonRequest stage = StageFrom(ParameterReader(values, kCoreCommand));
    stage.lambda = ParseLength("0");
    const auto also = TargetsFrom(values, kCoreCommand).also;
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
  const ParameterReader reader(values, kSkeletonCommand);
  SkeletonRequest       stage = StageFrom(reader);
  stage.border = BorderFrom(reader);
  return stage;
}

SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kSkeletonCommand);
  SkeletonOptions       options;
  options.input = reader.Text("scan");
  if (options.input.extension() == ".vtp" && !reader.FirstResolution())
  {
    RefuseScanOptions(values, options.input, kSkeletonCommand);
  }
  ReadScanFields(reader, options);
  ReadCavities(reader, options.edits);
  options.further = FurtherOptions(reader);
  options.stage = SkeletonRequestFrom(values);
  options.stage.lambda = LengthFrom(reader, "lambda");
  options.refine = RefineFrom(reader);
  options.stage.refined = !options.refine.surface.empty();
  options.targets = TargetsFrom(values, kSkeletonCommand);
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
    const auto heights = ParseTolerances(reader.Text("tolerance"));
    if (heights.size() > 1)
    {
      throw UsageError("--tolerance " + reader.Text("tolerance") + ": expected one value");
    }
    options.stage.tolerance = heights.front().value > 0 ? std::optional(heights.front()) : std::nullopt;
  }
  options.output = reader.File("output");
  options.report = reader.FileIfGiven("report");
  options.targets.table = reader.FileIfGiven("table");
  options.display = DisplayTargetsFrom(values);
  options.engine = EngineFrom(reader);
  options.threads = ThreadsFrom(values);
  options.force = values.contains("force");
  return options;
}

BranchRequest
MeasureBranchesFrom(const ParameterValues & values)
{
  return BranchRequestFrom(ParameterReader(values, kMeasureCommand));
}

MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values)
{
  const ParameterReader reader(values, kMeasureCommand);
  return { reader.Text("skeleton"),
           BranchRequestFrom(reader),
           TargetsFrom(values, kMeasureCommand),
           reader.File("output"),
           reader.IsGiven("force") };
}

} // namespace voxelcore
