// Loaded with the program by LD_PRELOAD: sends it a signal before main().

#include <csignal>
#include <cstdlib>

namespace
{

[[gnu::constructor]] void
SendSignal()
{
  if (const char * const signal = std::getenv("VOXELCORE_TEST_SIGNAL"))
  {
    std::raise(std::atoi(signal)); // NOLINT(cert-err34-c): 0 sends none
  }
}

} // namespace
