#include "voxelcore/Cohort/BatchJob.h"

#include "BidsDataset.h"
#include "CaseJob.h"
#include "ChildProcess.h"
#include "Scheduler.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/PlainText.h"
#include "voxelcore/Base/SystemCalls.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Cohort/GatherCohort.h"
#include "voxelcore/Jobs/DisplayTargets.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <thread>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

constexpr double kMegabyte = 1e6;

struct Unit
{
  std::string_view name;
  double           factor;
};

/** A positive number with one of the units; a bare number has the first. */
template <std::size_t N>
double
NumberWithUnit(const std::string & option, const std::string & text, const std::array<Unit, N> & units)
{
  double     value = 0;
  const auto read = from_chars(text.data(), text.data() + text.size(), value);
  const auto rest = std::string_view(read.ptr, static_cast<std::size_t>(text.data() + text.size() - read.ptr));
  for (const Unit & unit : units)
  {
    if (read.ec == std::errc() && std::isfinite(value) && value > 0 &&
        (rest == unit.name || (rest.empty() && &unit == units.data())))
    {
      return value * unit.factor;
    }
  }
  std::string names;
  for (const Unit & unit : units)
  {
    names += (names.empty() ? "" : ", ") + std::string(unit.name);
  }
  throw UsageError(option + " " + text + ": expected a number above 0 with a unit of " + names);
}

std::size_t
CountFrom(const ParameterValues & values, std::string_view name, std::size_t most)
{
  const std::string text = ValueOf(values, kBatchCommand, name);
  std::size_t       value = 0;
  const auto [end, error] = from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > most)
  {
    throw UsageError("--" + std::string(name) + " " + text + ": expected a whole number from 0 to " +
                     std::to_string(most));
  }
  return value;
}

double
MemoryThereIsMb()
{
  if (const auto available = AvailableMemoryMb())
  {
    return *available;
  }
  throw Error("cannot tell how much memory there is; give --memory");
}

/** What all cases are asked without sense is refused once, before any runs. What a line of a manifest asks fails its
 *  case alone. \throws UsageError */
void
RequireSense(const std::vector<CohortCase> & cases, const BatchOptions & options)
{
  for (const CohortCase & one : cases)
  {
    const CaseJob job = MakeCaseJob(one, options);
    if (job.refusal.empty())
    {
      continue;
    }
    CohortCase plain = job.one;
    plain.values.clear();
    if (MakeCaseJob(plain, options).refusal == job.refusal)
    {
      throw UsageError(job.refusal);
    }
  }
}

void
MakeOutput(const BatchOptions & options)
{
  std::error_code error;
  fs::create_directories(options.output, error);
  std::error_code ignored;
  if (!fs::is_directory(options.output, ignored))
  {
    throw OutputError(options.output.string() +
                      ": cannot make this folder: " + (error ? error.message() : std::string("it is a file")));
  }
}

/** Names of files and ids may hold line ends, and commands for a terminal. */
std::string
InOneLine(std::string text)
{
  std::replace_if(
    text.begin(),
    text.end(),
    [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7F; },
    ' ');
  return PlainText(text);
}

/** Why a run would do a case again that is done; empty when it would not. \throws InputError */
std::string
WhyDoneAgain(const CaseJob & job, const std::string & keyThen)
{
  const std::string digest = ScanSha256(job.one.scan, job.reading);
  const std::string key = KeyOf(job, digest);
  if (IsDone(job.folder, key))
  {
    return "";
  }
  const std::string seen = ScanDigestOfResults(job.folder);
  return std::string(seen.empty() || key == keyThen ? "its results are missing or were changed"
                     : seen != digest               ? "its scan has changed since"
                                      : "it was done with other options, masks or label names, or by another version") +
         "; run the batch again";
}

/** The done cases that a run would do again. */
std::vector<FailedCase>
Outdated(const std::vector<CohortCase> & cases, const BatchOptions & options, const JobContext & context)
{
  std::vector<FailedCase> outdated;
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    ReportProgress(context.progress, "checking", static_cast<double>(i) / static_cast<double>(cases.size()));
    const CaseJob job = MakeCaseJob(cases[i], options);
    const auto    record = ReadCaseRecord(job.folder);
    if (!record || !record->done)
    {
      continue; // GatherCohort() says so
    }
    std::string why;
    try
    {
      why = WhyDoneAgain(job, record->key);
    }
    catch (const std::exception & error) // it would fail its case
    {
      why = error.what();
    }
    if (!why.empty())
    {
      outdated.push_back({ job.one.id, why, false });
    }
  }
  return outdated;
}

/** Adds the cases of this batch that the tables have for failed: results of some could not be read again. */
void
AddLost(const std::vector<FailedCase> & lost, const std::vector<CohortCase> & cases, std::vector<FailedCase> & failed)
{
  const auto isIn = [](const auto & all, const std::string & id) {
    return std::any_of(all.begin(), all.end(), [&](const auto & one) { return one.id == id; });
  };
  for (const FailedCase & one : lost)
  {
    if (isIn(cases, one.id) && !isIn(failed, one.id))
    {
      failed.push_back(one);
    }
  }
}

} // namespace

BatchOptions
BatchOptionsFrom(const ParameterValues & values, std::span<const Command> commands)
{
  BatchOptions options;
  options.commands = commands;
  options.rows = OptionsOfCases(commands);
  const auto inputs = values.find("inputs");
  for (std::size_t at = 0; inputs != values.end() && at < inputs->second.size();)
  {
    const std::size_t end = std::min(inputs->second.find('\n', at), inputs->second.size());
    options.inputs.emplace_back(inputs->second.substr(at, end - at));
    at = end + 1;
  }
  options.output = ValueOf(values, kBatchCommand, "output");
  if (options.output.empty())
  {
    throw UsageError("--output: expected a folder");
  }
  if (!options.output.has_filename())
  {
    options.output = options.output.parent_path();
  }
  for (const Parameter & parameter : options.rows)
  {
    const auto value = values.find(parameter.name);
    if (DescribesACase(parameter) && value != values.end())
    {
      options.values.insert(*value);
    }
  }
  const auto cores = std::max<std::size_t>(1, std::thread::hardware_concurrency());
  const auto jobs = CountFrom(values, "jobs", 4096);
  const auto threads = static_cast<std::size_t>(ThreadsFrom(values));
  options.jobs = static_cast<int>(jobs > 0 ? jobs : cores);
  options.threads =
    static_cast<int>(threads > 0 ? threads : std::max<std::size_t>(1, cores / static_cast<std::size_t>(options.jobs)));
  const std::string memory = ValueOf(values, kBatchCommand, "memory");
  options.memoryMb =
    memory.empty() ? MemoryThereIsMb()
                   : NumberWithUnit("--memory",
                                    memory,
                                    std::array<Unit, 4>{
                                      { { "MB", 1 }, { "GB", 1e3 }, { "MiB", 1.048576 }, { "GiB", 1073.741824 } } });
  const std::string timeout = ValueOf(values, kBatchCommand, "timeout");
  options.timeout =
    timeout.empty()
      ? 0
      : NumberWithUnit("--timeout", timeout, std::array<Unit, 3>{ { { "s", 1 }, { "m", 60 }, { "h", 3600 } } });
  options.skeletons = !values.contains("no-skeleton");
  for (const Command & command : commands)
  {
    if (command.asCase == nullptr || (!IsUsual(command) && !values.contains(command.name)))
    {
      continue;
    }
    const std::string flag(command.asCase->flag);
    if (options.command != nullptr && !IsUsual(*options.command))
    {
      throw UsageError(std::string(options.command->asCase->flag) + " does not go with " + flag + "; give either");
    }
    if (!IsUsual(command) && !options.skeletons)
    {
      throw UsageError("--no-skeleton does not go with " + flag + "; give either");
    }
    options.command = &command;
  }
  RequireTaken(options.values, options, "");
  options.pages = values.contains("html");
  if (options.pages)
  {
    RequirePages(); // once, rather than in each case
  }
  options.force = values.contains("force");
  options.gather = values.contains("gather");
  options.bids = values.contains("bids");
  if (options.bids && !options.command->asCase->hasBids)
  {
    throw UsageError("--bids does not go with " + std::string(options.command->asCase->flag) + "; leave it out");
  }
  if (values.contains("case"))
  {
    options.only = CountFrom(values, "case", std::size_t{ 1 } << 40U);
  }
  if (options.inputs.empty() && !options.gather)
  {
    throw UsageError("no INPUT given; scans, folders, patterns or a manifest.csv; see 'voxelcore batch --help'");
  }
  return options;
}

BatchResult
RunBatchJob(const BatchOptions & options, const JobContext & context)
{
  std::vector<fs::path>   passedOver;
  std::vector<CohortCase> cases = options.inputs.empty()
                                    ? std::vector<CohortCase>()
                                    : FindCases(options.inputs, options.rows, options.output, &passedOver);
  if (options.only)
  {
    if (*options.only < 1 || *options.only > cases.size())
    {
      throw UsageError("--case " + std::to_string(*options.only) + ": there are cases 1 to " +
                       std::to_string(cases.size()));
    }
    cases = { cases[*options.only - 1] };
  }
  RequireSense(cases, options);
  if (options.bids)
  {
    RequireBidsPlaces(cases);
  }
  BatchResult result;
  if (options.gather)
  {
    const CohortSummary summary =
      GatherCohort(options.output, cases, context, Outdated(cases, options, context), options.bids);
    if (options.inputs.empty())
    {
      result.cases = summary.cases;
      result.failed = summary.failed;
    }
    else // it tells of these, as their run does; the tables hold what others have left, too
    {
      result.cases = cases.size();
      AddLost(summary.failed, cases, result.failed);
    }
    result.passedOver = std::move(passedOver);
    return result;
  }
  RequireChildProcesses();
  MakeOutput(options);
  result = Scheduler(options, cases, context).Run();
  if (!options.only)
  {
    AddLost(GatherCohort(options.output, cases, context, result.failed, options.bids).failed, cases, result.failed);
    result.passedOver = std::move(passedOver);
  }
  return result;
}

std::string
CaseList(const BatchOptions & options)
{
  std::string text;
  std::size_t number = 0;
  for (const CohortCase & one : FindCases(options.inputs, options.rows, options.output))
  {
    text += std::to_string(++number) + "\t" + one.folder + "\t" + InOneLine(one.id) + "\t" + InOneLine(one.scan) + "\n";
  }
  return text;
}

std::string
BatchText(const BatchResult & result)
{
  std::string text = std::to_string(result.cases - result.failed.size()) + " of " + std::to_string(result.cases) +
                     " cases done" + (result.kept > 0 ? ", " + std::to_string(result.kept) + " of them before" : "") +
                     "\n";
  for (const FailedCase & failed : result.failed)
  {
    text += "failed: " + InOneLine(failed.id + ": " + failed.reason) + "\n";
  }
  constexpr std::size_t shown = 20;
  for (std::size_t i = 0; i < std::min(shown, result.passedOver.size()); ++i)
  {
    text += "passed over, no scan that can be read: " + InOneLine(result.passedOver[i].string()) + "\n";
  }
  if (result.passedOver.size() > shown)
  {
    text += "passed over: " + std::to_string(result.passedOver.size() - shown) + " more files\n";
  }
  return text;
}

} // namespace voxelcore
