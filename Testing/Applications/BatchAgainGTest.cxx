// `voxelcore batch` again, after scans, masks, names, results or options have changed.

#include "CohortFolder.h"
#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"
#include "Scans.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace voxelcore::testing
{
namespace
{

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class BatchAgain : public ::testing::Test
{
protected:
  ProgramResult
  Batch(const std::vector<std::string> & more)
  {
    return RunBatch(m_Folder, more);
  }

  TemporaryFolder m_Folder;
};

TEST_F(BatchAgain, AChangedListOfNamesOrMaskHasTheCaseDoneAgain)
{
  WriteTinyScans(m_Folder.Path(), 1);
  const fs::path mask = m_Folder / "mask.nrrd";
  TestScan       voxels({ 12, 11, 10 });
  voxels.Fill({ 0, 0, 0 }, { 11, 10, 9 }, 1);
  WriteNrrd(mask, voxels);
  const std::vector<std::string> thickness{ m_Folder / "s0.nrrd", "--thickness", "--within", mask };
  EXPECT_THAT(Batch(thickness).output, Not(HasSubstr("before")));
  EXPECT_THAT(Batch(thickness).output, HasSubstr("before"));
  TestScan half({ 12, 11, 10 });
  half.Fill({ 0, 0, 0 }, { 11, 10, 8 }, 1);
  WriteNrrd(mask, half);
  EXPECT_THAT(Batch(thickness).output, HasSubstr("1 of 1 cases done\n"));

  for (const char * name : { "s0.ctab", "s0.nrrd.label" })
  {
    EXPECT_THAT(Batch({ m_Folder / "s0.nrrd" }).output, HasSubstr("1 of 1 cases done\n")) << name;
    EXPECT_THAT(Batch({ m_Folder / "s0.nrrd" }).output, HasSubstr("before")) << name;
    WriteAll(m_Folder / name, std::string("1 ") + (std::string(name) == "s0.ctab" ? "liver" : "spleen") + "\n");
  }
  EXPECT_THAT(Batch({ m_Folder / "s0.nrrd" }).output, HasSubstr("1 of 1 cases done\n"));
  EXPECT_THAT(ReadAll(m_Folder / "out/labels.csv"), HasSubstr(",spleen,"));
}

TEST_F(BatchAgain, AFailedCaseThatIsNoLongerAskedForFailsNoLaterGathering)
{
  WriteTinyScans(m_Folder.Path(), 1);
  WriteAll(m_Folder / "m.csv", "id,scan\na,s0.nrrd\nb,none.nrrd\n");
  EXPECT_EQ(Batch({ m_Folder / "m.csv" }).code, 1);
  WriteAll(m_Folder / "m.csv", "id,scan\na,s0.nrrd\n");
  const ProgramResult gathered = Batch({ m_Folder / "m.csv", "--gather" });
  EXPECT_EQ(gathered.code, 0) << "as without --gather";
  EXPECT_EQ(gathered.output, "1 of 1 cases done\n");
  EXPECT_EQ(Batch({ "--gather" }).code, 1) << "all that is there";
  EXPECT_THAT(ReadAll(m_Folder / "out/cases.csv"), HasSubstr("b,sub-b,failed"));
}

TEST_F(BatchAgain, WhatARunWouldDoAgainIsGatheredAsNotDone)
{
  WriteTinyScans(m_Folder.Path(), 4);
  WriteAll(m_Folder / "m.csv", "id,scan\na,s0.nrrd\nb,s1.nrrd\nc,s2.nrrd\nd,s3.nrrd\n");
  ASSERT_EQ(Batch({ m_Folder / "m.csv" }).code, 0);
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--gather" }).output, "4 of 4 cases done\n");
  WriteTinyScan(m_Folder / "s0.nrrd", 77);
  WriteAll(m_Folder / "out/sub-b/sub-b_medial.vtp", "damaged");
  fs::rename(m_Folder / "s2.nrrd", m_Folder / "away.nrrd");
  const ProgramResult gathered = Batch({ m_Folder / "m.csv", "--gather" });
  EXPECT_EQ(gathered.code, 1);
  EXPECT_THAT(gathered.output,
              HasSubstr("1 of 4 cases done\nfailed: a: its scan has changed since; run the batch again\n"
                        "failed: b: its results are missing or were changed; run the batch again\nfailed: c: "));
  EXPECT_THAT(gathered.output, HasSubstr("s2.nrrd"));
  const std::string cases = ReadAll(m_Folder / "out/cases.csv");
  EXPECT_THAT(cases, HasSubstr("a,sub-a,failed,its scan has changed"));
  EXPECT_THAT(cases, HasSubstr("d,sub-d,done"));
  const std::string labels = ReadAll(m_Folder / "out/labels.csv");
  EXPECT_THAT(labels, HasSubstr("\nd,"));
  EXPECT_THAT(labels, Not(HasSubstr("\na,"))) << "no numbers of an earlier scan";
  EXPECT_THAT(Batch({ m_Folder / "m.csv", "--lambda", "2vox", "--gather" }).output,
              HasSubstr("failed: d: it was done with other options"));
  fs::rename(m_Folder / "away.nrrd", m_Folder / "s2.nrrd");
  EXPECT_EQ(Batch({ m_Folder / "m.csv" }).output, "4 of 4 cases done, 2 of them before\n");
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--gather" }).code, 0);
}

TEST_F(BatchAgain, AScanKeepsItsNameWhenOthersOfThatNameComeAndGo)
{
  const auto add = [&](const char * folder, const char * name, unsigned seed) {
    fs::create_directory(m_Folder / folder);
    WriteTinyScan(m_Folder / (std::string(folder) + "/" + name), seed);
  };
  const fs::path pattern = m_Folder / "?/seg.*";
  add("a", "seg.nrrd", 1);
  EXPECT_EQ(Batch({ pattern }).output, "1 of 1 cases done\n");
  add("b", "seg.nrrd", 2);
  const std::string list = Batch({ pattern, "--list" }).output;
  EXPECT_THAT(list, HasSubstr("1\tsub-seg\tseg\t" + (m_Folder / "a/seg.nrrd").string() + "\n2\t"));
  EXPECT_EQ(Batch({ pattern }).output, "2 of 2 cases done, 1 of them before\n");
  EXPECT_EQ(Batch({ pattern, "--list" }).output, list);
  add("c", "seg.nrrd", 3);
  EXPECT_EQ(Batch({ pattern }).output, "3 of 3 cases done, 2 of them before\n");
  fs::remove_all(m_Folder / "a");
  fs::remove_all(m_Folder / "c");
  EXPECT_EQ(Batch({ pattern }).output, "1 of 1 cases done, 1 of them before\n") << "b has not become the only one";
  add("d", "seg.nrrd", 4);
  fs::remove_all(m_Folder / "b");
  EXPECT_EQ(Batch({ pattern }).output, "1 of 1 cases done\n") << "the results of a are none of d";

  // Below a folder: two formats of one name.
  add("e", "bone.nrrd", 5);
  EXPECT_EQ(Batch({ m_Folder / "e" }).output, "1 of 1 cases done\n");
  ASSERT_EQ(RunProgram({ "phantom", "box", "--size", "12", "-o", m_Folder / "e/bone.mha" }).code, 0);
  EXPECT_EQ(Batch({ m_Folder / "e" }).output, "2 of 2 cases done, 1 of them before\n");
}

TEST_F(BatchAgain, MasksOfAManifestLieBesideIt)
{
  WriteTinyScans(m_Folder.Path(), 1);
  TestScan mask({ 12, 11, 10 });
  mask.Fill({ 0, 0, 0 }, { 11, 10, 9 }, 1);
  WriteNrrd(m_Folder / "mask.nrrd", mask);
  WriteAll(m_Folder / "m.csv", "id,scan,within\na,s0.nrrd,mask.nrrd\n");
  EXPECT_EQ(Batch({ m_Folder / "m.csv", "--thickness" }).output, "1 of 1 cases done\n");
  fs::create_directory(m_Folder / "moved");
  for (const char * name : { "s0.nrrd", "mask.nrrd", "m.csv" })
  {
    fs::rename(m_Folder / name, m_Folder / ("moved/" + std::string(name)));
  }
  EXPECT_EQ(Batch({ m_Folder / "moved/m.csv", "--thickness" }).output, "1 of 1 cases done, 1 of them before\n");
}

} // namespace
} // namespace voxelcore::testing
