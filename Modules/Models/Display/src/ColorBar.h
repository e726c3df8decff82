#pragma once
// What is written at a colour bar: which length each of its colours is, and what lies beyond its ends.

#include "voxelcore/Display/RenderPicture.h"
#include "voxelcore/Models/ColorRange.h"

#include <string>
#include <utility>
#include <vector>

namespace voxelcore
{

struct ColorBar
{
  std::string                                 title;
  std::string                                 caption;       ///< below the bar; may be empty
  std::vector<std::pair<double, std::string>> ticks;         ///< place from 0, the lower end, to 1; words
  bool                                        below = false; ///< whether smaller values have the first colour, too
  bool                                        above = false; ///< greater ones the last
};

/** In nm, um or mm, whichever suits the range, or voxels; ends with values beyond them as "≤ 1.2" and "≥ 9.5". */
ColorBar
DescribeColorBar(const PictureOptions & options,
                 const ColorRange &     range,
                 bool                   eachLabel,
                 SpatialUnit            unit = SpatialUnit::Millimetres);

/** Round numbers that split a range into about `parts`. */
std::vector<double>
RoundTicks(double low, double high, int parts);

/** 1, 2 or 5 times a power of ten, the largest that is not above `value`. */
double
RoundDown(double value);

} // namespace voxelcore
