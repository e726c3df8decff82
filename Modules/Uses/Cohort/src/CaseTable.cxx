#include "CaseTable.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CsvText.h"

#include <map>
#include <set>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

const std::map<std::string, const char *> kOwnColumns{
  { "id", "the case" },
  { "folder", "where its results are" },
  { "status", "done or failed" },
  { "reason", "why it failed" },
  { "warnings", "what its run warned of, separated by |" },
  { "scan", "its scan" },
  { "labels", "number of its labels" },
  { "label", "value of the label" },
  { "name", "name of the label" },
  { "measure", "column compare_... of labels.csv" },
  { "cases", "in which the measure exists" },
  { "mean", "of these, in the measure's unit" },
  { "ci95_low", "95 % interval of the mean, by Student's t" },
  { "ci95_high", "its upper end" },
  { "sd", "standard deviation of the cases" },
  { "median", "of the cases" },
  { "min", "the least" },
  { "max", "the greatest" },
  { "outliers", "columns in which the row stands out, each with + or -" },
};

/** The unit that the name of a report's number ends in, before numbers of a list; empty: none. */
std::string
UnitOf(std::string name)
{
  for (std::size_t at = name.rfind('_');
       at != std::string::npos && name.find_first_not_of("0123456789", at + 1) == std::string::npos;
       at = name.rfind('_'))
  {
    name.resize(at);
  }
  if (name.starts_with("seconds_"))
  {
    return "s";
  }
  static const std::map<std::string, const char *> units{
    { "mm", "mm" },      { "mm2", "mm^2" },   { "mm3", "mm^3" }, { "vox", "vox" },
    { "vox2", "vox^2" }, { "vox3", "vox^3" }, { "deg", "deg" },  { "mb", "MB" },
  };
  const auto unit = units.find(name.substr(name.rfind('_') + 1));
  return unit != units.end() ? unit->second : "";
}

} // namespace

void
Flatten(const nlohmann::ordered_json & json,
        const std::string &            prefix,
        const std::set<std::string> &  leaveOut,
        Row &                          row)
{
  std::size_t number = 0;
  for (const auto & [key, value] : json.items())
  {
    const std::string own = json.is_array() ? std::to_string(number++) : key;
    const std::string name = prefix.empty() ? own : Text(prefix, "_", own);
    if (leaveOut.contains(name))
    {
      continue;
    }
    if (value.is_structured())
    {
      Flatten(value, name, leaveOut, row);
    }
    else
    {
      row[name] = value;
    }
  }
}

std::vector<TextColumn>
ColumnsOf(const std::vector<Row> & rows)
{
  std::vector<TextColumn> columns;
  std::set<std::string>   known;
  for (const Row & row : rows)
  {
    for (const auto & [key, value] : row.items())
    {
      if (known.insert(key).second)
      {
        const auto own = kOwnColumns.find(key);
        columns.push_back({ key, UnitOf(key), own != kOwnColumns.end() ? own->second : "as in the report" });
      }
    }
  }
  return columns;
}

std::string
CsvTable(const std::vector<Row> & rows, const std::vector<TextColumn> & columns, HeadUnits units)
{
  std::string text = HeadLine(columns, units);
  for (const Row & row : rows)
  {
    std::string line;
    for (const TextColumn & column : columns)
    {
      const Json value = row.value(column.name, Json());
      line += value.is_null()     ? ""
              : value.is_string() ? CsvField(value.get_ref<const std::string &>())
                                  : CsvPlainField(value.dump());
      line += ',';
    }
    line.back() = '\n';
    text += line;
  }
  return text;
}

} // namespace voxelcore
