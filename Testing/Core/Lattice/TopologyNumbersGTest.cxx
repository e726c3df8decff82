#include "voxelcore/Lattice/TopologyNumbers.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace voxelcore::testing
{
namespace
{

TEST(TopologyNumbers, AreOfNothingAtFirst)
{
  EXPECT_EQ(TopologyNumbers{}, (TopologyNumbers{ 0, { 0, 0, 0 } }));
}

TEST(TopologyNumbers, AreEqualOnlyWhereEveryOneIs)
{
  const TopologyNumbers        ring{ 0, { 1, 1, 0 } };
  std::vector<TopologyNumbers> others(4, ring);
  ++others[0].euler;
  for (std::size_t dimension = 0; dimension < 3; ++dimension)
  {
    // Beyond 32 bits: a certificate must see it.
    others[dimension + 1].betti[dimension] += std::int64_t{ 1 } << 32U;
  }
  for (std::size_t i = 0; i < others.size(); ++i)
  {
    EXPECT_FALSE(ring == others[i]) << i;
    EXPECT_TRUE(others[i] != ring) << i;
    EXPECT_TRUE(others[i] == TopologyNumbers(others[i])) << i;
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_NE(others[i], others[j]) << i << ' ' << j;
    }
  }
}

TEST(TopologyNumbers, TheEulerNumberAloneDoesNotMakeThemEqual)
{
  // A ball; a ball with a loop and a cavity; two balls and a loop: all of Euler number 1.
  const std::vector<TopologyNumbers> shapes{ { 1, { 1, 0, 0 } }, { 1, { 1, 1, 1 } }, { 1, { 2, 1, 0 } } };
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    EXPECT_EQ(shapes[i].euler, shapes[i].betti[0] - shapes[i].betti[1] + shapes[i].betti[2]);
    EXPECT_NE(shapes[i], shapes[(i + 1) % shapes.size()]);
  }
}

} // namespace
} // namespace voxelcore::testing
