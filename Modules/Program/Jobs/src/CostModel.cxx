#include "voxelcore/Jobs/CostModel.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/ParseReal.h"
#include "voxelcore/Jobs/LabelGroups.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numeric>

namespace voxelcore
{

namespace
{

// Printed by VoxelCoreCostFit.
constexpr CostConstants kFitted{
  { 0.503, 1.37, 1.34, 0.998 },
  { 0.992, 2.63, 3.29, 1.3 },
  { 3.94e7, 0, 125, 21.2, 88.5, 0 },
  { 0, 5.2e-7, 1.41e-6, 8.84e-7, 7.99e-7, 8.24e-9 },
  0.25,
  { 0, 0, 129, 0, 0, 0 },
  { 0, 1.14e-7, 0, 0, 0, 4.39e-8 },
  { 0, 62.9, 31.8, 0, 199, 0 },
  { 0, 6.25e-7, 5.3e-6, 0, 7.85e-6, 0 },
  // By VoxelCoreCostFit --further.
  { 3.54e7, 0, 483, 116, 13.8, 0 },
  { 0, 0, 0, 0, 0, 2.34e-7 },
  { 2.15e3, 58.4 },
  { 4.34e7, 152, 212 },
  { 0, 2.28e-6, 0 },
};

// Bytes a border voxel, where nothing else is said, measured on phantoms and atlases: small beside the above, so not
// fitted.
constexpr double kThreadBytes = 2e6;    // scratch of each thread beyond the first
constexpr double kWholeCoreBytes = 200; // a boundary vertex: of a whole core kept until it is written, and its writing
// Results of one file, kept until all are written, and their writing. Measured on four atlases, a scan of all organs
// and two phantoms of many labels: the first three were 103 to 115, 38 to 51 and 57 to 89 there.
constexpr double kPrunedBytes = 104;   // an edge of a core pruned by lambda
constexpr double kToleranceBytes = 43; // an edge of the whole core, pruned by tolerance
constexpr double kRefinedBytes = 73;   // likewise, refined as well
constexpr double kLabelBytes = 8e3;    // a label, whatever its size
constexpr double kFurtherBytes = 50;   // of each further result at the peak of a label
constexpr double kEdgeBytes = 40;      // of --keep-edges
constexpr double kTetgenBytes = 1050;  // TetGen's mesh
constexpr double kTetgenSeconds = 6e-5;
constexpr double kFurtherSeconds = 8e-7; // of each further result

template <std::size_t n>
double
Sum(const std::array<double, n> & terms, const std::array<double, n> & constants)
{
  return std::inner_product(terms.begin(), terms.end(), constants.begin(), 0.0);
}

double
WithThreads(double seconds, int threads, double serial)
{
  return seconds * (serial + (1 - serial) / threads);
}

/** Edges left of a core pruned at 1.5vox: about one for each border voxel, of sheets three voxels thick for each inner
 *  one; of what is thinner a tenth of all. */
double
PrunedEdges(const BoundaryCounts & counts, const CostConstants & constants)
{
  return static_cast<double>(std::min(counts.voxels - counts.borderVoxels, counts.borderVoxels)) +
         0.1 * Sum(CountBorderKinds(counts), constants.edges);
}

/** Beyond the program itself, which is the model's first term. */
struct LabelCost
{
  double bytes = 0;
  double kept = 0; ///< bytes of the results until they are written
  double seconds = 0;
  double skeletonSeconds = 0;
};

bool
ShowsWhole(const CoreOptions & options)
{
  return options.tolerances.empty() && options.lambdas.front().value == 0;
}

LabelCost
CostOfLabel(const BoundaryCounts & counts, const CoreOptions & options, const CostConstants & constants)
{
  CostTerms terms = ComputeCostTerms(counts, constants);
  terms.values[0] = 0;
  const auto   border = static_cast<double>(counts.borderVoxels);
  const double results = static_cast<double>(std::max(options.lambdas.size(), options.tolerances.size()));
  const bool   tetgen = options.engine == Engine::TetGen || options.crossCheck;
  LabelCost    cost;
  cost.bytes = Sum(terms.values, constants.bytes) + border * (results - 1) * kFurtherBytes;
  cost.seconds = Sum(terms.values, constants.seconds) + border * (results - 1) * kFurtherSeconds;
  // Of a skeleton alone no core is kept.
  for (std::size_t i = 0; !options.output.empty() && i < static_cast<std::size_t>(results); ++i)
  {
    const bool whole = options.tolerances.empty() && options.lambdas[i].value == 0;
    cost.kept += kLabelBytes;
    if (!options.tolerances.empty())
    {
      cost.kept += Sum(CountBorderKinds(counts), constants.edges) *
                   (options.refine.surface.empty() ? kToleranceBytes : kRefinedBytes);
    }
    else
    {
      cost.kept +=
        whole ? static_cast<double>(counts.vertices) * kWholeCoreBytes : PrunedEdges(counts, constants) * kPrunedBytes;
    }
    cost.kept += options.model.keepEdges ? border * kEdgeBytes : 0;
  }
  if (options.model.keepEdges)
  {
    cost.bytes += border * kEdgeBytes;
  }
  if (!options.tolerances.empty())
  {
    cost.bytes += Sum(terms.values, constants.toleranceBytes);
    cost.seconds += Sum(terms.values, constants.toleranceSeconds);
  }
  if (!options.refine.surface.empty())
  {
    cost.bytes += Sum(terms.values, constants.refineBytes);
    cost.seconds += Sum(terms.values, constants.refineSeconds);
  }
  if (tetgen)
  {
    cost.bytes = std::max(cost.bytes, border * kTetgenBytes);
    cost.seconds += border * kTetgenSeconds;
  }
  if (options.skeleton)
  {
    const double start = constants.skeletonBytes[0] - constants.bytes[0];
    cost.bytes = std::max(cost.bytes, start + Sum(terms.values, constants.skeletonBytes));
    cost.kept += constants.skeletonKept[0] + constants.skeletonKept[1] * static_cast<double>(counts.vertices);
    cost.skeletonSeconds = Sum(terms.values, constants.skeletonSeconds);
  }
  return cost;
}

} // namespace

BorderKinds
CountBorderKinds(const BoundaryCounts & counts)
{
  return { static_cast<double>(counts.flatVoxels),
           static_cast<double>(counts.borderVoxels - counts.cellVoxels - counts.flatVoxels),
           static_cast<double>(counts.cellVoxels - counts.fullVoxels),
           static_cast<double>(counts.fullVoxels) };
}

CostTerms
ComputeCostTerms(const BoundaryCounts & counts, const CostConstants & constants)
{
  const BorderKinds kinds = CountBorderKinds(counts);
  const double      edges = Sum(kinds, constants.edges);
  const auto        deep = static_cast<double>(counts.cubes15 - counts.cubes17);
  return { { 1,
             static_cast<double>(counts.vertices),
             Sum(kinds, constants.cells),
             deep,
             std::min(deep, static_cast<double>(counts.evenVoxels)),
             edges * std::log2(std::max(1.0, edges / 1000)) } };
}

PageTerms
ComputePageTerms(const BoundaryCounts & counts, bool whole, const CostConstants & constants)
{
  return { 1,
           static_cast<double>(counts.vertices),
           whole ? Sum(CountBorderKinds(counts), constants.edges) : PrunedEdges(counts, constants) };
}

const CostConstants &
FittedCosts()
{
  return kFitted;
}

CostPrediction
PredictLabel(const BoundaryCounts & counts, int threads, const CostConstants & constants)
{
  const CostTerms terms = ComputeCostTerms(counts, constants);
  return { static_cast<std::uint64_t>(Sum(terms.values, constants.bytes) + kThreadBytes * (threads - 1)),
           WithThreads(Sum(terms.values, constants.seconds), threads, constants.serial) };
}

std::vector<BoundaryCounts>
CountBoundaries(const std::vector<EditedLabel> & labels)
{
  std::vector<BoundaryCounts> counts(labels.size());
  RunEach(labels.size(), [&](std::size_t i) { counts[i] = CountBoundary(labels[i].label.shape); });
  return counts;
}

std::vector<BoundaryCounts>
CountBoundariesUpToBorder(const std::vector<EditedLabel> & labels,
                          const ImageGeometry &            geometry,
                          const VoxelBox &                 scan,
                          const SkeletonRequest &          request)
{
  std::vector<BoundaryCounts> counts(labels.size());
  RunEach(labels.size(), [&](std::size_t i) {
    counts[i] = CountBoundary(UpToBorder(labels[i].label.shape, geometry, scan, request).shape);
  });
  return counts;
}

CostPrediction
PredictJob(const std::vector<BoundaryCounts> & labels,
           const CoreOptions &                 options,
           int                                 threads,
           const CostConstants &               constants)
{
  const bool                 together = options.engine != Engine::TetGen && !options.crossCheck && threads > 1;
  std::vector<LabelCost>     costs;
  std::vector<std::uint64_t> vertices;
  for (const BoundaryCounts & counts : labels)
  {
    costs.push_back(CostOfLabel(counts, options, constants));
    // One by one, every label counts as large.
    vertices.push_back(together && labels.size() > 1 ? counts.vertices : kSmallLabel + 1);
  }
  const bool  isShown = options.display.html || options.display.scene;
  const bool  keeps = isShown || !IsFolderOutput(options.output.empty() ? options.skeletonOutput : options.output);
  double      peak = 0;
  double      kept = 0;
  double      seconds = constants.seconds[0];
  std::size_t first = 0;
  for (const std::size_t end : GroupLabels(vertices))
  {
    std::vector<double> bytes;
    double              group = 0;
    double              largest = 0;
    double              results = 0;
    double              skeletons = 0;
    for (std::size_t label = first; label < end; ++label)
    {
      bytes.push_back(costs[label].bytes);
      group += costs[label].seconds;
      skeletons += costs[label].skeletonSeconds;
      largest = std::max(largest, costs[label].seconds + costs[label].skeletonSeconds);
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
    seconds += end - first == 1 ? WithThreads(group + skeletons, threads, constants.serial)
                                : std::max(largest, (group + skeletons) / threads);
    first = end;
  }
  if (options.display.html)
  {
    double pageBytes = constants.pageBytes[0];
    double pageSeconds = 0;
    double longest = 0;
    for (const BoundaryCounts & counts : labels)
    {
      PageTerms page = ComputePageTerms(counts, ShowsWhole(options), constants);
      page[0] = 0;
      pageBytes += Sum(page, constants.pageBytes);
      pageSeconds += Sum(page, constants.pageSeconds);
      longest = std::max(longest, Sum(page, constants.pageSeconds));
    }
    peak = std::max(peak, pageBytes - constants.bytes[0]);
    seconds += constants.pageSeconds[0] + std::max(longest, pageSeconds / threads);
  }
  peak += constants.bytes[0] + kThreadBytes * (threads - 1);
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
  if (megabytes < 1)
  {
    (void)std::snprintf(text, sizeof(text), "%.0f kB", std::ceil(1000 * megabytes));
  }
  else if (megabytes < 1000)
  {
    (void)std::snprintf(text, sizeof(text), "%.0f MB", std::ceil(megabytes));
  }
  else
  {
    (void)std::snprintf(text, sizeof(text), "%.1f GB", std::ceil(megabytes / 100) / 10);
  }
  return text;
}

} // namespace voxelcore
