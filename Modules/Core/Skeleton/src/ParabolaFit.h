#pragma once
// A parabola through points, by weighted least squares.

#include "voxelcore/Lattice/Vectors.h"

#include <cstddef>

namespace voxelcore
{

/** Sums of a weighted fit of 1, u, u^2. */
struct ParabolaFit
{
  double  moments[5]{};
  Vector3 sums[3]{};

  void
  Add(double u, double weight, const Vector3 & point)
  {
    double power = weight;
    for (int k = 0; k < 5; ++k)
    {
      moments[k] += power;
      for (std::size_t axis = 0; k < 3 && axis < 3; ++axis)
      {
        sums[k][axis] += power * point[axis];
      }
      power *= u;
    }
  }

  /** Its value at u = 0; false when too few points define it. */
  bool
  Value(Vector3 & value) const
  {
    const double * m = moments;
    const double   c0 = m[2] * m[4] - m[3] * m[3];
    const double   c1 = m[2] * m[3] - m[1] * m[4];
    const double   c2 = m[1] * m[3] - m[2] * m[2];
    const double   determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
    if (!(determinant > 1e-9 * m[0] * m[0] * m[0]))
    {
      return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      value[axis] = (c0 * sums[0][axis] + c1 * sums[1][axis] + c2 * sums[2][axis]) / determinant;
    }
    return true;
  }

  /** What stands before 1, u and u^2; false as in Value(). */
  bool
  Coefficients(Vector3 (&factors)[3]) const
  {
    const double * m = moments;
    if (!Value(factors[0]))
    {
      return false;
    }
    // What is left of the first equations is solved for the other two.
    const double determinant = m[2] * m[4] - m[3] * m[3];
    const bool   isSolvable = determinant > 0;
    for (std::size_t axis = 0; axis < 3 && isSolvable; ++axis)
    {
      const double first = sums[1][axis] - m[1] * factors[0][axis];
      const double second = sums[2][axis] - m[2] * factors[0][axis];
      factors[1][axis] = (m[4] * first - m[3] * second) / determinant;
      factors[2][axis] = (m[2] * second - m[3] * first) / determinant;
    }
    return isSolvable;
  }
};

} // namespace voxelcore
