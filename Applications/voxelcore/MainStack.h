#pragma once
// Room on the stacks of threads.

#include <functional>

namespace voxelcore
{

/** Makes the main thread's stack a megabyte now, or a quarter of what the system allows. Otherwise it
 *  grows when it must, and where memory is used up that ends the program without a word. An array that finds no room
 *  is an error that can be reported. */
void
ReserveMainStack();

/** Calls `work`, in a thread of its own where the system gives the main thread less than threads need, and sees to it
 *  that threads begun from now on have as much. \throws UsageError where OMP_STACKSIZE gives OpenMP's threads less,
 *  which cannot be changed any more. */
int
RunWithStack(const std::function<int()> & work);

} // namespace voxelcore
