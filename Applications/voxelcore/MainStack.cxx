#include "MainStack.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <thread>

#include <alloca.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace voxelcore
{

namespace
{

// Of the system's usual 8 MB so much is enough for every thread, measured with room to spare.
constexpr std::size_t kStack = std::size_t{ 2 } << 20U;

/** As OpenMP reads it: a whole number, then B, K, M or G; kilobytes where there is none. What makes no sense it passes
 *  over. */
std::size_t
BytesOf(const char * text)
{
  char *                   end = nullptr;
  const unsigned long long number = std::strtoull(text, &end, 10);
  const auto               letter = std::find_if(end, end + std::strlen(end), [](char c) { return c != ' '; });
  const std::string_view   units("BKMG");
  const std::size_t        unit =
    *letter == 0 ? 1 : units.find(static_cast<char>(std::toupper(static_cast<unsigned char>(*letter))));
  return end == text || unit == std::string_view::npos || number >= 1U << 20U ? SIZE_MAX : number << (10 * unit);
}

} // namespace

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

int
RunWithStack(const std::function<int()> & work)
{
  for (const char * name : { "OMP_STACKSIZE", "GOMP_STACKSIZE" })
  {
    const char * const text = std::getenv(name);
    if (text != nullptr && BytesOf(text) < kStack)
    {
      throw UsageError(std::string(name) + "=" + text + ": threads need stacks of " + std::to_string(kStack >> 20U) +
                       " MB; unset it, or set it to " + std::to_string(kStack >> 20U) + "M or more");
    }
  }
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  std::size_t usual = 0;
  pthread_getattr_default_np(&attributes);
  pthread_attr_getstacksize(&attributes, &usual);
  int code = 0;
  if (usual < kStack) // by RLIMIT_STACK, as for the main thread
  {
    pthread_attr_setstacksize(&attributes, kStack);
    pthread_setattr_default_np(&attributes);
    std::exception_ptr failure;
    std::thread([&] {
      try
      {
        code = work();
      }
      catch (...)
      {
        failure = std::current_exception();
      }
    }).join();
    if (failure)
    {
      std::rethrow_exception(failure);
    }
  }
  else
  {
    code = work();
  }
  pthread_attr_destroy(&attributes);
  return code;
}

} // namespace voxelcore
