#include "voxelcore/Complex/FaceName.h"

#include "ComplexFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace voxelcore::testing
{
namespace
{

FaceName
NameOf(std::span<const ElementIndex> corners)
{
  FaceName name = kNoCorners;
  for (const ElementIndex corner : corners)
  {
    OfferCorner(name, corner);
  }
  return name;
}

TEST(FaceName, IsTheThreeSmallestCornersInAnyOrder)
{
  Corners corners{ 5, 9, 200, 4000000000U, 7 };
  std::sort(corners.begin(), corners.end());
  do
  {
    EXPECT_EQ(NameOf(corners), (FaceName{ 5, 7, 9 }));
  } while (std::next_permutation(corners.begin(), corners.end()));
}

TEST(FaceName, TellsTheFacesOfAComplexApart)
{
  for (std::uint32_t seed = 1; seed <= 10; ++seed)
  {
    const CellComplex  complex = RandomCubicalComplex(seed, 4, 60, 60);
    std::set<FaceName> names;
    for (std::size_t face = 0; face < complex.FaceCount(); ++face)
    {
      EXPECT_TRUE(names.insert(NameOf(complex.FaceVertices(face))).second) << "seed " << seed << ", face " << face;
    }
    EXPECT_GT(names.size(), 50U);
  }
}

} // namespace
} // namespace voxelcore::testing
