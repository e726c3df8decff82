#pragma once
// Linear models with constants that are not negative.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace voxelcore::performance
{

/** The non-negative constants with the least squares of errors over `scales`, one coordinate at a time. */
template <std::size_t n>
std::array<double, n>
Fit(const std::vector<std::array<double, n>> & terms,
    const std::vector<double> &                measured,
    const std::vector<double> &                scales)
{
  std::array<std::array<double, n>, n> squares{};
  std::array<double, n>                sums{};
  std::array<double, n>                constants{};
  for (std::size_t run = 0; run < terms.size(); ++run)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      sums[i] += terms[run][i] * measured[run] / (scales[run] * scales[run]);
      for (std::size_t j = 0; j < n; ++j)
      {
        squares[i][j] += terms[run][i] * terms[run][j] / (scales[run] * scales[run]);
      }
    }
  }
  for (int round = 0; round < 100000; ++round)
  {
    for (std::size_t i = 0; i < n; ++i)
    {
      double rest = sums[i];
      for (std::size_t j = 0; j < n; ++j)
      {
        rest -= squares[i][j] * constants[j];
      }
      constants[i] = squares[i][i] > 0 ? std::max(0.0, constants[i] + rest / squares[i][i]) : 0;
    }
  }
  return constants;
}

/** The same, with twice too much as bad as half too little: errors count over the geometric mean of what was measured
 *  and what is foretold. */
template <std::size_t n>
std::array<double, n>
FitRatios(const std::vector<std::array<double, n>> & terms, const std::vector<double> & measured)
{
  std::array<double, n> constants{};
  std::vector<double>   scales = measured;
  for (int round = 0; round < 20; ++round)
  {
    constants = Fit(terms, measured, scales);
    for (std::size_t run = 0; run < terms.size(); ++run)
    {
      const double foretold = std::inner_product(terms[run].begin(), terms[run].end(), constants.begin(), 0.0);
      scales[run] = std::sqrt(measured[run] * std::max(foretold, measured[run] / 10));
    }
  }
  return constants;
}

} // namespace voxelcore::performance
