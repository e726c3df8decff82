#include "voxelcore/Base/OutputStream.h"

#include "voxelcore/Base/Error.h"

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

using testing::ReadAll;
using testing::TemporaryFolder;

TEST(OutputStream, WritesWhatAFileStreamWritesAlsoAfterMoving)
{
  const TemporaryFolder folder;
  const auto            write = [](std::ostream & stream) {
    stream << "count " << 0 << ' ';
    const auto end = stream.tellp();
    stream.seekp(6);
    stream << 7;
    stream.seekp(end);
    stream.put('!').write("\0\n", 2);
    stream.seekp(-1, std::ios::cur);
    stream << 3.5;
  };
  OutputStream ours(folder / "a");
  write(ours);
  ours.Finish();
  std::ofstream theirs(folder / "b", std::ios::binary);
  write(theirs);
  theirs.close();
  EXPECT_EQ(ReadAll(folder / "a"), ReadAll(folder / "b"));
  EXPECT_EQ(ReadAll(folder / "a"), std::string("count 7 !\0003.5", 13));
}

TEST(OutputStream, OneThatIsNotFinishedLeavesNoFile)
{
  const TemporaryFolder folder;
  {
    OutputStream stream(folder / "a");
    stream << "begun";
  }
  EXPECT_TRUE(folder.Names().empty());
}

TEST(OutputStream, GoesBadOnAFullDiskAndFinishSaysWhy)
{
  const TemporaryFolder folder;
  const pid_t           child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit rule{ 4000, 4000 };
    setrlimit(RLIMIT_FSIZE, &rule);
    int code = 1;
    {
      OutputStream stream(folder / "a");
      stream << std::string(5 << 20, 'x');
      const bool bad = !stream;
      stream.clear();
      stream << "more"; // is not written to a file that has gone
      try
      {
        stream.Finish();
      }
      catch (const OutputError & error)
      {
        code = bad && std::string(error.what()).find("free some space") != std::string::npos ? 0 : 2;
      }
    }
    _exit(code);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_TRUE(folder.Names().empty());
}

} // namespace
} // namespace voxelcore
