#include "voxelcore/Cohort/GatherCohort.h"

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Report/CsvText.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

using ::testing::HasSubstr;

/** Leaves what a case leaves. */
void
MakeCase(const TemporaryFolder & folder, const std::string & id, bool done, const std::string & report)
{
  const std::string           name = CaseFolder(id);
  const std::filesystem::path place = folder / name;
  std::filesystem::create_directory(place);
  CaseRecord record;
  record.id = id;
  record.scan = "/data/" + id + ".nrrd";
  record.key = "k";
  record.done = done;
  record.reason = done ? "" : "has no label";
  if (done)
  {
    WriteAll(place / (name + "_report.json"), report);
    record.outputs = ListOutputs(place);
  }
  WriteCaseRecord(place, record);
}

std::string
ReportOf(const std::string & labels)
{
  return R"({"input":{"format":"NRRD"},"parameters":{"lambda":["0"]},"labels":[)" + labels + "]}";
}

CohortCase
Expected(const std::string & id)
{
  return { id, CaseFolder(id), "/data/" + id + ".nrrd", {} };
}

/** A table as rows of column and field. */
std::vector<std::map<std::string, std::string>>
Table(const std::filesystem::path & path)
{
  const auto                                      rows = ParseCsv(ReadAll(path), path.string());
  std::vector<std::map<std::string, std::string>> table;
  for (std::size_t i = 1; i < rows.size(); ++i)
  {
    EXPECT_EQ(rows[i].fields.size(), rows[0].fields.size());
    for (std::size_t c = 0; c < rows[0].fields.size(); ++c)
    {
      table.resize(i);
      table.back()[rows[0].fields[c]] = rows[i].fields[c];
    }
  }
  return table;
}

TEST(GatherCohort, EveryCaseHasARowAndEveryLabelOfADoneOne)
{
  const TemporaryFolder folder;
  MakeCase(folder,
           "b",
           true,
           ReportOf(R"({"label":1,"name":"=liver","volume_mm3":12.5,"box":[1,2]},{"label":7,"name":"rib"})"));
  MakeCase(folder, "a", false, "");
  const CohortSummary summary = GatherCohort(folder.Path(), { Expected("b"), Expected("a"), Expected("c") });
  EXPECT_EQ(summary.cases, 3U);
  ASSERT_EQ(summary.failed.size(), 2U);
  EXPECT_EQ(summary.failed[0].id, "a");
  EXPECT_EQ(summary.failed[0].reason, "has no label");
  EXPECT_EQ(summary.failed[1].id, "c");
  EXPECT_THAT(summary.failed[1].reason, HasSubstr("left no result"));

  const auto cases = Table(folder / "cases.csv");
  ASSERT_EQ(cases.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_EQ(cases[i].at("id"), std::string(1, static_cast<char>('a' + i))) << "ordered by id";
    EXPECT_EQ(cases[i].at("status"), i == 1 ? "done" : "failed");
  }
  EXPECT_EQ(cases[0].at("reason"), "has no label");
  EXPECT_EQ(cases[1].at("input_format"), "NRRD");
  EXPECT_EQ(cases[2].at("input_format"), "");

  const auto labels = Table(folder / "labels.csv");
  ASSERT_EQ(labels.size(), 2U);
  EXPECT_EQ(labels[0].at("id"), "b");
  EXPECT_EQ(labels[0].at("name"), "'=liver") << "no spreadsheet takes it for a formula";
  EXPECT_EQ(labels[0].at("volume_mm3"), "12.5");
  EXPECT_EQ(labels[0].at("box_1"), "2");
  EXPECT_EQ(labels[1].at("box_1"), "");
  EXPECT_TRUE(labels[0].contains("outliers"));

  const auto description = nlohmann::json::parse(ReadAll(folder / "dataset_description.json"));
  EXPECT_EQ(description.at("DatasetType"), "derivative");
  EXPECT_THAT(ReadAll(folder / "index.html"), HasSubstr("has no label"));
}

TEST(GatherCohort, TakesCasesOfAnyBatchAndWritesTheSameAgain)
{
  const TemporaryFolder folder;
  for (const char * id : { "x", "y", "z" })
  {
    MakeCase(folder, id, true, ReportOf(R"({"label":1,"name":"n","volume_mm3":3})"));
  }
  WriteAll(folder / "sub-file", "no case"); // only folders are
  std::filesystem::create_directory(folder / "sub-empty");
  std::filesystem::create_directory(folder / "other");
  EXPECT_EQ(GatherCohort(folder.Path(), {}).cases, 3U);
  std::map<std::string, std::string> before;
  for (const char * name : { "cases.csv", "labels.csv", "dataset_description.json", "index.html" })
  {
    before[name] = ReadAll(folder / name);
    EXPECT_FALSE(before[name].empty()) << name;
  }
  EXPECT_EQ(GatherCohort(folder.Path(), { Expected("y") }).cases, 3U);
  for (const auto & [name, bytes] : before)
  {
    EXPECT_EQ(ReadAll(folder / name), bytes) << name;
  }
}

TEST(GatherCohort, ADoneCaseWhoseReportIsGoneOrDamagedIsNotPassedOverInSilence)
{
  const TemporaryFolder folder;
  MakeCase(folder, "a", true, ReportOf(R"({"label":1,"name":"n"})"));
  const std::string              deep = std::string(200000, '[') + std::string(200000, ']');
  const std::vector<std::string> damaged{ "{ no json",
                                          "[]",
                                          R"({"labels":[]})",
                                          ReportOf(R"({"name":"n"})"),
                                          ReportOf(R"({"label":1})"),
                                          ReportOf("3"),
                                          ReportOf(R"({"label":1,"name":"n","x":)" + deep + "}") };
  for (std::size_t i = 0; i < damaged.size(); ++i)
  {
    MakeCase(folder, "b" + std::to_string(i), true, damaged[i]);
  }
  const CohortSummary summary = GatherCohort(folder.Path(), {});
  EXPECT_EQ(summary.cases, 1 + damaged.size());
  ASSERT_EQ(summary.failed.size(), damaged.size());
  EXPECT_EQ(summary.failed[0].id, "b0");
  EXPECT_THAT(summary.failed[0].reason, HasSubstr("its report is missing or damaged"));
  EXPECT_EQ(Table(folder / "labels.csv").size(), 1U);
  EXPECT_EQ(Table(folder / "cases.csv")[1].at("status"), "failed");
}

TEST(GatherCohort, AReportThatWasChangedIsNotPassedOverInSilence)
{
  const TemporaryFolder folder;
  MakeCase(folder, "a", true, ReportOf(R"({"label":1,"name":"n","volume_mm3":3})"));
  EXPECT_TRUE(GatherCohort(folder.Path(), {}).failed.empty());
  for (const char * label : { R"({"label":1,"name":"n","volume_mm3":4})", R"({"label":1,"name":5})" })
  {
    WriteAll(folder / "sub-a/sub-a_report.json", ReportOf(label));
    ASSERT_EQ(GatherCohort(folder.Path(), {}).failed.size(), 1U) << label;
  }
}

TEST(GatherCohort, ACaseThatFailedAndCouldNotSaySoIsNotTakenForWhatItWasBefore)
{
  const TemporaryFolder folder;
  MakeCase(folder, "a", true, ReportOf(R"({"label":1,"name":"n"})"));
  MakeCase(folder, "b", true, ReportOf(R"({"label":1,"name":"n"})"));
  const CohortSummary summary = GatherCohort(folder.Path(),
                                             { Expected("a"), Expected("b") },
                                             {},
                                             { { "a", "no room", false }, { "b", "late", true } });
  ASSERT_EQ(summary.failed.size(), 1U) << "another batch has done b since";
  EXPECT_EQ(summary.failed[0].reason, "no room");
  EXPECT_EQ(Table(folder / "cases.csv")[0].at("reason"), "no room");
}

TEST(GatherCohort, WithoutACaseThereIsNothingToGather)
{
  const TemporaryFolder folder;
  EXPECT_THROW(GatherCohort(folder.Path(), {}), InputError);
  EXPECT_THROW(GatherCohort(folder / "none", {}), InputError);
  EXPECT_TRUE(folder.Names().empty() || folder.Names() == std::set<std::string>{ ".voxelcore" });
}

} // namespace
} // namespace voxelcore::testing
