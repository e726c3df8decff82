#include "voxelcore/Report/CsvText.h"

#include "voxelcore/Base/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using ::testing::ElementsAre;

TEST(CsvText, QuotesCommasAndLineEndsBelongToAQuotedField)
{
  const auto rows = ParseCsv("a,\"b,\"\"c\"\"\nd\"\n\n\"\",e\n", "x.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].fields, ElementsAre("a", "b,\"c\"\nd"));
  EXPECT_THAT(rows[1].fields, ElementsAre("", "e"));
  EXPECT_EQ(rows[1].line, 4U);
}

TEST(CsvText, WindowsLineEndsAByteOrderMarkAndAMissingLastLineEndChangeNothing)
{
  const auto rows = ParseCsv("\xEF\xBB\xBFid,scan\r\n1,a\r\n2,b", "x.csv");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_THAT(rows[0].fields, ElementsAre("id", "scan"));
  EXPECT_THAT(rows[2].fields, ElementsAre("2", "b"));
}

TEST(CsvText, LineEndsOfOldMacsAndThoseConvertedTwiceAreLineEnds)
{
  for (const char * text : { "id,scan\r1,a\r2,b\r", "id,scan\r\r\n1,a\r\r\n2,b\r\r\n" })
  {
    const auto rows = ParseCsv(text, "x.csv");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_THAT(rows[0].fields, ElementsAre("id", "scan"));
    EXPECT_THAT(rows[2].fields, ElementsAre("2", "b"));
    EXPECT_EQ(rows[2].line, 3U);
  }
}

TEST(CsvText, WhatIsNoCsvIsRefusedWithItsLine)
{
  const auto refusal = [](const std::string & text) -> std::string {
    try
    {
      ParseCsv(text, "x.csv");
      return "";
    }
    catch (const InputError & error)
    {
      return error.what();
    }
  };
  EXPECT_THAT(refusal("a\n\"open\nb\n"), ::testing::HasSubstr("x.csv: line 2"));
  EXPECT_THAT(refusal("a\nb\n\"x\"y\n"), ::testing::HasSubstr("line 3"));
  EXPECT_THAT(refusal("a\nb\"c\n"), ::testing::HasSubstr("line 2"));
  EXPECT_THAT(refusal(std::string("a\0b", 3)), ::testing::HasSubstr("NUL"));
  EXPECT_THAT(refusal("\xFF\xFEi\0"), ::testing::HasSubstr("UTF-16"));
}

TEST(CsvText, NumbersOfOurOwnAreNoFormulas)
{
  EXPECT_EQ(CsvPlainField("-1.5"), "-1.5");
  EXPECT_EQ(CsvPlainField("a,b"), "\"a,b\"");
}

} // namespace
} // namespace voxelcore
