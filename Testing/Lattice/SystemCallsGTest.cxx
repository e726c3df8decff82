// What both halves, that for Linux and the portable one, promise.

#include "voxelcore/SystemCalls.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

#if defined(__linux__)
#  include <pthread.h>
#  include <sys/stat.h>
#endif

namespace voxelcore
{
namespace
{

using testing::TemporaryFolder;
using testing::WriteAll;

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
