#pragma once
// How long a batch will still take.

#include <cstddef>
#include <optional>
#include <vector>

namespace voxelcore
{

/** Seconds that cases like those that have finished will still need: each case that waits takes their median, each that
 *  runs what it lacks of it, `atATime` of them side by side. None before the first has finished. While no case ends it
 *  never rises. */
std::optional<double>
SecondsLeft(std::vector<double>         finishedSeconds,
            const std::vector<double> & runningSeconds,
            std::size_t                 waiting,
            std::size_t                 atATime);

} // namespace voxelcore
