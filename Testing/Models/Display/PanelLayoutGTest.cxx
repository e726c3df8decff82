// Panels are filled by what they show.

#include "PanelLayout.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

PictureFrame
Frame(double width, double height)
{
  PictureFrame frame;
  frame.halfWidth = width / 2;
  frame.halfHeight = height / 2;
  return frame;
}

PanelRequest
Request(std::size_t panels)
{
  PanelRequest request;
  request.panels = panels;
  request.width = 1600;
  request.height = 1200;
  request.left = request.bottom = request.top = 10;
  request.right = 200;
  request.title = 50;
  return request;
}

/** How much of a panel its content takes along its wider and its narrower side. */
std::pair<double, double>
Filled(const PanelLayout & layout, const PictureFrame & frame)
{
  const double x = 2 * frame.halfWidth / layout.mmPerPixel / layout.panelWidth;
  const double y = 2 * frame.halfHeight / layout.mmPerPixel / layout.panelHeight;
  return std::minmax(x, y);
}

TEST(PanelLayout, WhatIsShownFillsAPictureThatMayShrink)
{
  for (const auto & [width, height] : { std::pair{ 3.0, 1.0 }, { 1.0, 1.0 }, { 1.0, 3.0 }, { 0.004, 0.001 } })
  {
    for (const std::size_t panels : { 1U, 2U, 3U })
    {
      PanelRequest request = Request(panels);
      request.shrink = true;
      const PictureFrame frame = Frame(width, height);
      const PanelLayout  layout = LayOutPanels(request, frame);
      const auto [narrow, wide] = Filled(layout, frame);
      EXPECT_GT(narrow, 0.93) << width << " x " << height << ", " << panels;
      EXPECT_LE(wide, 1.0);
      EXPECT_LE(layout.width, request.width);
      EXPECT_LE(layout.height, request.height);
    }
  }
}

TEST(PanelLayout, InAFixedPictureOneSideIsFilledAndFlatThingsLieAboveEachOther)
{
  const PanelRequest request = Request(3);
  const PanelLayout  flat = LayOutPanels(request, Frame(8, 1));
  EXPECT_EQ(flat.columns, 1);
  EXPECT_EQ(flat.rows, 3);
  EXPECT_EQ(flat.width, 1600);
  EXPECT_EQ(flat.height, 1200);
  const PanelLayout tall = LayOutPanels(request, Frame(1, 4));
  EXPECT_EQ(tall.columns, 3);
  for (const auto & [layout, frame] : { std::pair{ flat, Frame(8, 1) }, { tall, Frame(1, 4) } })
  {
    EXPECT_GT(Filled(layout, frame).second, 0.96);
    EXPECT_LE(Filled(layout, frame).second, 1.0);
  }
}

TEST(PanelLayout, PanelsLieBesideAndUnderEachOtherWithoutOverlap)
{
  const PanelRequest request = Request(3);
  for (const double width : { 0.2, 1.0, 1.8, 5.0 })
  {
    const PanelLayout layout = LayOutPanels(request, Frame(width, 1));
    for (std::size_t a = 0; a < 3; ++a)
    {
      const auto p = layout.Corner(a, request);
      EXPECT_GE(p[0], request.left - 1e-9);
      EXPECT_GE(p[1], request.bottom - 1e-9);
      EXPECT_LE(p[0] + layout.panelWidth, request.width - request.right + 1e-9);
      EXPECT_LE(p[1] + layout.panelHeight + request.title, request.height - request.top + 1e-9);
      for (std::size_t b = 0; b < a; ++b)
      {
        const auto q = layout.Corner(b, request);
        EXPECT_TRUE(std::abs(p[0] - q[0]) > layout.panelWidth - 1e-9 ||
                    std::abs(p[1] - q[1]) > layout.panelHeight + request.title - 1e-9);
      }
    }
  }
}

TEST(PanelLayout, APointAloneHasAScale)
{
  EXPECT_GT(LayOutPanels(Request(1), Frame(0, 0)).mmPerPixel, 0);
}

} // namespace
} // namespace voxelcore::testing
