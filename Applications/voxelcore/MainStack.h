#pragma once
// Room on the main thread's stack.

namespace voxelcore
{

/** Makes the main thread's stack a megabyte now, or a quarter of what the system allows. It grows by itself else, and
 *  where memory is limited and used up, its growing ends the program without a word, while an array that finds no
 *  place is an error that can be told. */
void
ReserveMainStack();

} // namespace voxelcore
