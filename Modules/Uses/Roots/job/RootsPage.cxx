// The summary of a root system: a page that any browser shows offline.

#include "RootsDisplay.h"

#include "voxelcore/Base/LengthUnit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace voxelcore
{

namespace
{

std::string
Escaped(const std::string & text)
{
  std::string escaped;
  for (const char c : text)
  {
    escaped += c == '&' ? std::string("&amp;") : c == '<' ? std::string("&lt;") : std::string(1, c);
  }
  return escaped;
}

/** Three digits, and all before the point. */
std::string
NumberText(double value)
{
  char text[40];
  (void)std::snprintf(text, sizeof(text), std::abs(value) >= 999.5 ? "%.0f" : "%.3g", value);
  return std::isfinite(value) ? text : "";
}

struct Bar
{
  double      value;
  std::string label;
};

/** Bars from the left, the first on top; it takes the width and the colour of text that it is given. */
std::string
BarChart(const std::string & title, const std::vector<Bar> & bars)
{
  constexpr int step = 13;
  double        most = 0;
  for (const Bar & bar : bars)
  {
    most = std::max(most, bar.value);
  }
  std::string svg = "<figure><figcaption>" + Escaped(title) + "</figcaption><svg viewBox=\"0 0 300 " +
                    std::to_string(step * bars.size()) +
                    "\" width=\"100%\" role=\"img\" font-size=\"10\" fill=\"currentColor\">\n";
  for (std::size_t i = 0; i < bars.size(); ++i)
  {
    const int         y = step * static_cast<int>(i);
    const double      width = most > 0 ? 185 * bars[i].value / most : 0;
    const std::string base = std::to_string(y + 9);
    svg += "<text x=\"64\" y=\"" + base + "\" text-anchor=\"end\">" + Escaped(bars[i].label) +
           "</text><rect x=\"70\" y=\"" + std::to_string(y) + "\" width=\"" + NumberText(width) +
           "\" height=\"11\" fill=\"#a8703a\"/><text x=\"" + NumberText(74 + width) + "\" y=\"";
    svg += base;
    svg += "\">" + NumberText(bars[i].value) + "</text>\n";
  }
  return svg + "</svg></figure>\n";
}

std::string
LevelName(const RootLevelRecord & level)
{
  using Kind = RootLevelRecord::Kind;
  return level.kind == Kind::All        ? "all roots"
         : level.kind == Kind::Laterals ? "all laterals"
         : level.level == 0             ? "stem"
                                        : "level " + std::to_string(level.level);
}

std::string
LevelTable(const RootModel & model, const std::string & unit)
{
  std::string html =
    "<table><tr><th></th><th>roots</th><th>length, " + unit + "</th><th>mean length, " + unit +
    "</th><th>mean diameter, " + unit +
    "</th><th>tortuosity</th><th>emergence angle, \u00b0</th><th>from down, \u00b0</th><th>children</th></tr>\n";
  for (const RootLevelRecord & level : model.traits.levels)
  {
    html += "<tr><th>" + LevelName(level) + "</th>";
    for (const double value : { static_cast<double>(level.count),
                                level.totalLength,
                                level.meanLength,
                                level.meanDiameter,
                                level.meanTortuosity,
                                level.meanEmergenceAngle,
                                level.meanTipFromDown,
                                level.meanChildren })
    {
      html += "<td>" + NumberText(value) + "</td>";
    }
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string
PlantTable(const RootModel & model, double volume, const std::string & unit)
{
  const RootTraits &                          traits = model.traits;
  std::vector<std::pair<std::string, double>> rows{ { "stem length, " + unit, traits.stemLength },
                                                    { "stem diameter, " + unit, traits.stemDiameter },
                                                    { "depth, " + unit, traits.depth },
                                                    { "width, " + unit, traits.width },
                                                    { "volume, " + unit + "\u00b3", volume },
                                                    { "volume of convex hull, " + unit + "\u00b3", traits.hullVolume },
                                                    { "whorls", static_cast<double>(traits.whorls) },
                                                    { "distance between whorls, " + unit, traits.meanWhorlDistance },
                                                    { "contacts of roots", static_cast<double>(traits.contacts) },
                                                    { "undecided contacts",
                                                      static_cast<double>(traits.undecidedContacts) } };
  if (traits.soilDepth)
  {
    rows.emplace_back("roots above the soil", static_cast<double>(traits.rootsAboveSoil));
    rows.emplace_back("roots below the soil", static_cast<double>(traits.rootsBelowSoil));
    rows.emplace_back("whorls above the soil", static_cast<double>(traits.whorlsAboveSoil));
    rows.emplace_back("whorls below the soil", static_cast<double>(traits.whorlsBelowSoil));
  }
  std::string html = "<table>\n";
  for (const auto & [name, value] : rows)
  {
    if (value == 0 || std::isnan(value)) // such as no contacts
    {
      continue;
    }
    html += "<tr><th>" + name + "</th><td>" + NumberText(value) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

} // namespace

std::string
RootsFigures(const RootModel & model)
{
  const std::string unit = model.unit == SpatialUnit::Millimetres ? "mm" : "voxels";
  std::vector<Bar>  depths;
  for (const RootDepthRecord & slice : model.traits.depths)
  {
    depths.push_back({ slice.length, NumberText(slice.depth) });
  }
  std::vector<Bar> diameters;
  for (const RootDiameterRecord & range : model.traits.diameters)
  {
    diameters.push_back({ range.length, NumberText(range.from) + "\u2013" + NumberText(range.to) });
  }
  return BarChart("Length of roots by depth, " + unit, depths) +
         BarChart("Length of roots by diameter, " + unit, diameters);
}

std::string
RootsPage(const RootsResult &                result,
          double                             volume,
          const std::vector<std::string> &   remarks,
          const std::optional<std::string> & prefix)
{
  const RootModel & model = result.model;
  const std::string unit = model.unit == SpatialUnit::Millimetres ? "mm" : "voxels";
  const std::string title = "Roots of " + Escaped(model.name);
  std::string       html =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + title +
    "</title>\n<style>body{font:15px sans-serif;margin:2em auto;padding:0 1em;max-width:75em;color:#222}"
    "table{border-collapse:collapse;margin:1em 0}td,th{padding:.2em .8em;text-align:right;"
    "border-bottom:1px solid #ddd;font-weight:normal}th:first-child{text-align:left}"
    ".wide{overflow-x:auto}.beside{display:grid;grid-template-columns:2fr 1fr;gap:1em 2em;align-items:start}"
    ".two{display:grid;grid-template-columns:1fr 1fr;gap:1em 2em}"
    "@media(max-width:50em){.beside,.two{grid-template-columns:1fr}}"
    "img{max-width:100%;max-height:44em}figure{margin:0 0 1em}figcaption{margin-bottom:.4em;font-size:14px}"
    "</style></head><body>\n<h1>" +
    title + "</h1>\n";
  if (prefix)
  {
    const std::string start = Escaped(*prefix);
    html += "<div class=\"beside\"><p><a href=\"" + start + "roots.html\"><img src=\"" + start +
            "roots.png\" alt=\"The roots in the colours of their levels\"></a><br><a href=\"" + start +
            "roots.html\">View in three dimensions</a></p>\n<div>\n" + RootsFigures(model) + "</div></div>\n";
  }
  std::vector<Bar> widths;
  for (const RootDepthRecord & slice : model.traits.depths)
  {
    widths.push_back({ slice.width, NumberText(slice.depth) });
  }
  html += "<h2>Roots by level</h2>\n<div class=\"wide\">" + LevelTable(model, unit) +
          "</div>\n<h2>The plant</h2>\n<div class=\"two\"><div>" + PlantTable(model, volume, unit) + "</div>" +
          BarChart("Width of the plant by depth, " + unit, widths) + "</div>\n";
  if (!prefix)
  {
    html += "<div class=\"two\">\n" + RootsFigures(model) + "</div>\n";
  }
  if (result.topology)
  {
    html += RootsChanges(model, *result.topology);
  }
  if (!remarks.empty())
  {
    html += "<h2>What was done, and what to look at</h2>\n<ul>\n";
    for (const std::string & remark : remarks)
    {
      html += "<li>" + Escaped(remark) + "</li>\n";
    }
    html += "</ul>\n";
  }
  return html + "</body></html>\n";
}

} // namespace voxelcore
