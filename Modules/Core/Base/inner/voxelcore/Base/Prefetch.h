#pragma once
// Memory fetched before it is asked for.

namespace voxelcore
{

/** Has the line of memory at a place, which may be any, fetched into the cache. Changes nothing.
 *
 *  A function that does nothing but __builtin_prefetch counts as one without effects, and GCC leaves out calls of it.
 *  The statement beside it keeps the calls of whatever calls this. */
inline void
FetchLine(const void * place)
{
  __builtin_prefetch(place);
  asm volatile("");
}

} // namespace voxelcore
