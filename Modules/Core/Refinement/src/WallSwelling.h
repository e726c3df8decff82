#pragma once
// By how much smoothing makes walls thicker.

#include <utility>
#include <vector>

namespace voxelcore
{

/** Distances inside a wall rise to a ridge in its middle. Smoothing that flattens bends flattens this one, too, and
 *  carries it to the wall's sides: these move outwards. A wall's profile, smoothed like the field, tells how far. */
class WallSwelling
{
public:
  /** Distances end at +-clip and are smoothed by (1 + w) G - w G G for each weight w, with a Gaussian G of width
   *  `sigma`, held to labels after each but the last. */
  WallSwelling(double clip, double sigma, const std::vector<float> & weights);

  /** Of each side of a wall whose sides are found twice `half` apart. */
  double
  At(double half) const;

private:
  std::vector<std::pair<double, double>> m_Walls; ///< found half thickness, and how much of it is too much
};

} // namespace voxelcore
