#pragma once
// What smoothing has made of distances across a flat boundary.

#include <vector>

namespace voxelcore
{

/** Distances that end at +-clip, smoothed pass by pass. Where the boundary has the curvature h (the sum of both), G
 *  moves it by h sigma^2 / 2 to the first order, and G G by h sigma^2, each times the slope across it. So (1 + w) G - w
 *  G G leaves it where it is if w = a / (2 b - a), a and b the slopes after G and G G: 1 while the profile is straight
 *  for some way, and more when the bends at the clip have come near. */
class FlatProfile
{
public:
  explicit FlatProfile(double clip);

  /** The weight of the next pass with a Gaussian of width `sigma`. */
  float
  Weight(double sigma) const;

  /** Takes that pass. Returns its weight. */
  float
  Smooth(double sigma);

private:
  struct Passes
  {
    std::vector<double> once;
    std::vector<double> twice;
    double              weight = 1;
  };
  Passes
  Pass(double sigma) const;

  std::vector<double> m_Values;
};

} // namespace voxelcore
