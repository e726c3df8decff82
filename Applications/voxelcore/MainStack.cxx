#include "MainStack.h"

#include <algorithm>
#include <cstddef>

#include <alloca.h>
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
  // One touch at the far end is enough: the system then gives all addresses between, and memory only to that page.
  auto * const farEnd = static_cast<volatile char *>(alloca(size));
  *farEnd = 0;
}

} // namespace voxelcore
