#include "voxelcore/Cohort/CaseRecord.h"

#include "CaseLock.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/OutputTransaction.h"

#include <gtest/gtest.h>
#include <set>

namespace voxelcore::testing
{
namespace
{

class CaseRecords : public ::testing::Test
{
protected:
  CaseRecords()
  {
    std::filesystem::create_directory(m_Case);
    WriteAll(m_Case / "sub-a_medial.vtp", "surface");
    WriteAll(m_Case / "sub-a_report.json", "{}");
    CaseRecord record;
    record.id = "a \xFF"; // no UTF-8
    record.key = "k";
    record.done = true;
    record.outputs = ListOutputs(m_Case);
    WriteCaseRecord(m_Case, record);
  }
  TemporaryFolder       m_Folder;
  std::filesystem::path m_Case = m_Folder / "sub-a";
};

TEST_F(CaseRecords, ACaseIsDoneWithItsKeyAndAllItsFilesAsTheyWereWritten)
{
  EXPECT_EQ(ListOutputs(m_Case).size(), 2U);
  EXPECT_TRUE(IsDone(m_Case, "k"));
  EXPECT_FALSE(IsDone(m_Case, "other"));
  WriteAll(m_Case / "sub-a_medial.vtp", "surfacE");
  EXPECT_FALSE(IsDone(m_Case, "k"));
  WriteAll(m_Case / "sub-a_medial.vtp", "surface");
  EXPECT_TRUE(IsDone(m_Case, "k"));
  std::filesystem::remove(m_Case / "sub-a_report.json");
  EXPECT_FALSE(IsDone(m_Case, "k"));
}

TEST_F(CaseRecords, ARecordThatLostABitOrItsEndIsNone)
{
  const std::string whole = ReadAll(RecordPath(m_Case));
  for (std::size_t length = 0; length + 1 < whole.size(); ++length)
  {
    WriteAll(RecordPath(m_Case), whole.substr(0, length));
    ASSERT_FALSE(ReadCaseRecord(m_Case)) << length;
  }
  std::string wrong = whole;
  wrong[wrong.find("\"done\"") + 1] = 'g';
  WriteAll(RecordPath(m_Case), wrong);
  EXPECT_FALSE(ReadCaseRecord(m_Case));
  WriteAll(RecordPath(m_Case), whole);
  EXPECT_TRUE(ReadCaseRecord(m_Case));
}

TEST_F(CaseRecords, ARecordNestedSoDeeplyThatTheStackWouldEndIsNone)
{
  std::string text = ReadAll(RecordPath(m_Case));
  text.insert(text.find('{') + 1, "\"x\": " + std::string(200000, '[') + std::string(200000, ']') + ",");
  WriteAll(RecordPath(m_Case), text);
  EXPECT_FALSE(ReadCaseRecord(m_Case));
}

TEST_F(CaseRecords, ClearingTakesWhatTheCaseLeftAndNothingElse)
{
  WriteAll(m_Case / "sub-a_medial.vtp.part77", "half");
  WriteAll(m_Case / "mine.txt", "notes");
  ClearCase(m_Case);
  ASSERT_TRUE(std::filesystem::exists(m_Case / "mine.txt"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(m_Case), {}), 1);
}

TEST_F(CaseRecords, TheKeyFollowsContentNamesAndOptionsButNotThePlace)
{
  std::filesystem::create_directory(m_Folder / "b");
  WriteAll(m_Folder / "s.tif", "scan");
  WriteAll(m_Folder / "b/s.tif", "scan");
  const std::string key = CaseKey(m_Folder / "s.tif", "--lambda=1");
  EXPECT_EQ(key, CaseKey(m_Folder / "b/s.tif", "--lambda=1"));
  EXPECT_NE(key, CaseKey(m_Folder / "s.tif", "--lambda=2"));
  WriteAll(m_Folder / "b/s.tif.txt", "1\tliver\n");
  EXPECT_NE(key, CaseKey(m_Folder / "b/s.tif", "--lambda=1"));
  WriteAll(m_Folder / "s.tif", "scam");
  EXPECT_NE(key, CaseKey(m_Folder / "s.tif", "--lambda=1"));
}

TEST_F(CaseRecords, TheKeyFollowsEveryListOfNamesThatAScanMayHaveAndTheFilesThatOptionsName)
{
  WriteAll(m_Folder / "s.tif", "scan");
  WriteAll(m_Folder / "mask.tif", "mask");
  std::set<std::string> keys{ CaseKey(m_Folder / "s.tif", "") };
  for (const char * list : { "s.lut", "s.tif.ctab", "s.label", "s.tif.txt" })
  {
    WriteAll(m_Folder / list, "1 liver\n");
    EXPECT_TRUE(keys.insert(CaseKey(m_Folder / "s.tif", "")).second) << list;
  }
  EXPECT_TRUE(keys.insert(CaseKey(m_Folder / "s.tif", "", {}, { m_Folder / "mask.tif" })).second);
  WriteAll(m_Folder / "mask.tif", "musk");
  EXPECT_TRUE(keys.insert(CaseKey(m_Folder / "s.tif", "", {}, { m_Folder / "mask.tif" })).second);
}

TEST_F(CaseRecords, AFolderThatHasGoneHasNoOutputsAndNothingToClear)
{
  std::filesystem::remove_all(m_Case);
  EXPECT_TRUE(ListOutputs(m_Case).empty());
  EXPECT_NO_THROW(ClearCase(m_Case));
  EXPECT_FALSE(IsDone(m_Case, "k"));
}

TEST_F(CaseRecords, AFolderThatHasGoneIsNotTakenForOneThatTakesNoFiles)
{
  EXPECT_TRUE(WriteRecordIfThere(m_Case, {}));
  std::filesystem::remove(RecordPath(m_Case));
  std::filesystem::create_directories(RecordPath(m_Case) / "in the way");
  EXPECT_THROW(WriteRecordIfThere(m_Case, {}), OutputError);
  std::filesystem::remove_all(m_Case);
  EXPECT_FALSE(WriteRecordIfThere(m_Case, {}));
  EXPECT_FALSE(std::filesystem::exists(m_Case));
}

TEST_F(CaseRecords, WhoeverEndsTheProgramKnowsOfAFileThatIsNotYetARecord)
{
  TemporaryRegistry temporaries;
  WriteCaseRecord(m_Case, {}, &temporaries);
  EXPECT_TRUE(temporaries.HasCommitted());
}

TEST_F(CaseRecords, ALockThatCanNeverBeMadeIsAnError)
{
  std::filesystem::create_symlink(m_Folder / "nowhere", m_Folder / "link");
  WriteAll(m_Folder / "file", "");
  for (const char * folder : { "link", "file", "gone/locks" })
  {
    EXPECT_THROW(CaseLock::Try(m_Folder / folder / "a.lock"), OutputError) << folder;
  }
}

TEST_F(CaseRecords, OneAtATimeHoldsALock)
{
  const std::filesystem::path file = m_Folder / "locks/a.lock";
  {
    const auto first = CaseLock::Try(file);
    ASSERT_TRUE(first);
    EXPECT_FALSE(CaseLock::Try(file));
    EXPECT_TRUE(CaseLock::Try(m_Folder / "locks/b.lock"));
  }
  EXPECT_FALSE(std::filesystem::exists(m_Folder / "locks")); // nothing stays
  WriteAll(m_Folder / "left", "");
  EXPECT_TRUE(CaseLock::Try(file));
}

} // namespace
} // namespace voxelcore::testing
