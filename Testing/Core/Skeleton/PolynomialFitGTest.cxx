#include "voxelcore/Skeleton/PolynomialFit.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>

namespace voxelcore::testing
{

TEST(PolynomialFit, GivesPolynomialsOfItsDegreeBack)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  const auto      within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (std::size_t degree = 2; degree <= 4; ++degree)
  {
    double coefficients[3][5]{};
    for (auto & axis : coefficients)
    {
      for (std::size_t k = 0; k <= degree; ++k)
      {
        axis[k] = within(-5, 5);
      }
    }
    PolynomialFit fit;
    for (int i = 0; i < 30; ++i)
    {
      const double u = within(-1, 1);
      Vector3      place{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        for (std::size_t k = 5; k-- > 0;)
        {
          place[axis] = place[axis] * u + coefficients[axis][k];
        }
      }
      fit.Add(u, within(.5, 2), place);
    }
    Vector3 value{};
    double  leverage = 0;
    ASSERT_TRUE(fit.Value(degree, value, leverage));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(value[axis], coefficients[axis][0], 1e-9);
    }
    EXPECT_GT(leverage, 0);
  }
}

TEST(PolynomialFit, TooFewPointsAreNoParabola)
{
  PolynomialFit fit;
  fit.Add(-.5, 1, { 1, 2, 3 });
  fit.Add(.5, 1, { 3, 2, 1 });
  Vector3 value{};
  double  leverage = 0;
  EXPECT_FALSE(fit.Value(3, value, leverage));
  fit.Add(0, 1, { 2, 2, 2 });
  EXPECT_TRUE(fit.Value(3, value, leverage)) << "of three points a parabola";
  EXPECT_NEAR(value[0], 2, 1e-12);
}

} // namespace voxelcore::testing
