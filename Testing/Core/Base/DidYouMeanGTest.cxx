#include "voxelcore/Base/DidYouMean.h"

#include <array>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

constexpr std::array<std::string_view, 7> kNames{
  "lambda", "labels", "label-table", "threshold", "threads", "iso", "L"
};

TEST(DidYouMean, DistanceCountsInsertedRemovedReplacedAndSwappedLetters)
{
  EXPECT_EQ(EditDistance("", ""), 0U);
  EXPECT_EQ(EditDistance("abc", ""), 3U);
  EXPECT_EQ(EditDistance("", "abc"), 3U);
  EXPECT_EQ(EditDistance("lamda", "lambda"), 1U);
  EXPECT_EQ(EditDistance("lambbda", "lambda"), 1U);
  EXPECT_EQ(EditDistance("lombda", "lambda"), 1U);
  EXPECT_EQ(EditDistance("lamdba", "lambda"), 1U) << "a swap is one change";
  EXPECT_EQ(EditDistance("LAMBDA", "lambda"), 0U) << "case does not count";
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3U);
  EXPECT_EQ(EditDistance("ca", "abc"), 3U) << "no part is changed twice";
}

TEST(DidYouMean, NearestNameIsCloseOrNone)
{
  EXPECT_EQ(NearestName("lamda", kNames), "lambda");
  EXPECT_EQ(NearestName("label", kNames), "labels");
  EXPECT_EQ(NearestName("ios", kNames), "iso");
  EXPECT_EQ(NearestName("treshhold", kNames), "threshold");
  EXPECT_EQ(NearestName("thresh", kNames), "threshold") << "the only one that begins so";
  EXPECT_EQ(NearestName("xyz", kNames), "");
  EXPECT_EQ(NearestName("top", kNames), "");
  EXPECT_EQ(NearestName("9", kNames), "") << "not all letters are replaced";
  EXPECT_EQ(NearestName("", kNames), "");
  EXPECT_EQ(NearestName(std::string(100000, 'a'), kNames), "");
}

TEST(DidYouMean, TextIsEmptyWhereNothingIsClose)
{
  EXPECT_EQ(DidYouMean("lamda", kNames, "--"), "; did you mean '--lambda'?");
  EXPECT_EQ(DidYouMean("quantum", kNames, "--"), "");
}

} // namespace
} // namespace voxelcore
