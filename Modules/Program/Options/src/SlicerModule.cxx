#include "voxelcore/Options/SlicerModule.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

namespace voxelcore
{

namespace
{

struct Description
{
  CommandId        command;
  std::string_view title;
  std::string_view text;
  std::string_view outputName;
  std::string_view outputLabel;
};

constexpr std::array<Description, 2> kDescriptions{ {
  { CommandId::Core,
    "VoxelCore Medial Surface",
    "Medial surface of each label of a segmented volume, as a voxel core (Yan, Letscher and Ju 2018): with the "
    "topology "
    "of the segmentation, and the local radius at every point.",
    "MedialSurface",
    "Medial surface" },
  { CommandId::Skeleton,
    "VoxelCore Curve Skeleton",
    "Curve skeleton of each label of a segmented volume, with the components and cycles of the segmentation and the "
    "local "
    "radius at every point.",
    "CurveSkeleton",
    "Curve skeleton" },
} };

const Description &
Describe(CommandId command)
{
  for (const Description & one : kDescriptions)
  {
    if (one.command == command)
    {
      return one;
    }
  }
  throw std::logic_error("no module of Slicer for this command");
}

/** What only a person at a terminal has use for. */
constexpr std::array<std::string_view, 11> kTerminalOptions{ "progress", "quiet",          "force",     "report",
                                                             "also",     "memory",         "scene",     "html",
                                                             "json",     "html-triangles", "resolution" };

/** The parameters in the first, open group; in the table's order. */
constexpr std::array<std::string_view, 9> kMain{ "scan",   "output",    "table",         "labels", "tolerance",
                                                 "lambda", "stand-out", "fill-cavities", "binary" };

template <typename TNames>
bool
IsIn(const TNames & names, std::string_view name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool
IsShown(const Parameter & parameter, CommandId command)
{
  if (!BelongsTo(parameter, command) || IsIn(kTerminalOptions, parameter.name))
  {
    return false;
  }
  // The branches of `core --with-skeleton` have a module of their own: what needs that option is left to it.
  const bool ofBranches = parameter.name == "with-skeleton" || parameter.name == "stand-out" ||
                          parameter.name == "plates" || parameter.name == "smooth" ||
                          parameter.name == "prune-branches" ||
                          (BelongsTo(parameter, CommandId::Measure) && BelongsTo(parameter, CommandId::Skeleton) &&
                           !BelongsTo(parameter, CommandId::Info) && parameter.name != "output");
  return command != CommandId::Core || !ofBranches;
}

/** "cut-loops" -> "CutLoops" */
std::string
NameOf(const Parameter & parameter, CommandId command)
{
  if (parameter.name == "scan")
  {
    return "LabelVolume";
  }
  if (parameter.name == "output")
  {
    return std::string(Describe(command).outputName);
  }
  std::string name;
  bool        upper = true;
  for (const char c : parameter.name)
  {
    if (c == '-')
    {
      upper = true;
      continue;
    }
    name += upper ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    upper = false;
  }
  return name;
}

/** "cut-loops" -> "Cut loops" */
std::string
LabelOf(const Parameter & parameter, CommandId command)
{
  if (parameter.name == "scan")
  {
    return "Label volume";
  }
  if (parameter.name == "output")
  {
    return std::string(Describe(command).outputLabel);
  }
  std::string label(parameter.name);
  std::replace(label.begin(), label.end(), '-', ' ');
  label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
  return label;
}

std::string
LongFlag(const Parameter & parameter)
{
  const auto dashes = parameter.flags.rfind("--");
  return std::string(parameter.flags.substr(dashes));
}

std::string
Escaped(std::string_view text)
{
  std::string result;
  for (const char c : text)
  {
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  }
  return result;
}

std::string
Element(std::string_view tag, std::string_view text)
{
  return "      <" + std::string(tag) + ">" + Escaped(text) + "</" + std::string(tag) + ">\n";
}

/** The tag of a parameter's type. A number without a default is a text field, which can be left empty. */
std::string
TagOf(const Parameter & parameter)
{
  switch (parameter.kind)
  {
    case ParameterKind::Flag:
      return "boolean";
    case ParameterKind::Choice:
      return "string-enumeration";
    case ParameterKind::Integer:
      return parameter.defaultValue.empty() ? "string" : "integer";
    case ParameterKind::Real:
      return parameter.defaultValue.empty() ? "string" : "double";
    default:
      return "string";
  }
}

std::string
ParameterXml(const Parameter & parameter, CommandId command)
{
  std::string tag = TagOf(parameter);
  std::string attributes;
  std::string rest;
  if (parameter.name == "scan")
  {
    tag = "image";
    attributes = " type=\"label\"";
    rest = Element("channel", "input") + Element("index", "0");
  }
  else if (parameter.name == "output")
  {
    tag = "geometry";
    attributes = " reference=\"LabelVolume\" fileExtensions=\".vtp\"";
    rest = Element("channel", "output") + Element("index", "1");
  }
  else if (parameter.name == "table")
  {
    tag = "table";
    attributes = " fileExtensions=\".csv\"";
    rest = Element("channel", "output") + Element("longflag", LongFlag(parameter));
  }
  else
  {
    rest = Element("longflag", LongFlag(parameter));
    rest += Element("default", parameter.kind == ParameterKind::Flag ? "false" : parameter.defaultValue);
    for (std::string_view words = parameter.kind == ParameterKind::Choice ? parameter.placeholder : std::string_view();
         !words.empty();)
    {
      const auto bar = std::min(words.find('|'), words.size());
      rest += Element("element", words.substr(0, bar));
      words.remove_prefix(std::min(bar + 1, words.size()));
    }
  }
  return "    <" + tag + attributes + ">\n" + Element("name", NameOf(parameter, command)) +
         Element("label", LabelOf(parameter, command)) + "      <description><![CDATA[" +
         std::string(parameter.description) + "]]></description>\n" + rest + "    </" + tag + ">\n";
}

struct Output
{
  const char * name;
  const char * label;
  bool         whole; ///< a whole number
  double       value;
};

/** What a module tells besides its files. */
std::vector<Output>
Outputs(CommandId command, const CoreReport & report)
{
  TopologyNumbers topology;
  double          faces = 0;
  double          area = 0;
  double          branches = 0;
  double          length = 0;
  topology = {};
  for (const LabelRecord & label : report.labels)
  {
    if (command == CommandId::Skeleton && label.skeleton)
    {
      const SkeletonRecord & skeleton = *label.skeleton;
      branches += static_cast<double>(skeleton.numbers.branches);
      length += skeleton.numbers.totalLength;
    }
    for (std::size_t d = 0; d < 3; ++d)
    {
      topology.betti[d] += label.shape.betti[d]; // a result's are the same, or there is none
    }
    if (command == CommandId::Core && !label.pruned.empty())
    {
      faces += static_cast<double>(label.pruned.back().complex.faces);
      area += label.pruned.back().complex.areaMm2;
    }
  }
  std::vector<Output> outputs;
  if (command == CommandId::Core)
  {
    outputs.push_back({ "faces", "Faces", true, faces });
    outputs.push_back({ "area", "Area (mm2)", false, area });
  }
  else
  {
    outputs.push_back({ "branches", "Branches", true, branches });
    outputs.push_back({ "length", "Length (mm)", false, length });
  }
  outputs.push_back({ "b0", "Components (b0)", true, static_cast<double>(topology.betti[0]) });
  outputs.push_back({ "b1", "Loops (b1)", true, static_cast<double>(topology.betti[1]) });
  outputs.push_back({ "b2", "Cavities (b2)", true, static_cast<double>(topology.betti[2]) });
  outputs.push_back({ "seconds", "Seconds", false, report.seconds.total });
  return outputs;
}

std::string
NumberText(const Output & output)
{
  char text[40];
  (void)std::snprintf(text, sizeof(text), output.whole ? "%.0f" : "%.9g", output.value);
  return text;
}

} // namespace

std::string
SlicerXml(CommandId command)
{
  const Description & description = Describe(command);
  std::string         xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n";
  const auto          head = [&xml](std::string_view tag, std::string_view text) {
    xml += "  <" + std::string(tag) + ">" + Escaped(text) + "</" + std::string(tag) + ">\n";
  };
  head("category", "Surface Models");
  head("title", description.title);
  head("description", description.text);
  head("version", VoxelCoreVersion());
  head("documentation-url", "");
  head("license", "Apache-2.0");
  head("contributor", "");
  const auto section = [&](std::string_view label, std::string_view attributes, const auto & isIn) {
    std::string rows;
    for (const Parameter & parameter : Parameters())
    {
      if (IsShown(parameter, command) && isIn(parameter))
      {
        rows += ParameterXml(parameter, command);
      }
    }
    if (!rows.empty())
    {
      xml += "  <parameters" + std::string(attributes) + ">\n    <label>" + std::string(label) +
             "</label>\n    <description></description>\n" + rows + "  </parameters>\n";
    }
  };
  section("Parameters", "", [](const Parameter & parameter) { return IsIn(kMain, parameter.name); });
  for (auto group = ParameterGroup::Input; group <= ParameterGroup::Running;
       group = static_cast<ParameterGroup>(static_cast<int>(group) + 1))
  {
    section(GroupHeading(group), " advanced=\"true\"", [&](const Parameter & parameter) {
      return parameter.group == group && !IsIn(kMain, parameter.name);
    });
  }
  xml += "  <parameters>\n    <label>Results</label>\n    <description>Summed over all labels</description>\n";
  const CoreReport none;
  for (const Output & output : Outputs(command, none))
  {
    const std::string tag = output.whole ? "integer" : "double";
    xml += Text("    <", tag, ">\n");
    xml += Element("name", output.name) + Element("label", output.label) + Element("description", output.label);
    xml += Element("default", "0") + Element("channel", "output") + Text("    </", tag, ">\n");
  }
  return xml + "  </parameters>\n</executable>\n";
}

SlicerCall
ParseSlicerCall(CommandId command, const std::vector<std::string> & arguments)
{
  SlicerCall               call;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string & word = arguments[i];
    if (word == "--xml")
    {
      call.wantsXml = true;
      return call;
    }
    if (!word.starts_with("--"))
    {
      files.push_back(word);
      continue;
    }
    const auto all = Parameters();
    const auto meant = std::find_if(all.begin(), all.end(), [&](const Parameter & parameter) {
      return IsShown(parameter, command) && !parameter.flags.empty() && parameter.name != "output" &&
             LongFlag(parameter) == word;
    });
    if (meant == all.end() && word != "--returnparameterfile")
    {
      throw UsageError(word + ": there is no such option; --xml describes all of them");
    }
    if (meant != all.end() && meant->kind == ParameterKind::Flag)
    {
      call.values[std::string(meant->name)] = "true";
      continue;
    }
    if (++i == arguments.size())
    {
      throw UsageError(word + ": needs a value");
    }
    if (meant == all.end())
    {
      call.returnParameterFile = arguments[i];
    }
    else if (!arguments[i].empty())
    {
      call.values[std::string(meant->name)] = arguments[i];
    }
  }
  if (files.size() != 2 || files[0].empty() || files[1].empty())
  {
    throw UsageError("give a label volume and an output, in this order, after all options");
  }
  call.values["scan"] = files[0];
  call.values["output"] = files[1];
  call.values["force"] = "true";
  const std::string lambda = ValueOf(call.values, command, "lambda");
  if (lambda.find(',') != std::string::npos)
  {
    throw UsageError("--lambda " + lambda + ": one value, for there is one output");
  }
  return call;
}

std::string
SlicerReturnText(CommandId command, const CoreReport & report)
{
  std::string text;
  for (const Output & output : Outputs(command, report))
  {
    text += std::string(output.name) + " = " + NumberText(output) + "\n";
  }
  return text;
}

} // namespace voxelcore
