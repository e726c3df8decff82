#include "WayLine.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

TEST(WayLine, ALineIsStraightBetweenItsPlacesAndEndsAtTheLast)
{
  WayLine line;
  line.Add({ 0, 0, 0 });
  line.Add({ 4, 0, 0 });
  line.Add({ 4, 3, 0 });
  line.Add({ 4, 3, 5 });
  EXPECT_EQ(line.way, (std::vector<double>{ 0, 4, 7, 12 }));
  for (double here = -2; here < 15; here += 0.25)
  {
    const Vector3 at{ std::clamp(here, 0.0, 4.0), std::clamp(here - 4, 0.0, 3.0), std::clamp(here - 7, 0.0, 5.0) };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(line.At(here)[axis], at[axis], 1e-12) << here;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
