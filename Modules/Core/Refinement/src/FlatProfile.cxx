#include "FlatProfile.h"

#include "GaussWeights.h"
#include "SampledProfile.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::ptrdiff_t kHalf = 120; // far beyond any clip

// What has moved by `shift` units more, to the first order.
std::vector<double>
Shifted(std::vector<double> bent, const std::vector<double> & values, double shift)
{
  for (std::size_t i = 1; i + 1 < bent.size(); ++i)
  {
    bent[i] += shift * (values[i + 1] - values[i - 1]) / (2 * kProfileStep);
  }
  return bent;
}

} // namespace

FlatProfile::FlatProfile(double clip)
{
  for (std::ptrdiff_t i = -kHalf; i <= kHalf; ++i)
  {
    m_Values.push_back(std::clamp(static_cast<double>(i) * kProfileStep, -clip, clip));
  }
  m_Bent.assign(m_Values.size(), 0.0);
}

FlatProfile::Passes
FlatProfile::Pass(double sigma) const
{
  const double              width = sigma / kProfileStep;
  const std::vector<double> weights = GaussWeights(width * width, static_cast<std::size_t>(std::ceil(5 * width)));
  Passes                    passes;
  passes.once = ConvolveProfile(m_Values, weights);
  passes.twice = ConvolveProfile(passes.once, weights);
  passes.bentOnce = Shifted(ConvolveProfile(m_Bent, weights), passes.once, sigma * sigma / 2);
  passes.bentTwice = Shifted(ConvolveProfile(passes.bentOnce, weights), passes.twice, sigma * sigma / 2);
  passes.weight = passes.bentOnce[kHalf] / (passes.bentTwice[kHalf] - passes.bentOnce[kHalf]);
  return passes;
}

float
FlatProfile::Weight(double sigma) const
{
  return static_cast<float>(Pass(sigma).weight);
}

float
FlatProfile::Smooth(double sigma)
{
  const Passes passes = Pass(sigma);
  for (std::size_t i = 0; i < m_Values.size(); ++i)
  {
    m_Values[i] = (1 + passes.weight) * passes.once[i] - passes.weight * passes.twice[i];
    m_Bent[i] = (1 + passes.weight) * passes.bentOnce[i] - passes.weight * passes.bentTwice[i];
  }
  return static_cast<float>(passes.weight);
}

} // namespace voxelcore
