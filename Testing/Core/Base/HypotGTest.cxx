#include "voxelcore/Base/Hypot.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace voxelcore
{
namespace
{

TEST(Hypot, IsWithinAUnitOfTheLastPlaceAndTheSameForEachOrderAndSign)
{
  constexpr unsigned seed = 5;
  SCOPED_TRACE(seed);
  std::mt19937_64                        random(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  std::uniform_int_distribution<int>     power(-30, 30);
  for (int i = 0; i < 200000; ++i)
  {
    const double x = std::ldexp(share(random), power(random));
    const double y = std::ldexp(share(random), power(random));
    const double z = std::ldexp(share(random), power(random));
    const double two = std::hypot(x, y);
    EXPECT_LE(std::abs(Hypot(x, y) - two), std::nextafter(two, HUGE_VAL) - two) << x << " " << y;
    EXPECT_EQ(Hypot(x, y), Hypot(-y, x));
    const double three = std::hypot(x, y, z);
    EXPECT_LE(std::abs(Hypot(x, y, z) - three), 4 * (std::nextafter(three, HUGE_VAL) - three))
      << x << " " << y << " " << z;
#if defined(__GLIBCXX__) && defined(__GLIBC__) && __GLIBC_MINOR__ >= 35
    EXPECT_EQ(Hypot(x, y), two) << x << " " << y;
    EXPECT_EQ(Hypot(x, y, z), three) << x << " " << y << " " << z;
#endif
  }
}

TEST(Hypot, HoldsAtTheEndsOfTheRange)
{
  const double greatest = std::numeric_limits<double>::max();
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(Hypot(0.0, 0.0), 0);
  EXPECT_EQ(Hypot(3 * least, 4 * least), 5 * least);
  EXPECT_EQ(Hypot(greatest, 1.0), greatest);
  EXPECT_EQ(Hypot(0.75 * greatest, 0.5 * greatest), std::hypot(0.75 * greatest, 0.5 * greatest));
  EXPECT_EQ(Hypot(0.0, 0.0, 0.0), 0);
  EXPECT_EQ(Hypot(2.0, 3.0, 6.0), 7);
}

} // namespace
} // namespace voxelcore
