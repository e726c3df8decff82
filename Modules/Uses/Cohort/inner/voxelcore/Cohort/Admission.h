#pragma once
// How a case asks its batch for memory: when it has read its scan and knows what it will need, and before it takes it.

#include <functional>

namespace voxelcore
{

/** Environment variable that holds the descriptor of a case's line to its batch. */
inline constexpr const char * kAdmissionVariable = "VOXELCORE_BATCH_CHANNEL";

/** In a process that a batch has started: asks for so many MB and waits until they are granted. An empty function in
 *  any other process. `stop` is asked now and then whether to give up; then it throws Cancelled. */
std::function<void(double)>
AdmissionFromEnvironment(std::function<bool()> stop);

} // namespace voxelcore
