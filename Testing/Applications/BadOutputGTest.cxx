// Where results cannot go, and where memory does not suffice: one clear line, the right exit code, no output, no crash.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <unistd.h>

namespace voxelcore::testing
{
namespace
{

using Names = std::set<std::string>;

ProgramLimits
FileLimit(std::uint64_t bytes)
{
  ProgramLimits limits;
  limits.fileBytes = bytes;
  return limits;
}

class BadOutput : public ::testing::Test
{
protected:
  BadOutput()
  {
    WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  }
  void
  ExpectUnwritable(const std::string &              output,
                   const std::vector<std::string> & words,
                   const ProgramLimits &            limits = {})
  {
    ExpectRefusal(RunProgram({ "core", m_Folder / "a.nrrd", "--lambda", "0", "-o", output }, limits), 1, words);
  }

  TemporaryFolder m_Folder;
};

TEST_F(BadOutput, FolderThatIsNotThere)
{
  ExpectUnwritable(m_Folder / "none/out.vtp", { "none", "does not exist" });
  EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" });
}

TEST_F(BadOutput, NamesThatAreTooLong)
{
  const std::string name(260, 'a');
  ExpectUnwritable(m_Folder / (name + ".vtp"), { "cannot write: File name too long" });
  ExpectUnwritable(m_Folder / (name + "/"), { "cannot make this folder: File name too long" });
  ExpectUnwritable(m_Folder / (name + "/out.vtp"), { "File name too long" });
  ExpectRefusal(RunProgram({ "batch", m_Folder / "a.nrrd", "-o", m_Folder / name }), 1, { "File name too long" });
  ExpectRefusal(RunProgram({ "batch", m_Folder / name, "-o", m_Folder / "b" }), 3, { "File name too long" });
  EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" });
}

TEST_F(BadOutput, FolderThatTakesNoFiles)
{
  ExpectUnwritable("/proc/out.vtp", { "/proc/out.vtp" });
  ExpectUnwritable("/proc/new/", { "/proc/new" });
}

TEST_F(BadOutput, FolderWithoutTheRight)
{
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "root may write everywhere";
  }
  std::filesystem::create_directory(m_Folder / "locked");
  std::filesystem::permissions(m_Folder / "locked", std::filesystem::perms::owner_read);
  ExpectUnwritable(m_Folder / "locked/out.vtp", { "locked", "ermission" });
}

TEST_F(BadOutput, ExistingFileWithoutForce)
{
  WriteAll(m_Folder / "out.vtp", "precious");
  ExpectUnwritable(m_Folder / "out.vtp", { "out.vtp", "--force" });
  EXPECT_EQ(ReadAll(m_Folder / "out.vtp"), "precious");
}

TEST_F(BadOutput, FileSizeLimit)
{
  ExpectUnwritable(m_Folder / "out.vtp", { "out.vtp" }, FileLimit(2000));
  EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" });
  for (const char * extension : { "vtk", "ply", "obj", "stl", "ma" })
  {
    ExpectUnwritable(m_Folder / (std::string("out.") + extension), { "out." }, FileLimit(200));
    EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" }) << extension;
  }
  for (const char * name : { "out.nrrd", "out.nii.gz", "out.nii", "out.mha", "out.mhd", "out.tif" })
  {
    ExpectRefusal(RunProgram({ "phantom", "noise", "--size", "40", "-o", m_Folder / name }, FileLimit(1000)),
                  1,
                  { name });
    EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" }) << name;
  }
}

TEST_F(BadOutput, DiskFull)
{
  const std::filesystem::path disk = m_Folder / "disk";
  std::filesystem::create_directory(disk);
  if (mount("none", disk.c_str(), "tmpfs", 0, "size=8k") != 0)
  {
    GTEST_SKIP() << "cannot mount a small tmpfs here";
  }
  struct Unmount
  {
    std::filesystem::path path;
    ~Unmount()
    {
      umount(path.c_str());
    }
  };
  const Unmount unmount{ disk };
  ExpectUnwritable(disk / "out.vtp", { "out.vtp" });
  EXPECT_TRUE(std::filesystem::is_empty(disk));
}

TEST_F(BadOutput, WhatIsPrintedOnAFullDisk)
{
  ProgramLimits limits;
  limits.fullOutput = true;
  ExpectRefusal(RunProgram({ "info", m_Folder / "a.nrrd", "--json" }, limits), 1, { "printed", "No space left" });
  ExpectRefusal(RunProgram({ "--version" }, limits), 1, { "printed", "No space left" });
}

// A stack that has to grow when memory is used up ends the program without a word.
TEST_F(BadOutput, TheStackHasItsRoomBeforeMemoryIsUsedUp)
{
  std::size_t most = 0;
  EXPECT_EQ(RunProgram({ "phantom", "noise", "--size", "64", "-o", m_Folder / "noise.nrrd" },
                       {},
                       [&most](pid_t process, const std::string &) {
                         std::ifstream status("/proc/" + std::to_string(process) + "/status");
                         for (std::string word; status >> word;)
                         {
                           std::size_t kilobytes = 0;
                           if (word == "VmStk:" && status >> kilobytes)
                           {
                             most = std::max(most, kilobytes);
                           }
                         }
                       })
              .code,
            0);
  EXPECT_GE(most, 1024U);
}

TEST_F(BadOutput, NotEnoughMemory)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need address space of their own";
#endif
  EXPECT_EQ(RunProgram({ "phantom", "noise", "--size", "112", "-o", m_Folder / "noise.nrrd" }).code, 0);
  for (const std::uint64_t megabytes : { 400, 500, 600 }) // whichever stage and thread needs more
  {
    ProgramLimits limits;
    limits.memoryBytes = megabytes << 20U;
    ExpectRefusal(RunProgram({ "core", m_Folder / "noise.nrrd", "-o", m_Folder / "out.vtp" }, limits), 1, { "memory" });
    EXPECT_EQ(m_Folder.Names(), (Names{ "a.nrrd", "noise.nrrd" }));
  }
}

} // namespace
} // namespace voxelcore::testing
