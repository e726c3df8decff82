// The part of the summary that shows what was cut and filled, with a slider over grey levels.

#include "RootsDisplay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace voxelcore
{

namespace
{

std::string
ShortNumber(double value)
{
  char text[40];
  (void)std::snprintf(text, sizeof(text), std::abs(value) >= 999.5 ? "%.0f" : "%.3g", value);
  return std::isfinite(value) ? text : "";
}

/** The plant from one side, up on top, in a square of 300. */
class SideView
{
public:
  explicit SideView(const RootModel & model)
    : m_Model(model)
    , m_Up(model.roots.up)
  {
    m_Side = AddScaled(std::abs(m_Up[0]) < 0.9 ? Vector3{ 1, 0, 0 } : Vector3{ 0, 1, 0 }, 0, m_Up);
    m_Side = AddScaled(m_Side, -Dot(m_Side, m_Up), m_Up);
    m_Side = AddScaled({ 0, 0, 0 }, 1 / Length(m_Side), m_Side);
    for (const Vector3 & place : model.graph.positions)
    {
      const std::array<double, 2> at{ Dot(place, m_Side), -Dot(place, m_Up) };
      for (std::size_t axis = 0; axis < 2; ++axis)
      {
        m_Least[axis] = std::min(m_Least[axis], at[axis]);
        m_Most[axis] = std::max(m_Most[axis], at[axis]);
      }
    }
    const double most = std::max({ m_Most[0] - m_Least[0], m_Most[1] - m_Least[1], 1e-9 });
    m_Scale = 290 / most;
  }

  std::string
  Place(const Vector3 & place, const char * x, const char * y) const
  {
    return std::string(x) + ShortNumber(5 + m_Scale * (Dot(place, m_Side) - m_Least[0])) + y +
           ShortNumber(5 + m_Scale * (-Dot(place, m_Up) - m_Least[1]));
  }

  std::string
  Lines() const
  {
    std::string svg;
    for (const RootAxis & axis : m_Model.roots.axes)
    {
      const std::size_t step = std::max<std::size_t>(1, axis.points.size() / 40);
      svg += "<polyline points=\"";
      for (std::size_t i = 0; i < axis.points.size(); i += step)
      {
        svg += Place(m_Model.graph.positions[axis.points[i]], i > 0 ? " " : "", ",");
      }
      svg += Place(m_Model.graph.positions[axis.points.back()], " ", ",") + "\"/>";
    }
    return svg;
  }

  std::string
  Box() const
  {
    return "0 0 " + ShortNumber(10 + m_Scale * (m_Most[0] - m_Least[0])) + " " +
           ShortNumber(10 + m_Scale * (m_Most[1] - m_Least[1]));
  }

private:
  const RootModel &     m_Model;
  Vector3               m_Up;
  Vector3               m_Side{};
  std::array<double, 2> m_Least{ std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity() };
  std::array<double, 2> m_Most{ -std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  double                m_Scale = 1;
};

/** What a slider does: marks and rows of what a level still needs; the numbers of the nearest level tried. */
constexpr const char * kScript = R"(<script>
(() => {
  const slider = document.getElementById('level'), words = document.getElementById('level-words');
  const tried = JSON.parse(slider.dataset.tried);
  const show = () => {
    const level = Number(slider.value);
    let cuts = 0, fills = 0;
    document.querySelectorAll('[data-value]').forEach((one) => {
      const cut = one.dataset.kind === 'cut', value = Number(one.dataset.value);
      const needed = cut ? value >= level : value < level;
      one.style.opacity = needed ? 1 : 0.12;
      if (needed && one.tagName === 'TR') { if (cut) { ++cuts; } else { ++fills; } }
    });
    const near = tried.reduce((a, b) => Math.abs(b[0] - level) < Math.abs(a[0] - level) ? b : a);
    words.textContent = 'level ' + slider.value + ': ' + cuts + ' cuts and ' + fills + ' fills needed; at ' +
      near[0].toPrecision(6) + ': ' + near[1] + ' pieces, ' + near[2] + ' loops, ' + near[3] + ' cavities';
  };
  slider.addEventListener('input', show);
  show();
})();
</script>
)";

} // namespace

std::string
RootsChanges(const RootModel & model, const RootsTopology & topology)
{
  const std::string unit = model.unit == SpatialUnit::Millimetres ? "mm" : "voxels";
  const SideView    view(model);
  std::string       html = "<h2>Cuts and fills</h2>\n";
  if (topology.levels && !topology.levels->tried.empty())
  {
    const GreyLevels & levels = *topology.levels;
    html += "<p><label>Grey level <input type=\"range\" id=\"level\" style=\"width:20em\" min=\"" +
            ShortNumber(levels.tried.front().level) + "\" max=\"" + ShortNumber(levels.tried.back().level) +
            "\" step=\"any\" value=\"" + ShortNumber(levels.shape) + "\" data-tried=\"[";
    for (std::size_t i = 0; i < levels.tried.size(); ++i)
    {
      const auto & betti = levels.tried[i].numbers.betti;
      html += i > 0 ? "," : "";
      html += "[" + ShortNumber(levels.tried[i].level) + "," + std::to_string(betti[0]) + "," +
              std::to_string(betti[1]) + "," + std::to_string(betti[2]) + "]";
    }
    html += "]\"></label> <span id=\"level-words\"></span></p>\n";
  }
  html += "<div class=\"two\"><svg viewBox=\"" + view.Box() +
          "\" width=\"100%\" role=\"img\" aria-label=\"Where the mask was cut and filled\"><g fill=\"none\" "
          "stroke=\"#999\" stroke-width=\"0.8\">" +
          view.Lines() + "</g>\n";
  std::string rows;
  for (const RootsChange & change : topology.parts)
  {
    const std::string kind = change.isFill ? "fill" : "cut";
    const double      value = change.isFill ? change.darkest : change.brightest;
    const std::string data =
      " data-kind=\"" + kind + "\"" + (topology.levels ? " data-value=\"" + ShortNumber(value) + "\"" : "");
    html += "<circle" + data + view.Place(change.centre, " cx=\"", "\" cy=\"") + "\" r=\"4\" fill=\"" +
            (change.isFill ? "#1f6fb2" : "#c33") + "\" fill-opacity=\"0.75\"><title>";
    html += kind;
    html += ", " + std::to_string(change.voxels) + " voxels</title></circle>\n";
    rows += "<tr" + data + "><th>";
    rows += kind;
    rows += "</th>";
    for (const double number : { change.centre[0],
                                 change.centre[1],
                                 change.centre[2],
                                 static_cast<double>(change.voxels),
                                 change.cost,
                                 static_cast<double>(change.difference[0]),
                                 static_cast<double>(change.difference[1]),
                                 static_cast<double>(change.difference[2]) })
    {
      rows += "<td>" + ShortNumber(number) + "</td>";
    }
    rows += "</tr>\n";
  }
  html += "</svg>\n<div class=\"wide\" style=\"max-height:30em;overflow-y:auto\"><table><tr><th></th><th>x, " + unit +
          "</th><th>y</th><th>z</th><th>voxels</th><th>cost</th><th>pieces</th><th>loops</th><th>cavities</th></tr>\n" +
          rows + "</table></div></div>\n<p>Cuts are red, fills blue. Cost: " +
          (topology.levels ? "how far each voxel is from the level of the mask, 1 for the background and for roots, "
                             "summed"
                           : "the distance of each voxel to the boundary, in voxels, summed") +
          ". changes.txt has the voxels; edit it and give it to --change-voxels.</p>\n";
  if (topology.levels && !topology.levels->tried.empty())
  {
    html += kScript;
  }
  return html;
}

} // namespace voxelcore
