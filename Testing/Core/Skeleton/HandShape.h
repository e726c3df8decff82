#pragma once
// A hand: five fingers on a palm, and the forearm.

#include "TubeShapes.h"

namespace voxelcore::testing
{

/** A ball that wanders from one point to another while its radius changes. */
struct Ray
{
  Spacing3 from;
  Spacing3 to;
  double   fromRadius;
  double   toRadius;
};

/** Thumb first, then the wrist: where each ends, in mm. */
struct Hand
{
  std::vector<Ray>      rays;
  std::vector<Spacing3> ends;
};

inline Hand
MakeHand()
{
  const Spacing3              wrist{ 0, 0, 0 };
  const std::vector<Spacing3> knuckles{ { -26, 26, 4 }, { -19, 62, 0 }, { -6, 66, 1 }, { 7, 62, 1 }, { 18, 54, 0 } };
  const std::vector<Spacing3> tips{ { -58, 48, 6 }, { -46, 112, 2 }, { -9, 126, 0 }, { 28, 114, 2 }, { 56, 86, 4 } };
  const std::vector<double>   radii{ 6.5, 5, 5, 5, 4.5 };
  Hand                        hand;
  for (std::size_t i = 0; i < tips.size(); ++i)
  {
    hand.rays.push_back({ wrist, knuckles[i], 13, 1.3 * radii[i] });
    hand.rays.push_back({ knuckles[i], tips[i], 1.2 * radii[i], radii[i] });
  }
  // The palm between them, close enough to be one sheet.
  for (std::size_t i = 0; i + 1 < tips.size(); ++i)
  {
    for (int step = 1; step < 40; ++step)
    {
      const double part = step / 40.0;
      const auto   between = [&](double a, double b) { return (1 - part) * a + part * b; };
      Spacing3     knuckle{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        knuckle[axis] = between(knuckles[i][axis], knuckles[i + 1][axis]);
      }
      hand.rays.push_back({ wrist, knuckle, 13, between(1.3 * radii[i], 1.3 * radii[i + 1]) });
    }
  }
  hand.rays.push_back({ wrist, { 0, -60, 0 }, 13, 15 });
  hand.ends = tips;
  hand.ends.push_back({ 0, -60, 0 });
  return hand;
}

/** The hand turned and scaled, in voxels of side 1. */
inline VoxelShape
Voxels(const Hand & hand, double scale, double about, double tilt, std::vector<Spacing3> & ends)
{
  const double   side = std::ceil(290 * scale);
  const Spacing3 centre{ 0.5 * side, 0.5 * side, 0.5 * side };
  const auto     place = [&](const Spacing3 & p) {
    return Turned({ scale * p[0], scale * (p[1] - 30), scale * p[2] }, about, tilt, centre);
  };
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { int(side), int(side), int(side) } });
  for (const Ray & ray : hand.rays)
  {
    const Spacing3 from = place(ray.from);
    const Spacing3 to = place(ray.to);
    const int      steps = static_cast<int>(2 * Distance(from, to)) + 1;
    for (int step = 0; step <= steps; ++step)
    {
      const double t = static_cast<double>(step) / steps;
      const double radius = scale * ((1 - t) * ray.fromRadius + t * ray.toRadius);
      const auto   at = [&](std::size_t axis) { return (1 - t) * from[axis] + t * to[axis]; };
      for (int z = int(at(2) - radius) - 1; z <= int(at(2) + radius) + 1; ++z)
      {
        for (int y = int(at(1) - radius) - 1; y <= int(at(1) + radius) + 1; ++y)
        {
          for (int x = int(at(0) - radius) - 1; x <= int(at(0) + radius) + 1; ++x)
          {
            if (Distance({ x + 0.5, y + 0.5, z + 0.5 }, { at(0), at(1), at(2) }) <= radius)
            {
              shape.Insert(x, y, z);
            }
          }
        }
      }
    }
  }
  ends.clear();
  for (const Spacing3 & end : hand.ends)
  {
    ends.push_back(place(end));
  }
  return shape;
}

} // namespace voxelcore::testing
