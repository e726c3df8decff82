#pragma once
// Where the panels of a picture lie, so that what they show is as large as can be.

#include "PictureCamera.h"

namespace voxelcore
{

/** What is known before; lengths in pixels. */
struct PanelRequest
{
  std::size_t panels = 1;
  int         width = 0;
  int         height = 0;
  bool        shrink = false; ///< whether the picture may become smaller than that, lest it has broad margins
  double      left = 0;       ///< margins of the picture ...
  double      right = 0;
  double      bottom = 0;
  double      top = 0;
  double      title = 0;       ///< ... room above each panel
  double      leastWidth = 0;  ///< of a panel ...
  double      leastHeight = 0; ///< ... and of the picture, where it may shrink
  int         multiple = 1;    ///< its sides are whole multiples of this
};

/** Panels of one size in rows and columns, the first at the upper left. Pixels from the lower left of the picture. */
struct PanelLayout
{
  int    width = 0; ///< of the picture
  int    height = 0;
  int    columns = 1;
  int    rows = 1;
  double panelWidth = 0;
  double panelHeight = 0; ///< without its title
  double mmPerPixel = 1;

  /** Left and lower end of a panel. */
  std::array<double, 2>
  Corner(std::size_t panel, const PanelRequest & request) const;
};

/** Of all numbers of columns, the one with the largest scale; in doubt, the most columns. */
PanelLayout
LayOutPanels(const PanelRequest & request, const PictureFrame & frame);

} // namespace voxelcore
