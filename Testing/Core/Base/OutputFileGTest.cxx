#include "voxelcore/Base/OutputFile.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TemporaryNames.h"

#include "VoxelCoreTesting/Messages.h"
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

using testing::MessageOf;
using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WriteAll;

/** Exit code of a child that may write files of `bytes` at most: for who writes, that is a full disk. */
template <typename Work>
int
WithFileLimit(rlim_t bytes, const Work & work)
{
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit rule{ bytes, bytes };
    setrlimit(RLIMIT_FSIZE, &rule);
    _exit(work());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(OutputFile, HoldsWhatWasWrittenWhereItWasWritten)
{
  const TemporaryFolder folder;
  OutputFile            file(folder / "a");
  file.Write("head ....");
  EXPECT_EQ(file.Place(), 9U);
  file.Write(std::string(3 << 20, 'x'));
  file.MoveTo(5);
  file.Write("size");
  EXPECT_EQ(file.Place(), 9U);
  file.Finish();
  EXPECT_EQ(ReadAll(folder / "a"), "head size" + std::string(3 << 20, 'x'));
}

TEST(OutputFile, ALinkThatSomebodyPutAtTheTemporaryNameIsNotFollowed)
{
  const TemporaryFolder folder;
  const auto            temporary = TemporaryName(folder / "a.vtp", ThisWriter());
  WriteAll(folder / "precious", "mine");
  for (const bool dangling : { false, true })
  {
    std::filesystem::create_symlink(folder / (dangling ? "new" : "precious"), temporary);
    const std::string message = MessageOf<OutputError>([&] { OutputFile file(temporary); });
    EXPECT_NE(message.find("a.vtp': the temporary name"), std::string::npos) << message;
    EXPECT_EQ(ReadAll(folder / "precious"), "mine");
    EXPECT_FALSE(std::filesystem::exists(folder / "new"));
    EXPECT_TRUE(std::filesystem::is_symlink(temporary)); // whose it is we do not know
    std::filesystem::remove(temporary);
  }
  OutputFile file(temporary);
  file.Finish();
}

TEST(OutputFile, OneThatIsNotFinishedGoes)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a", "of before");
  {
    OutputFile file(folder / "a");
    file.Write(std::string(3 << 20, 'x'));
  }
  EXPECT_TRUE(folder.Names().empty());
}

TEST(OutputFile, AFullDiskLeavesNoFileOnWhicheverCallItShows)
{
  const TemporaryFolder folder;
  for (const std::size_t bytes : { std::size_t{ 5000 }, std::size_t{ 5 << 20 } }) // stays in the buffer, and does not
  {
    const int code = WithFileLimit(4000, [&] {
      const std::string message = MessageOf<OutputError>([&] { WriteTextFile(folder / "a", std::string(bytes, 'x')); });
      return message.find("free some space") != std::string::npos ? 0 : 1;
    });
    EXPECT_EQ(code, 0) << bytes;
    EXPECT_TRUE(folder.Names().empty()) << bytes;
  }
}

TEST(OutputFile, AnErrorNamesTheFinalNameAndWhatToDo)
{
  const TemporaryFolder folder;
  const auto            missing = folder / "no" / "a.vtp";
  const std::string     message = MessageOf<OutputError>([&] { OutputFile file(TemporaryName(missing)); });
  EXPECT_EQ(message, "cannot write '" + missing.string() + "': No such file or directory; create the folder first");
  EXPECT_NE(MessageOf<OutputError>([&] { FailOutput(folder / "a", EROFS); }).find("choose a folder you may write to"),
            std::string::npos);
}

TEST(OutputFile, FoldersAndDevicesAreRefusedAndLeftAlone)
{
  const TemporaryFolder folder;
  EXPECT_NE(MessageOf<OutputError>([&] { OutputFile file(folder.Path()); }).find("not a regular file"),
            std::string::npos);
  EXPECT_NE(MessageOf<OutputError>([&] { OutputFile file("/dev/null"); }).find("not a regular file"),
            std::string::npos);
  EXPECT_THROW(FailOutput("/dev/null", EIO), OutputError);
  EXPECT_TRUE(std::filesystem::is_directory(folder.Path()));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

} // namespace
} // namespace voxelcore
