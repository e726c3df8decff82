#include "voxelcore/Lattice/PlaceStep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace voxelcore;

TEST(PlaceStep, AddingWholeVoxelsToMultiplesOfItIsExact)
{
  int exponent = 0;
  EXPECT_EQ(std::frexp(kPlaceStep, &exponent), 0.5) << "a power of two";
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937                           random(seed);
  std::uniform_int_distribution<int>     voxels(-(1 << 18), 1 << 18);
  std::uniform_real_distribution<double> places(0, 1 << 18);
  for (int i = 0; i < 1000; ++i)
  {
    const double place = std::nearbyint(places(random) / kPlaceStep) * kPlaceStep;
    const int    moved = voxels(random);
    EXPECT_EQ((place + moved) - moved, place);
  }
}
