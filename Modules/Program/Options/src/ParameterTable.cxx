#include "ParameterReader.h"
#include "table/CohortRows.h"
#include "table/CompareRows.h"
#include "table/InputRows.h"
#include "table/OutputRows.h"
#include "table/PhantomRows.h"
#include "table/PictureRows.h"
#include "table/PruningRows.h"
#include "table/RootRows.h"
#include "table/RunningRows.h"
#include "table/SkeletonRows.h"
#include "table/StraightenRows.h"
#include "table/ThicknessRows.h"

namespace voxelcore
{

namespace
{

/** The rows of one file, in its group. */
template <std::size_t N>
struct Rows
{
  ParameterGroup                   group;
  const std::array<Parameter, N> & rows;
};

/** Said, as Clang 14 does not deduce it. */
template <std::size_t N>
Rows(ParameterGroup, const std::array<Parameter, N> &) -> Rows<N>;

template <std::size_t... N>
constexpr auto
JoinedRows(const Rows<N> &... parts)
{
  std::array<Parameter, (N + ...)> all{};
  std::size_t                      end = 0;
  const auto                       append = [&](const auto & part) {
    for (const Parameter & row : part.rows)
    {
      all[end] = row;
      all[end++].group = part.group;
    }
  };
  (append(parts), ...);
  return all;
}

constexpr auto kParameters = JoinedRows(Rows{ ParameterGroup::Input, table::kInputRows },
                                        Rows{ ParameterGroup::Output, table::kOutputRows },
                                        Rows{ ParameterGroup::Picture, table::kPictureRows },
                                        Rows{ ParameterGroup::Cohort, table::kCohortRows },
                                        Rows{ ParameterGroup::Phantom, table::kPhantomRows },
                                        Rows{ ParameterGroup::Roots, table::kRootRows },
                                        Rows{ ParameterGroup::Thickness, table::kThicknessRows },
                                        Rows{ ParameterGroup::Pruning, table::kPruningRows },
                                        Rows{ ParameterGroup::ShapeEdits, table::kShapeEditRows },
                                        Rows{ ParameterGroup::Refinement, table::kRefinementRows },
                                        Rows{ ParameterGroup::Skeleton, table::kSkeletonRows },
                                        Rows{ ParameterGroup::Straightening, table::kStraightenRows },
                                        Rows{ ParameterGroup::Comparison, table::kCompareRows },
                                        Rows{ ParameterGroup::Running, table::kRunningRows });

} // namespace

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

std::span<const Parameter>
Parameters()
{
  return kParameters;
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
