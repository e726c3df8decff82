#include "VtpPacking.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <omp.h>

#include <atomic>
#include <bit>
#include <cstdint>
#include <future>
#include <vector>

namespace voxelcore
{

static_assert(std::endian::native == std::endian::little, "files are little endian");

std::string
PackVtpArray(std::string_view bytes)
{
  constexpr std::size_t    blockSize = std::size_t{ 1 } << 20; // many for the threads, and streams lose 1 % to it
  const std::size_t        count = (bytes.size() + blockSize - 1) / blockSize;
  std::vector<std::string> streams(count);
  FirstFailure             failure;
  std::atomic<std::size_t> next = 0;
  const auto               work = [&] {
    for (std::size_t block = next++; block < count; block = next++)
    {
      failure.Guard(block, [&] { streams[block] = Deflate(bytes.substr(block * blockSize, blockSize)); });
    }
  };
  {
    // OpenMP has none in a process that was forked, and would wait for them.
    std::vector<std::future<void>> others;
    for (std::size_t i = 1; i < count && i < static_cast<std::size_t>(omp_get_max_threads()); ++i)
    {
      others.push_back(std::async(std::launch::async, work));
    }
    work();
  }
  failure.Rethrow();
  std::vector<std::uint64_t> head{ count, blockSize, bytes.size() % blockSize };
  for (const std::string & stream : streams)
  {
    head.push_back(stream.size());
  }
  std::string packed(reinterpret_cast<const char *>(head.data()), head.size() * sizeof(head[0]));
  for (std::string & stream : streams)
  {
    packed += stream;
    stream = {};
  }
  return packed;
}

} // namespace voxelcore
