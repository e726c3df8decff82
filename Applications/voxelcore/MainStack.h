#pragma once
// Room on the main thread's stack.

namespace voxelcore
{

/** Makes the main thread's stack a megabyte now, or a quarter of what the system allows. Otherwise it
 *  grows when it must, and where memory is used up that ends the program without a word. An array that finds no room
 *  is an error that can be reported. */
void
ReserveMainStack();

} // namespace voxelcore
