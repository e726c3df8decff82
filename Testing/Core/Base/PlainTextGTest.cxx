#include "voxelcore/Base/PlainText.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace voxelcore
{
namespace
{

TEST(PlainText, HasNothingThatATerminalActsOn)
{
  EXPECT_EQ(PlainText("a\x1b[2J\nb\tc\x7F"), "a?[2J?b?c?");
  EXPECT_EQ(PlainText("a\x1b[2J\nb\tc\x7F", true), "a?[2J\nb\tc?");
  EXPECT_EQ(PlainText(std::string("a\0b", 3)), "a?b");
  EXPECT_EQ(PlainText("\xC2\x9B"
                      "2J"),
            "?2J");
}

TEST(PlainText, HasNothingThatTurnsTheDirectionOfWriting)
{
  const std::vector<std::string> marks{ "\xD8\x9C",     "\xE2\x80\x8E", "\xE2\x80\x8F", "\xE2\x80\xA8", "\xE2\x80\xA9",
                                        "\xE2\x80\xAA", "\xE2\x80\xAB", "\xE2\x80\xAC", "\xE2\x80\xAD", "\xE2\x80\xAE",
                                        "\xE2\x81\xA6", "\xE2\x81\xA7", "\xE2\x81\xA8", "\xE2\x81\xA9" };
  for (const std::string & mark : marks)
  {
    EXPECT_EQ(PlainText("liver" + mark + "txt.exe"), "liver?txt.exe");
  }
}

TEST(PlainText, LeavesWhatIsText)
{
  for (const std::string text : { "",
                                  "\xC2\xB5m",
                                  "\xE2\x82\xAC",
                                  "\xE8\x82\x9D\xE8\x84\x8F",
                                  "\xD7\xA9\xD7\x9C\xD7\x95\xD7\x9D",
                                  "\xE2\x80\x93",
                                  "\xE2",
                                  "\xE2\x80",
                                  "\xC2",
                                  "\xFF\xFE" })
  {
    EXPECT_EQ(PlainText(text), text);
  }
}

} // namespace
} // namespace voxelcore
