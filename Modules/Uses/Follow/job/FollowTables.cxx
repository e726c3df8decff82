#include "FollowTables.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Jobs/JobTools.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Models/AppendedVtp.h"
#include "voxelcore/Models/SkeletonModel.h"
#include "voxelcore/Models/TableColumns.h"
#include "voxelcore/Roots/RootFiles.h"

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<Json>>; ///< null where there is nothing to measure

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr auto kBranchColumns = std::to_array<Column>({
  { "id", "", "number of the branch, the same on all days" },
  { "day", "", "from 1" },
  { "time", "", "of the day, in the unit of --times" },
  { "parent", "", "id of the branch it springs from; empty: none" },
  { "order", "", "0 without parent, 1 what springs from those, and so on" },
  { "state", "", "kept, new, back (it was lost) or lost (it was there the day before)" },
  { "length", "mm", "along the centre line, from its parent's to its tip" },
  { "growth",
    "mm",
    "by which its tip went on along its course since it was last there, by unit of time; of a new one its length since "
    "the day before" },
  { "mean_radius", "mm", "outside the ball it springs from, weighted by length" },
  { "radius_change",
    "mm",
    "since it was last there, mean along the course that both days share outside the ball it springs from" },
  { "x", "mm", "its tip, LPS, in the space of the first day; of a lost one where it was" },
  { "y", "mm", "" },
  { "z", "mm", "" },
});

constexpr auto kDayColumns = std::to_array<Column>({
  { "day", "", "from 1" },
  { "time", "", "in the unit of --times" },
  { "file", "", "" },
  { "branches", "", "that are there" },
  { "kept", "", "of them, that were there the day before" },
  { "new", "", "of them" },
  { "back", "", "of them, that had been lost" },
  { "lost", "", "branches of the day before that are not there" },
  { "length", "mm", "of all branches" },
  { "growth", "mm", "of all branches, by unit of time" },
  { "found", "1", "share of the length of the day before that is within the tolerance of this day's lines" },
  { "rms", "mm", "of the distances there" },
  { "slack", "mm", "standard deviation of the place that this motion leaves least certain: more than 1.5 rms warn" },
  { "turn", "degree", "by how much the motion into the space of the first day turns" },
  { "r11", "", "that motion: p -> R p + (x, y, z)" },
  { "r12", "", "" },
  { "r13", "", "" },
  { "r21", "", "" },
  { "r22", "", "" },
  { "r23", "", "" },
  { "r31", "", "" },
  { "r32", "", "" },
  { "r33", "", "" },
  { "x", "mm", "" },
  { "y", "mm", "" },
  { "z", "mm", "" },
});

Json
Known(double value)
{
  return std::isfinite(value) ? Json(value) : Json();
}

const char *
NameOf(BranchState state)
{
  return state == BranchState::Kept ? "kept" : state == BranchState::New ? "new" : "back";
}

/** By unit of time; NaN on the first day. */
double
GrowthOf(const FollowResult & result, std::size_t day, const FollowedBranch & branch)
{
  const bool isNew = branch.state == BranchState::New;
  if (day == 0)
  {
    return kNone;
  }
  return (isNew ? branch.length : branch.growth) / (result.times[day] - result.times[isNew ? day - 1 : branch.before]);
}

Rows
BranchRows(const FollowResult & result)
{
  Rows rows;
  for (std::size_t day = 0; day < result.days.size(); ++day)
  {
    const FollowedDay & now = result.days[day];
    const auto          head = [&](std::int64_t id) { return std::vector<Json>{ id, day + 1, result.times[day] }; };
    const auto          add = [&](std::vector<Json> & row, const Vector3 & tip) {
      row.insert(row.end(), tip.begin(), tip.end());
      rows.push_back(std::move(row));
    };
    for (const FollowedBranch & branch : now.branches)
    {
      auto row = head(branch.id);
      row.insert(row.end(),
                 { branch.parent == 0 ? Json() : Json(branch.parent),
                   branch.order,
                   NameOf(branch.state),
                   branch.length,
                   Known(GrowthOf(result, day, branch)),
                   branch.meanRadius,
                   Known(branch.radiusChange) });
      add(row, now.graph.positions[branch.points.back()]);
    }
    for (const LostBranch & branch : now.lost)
    {
      auto row = head(branch.id);
      row.insert(row.end(), { Json(), Json(), "lost", Json(), Json(), Json(), Json() });
      add(row, branch.tip);
    }
  }
  return rows;
}

double
LengthOf(const FollowedDay & day)
{
  double length = 0;
  for (const FollowedBranch & branch : day.branches)
  {
    length += branch.length;
  }
  return length;
}

std::int64_t
CountOf(const FollowedDay & day, BranchState state)
{
  return ranges::count(day.branches, state, &FollowedBranch::state);
}

Rows
DayRows(const FollowResult & result)
{
  Rows rows;
  for (std::size_t day = 0; day < result.days.size(); ++day)
  {
    const FollowedDay & now = result.days[day];
    const FoundMotion & moved = result.motions[day];
    double              growth = 0;
    for (const FollowedBranch & branch : now.branches)
    {
      growth += GrowthOf(result, day, branch);
    }
    std::vector<Json> row{ day + 1,
                           result.times[day],
                           result.names[day],
                           now.branches.size(),
                           CountOf(now, BranchState::Kept),
                           CountOf(now, BranchState::New),
                           CountOf(now, BranchState::Back),
                           now.lost.size(),
                           LengthOf(now),
                           Known(growth),
                           Known(moved.found),
                           Known(moved.rms),
                           Known(moved.spread * moved.rms),
                           moved.motion.Turn() };
    row.insert(row.end(), moved.motion.rotation.begin(), moved.motion.rotation.end());
    row.insert(row.end(), moved.motion.shift.begin(), moved.motion.shift.end());
    rows.push_back(std::move(row));
  }
  return rows;
}

template <typename Columns>
void
WriteRows(const std::filesystem::path & path, const Columns & columns, const Rows & rows, HeadUnits units)
{
  TextFile file(path, tableDigits);
  file << HeadLine(columns, units);
  for (const auto & row : rows)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      file << (i > 0 ? "," : "");
      if (row[i].is_number_float())
      {
        file << row[i].template get<double>();
      }
      else if (!row[i].is_null())
      {
        file << (row[i].is_string() ? CsvField(row[i].template get<std::string>()) : row[i].dump());
      }
    }
    file << "\n";
  }
  file.Finish();
}

template <typename Columns>
Json
ObjectsOf(const Columns & columns, const Rows & rows)
{
  Json objects = Json::array();
  for (const auto & row : rows)
  {
    Json object = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      object[columns[i].name] = row[i];
    }
    objects.push_back(std::move(object));
  }
  return objects;
}

} // namespace

void
WriteFollowedBranches(const std::filesystem::path & path, const FollowResult & result, HeadUnits units)
{
  WriteRows(path, kBranchColumns, BranchRows(result), units);
}

void
WriteFollowedDays(const std::filesystem::path & path, const FollowResult & result, HeadUnits units)
{
  WriteRows(path, kDayColumns, DayRows(result), units);
}

std::string
FollowColumnsJson(SpatialUnit unit)
{
  return TablesJson({ { "branches", ColumnsJson(kBranchColumns, unit) }, { "days", ColumnsJson(kDayColumns, unit) } });
}

std::string
FollowJson(const FollowResult & result, const std::string & command)
{
  const Json json = { { "voxelcore", { { "version", VoxelCoreVersion() }, { "command", command } } },
                      { "unit", UnitName(result.unit) },
                      { "days", ObjectsOf(kDayColumns, DayRows(result)) },
                      { "branches", ObjectsOf(kBranchColumns, BranchRows(result)) } };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string
FollowText(const FollowResult & result)
{
  std::string text;
  for (std::size_t day = 0; day < result.days.size(); ++day)
  {
    const FollowedDay & now = result.days[day];
    const FoundMotion & moved = result.motions[day];
    const std::string   unit = UnitName(result.unit);
    text += "day " + std::to_string(day + 1) + ": " + std::to_string(now.branches.size()) + " branches, " +
            FixedText(LengthOf(now)) + " " + unit;
    if (day > 0)
    {
      text += "; " + std::to_string(CountOf(now, BranchState::Kept)) + " kept, " +
              std::to_string(CountOf(now, BranchState::New)) + " new, " +
              std::to_string(CountOf(now, BranchState::Back)) + " back, " + std::to_string(now.lost.size()) +
              " lost; " + FixedText(100 * moved.found, 1) + " % of the day before found, rms " + FixedText(moved.rms) +
              " " + unit;
    }
    text += "\n";
  }
  return text;
}

void
WriteIdentitiesVtp(const std::filesystem::path & path, const FollowResult & result)
{
  VtpContent                               content;
  std::vector<double>                      radius;
  std::array<std::vector<std::int64_t>, 4> numbers;
  std::vector<double>                      lengths;
  for (std::size_t day = 0; day < result.days.size(); ++day)
  {
    const SkeletonGraph & graph = result.days[day].graph;
    for (const FollowedBranch & branch : result.days[day].branches)
    {
      for (const ElementIndex point : branch.points)
      {
        content.cells[1].points.push_back(std::ssize(radius));
        content.positions.insert(content.positions.end(), graph.positions[point].begin(), graph.positions[point].end());
        radius.push_back(SectionRadii(graph)[point]);
      }
      content.cells[1].offsets.push_back(std::ssize(radius));
      const std::int64_t values[]{ branch.id, static_cast<std::int64_t>(day + 1), branch.parent, branch.order };
      for (std::size_t k = 0; k < numbers.size(); ++k)
      {
        numbers[k].push_back(values[k]);
      }
      lengths.push_back(branch.length);
    }
  }
  content.texts = { { "SPACE", "LPS" }, { "Units", UnitName(result.unit) } };
  content.pointArrays = { { "Radius", std::move(radius) } };
  content.cellArrays = { { "Id", std::move(numbers[0]) },
                         { "Day", std::move(numbers[1]) },
                         { "ParentId", std::move(numbers[2]) },
                         { "Order", std::move(numbers[3]) },
                         { "Length", std::move(lengths) } };
  WriteVtp(path, std::move(content));
}

void
WriteDayRsml(const std::filesystem::path & path,
             const FollowResult &          result,
             std::size_t                   day,
             const std::filesystem::path & scan)
{
  const FollowedDay &                  now = result.days[day];
  RootModel                            model;
  RsmlSequence                         sequence{ ScanName(result.names.front()), static_cast<std::int64_t>(day), {} };
  std::map<std::int64_t, ElementIndex> numbers;
  for (const FollowedBranch & branch : now.branches)
  {
    numbers.emplace(branch.id, static_cast<ElementIndex>(numbers.size()));
    sequence.ids.push_back(branch.id);
  }
  for (const FollowedBranch & branch : now.branches)
  {
    RootAxis axis;
    axis.level = branch.order;
    axis.points = branch.points;
    RootRecord record;
    record.length = branch.length;
    record.meanDiameter = 2 * branch.meanRadius;
    record.emergenceAngle = kNone;
    if (branch.parent != 0)
    {
      axis.parent = numbers.at(branch.parent);
      const auto & above = now.branches[axis.parent].points;
      const auto   at = ranges::find(above, branch.points.front());
      axis.parentPoint = at == above.end() ? 0 : static_cast<std::size_t>(at - above.begin());
      record.alongParent = CourseOf(now.graph, std::span(above).first(axis.parentPoint + 1), false).arcs.back();
    }
    model.roots.axes.push_back(std::move(axis));
    model.traits.roots.push_back(record);
  }
  model.name = result.names[day];
  model.graph = now.graph;
  model.unit = result.unit;
  WriteRsml(path, model, { ModificationTime(scan), "VoxelCore " + VoxelCoreVersion(), {}, std::move(sequence) });
}

} // namespace voxelcore
