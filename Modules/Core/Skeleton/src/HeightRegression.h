#pragma once
// Least squares over heights.

#include "voxelcore/Lattice/Vectors.h"

namespace voxelcore
{

/** Heights, for slopes of what is given at each. */
struct HeightRegression
{
  double count = 0;
  double sumZ = 0;
  double sumZZ = 0;

  void
  Add(double z)
  {
    ++count;
    sumZ += z;
    sumZZ += z * z;
  }
  double
  MeanZ() const
  {
    return sumZ / count;
  }
  double
  Spread() const
  {
    return sumZZ - sumZ * sumZ / count;
  }
};

/** Places with their heights: where a line through them has a given height. */
struct PlaceRegression
{
  HeightRegression heights;
  Vector3          sum{};
  Vector3          products{};

  void
  Add(const Vector3 & place, double z)
  {
    heights.Add(z);
    sum = AddScaled(sum, 1, place);
    products = AddScaled(products, z, place);
  }

  Vector3
  Slope() const
  {
    return AddScaled({}, 1 / heights.Spread(), AddScaled(products, -heights.MeanZ(), sum));
  }

  Vector3
  At(double z) const
  {
    return AddScaled(AddScaled({}, 1 / heights.count, sum), z - heights.MeanZ(), Slope());
  }
};

} // namespace voxelcore
