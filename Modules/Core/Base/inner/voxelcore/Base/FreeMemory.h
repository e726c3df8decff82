#pragma once
// Memory that was freed and is kept for the next.

namespace voxelcore
{

/** Gives what small arrays have freed, of all threads, back to the system, where it can be told to: what one stage took
 *  in many small pieces is no use to the next when that takes a few large ones. */
void
GiveBackFreeMemory();

} // namespace voxelcore
