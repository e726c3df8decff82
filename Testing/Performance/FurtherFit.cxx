#include "FurtherFit.h"

#include "CostPhantoms.h"
#include "CostSamples.h"
#include "NonNegativeFit.h"
#include "voxelcore/Jobs/CostModel.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace voxelcore::performance
{

namespace
{

namespace fs = std::filesystem;

const std::vector<Phantom> fitted{
  { "ellipsoid", 64, {} },
  { "ellipsoid", 192, {} },
  { "torus", 192, {} },
  { "gyroid", 96, {} },
  { "gyroid", 112, { "--thickness", "3" } },
  { "porous", 80, {} },
  { "root", 128, {} },
  { "root", 256, {} },
  { "root", 384, {} },
  { "shell", 128, {} },
  { "plate", 160, {} },
  { "plate", 224, { "--thickness", "2" } },
  { "box", 96, {} },
};

/** Of many labels. */
const std::vector<Phantom> fittedMany{ { "cells", 64, {} }, { "cells", 112, {} } };

const std::vector<Phantom> heldOut{
  { "ellipsoid", 128, {} }, { "capsule", 200, {} }, { "tanglecube", 128, {} },
  { "root", 300, {} },      { "gyroid", 72, {} },   { "thick-and-thin", 160, {} },
  { "cells", 96, {} },      { "cells", 128, {} },   { "plate", 192, { "--thickness", "7" } },
};

CoreOptions
OptionsOf(CostJob job)
{
  CoreOptions options;
  if (job == CostJob::Skeleton)
  {
    options.lambdas = ParseLambdas("0");
    options.skeleton.emplace();
    options.skeletonOutput = "result.vtp";
    return options;
  }
  options.lambdas = ParseLambdas("1.5vox");
  options.output = "result.vtp";
  options.display.html = "result.html";
  return options;
}

double
PageShare(CostTask task, const CostSamples & samples)
{
  const double both = samples.Cost(task).share;
  task.job = CostJob::Core;
  return std::max(1e-3, both - samples.Cost(task).share);
}

/** What many labels take beyond the greatest of them. */
std::array<double, 2>
FitKept(const fs::path & folder, const CostSamples & samples, CostConstants constants)
{
  constants.skeletonKept = {};
  std::vector<std::array<double, 2>> terms;
  std::vector<double>                bytes;
  for (const Phantom & phantom : fittedMany)
  {
    const CostTask       task = TaskOf(phantom, folder, 1, CostJob::Skeleton);
    const auto           counts = CountScan(task.scan);
    const CostPrediction alone = PredictJob(counts, OptionsOf(task.job), 1, constants);
    double               vertices = 0;
    for (const BoundaryCounts & one : counts)
    {
      vertices += static_cast<double>(one.vertices);
    }
    terms.push_back({ static_cast<double>(counts.size()), vertices });
    bytes.push_back(samples.Cost(task).bytes - static_cast<double>(alone.memoryBytes));
  }
  return Fit(terms, bytes, bytes);
}

CostConstants
FitFurther(const fs::path & folder, const CostSamples & samples)
{
  CostConstants                                     constants = FittedCosts();
  std::vector<std::array<double, CostTerms::kSize>> terms;
  std::vector<PageTerms>                            pageTerms;
  std::vector<double>                               skeletonBytes;
  std::vector<double>                               skeletonSeconds;
  std::vector<double>                               pageBytes;
  std::vector<double>                               pageSeconds;
  for (const Phantom & phantom : fitted)
  {
    const CostTask       skeleton = TaskOf(phantom, folder, 1, CostJob::Skeleton);
    const BoundaryCounts counts = CountScan(skeleton.scan).at(0);
    terms.push_back(ComputeCostTerms(counts).values);
    skeletonBytes.push_back(samples.Cost(skeleton).bytes);
    skeletonSeconds.push_back(std::max(1e-3, samples.Cost(skeleton).share));
  }
  std::vector<PageTerms> peakTerms;
  for (const auto * phantoms : { &fitted, &fittedMany })
  {
    for (const Phantom & phantom : *phantoms)
    {
      const CostTask page = TaskOf(phantom, folder, 1, CostJob::Page);
      PageTerms      sum{};
      for (const BoundaryCounts & counts : CountScan(page.scan))
      {
        const PageTerms one = ComputePageTerms(counts, false);
        std::transform(sum.begin(), sum.end(), one.begin(), sum.begin(), std::plus());
      }
      sum[0] = 1;
      pageTerms.push_back(sum);
      pageSeconds.push_back(PageShare(page, samples));
      // Elsewhere the peak is that of the core.
      const double peak = samples.Cost(page).bytes;
      if (peak > 1.03 * samples.Cost(TaskOf(phantom, folder, 1)).bytes)
      {
        peakTerms.push_back(sum);
        pageBytes.push_back(peak);
      }
    }
  }
  auto withoutCaches = terms;
  auto withoutStart = terms;
  for (std::size_t i = 0; i < terms.size(); ++i)
  {
    withoutCaches[i].back() = 0;
    withoutStart[i].front() = 0;
  }
  constants.skeletonBytes = FitRatios(withoutCaches, skeletonBytes);
  constants.skeletonSeconds = FitRatios(withoutStart, skeletonSeconds);
  constants.skeletonKept = FitKept(folder, samples, constants);
  constants.pageBytes = FitRatios(peakTerms, pageBytes);
  constants.pageSeconds = FitRatios(pageTerms, pageSeconds);
  return constants;
}

/** Foretold over measured: one row each, then the extremes. */
void
PrintTable(const char *                  what,
           const std::vector<CostTask> & tasks,
           const CostSamples &           samples,
           const CostConstants &         constants)
{
  double bytesLeast = 1;
  double bytesMost = 1;
  double secondsLeast = 1;
  double secondsMost = 1;
  std::printf(
    "%s\n\n| job | MB foretold | measured | quotient | s foretold | measured | quotient |\n"
    "| --- | --- | --- | --- | --- | --- | --- |\n",
    what);
  for (const CostTask & task : tasks)
  {
    const JobCost        measured = samples.Cost(task);
    const CostPrediction foretold = PredictJob(CountScan(task.scan), OptionsOf(task.job), task.threads, constants);
    const double         bytes = static_cast<double>(foretold.memoryBytes) / measured.bytes;
    const double         seconds = foretold.seconds / measured.seconds;
    std::printf("| %s | %.0f | %.0f | %.2f | %.2f | %.2f | %.2f |\n",
                task.Key().c_str(),
                static_cast<double>(foretold.memoryBytes) / 1e6,
                measured.bytes / 1e6,
                bytes,
                foretold.seconds,
                measured.seconds,
                seconds);
    bytesLeast = std::min(bytesLeast, bytes);
    bytesMost = std::max(bytesMost, bytes);
    // What `info` prints is to a tenth of a second.
    if (measured.seconds >= 0.25)
    {
      secondsLeast = std::min(secondsLeast, seconds);
      secondsMost = std::max(secondsMost, seconds);
    }
  }
  std::printf("\nfrom %.2f to %.2f of the memory, from %.2f to %.2f of the seconds\n\n",
              bytesLeast,
              bytesMost,
              secondsLeast,
              secondsMost);
}

} // namespace

void
FitSkeletonsAndPages(const fs::path & folder, double limit, int rounds, const std::vector<fs::path> & scans, bool busy)
{
  std::vector<CostTask> all;
  std::vector<CostTask> skeletons;
  std::vector<CostTask> pages;
  const auto            add = [&](const CostTask & task) {
    all.push_back(task);
    (task.job == CostJob::Skeleton ? skeletons : pages).push_back(task);
  };
  for (const CostJob job : { CostJob::Skeleton, CostJob::Page })
  {
    for (const Phantom & phantom : fitted)
    {
      all.push_back(TaskOf(phantom, folder, 1, job));
    }
    for (const Phantom & phantom : fittedMany)
    {
      all.push_back(TaskOf(phantom, folder, 1, job));
    }
    for (const Phantom & phantom : heldOut)
    {
      add(TaskOf(phantom, folder, 1, job));
    }
    for (const fs::path & scan : scans)
    {
      add({ ScanName(scan), scan, 1, job });
      if (!busy)
      {
        add({ ScanName(scan), scan, 2, job });
      }
    }
  }
  for (const auto * phantoms : { &fitted, &fittedMany })
  {
    for (const Phantom & phantom : *phantoms)
    {
      all.push_back(TaskOf(phantom, folder, 1));
    }
  }
  CostSamples samples(folder, VOXELCORE_PROGRAM, busy ? VOXELCORE_CLOCK : "");
  samples.Measure(all, TaskOf(kReference, folder, 1).scan, rounds, limit);
  if (const std::size_t missing = samples.Missing(all); missing > 0)
  {
    std::printf("%zu of %zu jobs have not run yet: call again with the same folder\n", missing, all.size());
    return;
  }
  const CostConstants constants = FitFurther(folder, samples);
  PrintConstants(constants.skeletonBytes);
  PrintConstants(constants.skeletonSeconds);
  PrintConstants(constants.skeletonKept);
  PrintConstants(constants.pageBytes);
  PrintConstants(constants.pageSeconds);
  std::printf("\n");
  PrintTable("Skeletons, constants above", skeletons, samples, constants);
  PrintTable("Pages, constants above", pages, samples, constants);
  PrintTable("Skeletons, constants compiled in", skeletons, samples, FittedCosts());
  PrintTable("Pages, constants compiled in", pages, samples, FittedCosts());
}

} // namespace voxelcore::performance
