#include "voxelcore/Base/Error.h"
#include "voxelcore/Formats/RawLayout.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

using namespace voxelcore;

TEST(RawLayout, IsParsedWithOrWithoutAByteOrderBlanksAndCapitals)
{
  const std::vector<std::pair<std::string, RawLayout>> cases{
    { "6,5,4,uint8", { { 6, 5, 4 }, PixelType::UInt8, false } },
    { " 6, 5, 4, FLOAT32, little", { { 6, 5, 4 }, PixelType::Float32, false } },
    { "1,1,20000,int64,big", { { 1, 1, 20000 }, PixelType::Int64, true } },
  };
  for (const auto & [text, layout] : cases)
  {
    EXPECT_EQ(ParseRawLayout(text), layout) << text;
  }
}

TEST(RawLayout, TextOfALayoutIsParsedAsTheSameLayout)
{
  for (int type = 0; type <= static_cast<int>(PixelType::Float64); ++type)
  {
    for (const bool isBig : { false, true })
    {
      const RawLayout layout{ { 7, 1, 300 }, static_cast<PixelType>(type), isBig };
      EXPECT_EQ(ParseRawLayout(RawLayoutText(layout)), layout) << RawLayoutText(layout);
    }
  }
}

TEST(RawLayout, WithoutSenseIsAMistakeOfTheUser)
{
  for (const char * text : { "",
                             "6,5,4",
                             "6,5,uint8",
                             "6,5,4,uint12",
                             "6,5,0,uint8",
                             "6,5,-4,uint8",
                             "6,5,4,uint8,middle",
                             "6,5,4,uint8,big,big",
                             "6.5,5,4,uint8",
                             "9999999999,1,1,uint8" })
  {
    EXPECT_THROW(ParseRawLayout(text), UsageError) << text;
  }
}
