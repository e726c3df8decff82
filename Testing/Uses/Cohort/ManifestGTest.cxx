#include "voxelcore/Options/Command.h"
#include "voxelcore/Cohort/Manifest.h"

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace voxelcore::testing
{
namespace
{

using ::testing::HasSubstr;

class Manifest : public ::testing::Test
{
protected:
  std::vector<CohortCase>
  Read(const std::string & text)
  {
    WriteAll(m_Folder / "m.csv", text);
    return ReadManifest(m_Folder / "m.csv", OptionsOfCases(Commands()));
  }
  std::string
  Refusal(const std::string & text)
  {
    try
    {
      Read(text);
      return "";
    }
    catch (const InputError & error)
    {
      return error.what();
    }
  }
  TemporaryFolder m_Folder;
};

TEST_F(Manifest, ColumnsAreOptionsOfCore)
{
  const auto cases = Read(
    "id,scan,Lambda,labels,with_skeleton,binary,note\n"
    "a,x/a.nii,2vox,\"1,4\",no,,hello\n"
    "b,/data/b.nii,,,yes,1,\n");
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].scan, m_Folder / "x/a.nii");
  EXPECT_EQ(cases[0].values,
            (ParameterValues{ { "lambda", "2vox" }, { "labels", "1,4" }, { "with-skeleton", "false" } }));
  EXPECT_EQ(cases[1].scan, "/data/b.nii");
  EXPECT_EQ(cases[1].values, (ParameterValues{ { "with-skeleton", "true" }, { "binary", "true" } }));
}

TEST_F(Manifest, SemicolonsAndTabsSeparateColumnsToo)
{
  const auto commas = Read("id,scan,labels,note\na,x.nii,\"1,4\",\"one; two\"\n");
  for (const char * text : { "id;scan;labels;note\na;x.nii;1,4;\"one; two\"\n",
                             "\xEF\xBB\xBFid;scan;labels;note\r\na;x.nii;\"1,4\";\r\n",
                             "id\tscan\tlabels\tnote\na\tx.nii\t1,4\tone; two\n" })
  {
    const auto cases = Read(text);
    ASSERT_EQ(cases.size(), 1U) << text;
    EXPECT_EQ(cases[0].id, "a");
    EXPECT_EQ(cases[0].scan, commas[0].scan);
    EXPECT_EQ(cases[0].values, commas[0].values);
  }
}

TEST_F(Manifest, DecimalCommasOfSemicolonTablesAreNotTakenForTwoValues)
{
  EXPECT_THAT(Refusal("id;scan;lambda\na;b;1,5vox\n"),
              HasSubstr("line 2: lambda: '1,5vox' may be a decimal comma; write 1.5vox"));
  EXPECT_THAT(Refusal("id;scan;tolerance\na;b;1,2diag\n"), HasSubstr("write 1.2diag"));
  EXPECT_EQ(Read("id;scan;lambda\na;b;1vox,5vox\n")[0].values.at("lambda"), "1vox,5vox");
  EXPECT_EQ(Read("id,scan,lambda\na,b,\"1,5vox\"\n")[0].values.at("lambda"), "1,5vox");
}

TEST_F(Manifest, MasksAreLookedForFromItsFolderAsScansAre)
{
  const std::string text = "id,scan,within\na,x.nii,m/roi.nrrd\nb,x.nii,/data/roi.nrrd\nc,x.nii,2\nd,x.nii,./roi\n";
  const auto        cases = Read(text);
  ASSERT_EQ(cases.size(), 4U);
  EXPECT_EQ(cases[0].values.at("within"), m_Folder / "m/roi.nrrd");
  EXPECT_EQ(cases[1].values.at("within"), "/data/roi.nrrd");
  EXPECT_EQ(cases[2].values.at("within"), "2") << "a label";
  EXPECT_EQ(cases[3].values.at("within"), m_Folder / "roi");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(m_Folder.Path());
  const auto here = ReadManifest("m.csv", OptionsOfCases(Commands()));
  std::filesystem::current_path(before);
  EXPECT_EQ(here[0].values.at("within"), "m/roi.nrrd");
  EXPECT_EQ(here[2].values.at("within"), "2");
  EXPECT_EQ(here[3].values.at("within"), "./roi") << "no label";
}

TEST_F(Manifest, WhatACaseIsComparedWithIsAFileOfEachRow)
{
  const auto cases = Read("id,scan,b\na,a.nii,net/a.nii\nb,b.vtp,/data/b.swc\n");
  EXPECT_EQ(cases[0].values.at("b"), m_Folder / "net/a.nii");
  EXPECT_EQ(cases[1].values.at("b"), "/data/b.swc");
}

TEST_F(Manifest, MistypedColumnsSuggestTheNearest)
{
  EXPECT_THAT(Refusal("id,scan,lamda\na,b,1\n"), HasSubstr("'lamda' is not known; did you mean 'lambda'?"));
  EXPECT_THAT(Refusal("id,scn\na,b\n"), HasSubstr("did you mean 'scan'?"));
  EXPECT_THAT(Refusal("id,scan,favourite\na,b,1\n"), HasSubstr("use id, scan, note and the options labels, "));
}

TEST_F(Manifest, WhatCannotBeUnderstoodIsRefusedWithFileAndLine)
{
  EXPECT_THAT(Refusal(""), HasSubstr("m.csv: is empty"));
  EXPECT_THAT(Refusal("id,scan\n"), HasSubstr("no row"));
  EXPECT_THAT(Refusal("scan,lambda\na,1\n"), HasSubstr("no column 'id'"));
  EXPECT_THAT(Refusal("id,lambda\na,1\n"), HasSubstr("no column 'scan'"));
  EXPECT_THAT(Refusal("id,scan,lamda\na,b,1\n"), HasSubstr("'lamda' is not known"));
  EXPECT_THAT(Refusal("id,scan,output\na,b,/etc/passwd\n"), HasSubstr("'output' is not known"));
  EXPECT_THAT(Refusal("id,scan,report\na,b,/etc/passwd\n"), HasSubstr("'report' is not known"));
  EXPECT_THAT(Refusal("id,scan,scan\na,b,c\n"), HasSubstr("'scan' is there twice"));
  EXPECT_THAT(Refusal("id,scan\na,b\nc\n"), HasSubstr("line 3: has 1 fields"));
  EXPECT_THAT(Refusal("id,scan\na,b\n,c\n"), HasSubstr("line 3: the id is empty"));
  EXPECT_THAT(Refusal("id,scan\na,\n"), HasSubstr("line 2: the scan is empty"));
  EXPECT_THAT(Refusal("id,scan\na,b\nc,d\na,e\n"), HasSubstr("line 4: the id 'a' is on line 2"));
  EXPECT_THAT(Refusal("id,scan\na,b\nsub-a,e\n"), HasSubstr("line 3"));
  EXPECT_THAT(Refusal("id,scan,binary\na,b,perhaps\n"), HasSubstr("line 2: binary: 'perhaps'"));
}

TEST_F(Manifest, FoldersOfIdsAreNamesOfLettersAndDigitsAndDifferentOnesNeverMeet)
{
  const std::vector<std::string> ids{ "a",
                                      "sub-b",
                                      "a/b",
                                      "a b",
                                      "ab",
                                      "../../etc",
                                      "..",
                                      ".",
                                      "a\"b",
                                      "'a'",
                                      "=cmd",
                                      "a\nb",
                                      "ä",
                                      "日本",
                                      "-rf",
                                      "sub-../..",
                                      "CON",
                                      "/",
                                      "a<b>",
                                      "sub-",
                                      std::string(300, 'a'),
                                      std::string(299, 'a') + "b",
                                      std::string("a\0b", 3) };
  std::set<std::string>          folders;
  for (const std::string & id : ids)
  {
    const std::string folder = CaseFolder(id);
    EXPECT_TRUE(folder.starts_with("sub-")) << folder;
    EXPECT_EQ(folder.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_", 4),
              std::string::npos)
      << folder;
    EXPECT_GT(folder.size(), 4U);
    EXPECT_LT(folder.size(), 100U);
    EXPECT_TRUE(folders.insert(folder).second) << folder << " of " << id;
  }
  EXPECT_EQ(CaseFolder("01"), "sub-01");
  EXPECT_EQ(CaseFolder("sub-01"), "sub-01");
  EXPECT_EQ(CaseFolder("root_01"), "sub-root_01");
  EXPECT_EQ(CaseFolder("site-2_B"), "sub-site-2_B");
  EXPECT_TRUE(CaseFolder("site-2/seg").starts_with("sub-site-2_segx"));
}

TEST_F(Manifest, AHundredThousandRowsAreRead)
{
  std::string text = "id,scan,lambda\n";
  for (int i = 0; i < 100000; ++i)
  {
    text += std::to_string(i) + ",scans/" + std::to_string(i) + ".nii.gz,1.5mm\n";
  }
  EXPECT_EQ(Read(text).size(), 100000U);
}

TEST_F(Manifest, FoldersAreSearchedAndScansOfOneNameToldApart)
{
  for (const char * folder : { "one/deep", "two", "stack", "single", "stores/cells.zarr/0" })
  {
    std::filesystem::create_directories(m_Folder / folder);
  }
  for (const char * file : { "one/deep/seg.nrrd",
                             "two/seg.nrrd",
                             "two/seg.nii.gz",
                             "two/readme.txt",
                             "two/.hidden.nii",
                             "stack/1.png",
                             "stack/2.png",
                             "single/only.tif",
                             "single/aseg.mgz",
                             "stores/cells.zarr/.zgroup",
                             "stores/cells.zarr/0/.zarray",
                             "stores/cells.zarr/0/1.0.0" })
  {
    WriteAll(m_Folder / file, "");
  }
  for (const char * file : { "two/series.dcm", "two/readme.docx", "two/names.label", "stack/thumbs.db" })
  {
    WriteAll(m_Folder / file, "");
  }
  std::map<std::string, std::filesystem::path> found;
  std::vector<std::filesystem::path>           passedOver;
  for (const CohortCase & one : FindCases({ m_Folder.Path() }, {}, {}, &passedOver))
  {
    found[one.id] = std::filesystem::path(one.scan).lexically_relative(m_Folder.Path());
  }
  EXPECT_EQ(found,
            (std::map<std::string, std::filesystem::path>{ { "one/deep/seg", "one/deep/seg.nrrd" },
                                                           { "two/seg.nrrd", "two/seg.nrrd" },
                                                           { "two/seg.nii.gz", "two/seg.nii.gz" },
                                                           { "two/series", "two/series.dcm" },
                                                           { "stack", "stack" },
                                                           { "single/only", "single/only.tif" },
                                                           { "single/aseg", "single/aseg.mgz" },
                                                           { "stores/cells", "stores/cells.zarr" } }));
  EXPECT_EQ(passedOver,
            (std::vector<std::filesystem::path>{ m_Folder / "stack/thumbs.db", m_Folder / "two/readme.docx" }));
  EXPECT_EQ(FindCases({ m_Folder / "*/seg.*" }, {}).size(), 2U);
  EXPECT_EQ(FindCases({ m_Folder / "two", m_Folder / "two/seg.nrrd" }, {}).size(), 3U); // the same file twice
  EXPECT_EQ(FindCases({ m_Folder / "stores/cells.zarr/" }, {}).size(), 1U);
  EXPECT_THROW(FindCases({ m_Folder / "none*" }, {}), InputError);
  std::filesystem::create_directory(m_Folder / "empty");
  EXPECT_THROW(FindCases({ m_Folder / "empty" }, {}), InputError);
}

} // namespace
} // namespace voxelcore::testing
