#pragma once
// Pictures of medial surfaces and curve skeletons, drawn off screen.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Models/ColorRange.h"
#include "voxelcore/Models/DisplayContent.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace voxelcore
{

enum class PictureView
{
  Auto,  ///< from where most is to be seen: along the direction in which the points spread least
  Front, ///< from anterior, superior up
  Top,   ///< from superior, anterior up
  Iso    ///< from anterior, left and superior
};

struct PictureOptions
{
  int                                  width = 1600; ///< pixels
  int                                  height = 1200;
  bool                                 shrink = false; ///< below these, where there would be broad margins
  PictureView                          view = PictureView::Auto;
  PictureColoring                      coloring = PictureColoring::Radius;
  bool                                 dark = false;
  std::string                          title;          ///< of the whole, above it; none with panels
  bool                                 panels = false; ///< side by side: surface, medial surface, curve skeleton
  double                               tubes = 0.3;    ///< radius of a curve's tube, in radii of the shape
  std::optional<std::array<double, 2>> range;          ///< mm that the colour map runs over; else `shares`
  ColorShares                          shares;
  bool                                 anatomical = true; ///< whether the axes are the patient's: else no letters
  std::optional<bool>                  eachLabel;         ///< the map runs over each label's own range; else where
                                                          ///< NeedOwnRanges() and no `range` is given
  int frames = 1;                                         ///< of a full turn around the vertical
  int tile = 2048;                                        ///< pixels along each side that are drawn at a time
};

/** Red, green, blue, a byte each; rows from the top. */
struct Picture
{
  int                       width = 0;
  int                       height = 0;
  std::vector<std::uint8_t> pixels;
};

/** Draws each frame and hands it to `take`. Parallel projection, so that the scale bar holds everywhere; a colour bar
 *  that names its unit and says what lies beyond its ends, or the names of up to a dozen labels; a cross with the
 *  directions of the patient. The surface is translucent where something is in it. Where there is no display that can
 *  be used, Xvfb is started for the time being. Large pictures are drawn tile by tile, so that memory grows with the
 *  pixels of the picture alone, three bytes each. \throws UsageError when nothing is there to be shown; OutputError
 *  when there is neither a display nor Xvfb, or too little memory for so many pixels; Cancelled */
void
RenderPictures(const DisplayContent &                                  content,
               const PictureOptions &                                  options,
               const std::function<void(int frame, const Picture &)> & take,
               const ProgressCallback &                                progress = {});

/** \throws OutputError */
void
WritePng(const std::filesystem::path & path, const Picture & picture);

} // namespace voxelcore
