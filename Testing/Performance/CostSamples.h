#pragma once
// What runs of `voxelcore core` and `skeleton` took, kept in a file so that several calls on a busy machine add up.

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace voxelcore::performance
{

enum class CostJob
{
  Core,      ///< pruned at 1.5vox
  Tolerance, ///< `core` pruned as without options
  Refined,   ///< `core` without options
  Skeleton,
  Page ///< `core` with its page
};

/** One job to measure. */
struct CostTask
{
  std::string           name;
  std::filesystem::path scan;
  int                   threads;
  CostJob               job = CostJob::Core;

  std::string
  Key() const
  {
    static constexpr std::array<const char *, 5> words{ "", "by tolerance ", "refined ", "skeleton of ", "page of " };
    return words[static_cast<std::size_t>(job)] + name + ", " + std::to_string(threads) +
           (threads == 1 ? " thread" : " threads");
  }
};

/** What a job takes: medians over its samples. */
struct JobCost
{
  double cells; ///< Delaunay cells inside: vertices of the core
  double edges; ///< of the core
  double bytes;
  double seconds; ///< without reading, as if the machine had always been as fast as it mostly was
  double share;   ///< of these seconds: of a skeleton the stage's own, else those of writing
};

/** The speed of a machine whose memory others use as well drifts by half within minutes. So every run stands between
 *  two of a reference shape; what counts are its seconds over theirs. */
class CostSamples
{
public:
  /** Takes up what FOLDER/samples.jsonl holds, if it is of this build of the program. `clock`: preloaded into it. */
  CostSamples(const std::filesystem::path & folder, const std::string & program, const std::string & clock = "");

  /** Runs the tasks in turn, those with the fewest samples first, until each has `rounds` of them or `seconds` have
   *  passed. */
  void
  Measure(const std::vector<CostTask> & tasks, const std::filesystem::path & reference, int rounds, double seconds);

  /** How many of the tasks have no sample yet. */
  std::size_t
  Missing(const std::vector<CostTask> & tasks) const;

  JobCost
  Cost(const CostTask & task) const;

  /** The median of the reference's seconds over all samples. */
  double
  ReferenceSeconds() const;

private:
  struct Sample
  {
    double cells;
    double edges;
    double bytes;
    double seconds;
    double share;
    double reference;
  };

  Sample
  Run(const std::filesystem::path & scan, int threads, CostJob job) const;

  std::filesystem::path                      m_Folder;
  std::filesystem::path                      m_File;
  std::string                                m_Program;
  std::string                                m_Clock;
  std::map<std::string, std::vector<Sample>> m_Samples; ///< by task
};

} // namespace voxelcore::performance
