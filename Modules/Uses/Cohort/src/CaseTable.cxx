#include "CaseTable.h"

#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Report/CsvText.h"

#include <map>

namespace voxelcore
{

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

std::string
CsvTable(const std::vector<Row> & rows)
{
  std::vector<std::string>           columns;
  std::map<std::string, std::size_t> places;
  for (const Row & row : rows)
  {
    for (const auto & [key, value] : row.items())
    {
      if (places.emplace(key, columns.size()).second)
      {
        columns.push_back(key);
      }
    }
  }
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    text += (i > 0 ? "," : "") + CsvPlainField(columns[i]);
  }
  text += "\n";
  for (const Row & row : rows)
  {
    std::vector<std::string> fields(columns.size());
    for (const auto & [key, value] : row.items())
    {
      fields[places.at(key)] = value.is_null()     ? ""
                               : value.is_string() ? CsvField(value.get_ref<const std::string &>())
                                                   : CsvPlainField(value.dump());
    }
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      text += (i > 0 ? "," : "") + fields[i];
    }
    text += "\n";
  }
  return text;
}

} // namespace voxelcore
