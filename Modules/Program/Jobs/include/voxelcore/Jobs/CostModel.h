#pragma once
// What `voxelcore core`, `skeleton` and a page will need, foretold from the shapes alone. Counts of the boundary tell
// how many Delaunay cells there will be, and these what a job costs; all of it is linear, with constants fitted by
// Testing/Performance (VoxelCoreCostFit, and VoxelCoreCostFit --further for skeletons and pages), which prints them and
// how far they miss. On shapes not fitted to, memory of skeletons was 0.96 to 1.2 times what was measured, of pages 0.7
// to 1.5 times; seconds on one thread 0.7 to 1.5 and 0.7 to 1.4 times, but for the skeleton of a thin plate (2.0).

#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Shape/BoundaryCounts.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace voxelcore
{

/** What memory and time grow with, of one shape. */
struct CostTerms
{
  static constexpr std::size_t kSize = 6;
  /** 1; boundary vertices; Delaunay cells expected; the boundary of parts so thick that their cells are found by a
   *  tree of points, and of this the flat part, all of whose vertices are in the tree, of the rest a fifth; the
   *  core's edges expected times the doublings of their number over 1000, as caches miss more. */
  std::array<double, kSize> values{};
};

/** What cells and edges grow with: border voxels by their boundary corners: flat ones; those with few; those with a
 *  Delaunay cell of their own, but for those with all eight; the latter. */
using BorderKinds = std::array<double, 4>;

/** What a page's cost grows with, of one shape: 1; boundary vertices, as its surface is shown; edges of the core
 *  shown. */
using PageTerms = std::array<double, 3>;

/** The fitted constants. Seconds are those of the machine named in Testing/Performance/Forecasts.md; another may be
 *  twice as fast or half. */
struct CostConstants
{
  BorderKinds                          cells{};    ///< Delaunay cells for each border voxel of a kind
  BorderKinds                          edges{};    ///< edges of the core likewise
  std::array<double, CostTerms::kSize> bytes{};    ///< at the peak of one label, one thread
  std::array<double, CostTerms::kSize> seconds{};  ///< one thread, without reading
  double                               serial = 0; ///< part of the seconds that more threads do not shorten
  // Of pruning by tolerance instead of by lambda, and of refinement from labels beside it: what they add.
  std::array<double, CostTerms::kSize> toleranceBytes{};
  std::array<double, CostTerms::kSize> toleranceSeconds{};
  std::array<double, CostTerms::kSize> refineBytes{};
  std::array<double, CostTerms::kSize> refineSeconds{};

  // More threads do several labels at a time, but make no single label of a page faster.
  std::array<double, CostTerms::kSize> skeletonBytes{};   ///< at the peak of a job with a skeleton of one label
  std::array<double, CostTerms::kSize> skeletonSeconds{}; ///< of the skeleton alone
  std::array<double, 2>                skeletonKept{};    ///< bytes a label, and a vertex of it, until all are written
  PageTerms                            pageBytes{};       ///< at the peak of a job with a page
  PageTerms                            pageSeconds{};     ///< of the page alone
};

const CostConstants &
FittedCosts();

BorderKinds
CountBorderKinds(const BoundaryCounts & counts);

CostTerms
ComputeCostTerms(const BoundaryCounts & counts, const CostConstants & constants = FittedCosts());

/** `whole`: the core shown is not pruned. */
PageTerms
ComputePageTerms(const BoundaryCounts & counts, bool whole, const CostConstants & constants = FittedCosts());

struct CostPrediction
{
  std::uint64_t memoryBytes = 0; ///< peak of the whole process
  double        seconds = 0;     ///< wall clock, without reading
};

/** One label by itself, pruned once. */
CostPrediction
PredictLabel(const BoundaryCounts & counts, int threads, const CostConstants & constants = FittedCosts());

/** A whole job over labels, in the order given, as RunCoreJob goes about it: small labels side by side, results kept
 *  until they are written. Takes from `options` what decides cost: number of results, output, edges, engine, skeleton,
 *  page. With TetGen the figures are coarse (within a factor of two). */
CostPrediction
PredictJob(const std::vector<BoundaryCounts> & labels,
           const CoreOptions &                 options,
           int                                 threads,
           const CostConstants &               constants = FittedCosts());

/** The counts of each label's shape, on all threads. */
std::vector<BoundaryCounts>
CountBoundaries(const std::vector<EditedLabel> & labels);

/** Those of the bodies whose curves a skeleton has: they go on beyond the border of a scan that cuts them. */
std::vector<BoundaryCounts>
CountBoundariesUpToBorder(const std::vector<EditedLabel> & labels,
                          const ImageGeometry &            geometry,
                          const VoxelBox &                 scan,
                          const SkeletonRequest &          request);

/** "8GB", "500 MB", "1.5GiB": bytes. Units B, kB, MB, GB, TB (powers of 1000) and KiB, MiB, GiB, TiB, in any case.
 *  \throws UsageError, naming --memory, for anything else; a unit must be given. */
std::uint64_t
ParseMemory(const std::string & text);

/** For people: "850 MB", "2.1 GB". */
std::string
MemoryText(std::uint64_t bytes);

} // namespace voxelcore
