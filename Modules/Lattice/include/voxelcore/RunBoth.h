#pragma once
// Two independent pieces of work at the same time.

#include <functional>

namespace voxelcore
{

/** Calls both, in two threads when it is worth it and OpenMP has a second one to give, the first in the calling thread;
 *  otherwise one after the other. What either throws is thrown on, the first one's first. */
void
RunBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second);

} // namespace voxelcore
