#pragma once
// Tables whose columns are described in a list: each has `name`, `unit` and `meaning`.

#include "voxelcore/Models/TableHead.h"
#include "voxelcore/Models/TextFile.h"

#include "voxelcore/Base/SpatialUnit.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

constexpr int tableDigits = 7; // significant, of numbers that are not whole

/** A column whose values are written elsewhere. */
struct Column
{
  const char * name;
  const char * unit;
  const char * meaning;
};

// What many tables begin with.
constexpr Column kLabelColumn{ "label", "", "value of the label" };
constexpr Column kNameColumn{ "name", "", "name of the label" };
constexpr Column kPartColumn{ "part", "", "component of a label that was split, from 1; 0: the whole label" };
constexpr Column kBranchIdColumn{ "branch_id", "", "number of the branch, the cell array BranchId" };

/** A column's name as a table's first line has it. */
template <typename OneColumn>
std::string
HeadOf(const OneColumn & column, HeadUnits units)
{
  const std::string unit = units ? InUnit(column.unit, *units) : std::string();
  return std::string(column.name) + (unit.empty() || unit == "1" ? "" : " [" + unit + "]");
}

/** A table's first line. */
template <typename Columns>
std::string
HeadLine(const Columns & columns, HeadUnits units)
{
  std::string line;
  for (const auto & column : columns)
  {
    line += (line.empty() ? "" : ",") + HeadOf(column, units);
  }
  return line + "\n";
}

/** What the columns mean, as a JSON object; those of `further` follow. */
template <typename Columns, typename Further = std::vector<Column>>
std::string
ColumnsJson(const Columns & columns, SpatialUnit unit, const Further & further = {})
{
  std::string json = "{";
  const auto  add = [&](const auto & column) {
    json += (json.size() > 1 ? ",\n    \"" : "\n    \"") + std::string(column.name) + "\": {\"Description\": \"" +
            column.meaning + "\"" +
            (column.unit[0] != '\0' ? ", \"Units\": \"" + InUnit(column.unit, unit) + "\"" : "") + "}";
  };
  std::for_each(std::begin(columns), std::end(columns), add);
  std::for_each(std::begin(further), std::end(further), add);
  return json + "\n  }";
}

/** What the columns of several tables mean, as JSON: names of tables, each with its ColumnsJson(). */
inline std::string
TablesJson(const std::vector<std::pair<const char *, std::string>> & tables)
{
  std::string json = "{";
  for (const auto & [name, columns] : tables)
  {
    json += (json.size() > 1 ? ",\n  \"" : "\n  \"") + std::string(name) + "\": " + columns;
  }
  return json + "\n}\n";
}

/** Two TablesJson() as one. */
inline std::string
JoinedTables(const std::string & one, const std::string & other)
{
  return one.substr(0, one.rfind('\n', one.size() - 2)) + "," + other.substr(1);
}

} // namespace voxelcore
