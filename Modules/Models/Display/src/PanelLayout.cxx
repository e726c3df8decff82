#include "PanelLayout.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

std::array<double, 2>
PanelLayout::Corner(std::size_t panel, const PanelRequest & request) const
{
  const auto   column = static_cast<double>(panel % static_cast<std::size_t>(columns));
  const auto   row = panel / static_cast<std::size_t>(columns);
  const double top = height - request.top - static_cast<double>(row) * (panelHeight + request.title);
  return { request.left + column * panelWidth, top - request.title - panelHeight };
}

PanelLayout
LayOutPanels(const PanelRequest & request, const PictureFrame & frame)
{
  constexpr double kAir = 1.03;
  const double     wide = kAir * 2 * frame.halfWidth;
  const double     high = kAir * 2 * frame.halfHeight;
  const int        panels = static_cast<int>(request.panels);
  PanelLayout      best;
  for (int columns = panels; columns >= 1; --columns)
  {
    if (panels % columns != 0)
    {
      continue; // a corner would be empty
    }
    PanelLayout one;
    one.width = request.width;
    one.height = request.height;
    one.columns = columns;
    one.rows = (panels + columns - 1) / columns;
    one.panelWidth = std::max(1.0, (request.width - request.left - request.right) / columns);
    one.panelHeight = std::max(1.0, (request.height - request.bottom - request.top) / one.rows - request.title);
    one.mmPerPixel = std::max(wide / one.panelWidth, high / one.panelHeight);
    constexpr double kClearly = 0.9; // reading from left to right is easier
    if (best.panelWidth <= 0 || one.mmPerPixel < kClearly * best.mmPerPixel)
    {
      best = one;
    }
  }
  if (!(best.mmPerPixel > 0))
  {
    best.mmPerPixel = 1 / best.panelHeight; // a single point
  }
  if (request.shrink)
  {
    const auto   shrunk = [](double side, double needed) { return std::min(side, std::ceil(needed)); };
    const double beside = request.left + request.right;
    const double above = request.bottom + request.top + best.rows * request.title;
    best.panelWidth = shrunk(best.panelWidth, std::max(wide / best.mmPerPixel, request.leastWidth));
    best.panelHeight =
      shrunk(best.panelHeight, std::max(high / best.mmPerPixel, (request.leastHeight - above) / best.rows));
    const auto multiple = [&request](double side) {
      return request.multiple * static_cast<int>(std::ceil(side / request.multiple));
    };
    best.width = std::min(request.width, multiple(beside + best.columns * best.panelWidth));
    best.height = std::min(request.height, multiple(above + best.rows * best.panelHeight));
  }
  return best;
}

} // namespace voxelcore
