#pragma once
// A polynomial through points, by weighted least squares.

#include "voxelcore/Lattice/Vectors.h"

#include <cmath>
#include <cstddef>

namespace voxelcore
{

/** Sums of a weighted fit of powers of u up to the fourth. */
struct PolynomialFit
{
  static constexpr std::size_t kMostTerms = 5;

  double  moments[2 * kMostTerms - 1]{};
  Vector3 sums[kMostTerms]{};

  void
  Add(double u, double weight, const Vector3 & point)
  {
    double power = weight;
    for (std::size_t k = 0; k < 2 * kMostTerms - 1; ++k)
    {
      moments[k] += power;
      if (k < kMostTerms)
      {
        sums[k] = AddScaled(sums[k], power, point);
      }
      power *= u;
    }
  }

  /** Its value at u = 0, by Cholesky's decomposition, and what a point of weight 1 there has in it. The degree is lower
   *  where too few points define it; false when they do not define a parabola. */
  bool
  Value(std::size_t degree, Vector3 & value, double & leverage) const
  {
    constexpr double kLeastPivot = 1e-9;
    double           lower[kMostTerms][kMostTerms]{};
    Vector3          solved[kMostTerms]{};
    double           own[kMostTerms]{}; // the same of a point there
    std::size_t      terms = 0;
    for (; terms <= degree; ++terms)
    {
      for (std::size_t k = 0; k <= terms; ++k)
      {
        double sum = moments[terms + k];
        for (std::size_t j = 0; j < k; ++j)
        {
          sum -= lower[terms][j] * lower[k][j];
        }
        lower[terms][k] = k < terms ? sum / lower[k][k] : sum;
      }
      double & pivot = lower[terms][terms];
      if (!(pivot > kLeastPivot * moments[0]))
      {
        break;
      }
      pivot = std::sqrt(pivot);
      solved[terms] = sums[terms];
      own[terms] = terms == 0 ? 1 : 0;
      for (std::size_t k = 0; k < terms; ++k)
      {
        solved[terms] = AddScaled(solved[terms], -lower[terms][k], solved[k]);
        own[terms] -= lower[terms][k] * own[k];
      }
      solved[terms] = AddScaled({}, 1 / pivot, solved[terms]);
      own[terms] /= pivot;
    }
    if (terms < 3)
    {
      return false;
    }
    leverage = 0;
    for (std::size_t k = 0; k < terms; ++k)
    {
      leverage += own[k] * own[k];
    }
    for (std::size_t k = terms; k-- > 0;)
    {
      for (std::size_t j = k + 1; j < terms; ++j)
      {
        solved[k] = AddScaled(solved[k], -lower[j][k], solved[j]);
      }
      solved[k] = AddScaled({}, 1 / lower[k][k], solved[k]);
    }
    value = solved[0];
    return true;
  }
};

} // namespace voxelcore
