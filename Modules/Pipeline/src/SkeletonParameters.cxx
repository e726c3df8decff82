#include "voxelcore/DidYouMean.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"
#include "voxelcore/Parameters.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace voxelcore
{

namespace
{

std::vector<std::string>
SplitAtCommas(const std::string & text)
{
  std::vector<std::string> parts(1);
  for (const char c : text)
  {
    if (c == ',')
    {
      parts.emplace_back();
    }
    else if (c != ' ')
    {
      parts.back() += c;
    }
  }
  return parts;
}

bool
ParseNumber(const std::string & text, double & value)
{
  const char * end = text.data() + text.size();
  const auto   result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end && std::isfinite(value) && !text.empty();
}

/** One length with its unit; a bare number is mm. */
Lambda
ParseLength(const std::string & text)
{
  Lambda length = ParseLambda(text);
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
  try
  {
    return ParseLength(ValueOf(values, command, name));
  }
  catch (const UsageError & error)
  {
    throw UsageError("--" + std::string(name) + ": " + error.what());
  }
}

std::filesystem::path
OutputFrom(const ParameterValues & values, CommandId command)
{
  const std::string output = ValueOf(values, command, "output");
  if (output.empty())
  {
    throw UsageError("--output '': expected a file name");
  }
  return output;
}

BranchRequest
BranchRequestFrom(const ParameterValues & values, CommandId command)
{
  BranchRequest options;
  if (const std::string limit = ValueOf(values, command, "prune-branches"); !limit.empty())
  {
    ParseBranchLimit(limit, options);
  }
  options.cutLoops = values.contains("cut-loops");
  options.splitAtJunctions = values.contains("split-at-junctions");
  options.root = ParseRoot(ValueOf(values, command, "root"));
  return options;
}

/** What StageFrom() reads. */
constexpr std::array<const char *, 8> kStageOptions{ "stand-out",      "plates",    "smooth",
                                                     "prune-branches", "cut-loops", "split-at-junctions",
                                                     "root",           "also" };

/** All but lambda. */
SkeletonRequest
StageFrom(const ParameterValues & values, CommandId command)
{
  SkeletonRequest stage;
  stage.standOut = LengthFrom(values, command, "stand-out");
  stage.smooth = LengthFrom(values, command, "smooth");
  if (values.contains("plates"))
  {
    stage.plates = LengthFrom(values, command, "plates");
  }
  stage.branches = BranchRequestFrom(values, command);
  return stage;
}

/** A finished core was read, edited and pruned already. */
void
RefuseScanOptions(const ParameterValues & values, const std::filesystem::path & input)
{
  for (const Parameter & parameter : Parameters())
  {
    const bool ofScans = BelongsTo(parameter, CommandId::Skeleton) &&
                         (BelongsTo(parameter, CommandId::Info) || parameter.name == "lambda" ||
                          parameter.name == "bumps" || parameter.name == "engine") &&
                         parameter.name != "scan" && parameter.name != "threads" && parameter.name != "progress" &&
                         parameter.name != "quiet";
    if (ofScans && values.contains(parameter.name))
    {
      throw UsageError(
        "--" + std::string(parameter.name) + ": needs a scan, but " + input.string() +
        " is a medial surface; give the option to 'voxelcore core', or the scan to 'voxelcore skeleton'");
    }
  }
}

} // namespace

RootChoice
ParseRoot(const std::string & text)
{
  if (text == "thickest")
  {
    return {};
  }
  if (text == "top")
  {
    return { RootChoice::Kind::Top, {} };
  }
  const auto parts = SplitAtCommas(text);
  RootChoice root{ RootChoice::Kind::Point, {} };
  bool       good = parts.size() == 3;
  for (std::size_t axis = 0; good && axis < 3; ++axis)
  {
    good = ParseNumber(parts[axis], root.point[axis]);
  }
  if (!good)
  {
    constexpr std::array<std::string_view, 2> words{ "top", "thickest" };
    throw UsageError("--root " + text + ": expected top, thickest, or a point in LPS mm such as 12.5,-30,101" +
                     DidYouMean(text, words));
  }
  return root;
}

void
ParseBranchLimit(const std::string & text, BranchRequest & options)
{
  if (!text.empty() && text.back() == 'r')
  {
    if (!ParseNumber(text.substr(0, text.size() - 1), options.pruneRadii) || options.pruneRadii < 0)
    {
      throw UsageError("--prune-branches " + text + ": expected a length such as 5mm or 8vox, or radii such as 1.5r");
    }
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

std::vector<std::string>
ParseAlso(const std::string & text)
{
  constexpr std::array<std::string_view, 5> known{ "csv", "swc", "mrk.json", "graphml", "ma" };
  std::vector<std::string>                  endings;
  for (const std::string & ending : SplitAtCommas(text))
  {
    if (std::find(known.begin(), known.end(), ending) == known.end())
    {
      throw UsageError("--also " + text + ": '" + ending + "' is not one of csv, swc, mrk.json, graphml, ma" +
                       DidYouMean(ending, known));
    }
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    {
      endings.push_back(ending);
    }
  }
  return endings;
}

std::string
RootText(const RootChoice & root)
{
  if (root.kind != RootChoice::Kind::Point)
  {
    return root.kind == RootChoice::Kind::Top ? "top" : "thickest";
  }
  std::string text;
  for (const double coordinate : root.point)
  {
    std::array<char, 64> digits{}; // as few as give the same number again
    const auto           end = std::to_chars(digits.data(), digits.data() + digits.size(), coordinate).ptr;
    text += (text.empty() ? "" : ",") + std::string(digits.data(), end);
  }
  return text;
}

SkeletonTargets
TargetsFrom(const ParameterValues & values, CommandId command)
{
  SkeletonTargets targets;
  if (values.contains("also"))
  {
    targets.also = ParseAlso(ValueOf(values, command, "also"));
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

SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId command = CommandId::Skeleton;
  SkeletonOptions     options;
  options.input = ValueOf(values, command, "scan");
  const auto resolutions = ResolutionsFrom(values, command);
  if (resolutions.size() > 1)
  {
    throw UsageError("--resolution " + ValueOf(values, command, "resolution") + ": expected one value");
  }
  if (!resolutions.empty())
  {
    options.resolution = resolutions.front();
  }
  if (options.input.extension() == ".vtp" && !options.resolution)
  {
    RefuseScanOptions(values, options.input);
  }
  options.reading = ReadOptionsFrom(values, command);
  options.edits = ShapeEditsFrom(values, command);
  options.stage = StageFrom(values, command);
  options.stage.lambda = LengthFrom(values, command, "lambda");
  options.targets = TargetsFrom(values, command);
  if (values.contains("bumps"))
  {
    const auto heights = ParseBumpHeights(ValueOf(values, command, "bumps"));
    if (heights.size() > 1)
    {
      throw UsageError("--bumps " + ValueOf(values, command, "bumps") + ": expected one value");
    }
    options.stage.bumps = heights.front().value > 0 ? std::optional(heights.front()) : std::nullopt;
  }
  options.output = OutputFrom(values, command);
  if (values.contains("report"))
  {
    options.report = ValueOf(values, command, "report");
    if (options.report->empty())
    {
      throw UsageError("--report '': expected a file name");
    }
  }
  if (values.contains("table"))
  {
    options.targets.table = ValueOf(values, command, "table");
  }
  options.display = DisplayTargetsFrom(values, command);
  const std::string engine = ChoiceOf(values, command, "engine");
  options.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  options.threads = ThreadsFrom(values, command);
  options.force = values.contains("force");
  return options;
}

MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId command = CommandId::Measure;
  return { ValueOf(values, command, "skeleton"),
           BranchRequestFrom(values, command),
           TargetsFrom(values, command),
           OutputFrom(values, command),
           values.contains("force") };
}

} // namespace voxelcore
