#include "voxelcore/CostModel.h"

#include "ParameterReader.h"
#include "SideBySide.h"
#include "voxelcore/Error.h"
#include "voxelcore/OutputNames.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <omp.h>

namespace voxelcore
{

namespace
{

// Printed by VoxelCoreCostFit.
constexpr CostConstants kFitted{
  { 3.02e7, 108, 72.6, 83.7, 12.6, 11.8 },
  { 0.00417, 0, 3.25e-7, 6.37e-7, 1.05e-6, 3.83e-7 },
  0.6,
};

// Bytes a border voxel, measured on phantoms and atlases: small beside the above, so not fitted.
constexpr double kThreadBytes = 2e6;    // scratch of each thread beyond the first
constexpr double kWholeCoreBytes = 180; // of a whole core kept until it is written, and its writing
constexpr double kPrunedBytes = 65;     // of a pruned one
constexpr double kFurtherBytes = 50;    // of each further result at the peak of a label
constexpr double kEdgeBytes = 40;       // of --keep-edges
constexpr double kBumpBytes = 70;       // of bump heights
constexpr double kTetgenBytes = 1050;   // TetGen's mesh
constexpr double kTetgenSeconds = 6e-5;
constexpr double kFurtherSeconds = 8e-7; // of each further result
constexpr double kBumpSeconds = 8e-6;
constexpr double kRefineBytes = 700; // the band of the field, and what is kept of the whole core
constexpr double kRefineSeconds = 4e-5;
constexpr double kSkeletonBytes = 450;
constexpr double kSkeletonDeepBytes = 60; // an inner voxel
constexpr double kSkeletonSeconds = 3e-5;

double
Sum(const CostTerms & terms, const std::array<double, CostTerms::kSize> & constants)
{
  double sum = 0;
  for (std::size_t i = 0; i < CostTerms::kSize; ++i)
  {
    sum += terms.values[i] * constants[i];
  }
  return sum;
}

double
WithThreads(double seconds, int threads)
{
  return seconds * (kFitted.serial + (1 - kFitted.serial) / threads);
}

/** Beyond the program itself, which is the model's first term. */
struct LabelCost
{
  double bytes = 0;
  double kept = 0; ///< bytes of the results until they are written
  double seconds = 0;
};

LabelCost
CostOfLabel(const BoundaryCounts & counts, const CoreOptions & options)
{
  CostTerms terms = ComputeCostTerms(counts);
  terms.values[0] = 0;
  const auto   border = static_cast<double>(counts.borderVoxels);
  const double results = static_cast<double>(std::max(options.lambdas.size(), options.bumps.size()));
  const bool   tetgen = options.engine == Engine::TetGen || options.crossCheck;
  LabelCost    cost;
  cost.bytes = Sum(terms, kFitted.bytes) + border * (results - 1) * kFurtherBytes;
  cost.seconds = Sum(terms, kFitted.seconds) + border * (results - 1) * kFurtherSeconds;
  for (std::size_t i = 0; i < static_cast<std::size_t>(results); ++i)
  {
    const bool whole = options.bumps.empty() && options.lambdas[i].value == 0;
    cost.kept += border * ((whole ? kWholeCoreBytes : kPrunedBytes) + (options.model.keepEdges ? kEdgeBytes : 0));
  }
  if (options.model.keepEdges)
  {
    cost.bytes += border * kEdgeBytes;
  }
  if (!options.bumps.empty())
  {
    cost.bytes += border * kBumpBytes;
    cost.seconds += border * kBumpSeconds;
  }
  if (!options.refine.surface.empty())
  {
    cost.bytes += border * kRefineBytes;
    cost.seconds += border * kRefineSeconds;
  }
  if (tetgen)
  {
    cost.bytes = std::max(cost.bytes, border * kTetgenBytes);
    cost.seconds += border * kTetgenSeconds;
  }
  if (options.skeleton)
  {
    const double deep = static_cast<double>(counts.voxels - counts.borderVoxels);
    cost.bytes += border * kSkeletonBytes + deep * kSkeletonDeepBytes;
    cost.seconds += border * kSkeletonSeconds;
  }
  return cost;
}

} // namespace

CostTerms
ComputeCostTerms(const BoundaryCounts & counts)
{
  const auto border = static_cast<double>(counts.borderVoxels);
  const auto inner = static_cast<double>(counts.voxels - counts.borderVoxels);
  const auto flat = static_cast<double>(counts.flatVertices);
  return { { 1,
             border,
             static_cast<double>(counts.vertices) - flat,
             std::min(flat, std::max(0.0, inner - 4 * border)),
             std::min(inner, 4 * border),
             border * std::max(0.0, std::log2(border / 1000)) } };
}

const CostConstants &
FittedCosts()
{
  return kFitted;
}

CostPrediction
PredictLabel(const BoundaryCounts & counts, int threads)
{
  const CostTerms terms = ComputeCostTerms(counts);
  return { static_cast<std::uint64_t>(Sum(terms, kFitted.bytes) + kThreadBytes * (threads - 1)),
           WithThreads(Sum(terms, kFitted.seconds), threads) };
}

std::vector<BoundaryCounts>
CountBoundaries(const std::vector<EditedLabel> & labels)
{
  std::vector<BoundaryCounts> counts(labels.size());
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    counts[i] = CountBoundary(labels[i].label.shape);
  }
  return counts;
}

CostPrediction
PredictJob(const std::vector<BoundaryCounts> & labels, const CoreOptions & options, int threads)
{
  const bool                 together = options.engine != Engine::TetGen && !options.crossCheck && threads > 1;
  std::vector<LabelCost>     costs;
  std::vector<std::uint64_t> vertices;
  for (const BoundaryCounts & counts : labels)
  {
    costs.push_back(CostOfLabel(counts, options));
    // One by one, every label counts as large.
    vertices.push_back(together && labels.size() > 1 ? counts.vertices : kSmallLabel + 1);
  }
  const bool  keeps = !IsFolderOutput(options.output);
  double      peak = 0;
  double      kept = 0;
  double      seconds = kFitted.seconds[0];
  std::size_t first = 0;
  for (const std::size_t end : GroupLabels(vertices))
  {
    std::vector<double> bytes;
    double              group = 0;
    double              largest = 0;
    double              results = 0;
    for (std::size_t label = first; label < end; ++label)
    {
      bytes.push_back(costs[label].bytes);
      group += costs[label].seconds;
      largest = std::max(largest, costs[label].seconds);
      results += costs[label].kept;
    }
    // As many at a time as there are threads; the largest ones run first.
    const auto atATime = std::min(bytes.size(), static_cast<std::size_t>(threads));
    std::partial_sort(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(atATime), bytes.end(), std::greater());
    double running = 0;
    for (std::size_t i = 0; i < atATime; ++i)
    {
      running += bytes[i];
    }
    peak = std::max({ peak, kept + running, kept + results });
    kept = keeps ? kept + results : 0;
    seconds += end - first == 1 ? WithThreads(group, threads) : std::max(largest, group / threads);
    first = end;
  }
  peak += kFitted.bytes[0] + kThreadBytes * (threads - 1);
  return { static_cast<std::uint64_t>(peak), seconds };
}

std::uint64_t
ParseMemory(const std::string & text)
{
  static constexpr std::string_view letters = "kmgt";
  const auto                        refuse = [&]() -> std::uint64_t {
    throw UsageError("--memory " + text + ": give an amount with its unit, such as 8GB or 500MB");
  };
  const std::size_t numberEnds = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto        value = ParseReal(text.substr(0, numberEnds));
  const std::size_t unitBegins = std::min(text.find_first_not_of(' ', numberEnds), text.size());
  std::string       unit = text.substr(unitBegins);
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  if (!value || !(*value > 0) || unit.empty() || unit.back() != 'b')
  {
    return refuse();
  }
  double            bytes = *value;
  const std::size_t power = letters.find(unit.front());
  if (unit != "b")
  {
    const bool binary = unit.size() == 3 && unit[1] == 'i';
    if (power == std::string_view::npos || (unit.size() != 2 && !binary))
    {
      return refuse();
    }
    bytes *= std::pow(binary ? 1024.0 : 1000.0, static_cast<double>(power + 1));
  }
  return bytes >= 1 && bytes < 9e18 ? static_cast<std::uint64_t>(bytes) : refuse();
}

std::string
MemoryText(std::uint64_t bytes)
{
  const double megabytes = static_cast<double>(bytes) / 1e6;
  char         text[40];
  if (megabytes < 1000)
  {
    std::snprintf(text, sizeof(text), "%.0f MB", std::ceil(megabytes));
  }
  else
  {
    std::snprintf(text, sizeof(text), "%.1f GB", std::ceil(megabytes / 100) / 10);
  }
  return text;
}

} // namespace voxelcore
