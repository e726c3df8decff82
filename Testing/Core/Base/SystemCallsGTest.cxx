// What both halves, that for Linux and the portable one, promise.

#include "voxelcore/Base/SystemCalls.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#if defined(__linux__)
#  include <fcntl.h>
#  include <pthread.h>
#  include <sys/mman.h>
#  include <sys/stat.h>
#  include <unistd.h>
#endif

namespace voxelcore
{
namespace
{

using testing::TemporaryFolder;
using testing::WriteAll;

TEST(SystemCalls, MemoryIsPlausible)
{
  const std::vector<char> taken(64U << 20U, 'x');
  EXPECT_TRUE(PeakMemoryMb() == 0 || PeakMemoryMb() > 64) << taken[5];
  EXPECT_LT(PeakMemoryMb(), 100000);
  EXPECT_GT(AvailableMemoryMb().value_or(2), 1);
}

TEST(SystemCalls, AFolderGoesWithItsContentsOnlyWhereThatIsAsked)
{
  const TemporaryFolder folder;
  const auto            full = folder.Path() / "full";
  std::filesystem::create_directories(full / "inner");
  WriteAll(full / "inner" / "file", "text");
  RemoveNow(full.c_str(), false);
  EXPECT_TRUE(std::filesystem::exists(full / "inner" / "file"));
  RemoveNow(full.c_str(), true);
  EXPECT_FALSE(std::filesystem::exists(full));
  WriteAll(folder.Path() / "file", "text");
  RemoveNow((folder.Path() / "file").c_str(), false);
  EXPECT_FALSE(std::filesystem::exists(folder.Path() / "file"));
}

TEST(SystemCalls, AProcessIsTheSameAsOftenAsItIsAsked)
{
  const ProcessFacts once = ThisProcess();
  const ProcessFacts again = ThisProcess();
  EXPECT_EQ(once.machine, again.machine);
  EXPECT_EQ(once.space, again.space);
  EXPECT_EQ(once.process, again.process);
  EXPECT_EQ(once.start, again.start);
  EXPECT_GT(once.process, 0);
  EXPECT_FALSE(once.machine.empty());
  EXPECT_FALSE(once.space.empty());
  EXPECT_FALSE(HasProcessEnded(once.process, once.start));
}

TEST(SystemCalls, AFileIsReadFromAnyPlaceToItsEnd)
{
  const TemporaryFolder folder;
  std::string           text;
  for (int i = 0; i < 100000; ++i)
  {
    text += static_cast<char>('a' + i % 26);
  }
  const auto path = folder.Path() / "file";
  WriteAll(path, text);
  SystemFile file(path);
  ASSERT_TRUE(file.IsOpen());
  std::vector<std::byte> bytes(text.size() + 10);
  const auto             same = [&](std::size_t from, std::size_t count) {
    return text.compare(from, count, reinterpret_cast<const char *>(bytes.data()), count) == 0;
  };
  EXPECT_EQ(file.Read(bytes.data(), 70), 70);
  EXPECT_TRUE(same(0, 70));
  file.Skip(30000);
  EXPECT_EQ(file.Read(bytes.data(), 50000), 50000);
  EXPECT_TRUE(same(30070, 50000));
  EXPECT_EQ(file.Read(bytes.data(), bytes.size()), 100000 - 80070);
  EXPECT_TRUE(same(80070, 100000 - 80070));
  EXPECT_EQ(file.Read(bytes.data(), 1), 0);
  file.Skip(1000); // beyond the end there is nothing, and no error
  EXPECT_EQ(file.Read(bytes.data(), 1), 0);
}

TEST(SystemCalls, AFileIsReadForwardsAndBackwardsAndBeyondItsEndIsNothing)
{
  const TemporaryFolder folder;
  const auto            path = folder.Path() / "file";
  WriteAll(path, "0123456789");
  SystemFile file(path);
  const auto at = [&](std::uint64_t place) {
    std::byte byte{};
    file.MoveTo(place);
    const std::int64_t count = file.Read(&byte, 1);
    return count == 1 ? static_cast<char>(byte) : count == 0 ? 'e' : '?';
  };
  EXPECT_EQ(at(7), '7');
  EXPECT_EQ(at(2), '2');
  EXPECT_EQ(at(1000), 'e');
  EXPECT_EQ(at(0), '0');
}

TEST(SystemCalls, PiecesThatAreAnnouncedHaveTheSameBytes)
{
  const TemporaryFolder folder;
  std::string           text;
  for (int i = 0; i < 300000; ++i)
  {
    text += static_cast<char>('a' + (i + i / 26) % 26);
  }
  const auto path = folder.Path() / "file";
  WriteAll(path, text);
  SystemFile  file(path);
  std::string got(500, '?');
  file.Announce(7000, 500);
  file.Announce(7000 + 80000, 500);
  for (const std::size_t at : { 7000, 87000 })
  {
    file.Skip(at == 7000 ? 7000 : 80000 - 500);
    ASSERT_EQ(file.Read(reinterpret_cast<std::byte *>(got.data()), got.size()), 500);
    EXPECT_EQ(got, text.substr(at, 500));
  }
  file.Announce(1U << 20, 500); // what is not there may be announced
  std::vector<std::byte> rest(text.size());
  EXPECT_EQ(file.Read(rest.data(), rest.size()), 300000 - 87500); // as may what is read otherwise
  EXPECT_EQ(text.compare(87500, std::string::npos, reinterpret_cast<const char *>(rest.data()), 300000 - 87500), 0);
}

#ifdef __linux__
/** How many pages of a file the system holds. */
std::size_t
PagesHeld(const std::filesystem::path & path, std::size_t size)
{
  const int    descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  void * const memory = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, descriptor, 0);
  ::close(descriptor);
  std::vector<unsigned char> pages((size + 4095) / 4096);
  EXPECT_EQ(::mincore(memory, size, pages.data()), 0);
  ::munmap(memory, size);
  return static_cast<std::size_t>(std::ranges::count_if(pages, [](unsigned char page) { return (page & 1U) != 0; }));
}

TEST(SystemCalls, BetweenPiecesThatAreAnnouncedNothingIsRead)
{
  // A file of holes takes no disk, and the system holds none of its pages yet.
  constexpr std::size_t size = std::size_t{ 16 } << 20;
  constexpr std::size_t step = 65536;
  const TemporaryFolder folder;
  const auto            path = folder.Path() / "file";
  WriteAll(path, "");
  std::filesystem::resize_file(path, size);
  ASSERT_EQ(PagesHeld(path, size), 0U);
  SystemFile                 file(path);
  std::array<std::byte, 500> piece{};
  for (std::size_t i = 0; i < size / step; ++i)
  {
    file.Announce(i * step, piece.size());
  }
  for (std::size_t i = 0; i < size / step; ++i)
  {
    ASSERT_EQ(file.Read(piece.data(), piece.size()), 500);
    file.Skip(step - piece.size());
  }
  EXPECT_LE(PagesHeld(path, size), size / step);
}
#endif

TEST(SystemCalls, WhatCannotBeOpenedOrReadSaysWhy)
{
  const TemporaryFolder folder;
  errno = 0;
  const SystemFile missing(folder.Path() / "missing");
  EXPECT_FALSE(missing.IsOpen());
  EXPECT_EQ(errno, ENOENT);
  errno = 0;
  SystemFile own(folder.Path());
  std::byte  one{};
  EXPECT_TRUE(!own.IsOpen() || own.Read(&one, 1) == -1);
  EXPECT_NE(errno, 0);
}

#if defined(__linux__)
TEST(SystemCalls, ASignalDoesNotEndARead)
{
  const TemporaryFolder folder;
  const auto            path = folder.Path() / "pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  struct sigaction heard = {};
  struct sigaction before = {};
  heard.sa_handler = [](int) {}; // and no SA_RESTART: a read that waits ends with EINTR
  ASSERT_EQ(::sigaction(SIGUSR1, &heard, &before), 0);
  const ::pthread_t         reader = ::pthread_self();
  std::thread               writer([&] {
    std::ofstream pipe(path, std::ios::binary);
    for (int i = 0; i < 20; ++i)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ::pthread_kill(reader, SIGUSR1);
    }
    pipe << "voxels";
  });
  SystemFile                file(path);
  std::array<std::byte, 16> bytes{};
  EXPECT_EQ(file.Read(bytes.data(), bytes.size()), 6);
  writer.join();
  ::sigaction(SIGUSR1, &before, nullptr);
}
#endif

} // namespace
} // namespace voxelcore
