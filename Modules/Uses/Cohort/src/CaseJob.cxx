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

constexpr std::ptrdiff_t kBehindScan = 3; ///< of the arguments: voxelcore COMMAND SCAN

/** A path that no parser takes for an option or a command. */
std::string
PlainPath(const fs::path & path)
{
  const std::string text = path.string();
  return text.find('/') == std::string::npos ? "./" + text : text;
}

} // namespace

bool
IsUsual(const Command & command)
{
  return command.asCase->flag.empty();
}

bool
DescribesACase(const Parameter & parameter)
{
  return parameter.name != "force" && parameter.name != "progress" && parameter.name != "quiet" &&
         parameter.name != "threads";
}

void
RequireTaken(const ParameterValues & values, const BatchOptions & options, const std::string & where)
{
  const Command & run = *options.command;
  for (const auto & [name, value] : values)
  {
    if (FindParameter(run.rows, name) != nullptr)
    {
      continue;
    }
    if (!IsUsual(run))
    {
      throw UsageError(
        Text(where, "--", name, " is no option of 'voxelcore ", run.name, "', which --", run.name, " runs"));
    }
    std::string owners;
    std::string flags;
    for (const Command & owner : options.commands)
    {
      if (owner.asCase != nullptr && FindParameter(owner.rows, name) != nullptr)
      {
        owners += (owners.empty() ? "'voxelcore " : " and of 'voxelcore ") + std::string(owner.name) + "'";
        flags += (flags.empty() ? "" : " or ") + std::string(owner.asCase->flag);
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
  const Command & command = *options.command;
  RequireTaken(values, options, one.scan + ": ");
  job.arguments = { "voxelcore", std::string(command.name), PlainPath(one.scan) };
  const auto places = command.asCase->arguments({ job.folder, one.folder, options.bids });
  job.arguments.insert(job.arguments.end(), places.begin(), places.end());
  job.arguments.insert(job.arguments.end(), { "--force", "--progress", "none" });
  if (IsUsual(command))
  {
    values.emplace("with-skeleton", options.skeletons ? "true" : "false");
    if (values["with-skeleton"] == "true")
    {
      values.emplace("also", "csv,swc");
    }
  }
  else
  {
    job.options = std::string(command.name) + "\n" + (options.bids ? "nii.gz\n" : "");
  }
  if (command.asCase->drawsUnlessTold && !options.pages)
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
  for (const Parameter & parameter : options.rows)
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
      if (parameter.name == command.asCase->beside)
      {
        job.arguments.insert(job.arguments.begin() + kBehindScan, PlainPath(value->second));
      }
      else
      {
        job.arguments.push_back(argument);
      }
      job.options += (NamesFileOf(parameter, value->second) ? flag : argument) + "\n"; // a file is its content
      given.insert(*value);
    }
  }
  if (options.pages)
  {
    if (!command.asCase->drawsUnlessTold)
    {
      job.arguments.push_back("--html=" + (job.folder / one.folder).string() + "_view.html");
    }
    job.options += "--html\n";
  }
  given["output"] = (job.folder / "result.vtp").string(); // stands for the one among the arguments
  try
  {
    CaseInput input = command.asCase->understand(given); // what that refuses is a refusal here
    job.reading = std::move(input.reading);
    job.masks = std::move(input.masks);
  }
  catch (const UsageError & error)
  {
    job.refusal = error.what();
  }
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
