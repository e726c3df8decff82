#include "CaseJob.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Jobs/SystemFiles.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

/** Whether the command that a batch runs takes this option. It may stand in the table once for each command. */
bool
IsTaken(std::string_view name, CommandId command)
{
  return ranges::any_of(Parameters(), [&](const Parameter & parameter) {
    return parameter.name == name && BelongsTo(parameter, command);
  });
}

/** A path that no parser takes for an option or a command. */
std::string
PlainPath(const fs::path & path)
{
  const std::string text = path.string();
  return text.find('/') == std::string::npos ? "./" + text : text;
}

std::vector<std::string>
CommandLineOf(const CaseJob & job, CommandId command, bool bids)
{
  const std::string & folder = job.one.folder;
  const std::string   stem = (job.folder / folder).string();
  const std::string   scan = PlainPath(job.one.scan);
  if (command == CommandId::Roots)
  {
    return { "voxelcore", "roots",      scan,      "-o",         job.folder.string() + "/",
             "--prefix",  folder + "_", "--force", "--progress", "none" };
  }
  if (command == CommandId::Thickness)
  {
    return { "voxelcore",
             "thickness",
             scan,
             "-o",
             stem + (bids ? "_thickness.nii.gz" : "_thickness.nrrd"),
             "--table",
             stem + "_thickness.csv",
             "--report",
             stem + "_report.json",
             "--force",
             "--progress",
             "none" };
  }
  return { "voxelcore",           "core",    scan,         "-o",  stem + "_medial.vtp", "--report",
           stem + "_report.json", "--force", "--progress", "none" };
}

/** Reads the options as the case's process will: what that refuses is a refusal here. `given` is its command line. */
void
Understand(CaseJob & job, ParameterValues given, CommandId command)
{
  given["output"] = (job.folder / "result.vtp").string(); // stands for what CommandLineOf() gives
  try
  {
    if (command == CommandId::Roots)
    {
      job.reading = RootsOptionsFrom(given).reading;
    }
    else if (command == CommandId::Thickness)
    {
      const ThicknessOptions thickness = ThicknessOptionsFrom(given);
      job.reading = thickness.core.reading;
      if (IsMask(thickness.within))
      {
        job.masks.emplace_back(thickness.within);
      }
    }
    else
    {
      job.reading = CoreOptionsFrom(given).reading;
    }
  }
  catch (const UsageError & error)
  {
    job.refusal = error.what();
  }
}

} // namespace

std::string
CommandName(CommandId command)
{
  const auto found = ranges::find(Commands(), command, &Command::id);
  return std::string(found->name);
}

bool
DescribesACase(const Parameter & parameter)
{
  return IsOptionOfCases(parameter) && parameter.name != "force" && parameter.name != "progress" &&
         parameter.name != "quiet" && parameter.name != "threads";
}

void
RequireTaken(const ParameterValues & values, CommandId command, const std::string & where)
{
  for (const auto & [name, value] : values)
  {
    if (IsTaken(name, command))
    {
      continue;
    }
    if (command != CommandId::Core)
    {
      const std::string run = CommandName(command);
      throw UsageError(Text(where, "--", name, " is no option of 'voxelcore ", run, "', which --", run, " runs"));
    }
    std::string owners;
    std::string flags;
    for (const CommandId owner : { CommandId::Roots, CommandId::Thickness })
    {
      if (IsTaken(name, owner))
      {
        owners += (owners.empty() ? "'voxelcore " : " and of 'voxelcore ") + CommandName(owner) + "'";
        flags += (flags.empty() ? "--" : " or --") + CommandName(owner);
      }
    }
    throw UsageError(Text(where, "--", name, " is an option of ", owners, "; give ", flags, ", too"));
  }
}

CaseJob
MakeCaseJob(const CohortCase & one, const BatchOptions & options)
{
  CaseJob job;
  job.one = one;
  job.folder = options.output / one.folder;
  auto values = one.values;
  values.insert(options.values.begin(), options.values.end()); // those of the case stay
  RequireTaken(values, options.command, one.scan + ": ");
  job.arguments = CommandLineOf(job, options.command, options.bids);
  if (options.command == CommandId::Core)
  {
    values.emplace("with-skeleton", options.skeletons ? "true" : "false");
    if (values["with-skeleton"] == "true")
    {
      values.emplace("also", "csv,swc");
    }
  }
  else
  {
    job.options = CommandName(options.command) + "\n" + (options.bids ? "nii.gz\n" : "");
  }
  if (options.command == CommandId::Roots && !options.pages)
  {
    job.arguments.push_back("--no-pictures");
  }
  const auto threads = values.find("threads");
  job.arguments.push_back("--threads=" + (threads != values.end() ? threads->second : std::to_string(options.threads)));
  ParameterValues given;
  if (threads != values.end())
  {
    given.insert(*threads);
  }
  for (const Parameter & parameter : Parameters())
  {
    const auto value = values.find(parameter.name);
    if (!DescribesACase(parameter) || value == values.end())
    {
      continue;
    }
    const std::string flag = "--" + std::string(parameter.name);
    const bool        isFlag = parameter.kind == ParameterKind::Flag;
    if (!isFlag || value->second == "true")
    {
      const std::string argument = isFlag ? flag : flag + "=" + value->second;
      job.arguments.push_back(argument);
      job.options += (NamesMask(parameter.name, value->second) ? flag : argument) + "\n"; // a mask is its content
      given.insert(*value);
    }
    values.erase(value); // an option may stand in the table once for each command
  }
  if (options.pages)
  {
    if (options.command != CommandId::Roots)
    {
      job.arguments.push_back("--html=" + (job.folder / one.folder).string() + "_view.html");
    }
    job.options += "--html\n";
  }
  Understand(job, std::move(given), options.command);
  return job;
}

std::string
KeyOf(const CaseJob & job, const std::string & digest)
{
  return CaseKeyOf(digest, job.one.scan, job.options, job.masks);
}

std::string
TroubleWith(const fs::path & folder)
{
  std::error_code error;
  const auto      there = fs::symlink_status(folder, error);
  if (fs::is_symlink(there))
  {
    return folder.string() + ": is a link; results are written below the output folder alone; remove it";
  }
  if (fs::exists(there) && !fs::is_directory(there))
  {
    return folder.string() + ": cannot make this folder: it is a file";
  }
  if (!fs::create_directory(folder, error) && error)
  {
    throw OutputError(folder.string() + ": cannot make this folder: " + error.message());
  }
  return "";
}

std::string
TroubleWritingInto(const fs::path & folder)
{
  if (const std::string trouble = TroubleWith(folder); !trouble.empty())
  {
    return trouble;
  }
  std::error_code              error;
  const fs::directory_iterator listed(folder, error); // as gathering does
  return !error && MayWriteInto(folder)
           ? ""
           : folder.string() + ": cannot write into this folder: " + (error ? error.message() : std::strerror(errno));
}

} // namespace voxelcore
