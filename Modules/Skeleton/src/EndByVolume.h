#pragma once
// The end of a tube, by its volume.

#include "voxelcore/Vectors.h"
#include "voxelcore/VoxelShape.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace voxelcore
{

// Balls between the corners of voxels are smaller than the body, by so many diagonals on average.
inline constexpr double kMeanExcess = 0.25;

/** A line of points with the way to each. */
struct WayLine
{
  std::vector<Vector3> places;
  std::vector<double>  way;

  void
  Add(const Vector3 & place)
  {
    way.push_back(places.empty() ? 0 : way.back() + Distance(places.back(), place));
    places.push_back(place);
  }

  Vector3
  At(double here) const
  {
    const auto after = std::upper_bound(way.begin(), way.end(), here);
    const auto next = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - way.begin(), 1, static_cast<std::ptrdiff_t>(way.size()) - 1));
    const double step = way[next] - way[next - 1];
    const double t = step > 0 ? std::clamp((here - way[next - 1]) / step, 0.0, 1.0) : 0;
    return AddScaled(places[next - 1], t, Minus(places[next], places[next - 1]));
  }
};

/** Where the half ball around the end of a branch has its centre, if it is one of a tube. `line` leads from the end of
 *  the branch inwards, of which `free` is nothing but the branch; `radius` is about that of the tube, and stands for it
 *  where too little is free to measure it. `isBar`: the line ends at another tip. Places and lengths in mm along the
 *  grid (lattice coordinates times spacing). */
std::optional<Vector3>
FindEndByVolume(const VoxelShape & shape,
                const Vector3 &    spacing,
                const WayLine &    line,
                double             free,
                double             radius,
                bool               isBar);

} // namespace voxelcore
