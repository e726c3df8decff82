#include "voxelcore/Shape/LabelShape.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

TEST(LabelShape, ALabelIsCalledByValueAndName)
{
  EXPECT_EQ(LabelText(4, "Precentral_L"), "label 4 (Precentral_L)");
  EXPECT_EQ(LabelText(INT64_MAX, ""), "label 9223372036854775807 ()");
}

TEST(LabelShape, OfSeveralLabelsFiveAreCalledByName)
{
  LabelTexts texts;
  texts.Add("label 1 (a)", "");
  EXPECT_TRUE(texts.IsEmpty());
  EXPECT_EQ(texts.Text(), "");
  texts.Add("label 2 (b)", "two loops");
  EXPECT_EQ(texts.Text(), "label 2 (b): two loops");
  for (const char * label : { "3", "4", "5", "6" })
  {
    texts.Add(label, "one");
  }
  const std::string five = "label 2 (b): two loops; 3: one; 4: one; 5: one; 6: one";
  EXPECT_EQ(texts.Text(), five);
  texts.Add("7", "one");
  EXPECT_EQ(texts.Text(), five + "; and those of 1 more label");
  texts.Add("8", "one");
  EXPECT_EQ(texts.Text(), five + "; and those of 2 more labels");
  EXPECT_FALSE(texts.IsEmpty());
}

} // namespace
} // namespace voxelcore::testing
