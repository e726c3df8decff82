// Names of files being written: whose they are, and who may remove them.

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputStream.h"
#include "voxelcore/Base/TemporaryNames.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace voxelcore
{
namespace
{

using Names = std::set<std::string>;
using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WriteAll;

/** A process that has ended, and was waited for. */
WriterIdentity
EndedWriter()
{
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    const WriterIdentity self = ThisWriter();
    _exit(write(ends[1], &self, sizeof(self)) == sizeof(self) ? 0 : 1);
  }
  WriterIdentity writer;
  EXPECT_EQ(read(ends[0], &writer, sizeof(writer)), static_cast<ssize_t>(sizeof(writer)));
  waitpid(child, nullptr, 0);
  close(ends[0]);
  close(ends[1]);
  return writer;
}

TEST(TemporaryNames, ANameTellsItsWriterAndItsTarget)
{
  const WriterIdentity writer{ 0xabcU, 0xffffffffU, 42, 0x123456789abcU };
  EXPECT_EQ(TemporaryName("x/a.vtp", writer), "x/a.vtp.part-00000abc-ffffffff-42-123456789abc");
  EXPECT_EQ(WriterOf(TemporaryName("x/a.vtp", writer)), writer);
  EXPECT_EQ(WriterOf(TemporaryName("a.vtp")), ThisWriter());
  EXPECT_EQ(FinalName(TemporaryName("x/a.vtp")), "x/a.vtp");
  EXPECT_EQ(FinalName(TemporaryName("x/a.mhd") / "a.raw"), "x/a.mhd");
  EXPECT_EQ(FinalName(TemporaryName(TemporaryName("x/a.nii") / "a.nii") / "a.nii"), "x/a.nii");
  for (const std::string name : { "a.vtp", "x/a.vtp", "/", "a.part", "a.part-1", "" })
  {
    EXPECT_EQ(FinalName(name), name);
  }
}

TEST(TemporaryNames, WhatOnlyLooksLikeOneIsNobodys)
{
  const std::string name = TemporaryName("a.vtp", { 0xabcU, 1, 42, 7 }).string();
  for (const std::string & other : { std::string("a.vtp"),
                                     std::string("a.vtp.part123"),
                                     std::string("a.part-1-2-3-4"),
                                     name + "x",
                                     name + ".vtp",
                                     name.substr(0, name.size() - 2),
                                     name.substr(5) })
  {
    EXPECT_EQ(WriterOf(other), std::nullopt) << other;
  }
}

TEST(TemporaryNames, ALongNameStaysOneThatAFolderCanHold)
{
  const TemporaryFolder folder;
  for (const char last : { 'a', 'b' })
  {
    const auto temporary = TemporaryName(folder / (std::string(254, 'x') + last));
    EXPECT_EQ(temporary.filename().string().size(), 255U);
    EXPECT_EQ(WriterOf(temporary), ThisWriter());
    WriteTextFile(temporary, "A");
  }
  EXPECT_EQ(folder.Names().size(), 2U);
}

TEST(TemporaryNames, OnlyWhatProcessesOfThisMachineLeftThatHaveEndedIsRemoved)
{
  const TemporaryFolder folder;
  const WriterIdentity  here = ThisWriter();
  const WriterIdentity  ended = EndedWriter();
  ASSERT_EQ(ended.machine, here.machine);
  ASSERT_EQ(ended.space, here.space);
  EXPECT_TRUE(HasEnded(ended));
  EXPECT_FALSE(HasEnded(here));


  WriterIdentity reused = here; // the process id of one that is running, but which began at another time
  reused.start += 1;
  WriterIdentity otherMachine = ended;
  otherMachine.machine += 1;
  WriterIdentity otherContainer = ended;
  otherContainer.space += 1;
  const auto add = [&](const std::string & name, const WriterIdentity & writer) {
    WriteAll(TemporaryName(folder / name, writer), "x");
    return TemporaryName(name, writer).string();
  };
  add("ended.vtp", ended);
  add("reused.vtp", reused);
  std::filesystem::create_directory(TemporaryName(folder / "folder.mhd", ended));
  WriteAll(TemporaryName(folder / "folder.mhd", ended) / "folder.raw", "x");
  const Names kept{ add("running.vtp", here),
                    add("machine.vtp", otherMachine),
                    add("container.vtp", otherContainer),
                    "result.vtp",
                    "result.vtp.part1234" };
  WriteAll(folder / "result.vtp", "x");
  WriteAll(folder / "result.vtp.part1234", "x");
  RemoveAbandoned(folder.Path());
  EXPECT_EQ(folder.Names(), kept);
  RemoveAbandoned(folder / "no such folder"); // nothing to do
}

/** The message of what is thrown in a process whose files may have `limit` bytes. */
template <typename Work>
std::string
MessageWithLimit(rlim_t limit, Work && work)
{
  std::array<int, 2> ends{};
  EXPECT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit rule{ limit, limit };
    setrlimit(RLIMIT_FSIZE, &rule);
    std::string message;
    try
    {
      work();
    }
    catch (const OutputError & error)
    {
      message = error.what();
    }
    _exit(write(ends[1], message.data(), message.size()) >= 0 ? 0 : 1);
  }
  close(ends[1]);
  std::string   message(1000, '\0');
  const ssize_t count = read(ends[0], message.data(), message.size());
  message.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  close(ends[0]);
  waitpid(child, nullptr, 0);
  return message;
}

TEST(OutputFile, AFailureSaysWhyByTheFinalNameAndLeavesNoFile)
{
  const TemporaryFolder folder;
  const auto            path = folder / "a.txt";
  const std::string     expected =
    "cannot write '" + path.string() + "': File too large; free some space or write elsewhere";
  const std::string text(100000, 'x');
  EXPECT_EQ(MessageWithLimit(5000, [&] { WriteTextFile(TemporaryName(path), text); }), expected);
  EXPECT_EQ(folder.Names(), Names{});
  EXPECT_EQ(MessageWithLimit(5000,
                             [&] {
                               OutputStream stream(TemporaryName(path));
                               for (int i = 0; i < 300; ++i)
                               {
                                 stream << text << i; // goes bad on the way, as streams do
                               }
                               errno = ENOENT;
                               stream.Finish();
                             }),
            expected);
  EXPECT_EQ(folder.Names(), Names{});
}

TEST(OutputFile, AStreamWritesWhereItIsTold)
{
  const TemporaryFolder folder;
  OutputStream          stream(folder / "a.txt");
  stream << "one  three";
  EXPECT_EQ(stream.tellp(), std::streampos(10));
  stream.seekp(4);
  stream.put('2');
  stream.seekp(10);
  stream << 4;
  ASSERT_TRUE(stream.good());
  stream.Finish();
  EXPECT_EQ(ReadAll(folder / "a.txt"), "one 2three4");
}

} // namespace
} // namespace voxelcore
