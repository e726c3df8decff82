#include "voxelcore/Base/FreeMemory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#ifdef __GLIBC__
#  include <unistd.h>
#endif

namespace voxelcore
{
namespace
{

#ifdef __GLIBC__
std::size_t
ResidentBytes()
{
  std::size_t       whole = 0;
  std::size_t       resident = 0;
  std::FILE * const file = std::fopen("/proc/self/statm", "r");
  const int         read = file != nullptr ? std::fscanf(file, "%zu %zu", &whole, &resident) : 0;
  if (file != nullptr)
  {
    std::fclose(file);
  }
  return read == 2 ? resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) : 0;
}

TEST(FreeMemory, OfSmallArraysGoesBackToTheSystem)
{
#  if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "memory is the sanitizer's";
#  endif
  constexpr std::size_t                        count = 20000;
  constexpr std::size_t                        each = 4000; // bytes
  std::vector<std::unique_ptr<std::uint8_t[]>> pieces;
  for (std::size_t i = 0; i < count; ++i)
  {
    pieces.push_back(std::make_unique<std::uint8_t[]>(each)); // zeros: touched
  }
  const std::unique_ptr<std::uint8_t[]> last = std::make_unique<std::uint8_t[]>(each); // holds the heap's end
  pieces.clear();
  const std::size_t before = ResidentBytes();
  GiveBackFreeMemory();
  const std::size_t after = ResidentBytes();
  ASSERT_GT(before, 0U);
  EXPECT_LT(after + count * each / 2, before);
  EXPECT_EQ(last[each - 1], 0);
}
#endif

TEST(FreeMemory, ThatIsNotFreeStays)
{
  const std::vector<int> values(1000, 7);
  GiveBackFreeMemory();
  EXPECT_EQ(values, std::vector<int>(1000, 7));
}

} // namespace
} // namespace voxelcore
