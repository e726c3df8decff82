#pragma once
// What is written over a picture: colour bar, names of labels, scale bar, directions of the patient.

#include "ColorBar.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

class vtkRenderer;

namespace voxelcore
{

/** Draws into a renderer that covers the picture, or a tile of it whose lower left is `origin`; places in pixels from
 *  the lower left of the picture, text sizes in pixels. */
class PictureOverlay
{
public:
  PictureOverlay(vtkRenderer * renderer, bool dark, const std::array<double, 2> & origin = { 0, 0 })
    : m_Renderer(renderer)
    , m_Origin(origin)
    , m_Ink(dark ? Color{ 1, 1, 1 } : Color{ 0, 0, 0 })
  {}

  /** A vertical bar with its title above and its caption below; a triangle at each end beyond which there are
   *  values. */
  void
  AddColorBar(const ColorBar & bar, double x, double y, double height, double text);

  /** Names beside squares of their colours, from the top down. */
  void
  AddLegend(const std::vector<std::pair<std::string, Color>> & names, double x, double top, double text);

  /** A bar of a round length, at most `most` pixels long. */
  void
  AddScaleBar(double mmPerPixel, SpatialUnit lengths, double most, double x, double y, double text);

  /** Letters at the ends of a cross: `right` and `up` are the picture's axes in LPS. */
  void
  AddDirections(const std::array<double, 3> & right,
                const std::array<double, 3> & up,
                double                        x,
                double                        y,
                double                        arm,
                double                        text);

  /** Of each axis how far from the cross' centre its two letters lie, so that none overprints another; 0 where it has
   *  none, as they would lie on the centre. */
  static std::array<double, 3>
  LetterDistances(const std::array<double, 3> & right, const std::array<double, 3> & up, double arm, double text);

  /** `align`: -1 the text begins at x, 0 is centred, 1 ends there; it is centred on y. */
  void
  AddText(const std::string & words, double x, double y, double size, int align);

private:
  void
  AddRectangle(double x, double y, double width, double height, const Color & color);
  void
  AddPolygon(const std::vector<std::array<double, 2>> & corners, const Color & color);
  void
  AddLine(double x0, double y0, double x1, double y1, double width);

  vtkRenderer *         m_Renderer;
  std::array<double, 2> m_Origin;
  Color                 m_Ink;
};

} // namespace voxelcore
