#include "voxelcore/Cohort/GatherCohort.h"

#include "BidsDataset.h"
#include "CaseLock.h"
#include "CaseTable.h"
#include "CohortMeans.h"
#include "CohortPage.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/JsonText.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Cohort/CaseRecord.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Report/CoreReport.h"
#include "voxelcore/Report/Sha256.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <thread>

namespace voxelcore
{

namespace fs = std::filesystem;

namespace
{

using Json = nlohmann::ordered_json;

constexpr const char * kNoResult =
  "left no result: not run yet, or killed from outside (by the cluster's limits?) before it could say why";

/** Every case that has a record or should have one, by folder. */
std::map<std::string, CaseRecord>
FindRecords(const fs::path & folder, const std::vector<CohortCase> & expected, const std::vector<FailedCase> & failed)
{
  std::map<std::string, std::string> reasons;
  for (const FailedCase & one : failed)
  {
    if (!one.recorded)
    {
      reasons[CaseFolder(one.id)] = one.reason;
    }
  }
  std::map<std::string, CaseRecord> records;
  for (const CohortCase & one : expected)
  {
    CaseRecord & record = records[one.folder];
    record.id = one.id;
    record.scan = one.scan;
    const auto known = reasons.find(one.folder);
    record.reason = known != reasons.end() ? known->second : kNoResult;
  }
  std::error_code error;
  for (const auto & entry : fs::directory_iterator(folder, error))
  {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("sub-") || !fs::is_directory(entry.symlink_status()) || reasons.contains(name))
    {
      continue;
    }
    if (auto record = ReadCaseRecord(entry.path()))
    {
      records[name] = std::move(*record);
    }
  }
  if (error)
  {
    throw InputError(folder.string() + ": cannot read: " + error.message());
  }
  if (records.empty())
  {
    throw InputError(folder.string() + ": holds no case of 'voxelcore batch'; give the folder it wrote into");
  }
  return records;
}

std::string
Joined(const std::vector<std::string> & lines)
{
  std::string text;
  for (const std::string & line : lines)
  {
    text += (text.empty() ? "" : " | ") + line;
  }
  return text;
}

/** Label values as one field, so that atlases do not give a column a label. */
std::string
Joined(const Json & values)
{
  std::string text;
  for (const Json & value : values)
  {
    text += (text.empty() ? "" : " ") + value.dump();
  }
  return text;
}

/** The report of a case as it was written; none when it is missing or another one. */
Json
ReadReport(const fs::path & folder, const CaseRecord & record)
{
  const std::string name = folder.filename().string() + "_report.json";
  std::ifstream     file(folder / name, std::ios::binary);
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  const auto        written = ranges::find(record.outputs, name, &RecordedFile::name);
  return written != record.outputs.end() && written->sha256 == TextSha256(text)
           ? Json::parse(PlainJson(text), nullptr, false)
           : Json();
}

Row
CaseRow(const std::string & folder, const CaseRecord & record)
{
  Row row;
  row["id"] = record.id;
  row["folder"] = folder;
  row["status"] = record.done ? "done" : "failed";
  row["reason"] = record.reason;
  row["warnings"] = Joined(record.warnings);
  row["scan"] = record.scan;
  return row;
}

/** \throws Json::exception when the label is not as reports have it */
Row
LabelRow(const std::string & folder, const CaseRecord & record, const Json & label)
{
  Row row;
  row["id"] = record.id;
  row["folder"] = folder;
  row["label"] = label.at("label");
  row["name"] = label.at("name");
  Flatten(label, "", { "skeleton_cuts" }, row);
  if (label.contains("skeleton"))
  {
    row["skeleton_cuts"] = label.at("skeleton").at("cuts").size();
  }
  return row;
}

/** Adds the numbers of `voxelcore thickness` to the labels' rows, and a row for the separation.
 *  \throws Json::exception when they are not as reports have them */
void
AddThickness(const std::string & folder, const CaseRecord & record, const Json & report, std::vector<Row> & labels)
{
  const Json & thickness = report.at("thickness");
  for (std::size_t i = 0; i < thickness.size(); ++i)
  {
    const Json & numbers = thickness.at(i);
    // Labels in their order, the separation last.
    if (i == labels.size())
    {
      const Json separation = { { "label", 0 }, { "name", numbers.at("name") } };
      labels.push_back(
        LabelRow(folder, record, numbers.at("of") == "separation" ? separation : report.at("labels").at(i)));
    }
    Row & row = labels[i];
    Flatten(numbers,
            "thickness",
            { "thickness_label", "thickness_component", "thickness_name", "thickness_of", "thickness_histogram" },
            row);
    row["thickness_histogram"] = Joined(numbers.at("histogram"));
  }
}

/** A row a label of 'voxelcore compare', its measures as compare_..., with units where they have some; the case's row
 *  gets what was compared. \throws Json::exception when the report is not as it is written */
std::vector<Row>
TakeComparison(const std::string & folder, const CaseRecord & record, const Json & report, Row & row)
{
  std::vector<Row> labels;
  const Json &     units = report.at("units");
  for (const Json & label : report.at("labels"))
  {
    Json measures = Json::object();
    for (const auto & [key, value] : label.items())
    {
      if (key != "label" && key != "name")
      {
        measures[units.contains(key) ? key + "_" + units.at(key).get<std::string>() : key] = value;
      }
    }
    labels.push_back(LabelRow(folder, record, { { "label", label.at("label") }, { "name", label.at("name") } }));
    Flatten(measures, "compare", {}, labels.back());
  }
  row["labels"] = labels.size();
  Flatten(report, "", { "labels", "units", "differences", "branches", "levels" }, row);
  return labels;
}

/** Adds what a report says to its case's row; returns a row a label. \throws Json::exception when it is damaged */
std::vector<Row>
TakeReport(const std::string & folder, const CaseRecord & record, const Json & report, Row & row)
{
  if (report.contains("kind"))
  {
    return TakeComparison(folder, record, report, row);
  }
  std::vector<Row> labels;
  for (const Json & label : report.at("labels"))
  {
    labels.push_back(LabelRow(folder, record, label));
  }
  if (report.contains("roots") && !labels.empty())
  {
    const Json & roots = report.at("roots");
    Flatten(roots.at("plant"), "plant", {}, labels.at(0));
    row["up"] = roots.at("up");
    if (roots.contains("topology"))
    {
      row["cuts_and_fills"] = roots.at("topology").at("changes").size();
      row["topology_as_asked"] = roots.at("topology").at("as_asked");
    }
  }
  row["labels"] = labels.size();
  if (report.contains("thickness"))
  {
    AddThickness(folder, record, report, labels);
  }
  row["parameters_labels"] = Joined(report.at("parameters").value("labels", Json::array()));
  Flatten(report, "", { "labels", "parameters_labels", "parameters_change_voxels", "roots", "thickness" }, row);
  return labels;
}

std::string
Description()
{
  Json json;
  json["Name"] = "Medial surfaces and curve skeletons";
  json["BIDSVersion"] = "1.8.0";
  json["DatasetType"] = "derivative";
  json["GeneratedBy"] = Json::array({ { { "Name", "VoxelCore" }, { "Version", VoxelCoreVersion() } } });
  return json.dump(2) + "\n";
}

/** Two batches that end at once write one after the other. */
CaseLock
WaitForTables(const fs::path & folder, const ProgressCallback & progress)
{
  using namespace std::chrono_literals;
  for (;;)
  {
    if (auto lock = CaseLock::Try(folder / ".voxelcore" / "tables.lock"))
    {
      return std::move(*lock);
    }
    ReportProgress(progress, "waiting for another batch's tables", 1);
    std::this_thread::sleep_for(50ms);
  }
}

} // namespace

CohortSummary
GatherCohort(const fs::path &                folder,
             const std::vector<CohortCase> & expected,
             const JobContext &              context,
             const std::vector<FailedCase> & failed,
             bool                            bids)
{
  CohortSummary         summary;
  std::vector<Row>      caseRows;
  std::vector<Row>      labelRows;
  std::vector<PageCase> pageCases;
  if (!fs::is_directory(folder))
  {
    throw InputError(folder.string() + ": no such folder; give the one that 'voxelcore batch' wrote into");
  }
  const CaseLock lock = WaitForTables(folder, context.progress);
  for (auto & [name, record] : FindRecords(folder, expected, failed))
  {
    Row row = CaseRow(name, record);
    if (record.done)
    {
      try
      {
        const std::vector<Row> labels = TakeReport(name, record, ReadReport(folder / name, record), row);
        labelRows.insert(labelRows.end(), labels.begin(), labels.end());
      }
      catch (const Json::exception &)
      {
        record.done = false;
        record.reason = "its report is missing or damaged; run the batch again";
        row = CaseRow(name, record);
      }
    }
    if (!record.done)
    {
      summary.failed.push_back({ record.id, record.reason });
    }
    ++summary.cases;
    caseRows.push_back(std::move(row));
    pageCases.push_back({ name, std::move(record), {} });
  }
  FindOutliers(labelRows);
  std::size_t at = 0;
  for (const Row & row : labelRows)
  {
    while (pageCases[at].folder != row.at("folder").get_ref<const std::string &>())
    {
      ++at;
    }
    pageCases[at].labels.push_back(row);
  }
  OutputTransaction transaction(true, context.temporaries);
  const HeadUnits   units = context.Heads(SpatialUnit::Millimetres); // names say voxels where it is these
  const auto        caseColumns = ColumnsOf(caseRows);
  const auto        labelColumns = ColumnsOf(labelRows);
  WriteTextFile(transaction.Stage(folder / "cases.csv"), CsvTable(caseRows, caseColumns, units));
  WriteTextFile(transaction.Stage(folder / "labels.csv"), CsvTable(labelRows, labelColumns, units));
  std::vector<std::pair<const char *, std::string>> meanings{
    { "cases", ColumnsJson(caseColumns, SpatialUnit::Millimetres) },
    { "labels", ColumnsJson(labelColumns, SpatialUnit::Millimetres) }
  };
  if (const std::vector<Row> means = MeansOfComparisons(labelRows); !means.empty())
  {
    const auto columns = ColumnsOf(means);
    WriteTextFile(transaction.Stage(folder / "means.csv"), CsvTable(means, columns, units));
    meanings.emplace_back("means", ColumnsJson(columns, SpatialUnit::Millimetres));
  }
  WriteTextFile(transaction.Stage(folder / "columns.json"), TablesJson(meanings));
  WriteTextFile(transaction.Stage(folder / "dataset_description.json"), Description());
  WriteTextFile(transaction.Stage(folder / "index.html"), CohortPage(pageCases));
  if (bids)
  {
    std::vector<std::pair<std::string, const CaseRecord *>> done;
    for (const PageCase & one : pageCases)
    {
      if (one.record.done)
      {
        done.emplace_back(one.folder, &one.record);
      }
    }
    WriteBidsDataset(transaction.StageWithCompanions(folder / "bids"), folder, Description(), done);
  }
  transaction.Commit();
  return summary;
}

} // namespace voxelcore
