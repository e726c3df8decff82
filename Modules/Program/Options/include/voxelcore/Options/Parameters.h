#pragma once
// Every option of the program in one table: the parser, the help and descriptions for other programs come from it.

#include "voxelcore/Compare/CompareJob.h"
#include "voxelcore/Compare/ProbabilityJob.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/BlockJob.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/InfoJob.h"
#include "voxelcore/Jobs/PruneJob.h"
#include "voxelcore/Jobs/ReconstructJob.h"
#include "voxelcore/Jobs/RenderJob.h"
#include "voxelcore/Jobs/SkeletonJob.h"
#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Meshes/VoxelizeJob.h"
#include "voxelcore/Phantom/PhantomJob.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Sheets/SheetsJob.h"
#include "voxelcore/Thickness/ThicknessJob.h"
#include "voxelcore/Vessels/StraightenJob.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace voxelcore
{

/** A subcommand. Values are bits. */
enum class CommandId : std::uint32_t
{
  Core = 1,
  Info = 2,
  Verify = 4,
  Prune = 8,
  Phantom = 16,
  Skeleton = 32,
  Measure = 64,
  Render = 128,
  Batch = 256, ///< takes besides its own all options of Core that do not name a file
  Reconstruct = 512,
  Voxelize = 1024,
  Roots = 2048,
  Thickness = 4096,
  Sheets = 8192,
  Straighten = 16384,
  Compare = 32768
};

struct Command
{
  CommandId        id;
  std::string_view name;
  std::string_view description; ///< one line
  std::string_view footer;      ///< examples, and what must be known to use it well
};

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
  std::uint32_t    commands;         ///< bits of CommandId
  std::string_view description;      ///< one line
  std::string_view keyword = {};     ///< in Python, where KeywordOf() does not follow from the name; "-": none
  bool             recorded = false; ///< has no field of its own: stands in reports and files as it was given
  ParameterGroup   group = ParameterGroup::Running; ///< that of the table the row stands in
};

std::span<const Command>
Commands();

/** Group by group; within a group the most needed first. */
std::span<const Parameter>
Parameters();

/** The keyword argument of the Python module that does the same; empty where there is none. Those of pruning, shape
 *  edits, refinement and skeletons have the option's name with underscores; others are there if their row says so. */
std::string
KeywordOf(const Parameter & parameter);

inline bool
BelongsTo(const Parameter & parameter, CommandId command)
{
  const auto has = [&](CommandId one) { return (parameter.commands & static_cast<std::uint32_t>(one)) != 0; };
  // A path, what goes with one, a part of one scan, or its memory is not a cohort's.
  const bool ofOneRun = parameter.kind == ParameterKind::Input || parameter.kind == ParameterKind::Output ||
                        parameter.name == "blocks" || parameter.name == "block" || parameter.name == "block-size" ||
                        parameter.name == "memory" || parameter.name == "grey-range";
  return has(command) || (command == CommandId::Batch && has(CommandId::Core) && !ofOneRun);
}

/** An argument of a command line with the name its option has now: `--bumps` was `--tolerance` until 0.1. */
std::string
WithoutFormerName(std::string argument);

/** What was given, as text, by Parameter::name; a flag that was given is "true". */
using ParameterValues = std::map<std::string, std::string, std::less<>>;

/** The value given, else the default of the table for this command. */
std::string
ValueOf(const ParameterValues & values, CommandId command, std::string_view name);

/** The same of a choice. \throws UsageError, naming the option, unless it is one of its words. */
std::string
ChoiceOf(const ParameterValues & values, CommandId command, std::string_view name);

/** `--threads`: 0 means all processors.
 *  \throws UsageError unless it is a whole number from 0 to 4096 */
int
ThreadsFrom(const ParameterValues & values, CommandId command);

/** Each throws UsageError, naming the option, for a value without sense. */
CoreOptions
CoreOptionsFrom(const ParameterValues & values);
/** What is asked of shapes and cores, wherever they come from: no path is read, and none need be there. */
CoreOptions
CoreOptionsWithoutFiles(const ParameterValues & values);
/** None unless --blocks is given. */
std::optional<BlockOptions>
BlockOptionsFrom(const ParameterValues & values);
InfoOptions
InfoOptionsFrom(const ParameterValues & values);
VerifyOptions
VerifyOptionsFrom(const ParameterValues & values);
PruneOptions
PruneOptionsFrom(const ParameterValues & values);
PruneOptions
PruneOptionsWithoutFiles(const ParameterValues & values);
ReconstructOptions
ReconstructOptionsFrom(const ParameterValues & values);
/** `--resolution`: of meshes; none unless it is given. */
std::vector<std::int64_t>
ResolutionsFrom(const ParameterValues & values, CommandId command);
VoxelizeJobOptions
VoxelizeOptionsFrom(const ParameterValues & values);
PhantomJobOptions
PhantomOptionsFrom(const ParameterValues & values);
DisplayTargets
DisplayTargetsFrom(const ParameterValues & values, CommandId command);
std::optional<SkeletonRequest>
CoreSkeletonFrom(const ParameterValues & values);
SkeletonTargets
TargetsFrom(const ParameterValues & values, CommandId command);
SkeletonOptions
SkeletonOptionsFrom(const ParameterValues & values);
/** None unless --probability is given. */
std::optional<ProbabilityOptions>
ProbabilityOptionsFrom(const ParameterValues & values);
/** How a finished core is burned; its lambda is 0. */
SkeletonRequest
SkeletonRequestFrom(const ParameterValues & values);
/** What `measure` does to a finished skeleton. */
BranchRequest
MeasureBranchesFrom(const ParameterValues & values);
MeasureJobOptions
MeasureOptionsFrom(const ParameterValues & values);
RootsOptions
RootsOptionsFrom(const ParameterValues & values);
ThicknessOptions
ThicknessOptionsWithoutFiles(const ParameterValues & values);
ThicknessOptions
ThicknessOptionsFrom(const ParameterValues & values);
SheetsOptions
SheetsOptionsFrom(const ParameterValues & values);
StraightenOptions
StraightenOptionsFrom(const ParameterValues & values);
/** No path is read, and none need be there. */
CompareOptions
CompareOptionsWithoutFiles(const ParameterValues & values);
CompareOptions
CompareOptionsFrom(const ParameterValues & values);
RenderJobOptions
RenderOptionsFrom(const ParameterValues & values);

} // namespace voxelcore
