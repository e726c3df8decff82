#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/OutputTransaction.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using Names = std::set<std::string>;
using testing::ReadAll;
using testing::TemporaryFolder;
using testing::WriteAll;

TEST(OutputTransaction, NothingHasItsFinalNameBeforeTheCommit)
{
  const TemporaryFolder folder;
  OutputTransaction     transaction(false);
  const auto            a = transaction.Stage(folder / "a.vtp");
  const auto            b = transaction.Stage(folder / "b.json");
  WriteTextFile(a, "A");
  WriteTextFile(b, "B");
  EXPECT_EQ(a.parent_path(), folder.Path());
  EXPECT_EQ(folder.Names(), (Names{ a.filename(), b.filename() }));
  transaction.Commit();
  EXPECT_EQ(folder.Names(), (Names{ "a.vtp", "b.json" }));
  EXPECT_EQ(ReadAll(folder / "a.vtp"), "A");
}

TEST(OutputTransaction, WithoutACommitNothingIsLeft)
{
  const TemporaryFolder folder;
  {
    OutputTransaction transaction(false);
    transaction.MakeDirectory(folder / "new/deep/");
    WriteTextFile(transaction.Stage(folder / "new/deep/a.vtp"), "A");
    WriteTextFile(transaction.StageWithCompanions(folder / "b.mhd"), "B");
  }
  EXPECT_EQ(folder.Names(), Names{});
}

TEST(OutputTransaction, ExistingFilesAreReplacedOnlyWhenForced)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.vtp", "old");
  OutputTransaction careful(false);
  try
  {
    careful.Stage(folder / "a.vtp");
    FAIL() << "an existing file was accepted";
  }
  catch (const OutputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("--force"), std::string::npos) << error.what();
  }
  OutputTransaction forced(true);
  WriteTextFile(forced.Stage(folder / "a.vtp"), "new");
  EXPECT_EQ(ReadAll(folder / "a.vtp"), "old");
  forced.Commit();
  EXPECT_EQ(ReadAll(folder / "a.vtp"), "new");
}

TEST(OutputTransaction, AFileThatAppearsMeanwhileIsNotReplacedAndNothingElseIsWritten)
{
  const TemporaryFolder folder;
  {
    OutputTransaction transaction(false);
    WriteTextFile(transaction.Stage(folder / "a.vtp"), "A");
    WriteTextFile(transaction.Stage(folder / "b.vtp"), "B");
    WriteAll(folder / "b.vtp", "another's");
    EXPECT_THROW(transaction.Commit(), OutputError);
  }
  EXPECT_EQ(folder.Names(), Names{ "b.vtp" });
  EXPECT_EQ(ReadAll(folder / "b.vtp"), "another's");
}

TEST(OutputTransaction, AStoreIsReplacedAsFilesAre)
{
  const TemporaryFolder folder;
  const auto            make = [](const std::filesystem::path & store, const std::string & text) {
    std::filesystem::create_directories(store / "0");
    WriteAll(store / "zarr.json", text);
    WriteAll(store / "0" / text, text);
  };
  make(folder / "a.zarr", "old");
  std::filesystem::create_directory(folder / "other.zarr");
  EXPECT_THROW(OutputTransaction(false).CheckTarget(folder / "a.zarr"), OutputError);
  EXPECT_THROW(OutputTransaction(true).CheckTarget(folder / "other.zarr"), OutputError) << "is no store";
  {
    OutputTransaction transaction(true);
    make(transaction.StageWithCompanions(folder / "a.zarr"), "new");
    EXPECT_EQ(ReadAll(folder / "a.zarr/zarr.json"), "old");
    transaction.Commit();
  }
  EXPECT_EQ(ReadAll(folder / "a.zarr/zarr.json"), "new");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.zarr/0/old"));
  {
    OutputTransaction transaction(true);
    make(transaction.StageWithCompanions(folder / "a.zarr"), "newer");
    make(transaction.StageWithCompanions(folder / "b.zarr"), "newer");
    WriteAll(folder / "b.zarr", "in the way of a folder");
    EXPECT_THROW(transaction.Commit(), OutputError);
  }
  EXPECT_EQ(ReadAll(folder / "a.zarr/zarr.json"), "new") << "all or nothing";
  EXPECT_EQ(folder.Names(), (std::set<std::string>{ "a.zarr", "b.zarr", "other.zarr" }));
}

TEST(OutputTransaction, CompanionsComeAlong)
{
  const TemporaryFolder folder;
  OutputTransaction     transaction(false);
  const auto            header = transaction.StageWithCompanions(folder / "a.mhd");
  EXPECT_EQ(header.filename(), "a.mhd");
  WriteTextFile(header, "ElementDataFile = a.raw");
  WriteTextFile(header.parent_path() / "a.raw", "data");
  transaction.Commit();
  EXPECT_EQ(folder.Names(), (Names{ "a.mhd", "a.raw" }));
}

TEST(OutputTransaction, ACompanionDoesNotReplaceAFileUnforced)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.raw", "precious");
  {
    OutputTransaction transaction(false);
    const auto        header = transaction.StageWithCompanions(folder / "a.mhd");
    WriteTextFile(header, "ElementDataFile = a.raw");
    WriteTextFile(header.parent_path() / "a.raw", "data");
    EXPECT_THROW(transaction.Commit(), OutputError);
  }
  EXPECT_EQ(folder.Names(), Names{ "a.raw" });
  EXPECT_EQ(ReadAll(folder / "a.raw"), "precious");
}

TEST(OutputTransaction, RefusesWhatCannotBeWrittenInTheEnd)
{
  const TemporaryFolder folder;
  WriteAll(folder / "file", "");
  OutputTransaction transaction(true);
  EXPECT_THROW(transaction.CheckTarget(folder / "none/a.vtp"), OutputError);
  EXPECT_THROW(transaction.CheckTarget(folder.Path()), OutputError);
  EXPECT_THROW(transaction.MakeDirectory(folder / "file/"), OutputError);
  EXPECT_THROW(transaction.MakeDirectory(folder / "file/below/"), OutputError);
  transaction.Stage(folder / "a.vtp");
  EXPECT_THROW(transaction.Stage(folder / "./a.vtp"), UsageError);
}

TEST(OutputTransaction, TheInputIsNeverReplaced)
{
  const TemporaryFolder folder;
  WriteAll(folder / "scan.nrrd", "scan");
  std::filesystem::create_hard_link(folder / "scan.nrrd", folder / "alias.vtp");
  OutputTransaction transaction(true);
  transaction.Protect(folder / "scan.nrrd");
  EXPECT_THROW(transaction.Stage(folder / "scan.nrrd"), OutputError);
  EXPECT_THROW(transaction.Stage(folder / "alias.vtp"), OutputError);
}

TEST(TemporaryRegistry, RemovesExactlyWhatIsNotCommitted)
{
  const TemporaryFolder folder;
  TemporaryRegistry     registry;
  OutputTransaction     done(false, &registry);
  WriteTextFile(done.Stage(folder / "done.vtp"), "1");
  done.Commit();
  OutputTransaction open(false, &registry);
  open.MakeDirectory(folder / "new/");
  WriteTextFile(open.Stage(folder / "new/open.vtp"), "2");
  WriteTextFile(open.StageWithCompanions(folder / "b.mhd"), "3");
  registry.RemoveAllNow();
  EXPECT_EQ(folder.Names(), Names{ "done.vtp" });
}

} // namespace
} // namespace voxelcore
