#pragma once
// A line of points, by the way along it.

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace voxelcore
{

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

} // namespace voxelcore
