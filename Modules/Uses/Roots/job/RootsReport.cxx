#include "RootsReport.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Report/ReportTable.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <vector>

namespace voxelcore
{

namespace
{

using Json = nlohmann::ordered_json;

/** Grey levels, and what persists over them. */
Json
LevelsJson(const GreyLevels & levels)
{
  Json json{ { "shape", levels.shape },           { "kernel", levels.kernel }, { "neighborhood", levels.neighbourhood },
             { "background", levels.background }, { "bright", levels.bright }, { "otsu", levels.otsu },
             { "valley", levels.valley },         { "tried", Json::array() } };
  for (const auto & tried : levels.tried)
  {
    json["tried"].push_back({ { "level", tried.level }, { "betti", tried.numbers.betti } });
  }
  return json;
}

/** Where the length of the skeleton is. */
Json
BalanceJson(const RootBalance & balance)
{
  return { { "skeleton", balance.skeleton }, { "roots", balance.roots },     { "within_parents", balance.within },
           { "shared", balance.shared },     { "bridged", balance.bridged }, { "bridges", balance.bridges },
           { "removed", balance.removed },   { "bulges", balance.bulges } };
}

/** What was cut and filled. */
Json
TopologyJson(const RootsTopology & topology)
{
  Json json{ { "before", topology.before.betti }, { "after", topology.after.betti }, { "as_asked", topology.asAsked } };
  if (!topology.asAsked)
  {
    json["reason"] = topology.reason;
  }
  if (topology.levels)
  {
    json["levels"] = LevelsJson(*topology.levels);
  }
  json["changes"] = Json::array();
  for (const RootsChange & change : topology.parts)
  {
    json["changes"].push_back({ { "kind", change.isFill ? "fill" : "cut" },
                                { "place", change.centre },
                                { "voxels", change.voxels },
                                { "cost", change.cost },
                                { "difference", change.difference } });
  }
  return json;
}

} // namespace

std::string
RootsJson(const RootModel &                    model,
          const std::optional<RootsTopology> & topology,
          double                               volume,
          const std::string &                  edits)
{
  const RootTraits & traits = model.traits;
  Json               json{ { "up", UpText(model.roots.up) },
             { "up_found", model.roots.upFound },
             { "axes", model.roots.axes.size() },
             { "stems", traits.stems },
             { "total_length", traits.levels.empty() ? 0 : traits.levels.back().totalLength },
             { "whorls", traits.whorls },
             { "balance", BalanceJson(traits.balance) },
             { "plant", Json::parse(PlantJson(model, volume)) },
             { "edits", Json::parse(edits) },
             { "contacts", Json::array() } };
  for (const RootMeeting & meeting : model.roots.meetings)
  {
    json["contacts"].push_back({ { "place", meeting.position },
                                 { "radius", meeting.radius },
                                 { "margin", meeting.margin },
                                 { "undecided", meeting.undecided } });
  }
  if (topology)
  {
    json["topology"] = TopologyJson(*topology);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string
RootsText(const RootsResult & result)
{
  const RootTraits & traits = result.model.traits;
  const LengthUnit   unit = LengthUnit::For(traits.depth, result.model.unit);
  const auto         angle = [](double value) {
    char text[24];
    (void)std::snprintf(text, sizeof(text), "%.0f", value);
    return std::isfinite(value) ? std::string(text) : std::string("-");
  };
  std::vector<std::vector<std::string>> rows{ { "level",
                                                "roots",
                                                "length " + unit.Name(),
                                                "mean " + unit.Name(),
                                                "diameter " + unit.Name(),
                                                "emergence deg",
                                                "from down deg" } };
  for (const RootLevelRecord & level : traits.levels)
  {
    using Kind = RootLevelRecord::Kind;
    rows.push_back({ level.kind == Kind::All        ? std::string("all")
                     : level.kind == Kind::Laterals ? std::string("laterals")
                                                    : std::to_string(level.level),
                     std::to_string(level.count),
                     unit.Text(level.totalLength),
                     level.count > 0 ? unit.Text(level.meanLength) : "-",
                     level.count > 0 ? unit.Text(level.meanDiameter) : "-",
                     angle(level.meanEmergenceAngle),
                     angle(level.meanTipFromDown) });
  }
  const auto counted = [](std::size_t count, const char * one, const char * more) {
    return count > 0 ? std::to_string(count) + (count == 1 ? one : more) : std::string();
  };
  const std::string leftOut = unit.Text(traits.balance.LeftOut());
  const bool        isLeft = leftOut.find_first_of("123456789") != std::string::npos;
  return FormatTable(rows) + counted(traits.contacts, " contact of roots", " contacts of roots") +
         (traits.undecidedContacts > 0 ? ", " : "") + counted(traits.undecidedContacts, " undecided", " undecided") +
         (traits.contacts > 0 ? "; " : "") + counted(traits.whorls, " whorl; ", " whorls; ") + "of the skeleton's " +
         unit.Text(traits.balance.skeleton) + " " + unit.Name() + " " + unit.Text(traits.balance.roots) +
         " on roots, " + unit.Text(traits.balance.within) + " within their parents" +
         (isLeft ? ", " + leftOut + " left out" : "") + "; depth " + unit.Text(traits.depth) + " " + unit.Name() +
         ", width " + unit.Text(traits.width) + " " + unit.Name() + "\n";
}

} // namespace voxelcore
