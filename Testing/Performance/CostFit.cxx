// Fits the constants of CostModel to phantoms on this machine, prints them as they stand in CostModel.cxx, and then how
// far they miss on shapes they were not fitted to, and on scans named on the command line.
// usage: VoxelCoreCostFit [--further] [--busy] [--seconds N] [--rounds N] FOLDER [SCAN...]
// --further: the constants of skeletons and pages instead of those of cores.
// --busy: processor time instead of elapsed, for a machine with other work to do; one thread only, so that what more
// threads gain is not fitted.
// FOLDER: for volumes and results, about 100 MB, and for what was measured: a call that ends after N seconds is taken
// up by the next with the same FOLDER.

#include "CostPhantoms.h"
#include "CostSamples.h"
#include "FurtherFit.h"
#include "NonNegativeFit.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{

using namespace voxelcore;
using performance::CostJob;
using performance::CostSamples;
using performance::CostTask;
using performance::CountScan;
using performance::Fit;
using performance::FitRatios;
using performance::JobCost;
using performance::NameOf;
using performance::Phantom;
using performance::PrintConstants;
using performance::TaskOf;
using Terms = std::array<double, CostTerms::kSize>;
namespace fs = std::filesystem;

/** Largest misses, as factors from one. */
struct Misses
{
  double      bytes = 0;
  double      seconds = 0;
  std::string bytesOf;
  std::string secondsOf;

  void
  Print(const char * what) const
  {
    std::printf("Largest misses, %s: memory %+.0f %% (%s), seconds %+.0f %% (%s)\n",
                what,
                100 * bytes,
                bytesOf.c_str(),
                100 * seconds,
                secondsOf.c_str());
  }
};

CoreOptions
OptionsOf(CostJob job)
{
  CoreOptions options;
  options.lambdas = ParseLambdas("1.5vox");
  options.output = "core.vtp";
  if (job != CostJob::Core)
  {
    options.tolerances = ParseTolerances("1.2diag");
  }
  if (job == CostJob::Refined)
  {
    options.refine.surface = "labels";
  }
  return options;
}

void
PrintRow(const CostTask & task, const JobCost & measured, const CostConstants & constants, Misses & misses)
{
  // What `info` prints is to a tenth of a second; less says nothing about the model.
  constexpr double worthTelling = 0.25;
  const auto       counts = CountScan(task.scan);
  const auto       foretold = PredictJob(counts, OptionsOf(task.job), task.threads, constants);
  std::uint64_t    vertices = 0;
  for (const BoundaryCounts & one : counts)
  {
    vertices += one.vertices;
  }
  const double bytes = static_cast<double>(foretold.memoryBytes) / measured.bytes - 1;
  const double seconds = foretold.seconds / measured.seconds - 1;
  std::printf("| %s | %llu | %.0f | %.0f | %+.0f %% | %.2f | %.2f |",
              task.Key().c_str(),
              static_cast<unsigned long long>(vertices),
              static_cast<double>(foretold.memoryBytes) / 1e6,
              measured.bytes / 1e6,
              100 * bytes,
              foretold.seconds,
              measured.seconds);
  if (std::abs(bytes) > std::abs(misses.bytes))
  {
    misses.bytes = bytes;
    misses.bytesOf = task.Key();
  }
  if (measured.seconds < worthTelling)
  {
    std::printf(" - |\n");
    return;
  }
  std::printf(" %+.0f %% |\n", 100 * seconds);
  if (std::abs(seconds) > std::abs(misses.seconds))
  {
    misses.seconds = seconds;
    misses.secondsOf = task.Key();
  }
}

/** Of the fitted shapes the seconds of two threads = those of one * (serial + (1 - serial) / 2). */
double
FitSerial(const std::vector<CostTask> & ofTwo, const CostSamples & samples)
{
  std::vector<double> serial;
  for (CostTask task : ofTwo)
  {
    const double two = samples.Cost(task).seconds;
    task.threads = 1;
    serial.push_back(2 * two / samples.Cost(task).seconds - 1);
  }
  std::sort(serial.begin(), serial.end());
  return std::clamp(serial[serial.size() / 2], 0.0, 1.0);
}

/** Of all labels together. */
Terms
TermsOf(const std::vector<BoundaryCounts> & labels, const CostConstants & constants)
{
  Terms sum{};
  for (const BoundaryCounts & label : labels)
  {
    const Terms one = ComputeCostTerms(label, constants).values;
    std::transform(sum.begin(), sum.end(), one.begin(), sum.begin(), std::plus());
  }
  sum.front() = 1;
  return sum;
}

CostConstants
FitConstants(const std::vector<CostTask> & ofOne, const std::vector<CostTask> & ofTwo, const CostSamples & samples)
{
  // First what can be counted: neither machine nor chance is in it.
  CostConstants                            constants;
  std::vector<std::vector<BoundaryCounts>> counts;
  std::vector<BorderKinds>                 kinds;
  std::vector<double>                      cells;
  std::vector<double>                      edges;
  std::vector<double>                      edgeScales;
  for (const CostTask & task : ofOne)
  {
    const JobCost cost = samples.Cost(task);
    counts.push_back(CountScan(task.scan));
    kinds.emplace_back();
    double vertices = 0;
    for (const BoundaryCounts & label : counts.back())
    {
      const BorderKinds one = CountBorderKinds(label);
      std::transform(kinds.back().begin(), kinds.back().end(), one.begin(), kinds.back().begin(), std::plus());
      vertices += static_cast<double>(label.vertices);
    }
    cells.push_back(cost.cells);
    edges.push_back(cost.edges);
    // Single voxels have hardly any edges, and do not matter.
    edgeScales.push_back(std::max(cost.edges, vertices));
  }
  constants.cells = Fit(kinds, cells, cells);
  constants.edges = Fit(kinds, edges, edgeScales);

  std::vector<Terms>  terms;
  std::vector<Terms>  withoutCaches;
  std::vector<double> bytes;
  std::vector<double> seconds;
  for (std::size_t i = 0; i < ofOne.size(); ++i)
  {
    const JobCost cost = samples.Cost(ofOne[i]);
    terms.push_back(TermsOf(counts[i], constants));
    seconds.push_back(cost.seconds);
    if (counts[i].size() == 1)
    {
      // Memory knows no caches.
      withoutCaches.push_back(terms.back());
      withoutCaches.back().back() = 0;
      bytes.push_back(cost.bytes);
    }
  }
  constants.bytes = FitRatios(withoutCaches, bytes);
  constants.seconds = FitRatios(terms, seconds);
  constants.serial = ofTwo.empty() ? FittedCosts().serial : FitSerial(ofTwo, samples);
  return constants;
}

/** What a job takes beyond another one, in the terms' order; the program itself is in both. */
void
FitMore(const std::vector<CostTask> & ofOne,
        CostJob                       job,
        const CostSamples &           samples,
        const CostConstants &         constants,
        Terms &                       moreBytes,
        Terms &                       moreSeconds)
{
  std::vector<Terms>  terms;
  std::vector<Terms>  withoutCaches;
  std::vector<double> bytes;
  std::vector<double> byteScales;
  std::vector<double> seconds;
  std::vector<double> secondScales;
  for (CostTask task : ofOne)
  {
    task.job = job;
    const JobCost cost = samples.Cost(task);
    const auto    counts = CountScan(task.scan);
    const auto    foretold = PredictJob(counts, OptionsOf(job), 1, constants); // without what is to be fitted
    terms.push_back(TermsOf(counts, constants));
    terms.back().front() = 0;
    if (counts.size() == 1)
    {
      withoutCaches.push_back(terms.back());
      withoutCaches.back().back() = 0;
      bytes.push_back(cost.bytes - static_cast<double>(foretold.memoryBytes));
      byteScales.push_back(cost.bytes);
    }
    seconds.push_back(cost.seconds - foretold.seconds);
    secondScales.push_back(cost.seconds);
  }
  moreBytes = Fit(withoutCaches, bytes, byteScales);
  moreSeconds = Fit(terms, seconds, secondScales);
}

void
MeasureFitAndPrint(const fs::path & folder, double limit, int rounds, const std::vector<fs::path> & scans, bool busy)
{
  constexpr std::array<CostJob, 3> jobs{ CostJob::Core, CostJob::Tolerance, CostJob::Refined };
  std::vector<CostTask>            ofOne;
  std::vector<CostTask>            ofTwo;
  std::vector<CostTask>            shapes;
  std::vector<CostTask>            files;
  for (const Phantom & phantom : performance::kFittedPhantoms)
  {
    ofOne.push_back(TaskOf(phantom, folder, 1));
    if (phantom.atTwo && !busy)
    {
      ofTwo.push_back(TaskOf(phantom, folder, 2));
    }
  }
  for (const CostJob job : jobs)
  {
    for (int threads = 1; threads <= (busy ? 1 : 2); ++threads)
    {
      for (const Phantom & phantom : performance::kOtherPhantoms)
      {
        shapes.push_back(TaskOf(phantom, folder, threads, job));
      }
      for (const fs::path & scan : scans)
      {
        files.push_back({ ScanName(scan), scan, threads, job });
      }
    }
  }
  std::vector<CostTask> own; // those fitted, in all jobs
  for (CostTask task : ofOne)
  {
    for (const CostJob job : jobs)
    {
      task.job = job;
      own.push_back(task);
    }
  }
  std::vector<CostTask> all;
  for (const auto * tasks : { &own, &shapes, &ofTwo, &files })
  {
    all.insert(all.end(), tasks->begin(), tasks->end());
  }
  CostSamples samples(folder, VOXELCORE_PROGRAM, busy ? VOXELCORE_CLOCK : "");
  samples.Measure(all, TaskOf(performance::kReference, folder, 1).scan, rounds, limit);
  const std::size_t missing = samples.Missing(all);
  if (missing > 0)
  {
    std::printf("%zu of %zu jobs have not run yet: call again with the same folder\n\n", missing, all.size());
  }
  if (samples.Missing(own) + samples.Missing(ofTwo) > 0)
  {
    return;
  }

  CostConstants constants = FitConstants(ofOne, ofTwo, samples);
  FitMore(ofOne, CostJob::Tolerance, samples, constants, constants.toleranceBytes, constants.toleranceSeconds);
  FitMore(ofOne, CostJob::Refined, samples, constants, constants.refineBytes, constants.refineSeconds);
  std::printf("constexpr CostConstants kFitted{\n");
  PrintConstants(constants.cells);
  PrintConstants(constants.edges);
  PrintConstants(constants.bytes);
  PrintConstants(constants.seconds);
  std::printf("  %.2g,\n", constants.serial);
  PrintConstants(constants.toleranceBytes);
  PrintConstants(constants.toleranceSeconds);
  PrintConstants(constants.refineBytes);
  PrintConstants(constants.refineSeconds);
  std::printf("};\n\n");
  std::printf("%s takes %.2f s, 1 thread\n\n", NameOf(performance::kReference).c_str(), samples.ReferenceSeconds());
  const auto table = [&](const CostConstants & with, const std::vector<CostTask> & tasks) {
    Misses misses;
    std::printf(
      "| shape | boundary vertices | MB foretold | measured | miss | s foretold | measured | miss |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (const CostTask & task : tasks)
    {
      if (samples.Missing({ task }) == 0)
      {
        PrintRow(task, samples.Cost(task), with, misses);
      }
    }
    std::printf("\n");
    return misses;
  };
  std::printf("With the constants above, the shapes fitted to\n\n");
  const Misses ofOwn = table(constants, own);
  std::printf("Shapes not fitted to, and scans\n\n");
  const Misses ofShapes = table(constants, shapes);
  const Misses ofFiles = table(constants, files);
  std::printf("With the constants compiled in\n\n");
  const Misses ofOwnNow = table(FittedCosts(), own);
  const Misses ofShapesNow = table(FittedCosts(), shapes);
  const Misses ofFilesNow = table(FittedCosts(), files);
  ofOwn.Print("shapes fitted to, constants above");
  ofShapes.Print("other shapes, constants above");
  ofFiles.Print("scans, constants above");
  ofOwnNow.Print("shapes fitted to, constants compiled in");
  ofShapesNow.Print("other shapes, constants compiled in");
  ofFilesNow.Print("scans, constants compiled in");
}

} // namespace

int
main(int argc, char ** argv)
{
  std::vector<std::string> arguments(argv + 1, argv + argc);
  double                   limit = std::numeric_limits<double>::infinity();
  int                      rounds = 3;
  try
  {
    const auto take = [&](const char * word) {
      const bool isThere = !arguments.empty() && arguments.front() == word;
      arguments.erase(arguments.begin(), arguments.begin() + (isThere ? 1 : 0));
      return isThere;
    };
    const bool further = take("--further");
    const bool busy = take("--busy");
    while (arguments.size() > 1 && arguments.front().rfind("--", 0) == 0)
    {
      if (arguments[0] == "--seconds")
      {
        limit = std::stod(arguments[1]);
      }
      else if (arguments[0] == "--rounds")
      {
        rounds = std::stoi(arguments[1]);
      }
      else
      {
        arguments.clear();
        break;
      }
      arguments.erase(arguments.begin(), arguments.begin() + 2);
    }
    if (arguments.empty())
    {
      std::fprintf(stderr,
                   "usage: VoxelCoreCostFit [--further] [--busy] [--seconds N] [--rounds N] FOLDER [SCAN...]\n");
      return 2;
    }
    fs::create_directories(arguments.front());
    const std::vector<fs::path> scans(arguments.begin() + 1, arguments.end());
    if (further)
    {
      performance::FitSkeletonsAndPages(arguments.front(), limit, rounds, scans, busy);
    }
    else
    {
      MeasureFitAndPrint(arguments.front(), limit, rounds, scans, busy);
    }
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "VoxelCoreCostFit: %s\n", error.what());
    return 1;
  }
  return 0;
}
