// What both halves, that for Linux and the portable one, promise.

#include "voxelcore/SystemCalls.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <vector>

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

} // namespace
} // namespace voxelcore
