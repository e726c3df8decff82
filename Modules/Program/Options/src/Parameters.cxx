#include "voxelcore/Options/Parameters.h"

#include "voxelcore/Options/ParameterReader.h"

namespace voxelcore
{

std::string_view
GroupHeading(ParameterGroup group)
{
  switch (group)
  {
    case ParameterGroup::Input:
      return "Input";
    case ParameterGroup::Output:
      return "Output";
    case ParameterGroup::Pruning:
      return "Pruning";
    case ParameterGroup::ShapeEdits:
      return "Shape edits";
    case ParameterGroup::Refinement:
      return "Refinement";
    case ParameterGroup::Skeleton:
      return "Skeleton";
    case ParameterGroup::Picture:
      return "Picture";
    case ParameterGroup::Cohort:
      return "Cohort";
    case ParameterGroup::Phantom:
      return "Phantom";
    case ParameterGroup::Roots:
      return "Roots";
    case ParameterGroup::Thickness:
      return "Thickness and sheets";
    case ParameterGroup::Straightening:
      return "Straightening";
    case ParameterGroup::Comparison:
      return "Comparison";
    case ParameterGroup::Running:
      break;
  }
  return "Running";
}

std::string
KeywordOf(const Parameter & parameter)
{
  if (!parameter.keyword.empty())
  {
    return parameter.keyword == "-" ? std::string() : std::string(parameter.keyword);
  }
  const bool isFile = parameter.kind == ParameterKind::Input || parameter.kind == ParameterKind::Output;
  const bool isNamedAlike =
    parameter.group == ParameterGroup::Pruning || parameter.group == ParameterGroup::ShapeEdits ||
    parameter.group == ParameterGroup::Refinement || parameter.group == ParameterGroup::Skeleton ||
    parameter.group == ParameterGroup::Thickness || parameter.group == ParameterGroup::Comparison;
  return isNamedAlike && !isFile && !parameter.flags.empty() ? WithUnderscores(parameter.name) : std::string();
}

std::string
WithoutFormerName(std::string argument)
{
  constexpr std::string_view former = "--bumps";
  if (argument == former || argument.starts_with("--bumps="))
  {
    argument.replace(0, former.size(), "--tolerance");
  }
  return argument;
}

} // namespace voxelcore
