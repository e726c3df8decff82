#include "voxelcore/Base/LengthText.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace voxelcore::testing
{
namespace
{

LengthText
Read(const char * text)
{
  return ReadLength(text, [](const char * why) { throw std::runtime_error(why); });
}

TEST(LengthText, IsANumberAndWhatFollowsIt)
{
  const LengthText length = Read(" 2.5 vox");
  EXPECT_EQ(length.value, 2.5);
  EXPECT_EQ(length.unit, "vox");
  EXPECT_EQ(length.text, "2.5vox");
  EXPECT_EQ(Read("3").unit, "");
  EXPECT_EQ(Read("1e1mm").value, 10);
}

TEST(LengthText, SaysWhyATextIsNone)
{
  for (const auto & [text, why] :
       std::initializer_list<std::pair<const char *, const char *>>{ { "mm", "is not a number" },
                                                                     { "inf", "is not a number" },
                                                                     { "-1mm", "is negative" },
                                                                     { "1 2mm", "has a blank" } })
  {
    try
    {
      Read(text);
      FAIL() << text;
    }
    catch (const std::runtime_error & error)
    {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << text << ": " << error.what();
    }
  }
}

TEST(LengthText, MillimetresAreRefusedWithWhatToDo)
{
  try
  {
    RefuseMillimetres("1.5mm");
    FAIL();
  }
  catch (const InputError & error)
  {
    EXPECT_NE(std::string(error.what()).find("(1.5vox)"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("--spacing"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace voxelcore::testing
