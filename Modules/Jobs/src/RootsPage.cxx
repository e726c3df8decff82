// The summary of a root system: a page that any browser shows offline.

#include "RootsDisplay.h"

#include "voxelcore/LengthUnit.h"

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

std::string
NumberText(double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return std::isfinite(value) ? text : "";
}

struct Bar
{
  double      value;
  std::string label;
};

/** Bars from the left, the first on top. */
std::string
BarChart(const std::string & title, const std::vector<Bar> & bars)
{
  double most = 0;
  for (const Bar & bar : bars)
  {
    most = std::max(most, bar.value);
  }
  const int   height = 16 * static_cast<int>(bars.size()) + 8;
  std::string svg = "<figure><figcaption>" + Escaped(title) + "</figcaption><svg width=\"420\" height=\"" +
                    std::to_string(height) + "\" role=\"img\">\n";
  for (std::size_t i = 0; i < bars.size(); ++i)
  {
    const int         y = 16 * static_cast<int>(i) + 2;
    const std::string width = NumberText(most > 0 ? 250 * bars[i].value / most : 0);
    svg += "<text x=\"95\" y=\"" + std::to_string(y + 11) + "\" text-anchor=\"end\">" + Escaped(bars[i].label) +
           "</text><rect x=\"100\" y=\"" + std::to_string(y) + "\" width=\"" + width +
           "\" height=\"13\"/><text x=\"355\" y=\"" + std::to_string(y + 11) + "\">" + NumberText(bars[i].value) +
           "</text>\n";
  }
  return svg + "</svg></figure>\n";
}

std::string
LevelName(const RootLevelRecord & level)
{
  using Kind = RootLevelRecord::Kind;
  return level.kind == Kind::All        ? "all"
         : level.kind == Kind::Laterals ? "all laterals"
         : level.level == 0             ? "stem"
                                        : "level " + std::to_string(level.level);
}

std::string
LevelTable(const RootModel & model, const std::string & unit)
{
  std::string html = "<table><tr><th></th><th>roots</th><th>length, " + unit + "</th><th>mean length, " + unit +
                     "</th><th>mean diameter, " + unit +
                     "</th><th>tortuosity</th><th>emergence angle</th><th>from down</th><th>children</th></tr>\n";
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
                                                    { "convex hull, " + unit + "\u00b3", traits.hullVolume },
                                                    { "whorls", static_cast<double>(traits.whorls) },
                                                    { "between whorls, " + unit, traits.meanWhorlDistance },
                                                    { "contacts", static_cast<double>(traits.contacts) },
                                                    { "of them undecided",
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
    html += "<tr><th>" + name + "</th><td>" + NumberText(value) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

} // namespace

std::string
RootsPage(const RootModel & model, double volume, const std::vector<std::string> & remarks, bool drawn)
{
  const std::string unit = model.unit == SpatialUnit::Millimetres ? "mm" : "voxels";
  std::vector<Bar>  depths;
  std::vector<Bar>  widths;
  for (const RootDepthRecord & slice : model.traits.depths)
  {
    depths.push_back({ slice.length, NumberText(slice.depth) });
    widths.push_back({ slice.width, NumberText(slice.depth) });
  }
  std::vector<Bar> diameters;
  for (const RootDiameterRecord & range : model.traits.diameters)
  {
    diameters.push_back({ range.length, NumberText(range.from) + "\u2013" + NumberText(range.to) });
  }
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + Escaped(model.name) +
                     "</title>\n<style>body{font:15px sans-serif;margin:2em auto;max-width:75em;color:#222}"
                     "table{border-collapse:collapse;margin:1em 0}td,th{padding:.2em .8em;text-align:right;"
                     "border-bottom:1px solid #ddd;font-weight:normal}th:first-child{text-align:left}"
                     "img{max-width:100%}figure{display:inline-block;margin:1em 1em 1em 0}"
                     "svg text{font:11px sans-serif;fill:#333}svg rect{fill:#8a5a2b}</style></head><body>\n<h1>" +
                     Escaped(model.name) + "</h1>\n";
  if (drawn)
  {
    html +=
      "<p><a href=\"roots.html\"><img src=\"roots.png\" alt=\"The roots in the colours of their levels\"></a><br>"
      "<a href=\"roots.html\">In three dimensions</a></p>\n";
  }
  html += "<h2>Roots by level</h2>\n" + LevelTable(model, unit) + "<h2>The plant</h2>\n" +
          PlantTable(model, volume, unit) + "<h2>Profiles</h2>\n" +
          BarChart("Length of roots by depth, " + unit, depths) + BarChart("Width by depth, " + unit, widths) +
          BarChart("Length of roots by diameter, " + unit, diameters);
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
