#include "MainStack.h"

#include <algorithm>
#include <cstddef>

#include <alloca.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace voxelcore
{

void
ReserveMainStack()
{
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0)
  {
    return;
  }
  constexpr rlim_t  enough = rlim_t{ 1 } << 20;
  const std::size_t size = std::min(enough, limit.rlim_cur / 4);
  // Where there is no room even for that, the touch would be the end; the first array will say what is wrong.
  void * const room = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED)
  {
    return;
  }
  munmap(room, size);
  // One touch at the far end is enough: the system then gives all addresses between, and memory only to that page.
  auto * const farEnd = static_cast<volatile char *>(alloca(size));
  *farEnd = 0;
}

} // namespace voxelcore
