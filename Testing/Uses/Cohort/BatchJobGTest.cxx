// What concerns all cases of a batch. That cases run, each in a process of its own, is tested through the program
// (Testing/Applications): a batch starts itself.

#include "voxelcore/Cohort/BatchJob.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

using ::testing::HasSubstr;

BatchOptions
Options(ParameterValues values)
{
  values.emplace("inputs", "a.nrrd");
  values.emplace("output", "out/");
  values.emplace("memory", "1GB");
  return BatchOptionsFrom(values, Commands());
}

TEST(BatchJob, OptionsOfCasesAndOfTheBatchAreToldApart)
{
  const BatchOptions options = Options({ { "inputs", "a.nrrd\nb c/\n*.nii" },
                                         { "lambda", "2vox" },
                                         { "labels", "1" },
                                         { "jobs", "3" },
                                         { "threads", "2" },
                                         { "timeout", "1.5h" },
                                         { "no-skeleton", "true" },
                                         { "force", "true" } });
  EXPECT_EQ(options.inputs, (std::vector<std::filesystem::path>{ "a.nrrd", "b c/", "*.nii" }));
  EXPECT_EQ(options.output, "out") << "without a slash behind";
  EXPECT_EQ(options.values, (ParameterValues{ { "labels", "1" }, { "lambda", "2vox" } }));
  EXPECT_EQ(options.jobs, 3);
  EXPECT_EQ(options.threads, 2);
  EXPECT_EQ(options.timeout, 5400);
  EXPECT_EQ(options.memoryMb, 1000);
  EXPECT_FALSE(options.skeletons);
  EXPECT_TRUE(options.force);
  EXPECT_FALSE(options.only);
}

TEST(BatchJob, AmountsHaveUnits)
{
  for (const auto & [text, megabytes] : std::vector<std::pair<std::string, double>>{ { "500", 500 },
                                                                                     { "500MB", 500 },
                                                                                     { "2.5GB", 2500 },
                                                                                     { "1MiB", 1.048576 },
                                                                                     { "1GiB", 1073.741824 } })
  {
    EXPECT_DOUBLE_EQ(Options({ { "memory", text } }).memoryMb, megabytes) << text;
  }
  for (const auto & [text, seconds] :
       std::vector<std::pair<std::string, double>>{ { "90", 90 }, { "90s", 90 }, { "2m", 120 }, { "0.5h", 1800 } })
  {
    EXPECT_DOUBLE_EQ(Options({ { "timeout", text } }).timeout, seconds) << text;
  }
  for (const char * text : { "0", "-1GB", "GB", "1 GB", "1gb", "1KB", "inf", "nan", "1e999", "1GB2" })
  {
    EXPECT_THROW(Options({ { "memory", text } }), UsageError) << text;
    EXPECT_THROW(Options({ { "timeout", text } }), UsageError) << text;
  }
  for (const char * text : { "-1", "4097", "1.5", "x", "1x" })
  {
    EXPECT_THROW(Options({ { "jobs", text } }), UsageError) << text;
  }
}

TEST(BatchJob, WhatIsMissingIsAskedFor)
{
  EXPECT_THROW(BatchOptionsFrom({ { "inputs", "a.nrrd" }, { "output", "" } }, Commands()), UsageError);
  EXPECT_THROW(BatchOptionsFrom({ { "output", "out" } }, Commands()), UsageError);
  EXPECT_NO_THROW(BatchOptionsFrom({ { "output", "out" }, { "gather", "true" } }, Commands()));
}

TEST(BatchJob, CasesAreListedByNumberFolderIdAndScan)
{
  const TemporaryFolder folder;
  for (const char * name : { "b.nrrd", "a.nrrd", "notes.txt" })
  {
    WriteAll(folder / name, "");
  }
  WriteAll(folder / "m.csv", "id,scan\n\"odd\tid\",a.nrrd\nplain,b.nrrd\n");
  BatchOptions options = Options({});
  options.inputs = { folder.Path() / "m.csv" };
  options.output = folder / "out";
  const std::string list = CaseList(options);
  EXPECT_THAT(list, HasSubstr("1\tsub-odd"));
  EXPECT_THAT(list, HasSubstr("\todd id\t" + (folder / "a.nrrd").string() + "\n"))
    << "an id with a tab does not make a column";
  EXPECT_THAT(list, HasSubstr("2\tsub-plain\tplain\t" + (folder / "b.nrrd").string() + "\n"));
  options.inputs = { folder.Path() / "none" };
  EXPECT_THROW(CaseList(options), InputError);
}

TEST(BatchJob, ACaseThatIsNoneIsRefusedBeforeAnythingIsMade)
{
  const TemporaryFolder folder;
  WriteAll(folder / "a.nrrd", "");
  BatchOptions options = Options({});
  options.inputs = { folder / "a.nrrd" };
  options.output = folder / "out";
  for (const std::size_t number : { 0, 2 })
  {
    options.only = number;
    EXPECT_THROW(RunBatchJob(options), UsageError) << number;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
  options.only.reset();
  options.output = folder / "a.nrrd"; // a file in the place of the folder
  EXPECT_THROW(RunBatchJob(options), OutputError);
  options.output = folder / "none";
  options.gather = true;
  EXPECT_THROW(RunBatchJob(options), InputError);
}

TEST(BatchJob, TheTextCountsWhatIsDoneAndNamesWhatFailed)
{
  BatchResult result;
  result.cases = 5;
  result.kept = 2;
  result.failed = { { "x", "has no label" } };
  for (int i = 0; i < 23; ++i)
  {
    result.passedOver.emplace_back("f" + std::to_string(i) + ".txt");
  }
  const std::string text = BatchText(result);
  EXPECT_THAT(text, HasSubstr("4 of 5 cases done, 2 of them before\nfailed: x: has no label\n"));
  EXPECT_THAT(text, HasSubstr("f19.txt\n"));
  EXPECT_EQ(text.find("f20.txt"), std::string::npos);
  EXPECT_THAT(text, HasSubstr("passed over: 3 more files"));
  result.kept = 0;
  EXPECT_EQ(BatchText(result).find("before"), std::string::npos);
  result.failed = { { "a\nb\x1B[2J", "c\rd" } };
  EXPECT_THAT(BatchText(result), HasSubstr("\nfailed: a b [2J: c d\n")) << "a line a case, whatever its id";
}

} // namespace
} // namespace voxelcore::testing
