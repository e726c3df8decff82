#include "voxelcore/Report/SkeletonTexts.h"

#include "VoxelCoreTesting/Random.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace voxelcore
{
namespace
{

TEST(SkeletonTexts, ARootIsAWordOrAPoint)
{
  EXPECT_EQ(ParseRoot("thickest").kind, RootChoice::Kind::Thickest);
  EXPECT_EQ(ParseRoot("top").kind, RootChoice::Kind::Top);
  const RootChoice point = ParseRoot("12.5,-30,1e2");
  EXPECT_EQ(point.kind, RootChoice::Kind::Point);
  EXPECT_EQ(point.point, (std::array<double, 3>{ 12.5, -30, 100 }));
  EXPECT_EQ(RootText(ParseRoot("thickest")), "thickest");
  EXPECT_EQ(RootText(ParseRoot("top")), "top");
  EXPECT_EQ(ParseRoot("bottom").kind, RootChoice::Kind::Bottom);
  EXPECT_EQ(RootText(ParseRoot("bottom")), "bottom");
}

TEST(SkeletonTexts, PointsComeBackToTheLastBit)
{
  constexpr std::uint64_t seed = 20261122;
  std::cout << "seed " << seed << '\n';
  testing::Random random(seed);
  for (int i = 0; i < 1000; ++i)
  {
    RootChoice root{ RootChoice::Kind::Point, {} };
    for (double & coordinate : root.point)
    {
      coordinate = std::ldexp(random.Unit() - 0.5, static_cast<int>(random.Between(-60, 60)));
    }
    const RootChoice again = ParseRoot(RootText(root));
    ASSERT_EQ(again.kind, RootChoice::Kind::Point);
    ASSERT_EQ(again.point, root.point) << RootText(root);
  }
}

TEST(SkeletonTexts, WhatIsNeitherIsRefused)
{
  for (const char * text :
       { "", "Top", "1,2", "1,2,3,4", "1,2,", "1,2,x", "1,2,inf", "nan,0,0", "1;2;3", "1,2,3mm", "1, 2, 3 4" })
  {
    EXPECT_THROW(ParseRoot(text), UsageError) << text;
  }
  try
  {
    ParseRoot("tpo");
    FAIL() << "it was taken";
  }
  catch (const UsageError & error)
  {
    EXPECT_NE(std::string(error.what()).find("--root tpo: expected top, bottom, thickest, or a point"),
              std::string::npos);
    EXPECT_NE(std::string(error.what()).find("did you mean"), std::string::npos) << error.what();
  }
}

TEST(SkeletonTexts, ListsOfPointsAreReadInOneWay)
{
  EXPECT_EQ(ParsePlaces("1,2,3"), (std::vector<Vector3>{ { 1, 2, 3 } }));
  EXPECT_EQ(ParsePlaces(" 1, 2 ,3 ; -4.5,0,1e2"), (std::vector<Vector3>{ { 1, 2, 3 }, { -4.5, 0, 100 } }));
  for (const char * text :
       { "", ";", "1,2,3;", ";1,2,3", "1,2,3;;4,5,6", "1,2", "1,2,3,4", "1,2,x", "1,2,inf", "1 2 3" })
  {
    EXPECT_THROW(ParsePlaces(text), UsageError) << text;
  }
}

} // namespace
} // namespace voxelcore
