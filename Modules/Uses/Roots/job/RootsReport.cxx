#include "RootsReport.h"

#include "voxelcore/Base/LengthUnit.h"
#include "voxelcore/Report/ReportTable.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace voxelcore
{

namespace
{

std::string
JsonNumber(double value)
{
  char text[40];
  (void)std::snprintf(text, sizeof(text), "%.9g", value);
  return std::isfinite(value) ? text : "null";
}

std::string
BettiJson(const TopologyNumbers & numbers)
{
  const auto & betti = numbers.betti;
  return "[" + std::to_string(betti[0]) + "," + std::to_string(betti[1]) + "," + std::to_string(betti[2]) + "]";
}

/** Grey levels, and what persists over them. */
std::string
LevelsJson(const GreyLevels & levels)
{
  std::string json = ",\n      \"levels\": {\n        \"shape\": " + JsonNumber(levels.shape) +
                     ",\n        \"kernel\": " + JsonNumber(levels.kernel) +
                     ",\n        \"neighborhood\": " + JsonNumber(levels.neighbourhood) +
                     ",\n        \"background\": " + JsonNumber(levels.background) +
                     ",\n        \"bright\": " + JsonNumber(levels.bright) +
                     ",\n        \"otsu\": " + JsonNumber(levels.otsu) +
                     ",\n        \"valley\": " + JsonNumber(levels.valley) + ",\n        \"tried\": [";
  for (std::size_t i = 0; i < levels.tried.size(); ++i)
  {
    json += std::string(i > 0 ? "," : "") + "\n          { \"level\": " + JsonNumber(levels.tried[i].level) +
            ", \"betti\": " + BettiJson(levels.tried[i].numbers) + " }";
  }
  return json + (levels.tried.empty() ? "]" : "\n        ]") + "\n      }";
}

/** Where the length of the skeleton is. */
std::string
BalanceJson(const RootBalance & balance)
{
  return "{ \"skeleton\": " + JsonNumber(balance.skeleton) + ", \"roots\": " + JsonNumber(balance.roots) +
         ", \"within_parents\": " + JsonNumber(balance.within) + ", \"shared\": " + JsonNumber(balance.shared) +
         ", \"bridged\": " + JsonNumber(balance.bridged) + ", \"bridges\": " + JsonNumber(balance.bridges) +
         ", \"removed\": " + JsonNumber(balance.removed) + ", \"bulges\": " + JsonNumber(balance.bulges) + " }";
}

/** What was cut and filled. */
std::string
TopologyJson(const RootsTopology & topology)
{
  std::string json = ",\n    \"topology\": {\n      \"before\": " + BettiJson(topology.before) +
                     ",\n      \"after\": " + BettiJson(topology.after) +
                     ",\n      \"as_asked\": " + (topology.asAsked ? "true" : "false") +
                     (topology.asAsked ? std::string() : ",\n      \"reason\": \"" + topology.reason + "\"") +
                     (topology.levels ? LevelsJson(*topology.levels) : std::string()) + ",\n      \"changes\": [";
  for (std::size_t i = 0; i < topology.parts.size(); ++i)
  {
    const RootsChange & change = topology.parts[i];
    json += std::string(i > 0 ? "," : "") + "\n        { \"kind\": \"" + (change.isFill ? "fill" : "cut") +
            "\", \"place\": [" + JsonNumber(change.centre[0]) + ", " + JsonNumber(change.centre[1]) + ", " +
            JsonNumber(change.centre[2]) + "], \"voxels\": " + std::to_string(change.voxels) +
            ", \"cost\": " + JsonNumber(change.cost) + ", \"difference\": [" + std::to_string(change.difference[0]) +
            "," + std::to_string(change.difference[1]) + "," + std::to_string(change.difference[2]) + "] }";
  }
  return json + (topology.parts.empty() ? "]" : "\n      ]") + "\n    }";
}

} // namespace

std::string
RootsJson(const RootModel &                    model,
          const std::optional<RootsTopology> & topology,
          double                               volume,
          const std::string &                  edits)
{
  const RootTraits & traits = model.traits;
  std::string        json =
    ",\n  \"roots\": {\n    \"up\": \"" + UpText(model.roots.up) +
    "\",\n    \"up_found\": " + (model.roots.upFound ? "true" : "false") +
    ",\n    \"axes\": " + std::to_string(model.roots.axes.size()) +
    ",\n    \"stems\": " + std::to_string(traits.stems) +
    ",\n    \"total_length\": " + JsonNumber(traits.levels.empty() ? 0 : traits.levels.back().totalLength) +
    ",\n    \"whorls\": " + std::to_string(traits.whorls) + ",\n    \"balance\": " + BalanceJson(traits.balance) +
    ",\n    \"plant\": " + PlantJson(model, volume) + ",\n    \"edits\": " + edits + ",\n    \"contacts\": [";
  for (std::size_t i = 0; i < model.roots.meetings.size(); ++i)
  {
    const RootMeeting & meeting = model.roots.meetings[i];
    json += std::string(i > 0 ? "," : "") + "\n      { \"place\": [" + JsonNumber(meeting.position[0]) + ", " +
            JsonNumber(meeting.position[1]) + ", " + JsonNumber(meeting.position[2]) +
            "], \"radius\": " + JsonNumber(meeting.radius) + ", \"margin\": " + JsonNumber(meeting.margin) +
            ", \"undecided\": " + (meeting.undecided ? "true" : "false") + " }";
  }
  json += model.roots.meetings.empty() ? "]" : "\n    ]";
  return json + (topology ? TopologyJson(*topology) : std::string()) + "\n  }\n}\n";
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
  return FormatTable(rows) + std::to_string(traits.contacts) + (traits.contacts == 1 ? " contact" : " contacts") +
         " of roots, " + std::to_string(traits.undecidedContacts) + " undecided; " + std::to_string(traits.whorls) +
         (traits.whorls == 1 ? " whorl" : " whorls") + "; of the skeleton's " + unit.Text(traits.balance.skeleton) +
         " " + unit.Name() + " " + unit.Text(traits.balance.roots) + " on roots, " + unit.Text(traits.balance.within) +
         " within their parents, " + unit.Text(traits.balance.LeftOut()) + " left out" + "; depth " +
         unit.Text(traits.depth) + " " + unit.Name() + ", width " + unit.Text(traits.width) + " " + unit.Name() + "\n";
}

} // namespace voxelcore
