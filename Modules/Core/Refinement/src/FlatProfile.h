#pragma once
// What smoothing has made of distances across a boundary that is flat, or nearly.

#include <vector>

namespace voxelcore
{

/** Distances that end at +-clip, smoothed pass by pass, to the first order of the boundary's curvature h (the sum of
 *  both): u + h v across it, u odd and v even. What diffuses for a variance t drifts by h t / 2, so G, a Gaussian g of
 *  width sigma, makes g u + h (g v + sigma^2 / 2 (g u)') of it. (1 + w) G - w G G leaves the boundary where it is if v
 *  stays 0 there: w = p / (q - p), p and q what v is there after G and G G. It is 1 while u is straight for some way,
 *  and more when its bends at the clip have come near. */
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
    std::vector<double> bentOnce;
    std::vector<double> bentTwice;
    double              weight = 1;
  };
  Passes
  Pass(double sigma) const;

  std::vector<double> m_Values;
  std::vector<double> m_Bent; ///< what is added where the boundary is bent, times its curvature
};

} // namespace voxelcore
