#include "ShelvedTolerances.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

TEST(ShelvedTolerances, ComeBackWhereTheyReachTheHeight)
{
  const ToleranceValues values{ { 1.5, 0.25, 2.0, 1.0 }, { 0.5, 1.0 }, { 3.0, 0.999 } };
  const ToleranceValues back = ShelvedTolerances(values, 1.0).Take();
  EXPECT_EQ(back.vertices, (std::vector<double>{ 1.5, 0, 2.0, 1.0 }));
  EXPECT_EQ(back.edges, (std::vector<double>{ 0, 1.0 }));
  EXPECT_EQ(back.faces, (std::vector<double>{ 3.0, 0 }));
}

TEST(ShelvedTolerances, OfNothingAreNone)
{
  const ToleranceValues back = ShelvedTolerances({}, 1.0).Take();
  EXPECT_TRUE(back.vertices.empty() && back.edges.empty() && back.faces.empty());
}

} // namespace
} // namespace voxelcore
