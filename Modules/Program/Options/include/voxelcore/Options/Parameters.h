#pragma once
// An option of the program: the parser, the help and descriptions for other programs come from such rows.


#include <map>
#include <string>
#include <string_view>

namespace voxelcore
{

enum class ParameterKind
{
  Input,   ///< a path that is read
  Inputs,  ///< one or more such paths; as a value, a line each
  Output,  ///< a path that is written
  Text,    ///< checked by the job
  Integer, ///< a whole number
  Real,    ///< a number
  Choice,  ///< one of the words in `placeholder`, separated by |
  Flag     ///< no value
};

/** Under which heading help and manual pages show an option; in the order of the headings. */
enum class ParameterGroup
{
  Input,
  Output,
  Picture,
  Cohort,
  Phantom,
  Roots,
  Thickness,
  Pruning,
  ShapeEdits,
  Refinement,
  Skeleton,
  Straightening,
  Comparison,
  Running
};

std::string_view
GroupHeading(ParameterGroup group);

/** An option or, without flags, a positional argument. */
struct Parameter
{
  std::string_view name;             ///< key of ParameterValues
  std::string_view flags;            ///< "-o,--output"; empty: positional
  ParameterKind    kind;             ///< of its value
  std::string_view placeholder;      ///< stands for the value in help texts, with its unit
  std::string_view defaultValue;     ///< empty: none
  bool             required;         ///< must be given
  ParameterGroup   group;            ///< under which heading
  std::string_view description;      ///< one line
  std::string_view keyword = {};     ///< in Python, where KeywordOf() does not follow from the name; "-": none
  bool             recorded = false; ///< has no field of its own: stands in reports and files as it was given
  bool             ofOneRun = false; ///< a part of one scan, or its memory: a batch does not take it for its cases
};

/** The keyword argument of the Python module that does the same; empty where there is none. Those of pruning, shape
 *  edits, refinement and skeletons have the option's name with underscores; others are there if their row says so. */
std::string
KeywordOf(const Parameter & parameter);

/** An argument of a command line with the name its option has now: `--bumps` was `--tolerance` until 0.1. */
std::string
WithoutFormerName(std::string argument);

/** What was given, as text, by Parameter::name; a flag that was given is "true". */
using ParameterValues = std::map<std::string, std::string, std::less<>>;

} // namespace voxelcore
