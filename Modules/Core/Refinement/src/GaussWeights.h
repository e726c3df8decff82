#pragma once
// A sampled Gaussian, the same bits on every machine.

#include <cstddef>
#include <vector>

namespace voxelcore
{

/** By distance from the centre, 0 to `radius` steps; both sides together sum up to 1. The exponential is made of sums
 *  and products, as the last bit of exp() differs between libraries. */
inline std::vector<double>
GaussWeights(double variance, std::size_t radius)
{
  constexpr int halvings = 8;
  const double  exponent = -0.5 / variance / (1 << halvings);
  double        base = 1;
  for (int term = 10; term > 0; --term)
  {
    base = 1 + base * exponent / term;
  }
  for (int i = 0; i < halvings; ++i)
  {
    base *= base;
  }
  std::vector<double> weights{ 1 };
  double              sum = 1;
  double              ratio = base; // base^(k^2) by its odd differences
  for (std::size_t k = 1; k <= radius; ++k)
  {
    weights.push_back(weights.back() * ratio);
    ratio *= base * base;
    sum += 2 * weights.back();
  }
  for (double & weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

} // namespace voxelcore
