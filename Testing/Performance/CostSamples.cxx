#include "CostSamples.h"

#include "ChildProcess.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

namespace voxelcore::performance
{

namespace fs = std::filesystem;

namespace
{

double
Median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/** Differs from build to build. */
std::string
BuildOf(const fs::path & program)
{
  return std::to_string(fs::file_size(program)) + " " +
         std::to_string(fs::last_write_time(program).time_since_epoch().count());
}

} // namespace

CostSamples::CostSamples(const fs::path & folder, const std::string & program, const std::string & clock)
  : m_Folder(folder)
  , m_File(folder / "samples.jsonl")
  , m_Program(program)
  , m_Clock(clock)
{
  const std::string build = BuildOf(program);
  std::ifstream     file(m_File);
  std::string       line;
  if (std::getline(file, line) && line == build)
  {
    while (std::getline(file, line))
    {
      const auto json = nlohmann::json::parse(line);
      m_Samples[json.at("task")].push_back({ json.at("cells"),
                                             json.at("edges"),
                                             json.at("bytes"),
                                             json.at("seconds"),
                                             json.at("share"),
                                             json.at("reference") });
    }
    return;
  }
  std::ofstream(m_File) << build << "\n";
}

CostSamples::Sample
CostSamples::Run(const fs::path & scan, int threads, CostJob job) const
{
  const fs::path           report = m_Folder / "report.json";
  std::vector<std::string> command{ m_Program,
                                    job == CostJob::Skeleton ? "skeleton" : "core",
                                    scan.string(),
                                    "-o",
                                    (m_Folder / "result.vtp").string(),
                                    "--report",
                                    report.string(),
                                    "--threads",
                                    std::to_string(threads),
                                    "--force",
                                    "-q" };
  if (job == CostJob::Core || job == CostJob::Page)
  {
    command.insert(command.end(), { "--lambda", "1.5vox" });
  }
  if (job != CostJob::Skeleton && job != CostJob::Refined)
  {
    command.insert(command.end(), { "--refine", "off" });
  }
  if (job == CostJob::Page)
  {
    command.insert(command.end(), { "--html", (m_Folder / "result.html").string() });
  }
  Sample best{ 0, 0, 0, std::numeric_limits<double>::infinity(), 0, 0 };
  // Of short runs the better of two: what other programs do only adds.
  for (int i = 0; i < 2 && (i == 0 || best.seconds < 0.5); ++i)
  {
    RunChild(command, m_Clock);
    std::ifstream file(report);
    const auto    json = nlohmann::json::parse(file);
    const auto &  stages = json.at("seconds");
    const double  seconds = stages.at("total").get<double>() - stages.at("read").get<double>();
    if (seconds < best.seconds)
    {
      const double share = stages.at(job == CostJob::Skeleton ? "skeleton" : "write").get<double>();
      best = { 0, 0, 1e6 * json.at("peak_memory_mb").get<double>(), seconds, share, 0 };
      for (const auto & label : json.at("labels"))
      {
        best.cells += label.at("core").at("vertices").get<double>();
        best.edges += label.at("core").at("edges").get<double>();
      }
    }
  }
  return best;
}

void
CostSamples::Measure(const std::vector<CostTask> & tasks, const fs::path & reference, int rounds, double seconds)
{
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const auto count = [&](const CostTask & task) {
    const auto found = m_Samples.find(task.Key());
    return found == m_Samples.end() ? 0 : found->second.size();
  };
  const auto next = [&] {
    return std::min_element(tasks.begin(), tasks.end(), [&](const CostTask & a, const CostTask & b) {
      return count(a) < count(b);
    });
  };
  double before = Run(reference, 1, CostJob::Core).seconds;
  for (auto task = next(); count(*task) < static_cast<std::size_t>(rounds) && passed() < seconds; task = next())
  {
    Sample       sample = Run(task->scan, task->threads, task->job);
    const double after = Run(reference, 1, CostJob::Core).seconds;
    sample.reference = (before + after) / 2;
    before = after;
    m_Samples[task->Key()].push_back(sample);
    std::ofstream(m_File, std::ios::app) << nlohmann::json{ { "task", task->Key() },          { "cells", sample.cells },
                                                            { "edges", sample.edges },        { "bytes", sample.bytes },
                                                            { "seconds", sample.seconds },    { "share", sample.share },
                                                            { "reference", sample.reference } }
                                         << "\n";
    std::fprintf(stderr, "%s: %.2f s, reference %.2f s\n", task->Key().c_str(), sample.seconds, sample.reference);
  }
}

std::size_t
CostSamples::Missing(const std::vector<CostTask> & tasks) const
{
  return static_cast<std::size_t>(
    std::count_if(tasks.begin(), tasks.end(), [&](const CostTask & task) { return !m_Samples.contains(task.Key()); }));
}

double
CostSamples::ReferenceSeconds() const
{
  std::vector<double> references;
  for (const auto & [key, samples] : m_Samples)
  {
    for (const Sample & sample : samples)
    {
      references.push_back(sample.reference);
    }
  }
  return Median(std::move(references));
}

JobCost
CostSamples::Cost(const CostTask & task) const
{
  std::vector<double> bytes;
  std::vector<double> seconds;
  std::vector<double> share;
  for (const Sample & sample : m_Samples.at(task.Key()))
  {
    bytes.push_back(sample.bytes);
    seconds.push_back(sample.seconds / sample.reference);
    share.push_back(sample.share / sample.reference);
  }
  const Sample & first = m_Samples.at(task.Key()).front();
  const double   usual = ReferenceSeconds();
  return { first.cells,
           first.edges,
           Median(std::move(bytes)),
           Median(std::move(seconds)) * usual,
           Median(std::move(share)) * usual };
}

} // namespace voxelcore::performance
