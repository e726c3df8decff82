#pragma once
// Small labels of a scan run side by side, one thread each: too small for the threads of one to be worth their start.

#include "voxelcore/Jobs/CoreJob.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace voxelcore
{

/** Boundary vertices up to which a label is small. */
inline constexpr std::uint64_t kSmallLabel = 300000;
/** The most boundary vertices of a group: bounds what its labels need at a time, whatever the number of threads. */
inline constexpr std::uint64_t kGroupVertices = 1500000;

/** Parts labels, in their order, into groups to run one after the other: large labels alone, consecutive small ones
 *  together. Returns where each group ends; the last end is the number of labels. */
std::vector<std::size_t>
GroupLabels(const std::vector<std::uint64_t> & boundaryVertices);

/** One label's computation. */
using LabelWork = std::function<LabelOutcome(std::size_t label, const ProgressCallback & progress)>;

/** Runs `work` for each label of [first, end) on as many threads as there are, one thread for each label; outcomes in
 *  the labels' order. `progress` gets the part of the group's boundary vertices that is done; calls come from several
 *  threads, but never two at a time. When labels fail, throws what the first of them in the labels' order threw: as if
 *  one ran after the other. */
std::vector<LabelOutcome>
ProcessSideBySide(std::size_t                        first,
                  std::size_t                        end,
                  const std::vector<std::uint64_t> & boundaryVertices,
                  const LabelWork &                  work,
                  const ProgressCallback &           progress);

} // namespace voxelcore
