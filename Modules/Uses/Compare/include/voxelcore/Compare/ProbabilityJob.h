#pragma once
// `voxelcore skeleton --probability`: certified trees of a map of probabilities over thresholds, the life of each
// branch, and one tree of what is stable (BranchLives.h).

#include "voxelcore/Compare/BranchLives.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Jobs/SkeletonJob.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct ProbabilityOptions
{
  SkeletonOptions     making;     ///< the map is its input; what it writes is of the tree that is chosen
  std::vector<double> thresholds; ///< ParseThresholds()
  double              persistence = 0;
};

/** "0.3,0.4": from above 0 to 1, each once; gives them rising. \throws UsageError, also unless there are 2 to 100 */
std::vector<double>
ParseThresholds(std::string_view text);

/** What a stored value is divided by, 1 or 255, from what is known of all values. \throws InputError, naming the map
 *  `where`, when they are no probabilities */
double
ProbabilityScale(double least, double greatest, bool areWhole, const std::string & where);

/** What is found at a threshold. */
struct ThresholdRecord
{
  double          threshold = 0;
  std::uint64_t   voxels = 0; ///< that reach it
  TopologyNumbers topology;   ///< of the shape, with its edits, and of the tree
  std::size_t     branches = 0;
  double          length = 0;
  std::size_t     stableBranches = 0;
  double          stableLength = 0;
  bool            isChosen = false;
};

struct ProbabilityResult : SkeletonResult
{
  std::vector<ThresholdRecord> thresholds;
};

/** Values are 0 to 1, or, where one is more than 1, whole numbers from 0 to 255 that stand for them. A voxel belongs to
 *  the shape of a threshold when its value is at least that, both as float32. "OUT.vtp" gets the tree of the threshold
 *  that StablestThreshold() gives, without pieces that hold no stable branch and without ends that are not stable:
 *  its topology is that of the shape without these pieces. "OUT_threshold-0.3.vtp" and so on get the tree at each
 *  threshold that any voxel reaches, "OUT_thresholds.csv" the numbers of ThresholdRecord. All are certified, and lives
 *  are checked by FindWrongLife(), or nothing is written.
 *  \throws UsageError, InputError, OutputError, CertificateError, Cancelled */
ProbabilityResult
RunProbabilityJob(const ProbabilityOptions & options, const JobContext & context = {});

/** A row per threshold. */
std::string
ThresholdsText(const ProbabilityResult & result);

} // namespace voxelcore
