// `voxelcore core --block` and `--join` as a user runs them.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

class BlockCommand : public ::testing::Test
{
protected:
  void
  Cut(const std::string & scan, int blocks, const std::vector<std::string> & more = {})
  {
    for (int block = 1; block <= blocks; ++block)
    {
      std::vector<std::string> arguments{ "core",     m_Folder / scan,
                                          "--blocks", std::to_string(blocks),
                                          "--block",  std::to_string(block),
                                          "-o",       (m_Folder / "parts").string() + "/" };
      arguments.insert(arguments.end(), more.begin(), more.end());
      const ProgramResult result = RunProgram(arguments);
      ASSERT_EQ(result.code, 0) << result.error;
      EXPECT_NE(result.output.find("block " + std::to_string(block) + " of " + std::to_string(blocks)),
                std::string::npos);
    }
  }
  ProgramResult
  Join(const std::string & scan, const std::vector<std::string> & more = {})
  {
    std::vector<std::string> arguments{ "core", m_Folder / scan,        "--join", m_Folder / "parts",
                                        "-o",   m_Folder / "joined.vtp" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram(arguments);
  }
  void
  ExpectTheBytesOfASingleRun(const std::string & scan, const std::vector<std::string> & more = {})
  {
    const ProgramResult joined = Join(scan, more);
    ASSERT_EQ(joined.code, 0) << joined.error;
    std::vector<std::string> arguments{ "core", m_Folder / scan, "-o", m_Folder / "single.vtp" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    ASSERT_EQ(RunProgram(arguments).code, 0);
    const std::string single = ReadAll(m_Folder / "single.vtp");
    EXPECT_GT(single.size(), 1000U);
    EXPECT_TRUE(ReadAll(m_Folder / "joined.vtp") == single);
  }
  TemporaryFolder m_Folder;
};

TEST_F(BlockCommand, TheJoinedFileIsThatOfASingleRunForEveryLabel)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  Cut("a.nrrd", 3);
  ExpectTheBytesOfASingleRun("a.nrrd");
  ExpectTheBytesOfASingleRun("a.nrrd", { "--lambda", "0", "--keep-edges", "--labels", "2,9", "--force" });
}

TEST_F(BlockCommand, TheJoinedFileIsThatOfASingleRunForARootAndItsSkeleton)
{
  ASSERT_EQ(RunProgram({ "phantom", "root", "--size", "96", "--detail", "1", "-o", m_Folder / "r.nrrd" }).code, 0);
  Cut("r.nrrd", 4, { "--threads", "1" });
  ExpectTheBytesOfASingleRun("r.nrrd", { "--with-skeleton" });
  ASSERT_TRUE(std::filesystem::exists(m_Folder / "single_skeleton.vtp"));
  EXPECT_TRUE(ReadAll(m_Folder / "joined_skeleton.vtp") == ReadAll(m_Folder / "single_skeleton.vtp"));
}

TEST_F(BlockCommand, BlocksOfASizeJoinToTheFileOfASingleRun)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  const std::array<std::size_t, 3> size = ThreeBlocks().size;
  std::size_t                      blocks = 1;
  for (const std::size_t length : size)
  {
    blocks *= (length + 8) / 9;
  }
  for (std::size_t block = 1; block <= blocks; ++block)
  {
    const ProgramResult result = RunProgram({ "core",
                                              m_Folder / "a.nrrd",
                                              "--binary",
                                              "--block-size",
                                              "9",
                                              "--block",
                                              std::to_string(block),
                                              "-o",
                                              (m_Folder / "parts").string() + "/" });
    ASSERT_EQ(result.code, 0) << result.error;
  }
  ExpectTheBytesOfASingleRun("a.nrrd", { "--binary" });
}

TEST_F(BlockCommand, ComponentsHavePartsOfTheirOwn)
{
  TestScan scan({ 20, 8, 8 });
  scan.Fill({ 1, 1, 1 }, { 7, 6, 6 }, 1);
  scan.Fill({ 10, 1, 1 }, { 18, 6, 6 }, 1);
  WriteNrrd(m_Folder / "c.nrrd", scan);
  Cut("c.nrrd", 2, { "--split-components" });
  ExpectTheBytesOfASingleRun("c.nrrd", { "--split-components" });
}

TEST_F(BlockCommand, PartsThatAreMissingDamagedOrOfAnotherScanAreRefused)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  ExpectRefusal(Join("a.nrrd"), 3, { "parts", "no such folder" });
  Cut("a.nrrd", 2, { "--labels", "1" });
  ExpectRefusal(Join("a.nrrd"), 3, { "holds no part a_label-2_block-" });
  const std::filesystem::path second = m_Folder / "parts/a_label-1_block-2-of-2.vcb";
  const std::string           whole = ReadAll(second);
  std::filesystem::remove(second);
  ExpectRefusal(Join("a.nrrd", { "--labels", "1" }), 3, { "missing: 2;", "with --blocks or --block-size" });
  WriteAll(second, whole.substr(0, whole.size() - 9));
  ExpectRefusal(Join("a.nrrd", { "--labels", "1" }), 3, { "block-2-of-2.vcb" });
  WriteAll(second, whole);
  EXPECT_EQ(Join("a.nrrd", { "--labels", "1" }).code, 0);
  TestScan other = ThreeBlocks();
  other.At(2, 2, 8) = 0;
  WriteNrrd(m_Folder / "a.nrrd", other);
  ExpectRefusal(Join("a.nrrd", { "--labels", "1", "--force" }), 3, { "another scan" });
  for (const char * part : { "a_label-1_block-1-of-2.vcb", "a_label-1_block-2-of-2.vcb" })
  {
    std::filesystem::remove(m_Folder / ("parts/" + std::string(part)));
  }
  WriteAll(m_Folder / "parts/a_label-1_block-3-of-99.vcb", whole);
  ExpectRefusal(Join("a.nrrd", { "--labels", "1", "--force" }), 3, { "missing: 1, 2, 4, ", "12, 13, ...;" });
}

TEST_F(BlockCommand, WrongUseIsSaidInOneLine)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  const auto core = [&](std::vector<std::string> more) {
    more.insert(more.begin(), { "core", m_Folder / "a.nrrd", "-o", (m_Folder / "parts").string() + "/" });
    return RunProgram(more);
  };
  ExpectRefusal(core({ "--blocks", "3" }), 2, { "--blocks N and --block K" });
  ExpectRefusal(core({ "--blocks", "3", "--block", "4" }), 2, { "--block 4", "1 to 3" });
  ExpectRefusal(core({ "--blocks", "0", "--block", "1" }), 2, { "--blocks 0" });
  ExpectRefusal(core({ "--blocks", "3", "--block-size", "9", "--block", "1" }), 2, { "--blocks", "--block-size" });
  ExpectRefusal(core({ "--block-size", "9", "--block", "1" }), 2, { "--block-size", "--labels VALUE" });
  ExpectRefusal(core({ "--blocks", "3", "--block", "1", "--join", "x" }), 2, { "--join" });
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "parts"));
}

} // namespace
} // namespace voxelcore::testing
