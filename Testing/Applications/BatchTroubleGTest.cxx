// `voxelcore batch` where folders are in the way, files go away while cases run, and what a case reads is changed.

#include "CohortFolder.h"
#include "VoxelCoreTesting/ProcessUse.h"
#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <thread>
#include <vector>

namespace voxelcore::testing
{
namespace
{

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class BatchTrouble : public ::testing::Test
{
protected:
  ProgramResult
  Batch(const std::vector<std::string> & more, const Watcher & watcher = {})
  {
    ProgramLimits limits;
    limits.time = std::chrono::seconds(60);
    return RunBatch(m_Folder, more, limits, watcher);
  }

  /** Two small scans, and one that takes long enough to have something removed meanwhile. */
  void
  WriteOneThatLasts()
  {
    WriteTinyScans(m_Folder.Path(), 2);
    ASSERT_EQ(RunProgram({ "phantom", "gyroid", "--size", "80", "-o", m_Folder / "long.nrrd" }).code, 0);
  }

  TemporaryFolder m_Folder;
};

TEST_F(BatchTrouble, AnOutputFolderThatTakesNoFilesIsAnErrorAndNoWaitWithoutEnd)
{
  WriteTinyScans(m_Folder.Path(), 1);
  fs::create_directory(m_Folder / "out");
  fs::create_symlink(m_Folder / "nowhere", m_Folder / "out/.voxelcore"); // fails for every user
  const ProgramResult result = Batch({ m_Folder / "s0.nrrd" });
  ExpectRefusal(result, 1, { "out/.voxelcore", "cannot make this folder" });
  EXPECT_LT(result.seconds, 30);
}

TEST_F(BatchTrouble, WhatStandsInTheWayOfOneCaseCostsThatCaseAlone)
{
  WriteTinyScans(m_Folder.Path(), 4);
  fs::create_directory(m_Folder / "out");
  fs::create_directory(m_Folder / "elsewhere");
  fs::create_directory_symlink(m_Folder / "elsewhere", m_Folder / "out/sub-s1");
  WriteAll(m_Folder / "out/sub-s2", "a file");
  const ProgramResult result = Batch({ m_Folder.Path(), "--jobs", "1" });
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("2 of 4 cases done"));
  EXPECT_THAT(result.output, HasSubstr("failed: s1: "));
  EXPECT_THAT(result.output, HasSubstr("sub-s1: is a link"));
  EXPECT_THAT(result.output, HasSubstr("sub-s2: cannot make this folder: it is a file"));
  EXPECT_TRUE(fs::is_empty(m_Folder / "elsewhere"));
  EXPECT_EQ(ReadAll(m_Folder / "out/sub-s2"), "a file");
  EXPECT_TRUE(fs::exists(m_Folder / "out/sub-s3/sub-s3_medial.vtp"));
  EXPECT_THAT(ReadAll(m_Folder / "out/cases.csv"), HasSubstr("sub-s1: is a link")) << "the tables say why, too";
}

TEST_F(BatchTrouble, AFinishedCaseThatWasMadeReadOnlyStaysDone)
{
  WriteTinyScans(m_Folder.Path(), 1);
  ASSERT_EQ(Batch({ m_Folder / "s0.nrrd" }).code, 0);
  fs::permissions(m_Folder / "out/sub-s0", fs::perms::owner_read | fs::perms::owner_exec);
  const std::string output = Batch({ m_Folder / "s0.nrrd" }).output;
  fs::permissions(m_Folder / "out/sub-s0", fs::perms::owner_all);
  EXPECT_THAT(output, HasSubstr("1 of 1 cases done, 1 of them before"));
}

TEST_F(BatchTrouble, ACaseWhoseFolderIsRemovedWhileItRunsFailsAlone)
{
  WriteOneThatLasts();
  bool       removed = false;
  const auto whileItRuns = [&](pid_t, const std::string & said) {
    removed =
      removed || (said.find(" 1 running") != std::string::npos && fs::remove_all(m_Folder / "out/sub-long") > 0);
  };
  const ProgramResult result = Batch({ m_Folder.Path(), "--jobs", "2", "--progress", "plain" }, whileItRuns);
  ASSERT_TRUE(removed);
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("2 of 3 cases done\nfailed: long: "));
  EXPECT_TRUE(fs::exists(m_Folder / "out/index.html"));
  EXPECT_THAT(Batch({ m_Folder.Path() }).output, HasSubstr("3 of 3 cases done, 2 of them before"));
}

TEST_F(BatchTrouble, ACaseWhoseScanIsRemovedWhileItRunsFailsAlone)
{
  WriteOneThatLasts();
  bool                removed = false;
  const ProgramResult result = Batch({ m_Folder.Path(), "--jobs", "2" }, [&](pid_t, const std::string &) {
    if (!removed && fs::exists(m_Folder / "out/sub-long"))
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(300)); // it has been read; if not, it fails by itself
      removed = fs::remove(m_Folder / "long.nrrd");
    }
  });
  ASSERT_TRUE(removed);
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("2 of 3 cases done\nfailed: long: "));
  EXPECT_TRUE(fs::exists(m_Folder / "out/index.html"));
}

TEST_F(BatchTrouble, WhatAllCasesAreAskedIsRefusedOnceBeforeAnyRuns)
{
  WriteTinyScans(m_Folder.Path(), 2);
  const std::vector<std::vector<std::string>> wrong{ { "--lambda", "x" },
                                                     { "--tolerance", "-1" },
                                                     { "--crop", "5" },
                                                     { "--engine", "best" },
                                                     { "--no-skeleton", "--prune-branches", "2r" },
                                                     { "--html-triangles", "5" },
                                                     { "--block-size", "64" },
                                                     { "--roots", "--up", "w" },
                                                     { "--roots", "--also", "swc" },
                                                     { "--thickness", "--with-skeleton" },
                                                     { "--thickness", "--border", "keeep" },
                                                     { "--thickness", "--within", "a.nrrd", "--separation", "box" } };
  for (const std::vector<std::string> & options : wrong)
  {
    std::vector<std::string> arguments{ m_Folder / "s0.nrrd", m_Folder / "s1.nrrd" };
    arguments.insert(arguments.end(), options.begin(), options.end());
    ExpectRefusal(Batch(arguments), 2, {});
  }
  EXPECT_FALSE(fs::exists(m_Folder / "out"));
}

TEST_F(BatchTrouble, WhatOneLineOfAManifestAsksFailsItsCaseAlone)
{
  WriteTinyScans(m_Folder.Path(), 2);
  WriteAll(m_Folder / "m.csv", "id,scan,lambda,with_skeleton\na,s0.nrrd,x,\nb,s1.nrrd,2vox,yes\n");
  EXPECT_THAT(Batch({ m_Folder / "m.csv" }).output, HasSubstr("1 of 2 cases done\nfailed: a: lambda 'x'"));
  WriteAll(m_Folder / "m.csv", "id,scan,with_skeleton\na,s0.nrrd,yes\nb,s1.nrrd,yes\n");
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--no-skeleton", "--prune-branches", "2r" }).code, 0)
    << "each line says what makes sense of the options of all";
}

/** A scan of `side` x `side` x `slices` bytes, all but a box of them background; a sparse file. */
void
WriteLargeScan(const fs::path & path, int side, int slices)
{
  const std::string sides = std::to_string(side) + " " + std::to_string(side) + " ";
  const std::string head = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " + sides + std::to_string(slices) +
                           "\nencoding: raw\nspacings: 1 1 1\n\n";
  const auto  row = static_cast<std::size_t>(side);
  std::string box(9 * row * row, '\0');
  for (const std::size_t slice : { 2, 3, 4, 5 })
  {
    for (const std::size_t line : { 2, 3, 4, 5 })
    {
      box.replace((slice * row + line) * row + 2, 4, "\1\1\1\1");
    }
  }
  WriteAll(path, head + box);
  fs::resize_file(path, head.size() + row * row * static_cast<std::size_t>(slices));
}

TEST_F(BatchTrouble, AScanIsReadOnceBeforeAndOnceAfterItsCase)
{
  if (BytesRead() == 0)
  {
    GTEST_SKIP() << "this system does not say what was read";
  }
  constexpr std::uint64_t bytes = 16U << 20U;
  WriteLargeScan(m_Folder / "large.nrrd", 256, 256);
  const auto readBy = [&](const std::function<void()> & work) {
    const std::uint64_t before = BytesRead();
    work();
    return BytesRead() - before;
  };
  const std::uint64_t alone = readBy([&] {
    ASSERT_EQ(RunProgram({ "core", m_Folder / "large.nrrd", "--with-skeleton", "-o", m_Folder / "one.vtp" }).code, 0);
  });
  const std::uint64_t batch = readBy([&] { ASSERT_EQ(Batch({ m_Folder / "large.nrrd" }).code, 0); });
  EXPECT_GT(alone, bytes);
  EXPECT_GT(batch - alone, 2 * bytes) << "whether it has been done, and whether it has changed meanwhile";
  EXPECT_LT(batch - alone, 5 * bytes / 2);
}

TEST_F(BatchTrouble, AFolderRemovedWhileItsResultsAreCheckedCostsItsCaseAlone)
{
  WriteLargeScan(m_Folder / "large.nrrd", 1024, 400);
  WriteTinyScans(m_Folder.Path(), 2);
  bool                removed = false;
  const ProgramResult result = Batch(
    { m_Folder / "large.nrrd", m_Folder / "s0.nrrd", m_Folder / "s1.nrrd", "--crop", "0:9,0:9,0:9", "--jobs", "1" },
    [&](pid_t process, const std::string &) {
      std::ifstream children("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
      int           child = 0;
      if (!removed && fs::exists(m_Folder / "out/sub-large/sub-large_report.json") && !(children >> child))
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(20)); // it reads the scan for longer than that
        removed = fs::remove_all(m_Folder / "out/sub-large") > 0;
      }
    });
  ASSERT_TRUE(removed);
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.output, HasSubstr("2 of 3 cases done\nfailed: large: "));
  EXPECT_THAT(Batch({ m_Folder / "large.nrrd", m_Folder / "s0.nrrd", "--crop", "0:9,0:9,0:9" }).output,
              HasSubstr("2 of 2 cases done, 1 of them before"));
}

TEST_F(BatchTrouble, WhatABatchHasMadeIsNoScanOfTheNext)
{
  fs::create_directory(m_Folder / "scans");
  WriteTinyScans(m_Folder / "scans", 2);
  for (const char * kind : { "--thickness", "--no-skeleton" })
  {
    ASSERT_EQ(
      RunProgram({ "batch", m_Folder / "scans", kind, "-o", m_Folder / ("scans/earlier" + std::string(kind)) }).code,
      0);
  }
  const ProgramResult list = Batch({ m_Folder / "scans", "--list" });
  const std::string   scans = m_Folder / "scans/s";
  EXPECT_EQ(list.output, "1\tsub-s0\ts0\t" + scans + "0.nrrd\n2\tsub-s1\ts1\t" + scans + "1.nrrd\n");
}

TEST_F(BatchTrouble, OfAZarrStoreTheLevelThatIsReadIsTheScan)
{
  const fs::path store = m_Folder / "z.zarr";
  const auto     level = [&](int which, int side) {
    const fs::path    folder = store / std::to_string(which);
    const std::string sides = std::to_string(side) + "," + std::to_string(side) + "," + std::to_string(side);
    fs::create_directories(folder);
    WriteAll(folder / ".zarray",
             R"({"zarr_format":2,"shape":[)" + sides + R"(],"chunks":[)" + sides +
               R"(],"dtype":"|u1","compressor":null,"fill_value":0,"order":"C","filters":null})");
    std::string voxels(static_cast<std::size_t>(side) * side * side, '\0');
    voxels.replace(voxels.size() / 2, 3, "\1\1\1");
    WriteAll(folder / "0.0.0", voxels);
    return R"({"path":")" + std::to_string(which) +
           R"(","coordinateTransformations":[{"type":"scale","scale":[1,1,1]}]})";
  };
  const std::string levels = level(0, 8) + "," + level(1, 5);
  WriteAll(store / ".zgroup", R"({"zarr_format":2})");
  WriteAll(store / ".zattrs",
           R"({"multiscales":[{"version":"0.4","axes":[{"name":"z","type":"space"},{"name":"y","type":"space"},)"
           R"({"name":"x","type":"space"}],"datasets":[)" +
             levels + "]}]}");
  const ProgramResult first = Batch({ store, "--level", "1" });
  EXPECT_EQ(first.code, 0) << first.error;
  EXPECT_THAT(Batch({ store, "--level", "1" }).output, HasSubstr("before"));
  std::string other(125, '\0');
  other.replace(30, 2, "\1\1");
  WriteAll(store / "1/0.0.0", other);
  EXPECT_THAT(Batch({ store, "--level", "1" }).output, HasSubstr("1 of 1 cases done\n"));
}

TEST_F(BatchTrouble, ANameWithALineEndIsRefusedAndNotTakenForTwo)
{
  WriteTinyScan(m_Folder / "a\nb.nrrd", 1);
  ExpectRefusal(Batch({ m_Folder / "a\nb.nrrd" }), 2, { "line end" });
  EXPECT_EQ(Batch({ m_Folder.Path() }).code, 0);
}

} // namespace
} // namespace voxelcore::testing
