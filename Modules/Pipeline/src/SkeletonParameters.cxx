#include "voxelcore/Error.h"
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

Lambda
LengthFrom(const ParameterValues & values, std::string_view name)
{
  try
  {
    return ParseLambda(ValueOf(values, CommandId::Skeleton, name));
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

BranchOptions
BranchOptionsFrom(const ParameterValues & values, CommandId command)
{
  BranchOptions options;
  if (values.contains("prune-branches"))
  {
    ParseBranchLimit(ValueOf(values, command, "prune-branches"), options);
  }
  options.cutLoops = values.contains("cut-loops");
  options.splitAtJunctions = values.contains("split-at-junctions");
  options.root = ParseRoot(ValueOf(values, command, "root"));
  if (values.contains("also"))
  {
    options.also = ParseAlso(ValueOf(values, command, "also"));
  }
  return options;
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
    throw UsageError("--root " + text + ": expected top, thickest, or a point in LPS mm such as 12.5,-30,101");
  }
  return root;
}

void
ParseBranchLimit(const std::string & text, BranchOptions & options)
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
    options.pruneLength = ParseLambda(text);
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
      throw UsageError("--also " + text + ": '" + ending + "' is not one of csv, swc, mrk.json, graphml, ma");
    }
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    {
      endings.push_back(ending);
    }
  }
  return endings;
}

SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId command = CommandId::Skeleton;
  SkeletonOptions     options;
  options.input = ValueOf(values, command, "scan");
  options.reading = ReadOptionsFrom(values, command);
  options.edits = ShapeEditsFrom(values, command);
  options.lambda = LengthFrom(values, "lambda");
  options.threshold = LengthFrom(values, "stand-out");
  options.smooth = LengthFrom(values, "smooth");
  if (values.contains("plates"))
  {
    options.plates = LengthFrom(values, "plates");
  }
  options.branches = BranchOptionsFrom(values, command);
  options.output = OutputFrom(values, command);
  const std::string engine = ValueOf(values, command, "engine");
  if (engine != "auto" && engine != "lattice" && engine != "tetgen")
  {
    throw UsageError("--engine " + engine + ": expected one of auto|lattice|tetgen");
  }
  options.engine = engine == "tetgen" ? Engine::TetGen : engine == "lattice" ? Engine::Lattice : Engine::Auto;
  options.force = values.contains("force");
  return options;
}

MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values)
{
  constexpr CommandId command = CommandId::Measure;
  return { ValueOf(values, command, "skeleton"),
           BranchOptionsFrom(values, command),
           OutputFrom(values, command),
           values.contains("force") };
}

} // namespace voxelcore
