#pragma once
// Independent work at the same time.

#include <cstddef>
#include <functional>

namespace voxelcore
{

/** Calls both, in two threads when it is worth it and OpenMP has a second one to give, the first in the calling thread;
 *  otherwise one after the other. What either throws is thrown on, the first one's first. */
void
RunBoth(bool worthIt, const std::function<void()> & first, const std::function<void()> & second);

/** Cuts 0 .. count - 1 into as many parts as OpenMP has threads to give, or into one when that is not worth it, and
 *  calls work(first, last) for items first to last - 1 of each part, side by side. For loops that look ahead at data
 *  which they change, or that hold a part of the results for themselves. What one throws is thrown on, that of the
 *  first part first. */
void
RunInParts(bool worthIt, std::size_t count, const std::function<void(std::size_t first, std::size_t last)> & work);

/** Calls work(0) to work(count - 1) on as many threads as OpenMP has to give, each taking the next item when it has
 *  done one: for items of different size. Calls done(n) when n are done, from one thread at a time. Whatever one of
 *  these throws lets no further item begin and is thrown on, that of the first item first. */
void
RunEach(std::size_t                                     count,
        const std::function<void(std::size_t item)> &   work,
        const std::function<void(std::size_t number)> & done = {});

} // namespace voxelcore
