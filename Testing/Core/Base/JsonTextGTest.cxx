#include "voxelcore/Base/JsonText.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace voxelcore
{
namespace
{

std::string
Nested(std::size_t depth)
{
  std::string text = R"({"a": )";
  text.append(depth - 1, '[').append(depth - 1, ']');
  return text + "}";
}

std::string
Wide(int members)
{
  nlohmann::json json;
  for (int i = 0; i < members; ++i)
  {
    json[std::to_string(i)] = i;
  }
  return json.dump();
}

TEST(JsonText, TextsOfProgramsAreLeftAsTheyAre)
{
  for (const std::string & text : { std::string(),
                                    std::string("no JSON"),
                                    Nested(2),
                                    Nested(256),
                                    Wide(4096),
                                    "[" + Wide(4096) + Wide(4096) + "]" })
  {
    EXPECT_EQ(PlainJson(text), text);
  }
}

TEST(JsonText, TextsNestedDeeplyAreNothing)
{
  EXPECT_EQ(PlainJson(Nested(257)), "");
  EXPECT_EQ(PlainJson("]]]]" + Nested(257)), "");
  EXPECT_EQ(PlainJson(std::string(1000000, '[')), "");
}

TEST(JsonText, ObjectsOfManyMembersAreNothingUnlessTheyAreWanted)
{
  EXPECT_EQ(PlainJson(Wide(4097)), "");
  EXPECT_EQ(PlainJson("[" + Wide(4097) + "]"), "");
  EXPECT_EQ(PlainJson(Wide(4097), 4097), Wide(4097));
}

TEST(JsonText, BracketsAndColonsInStringsAreLetters)
{
  const std::string letters = nlohmann::json(std::string(1000, '[') + "\"\\" + std::string(10000, ':')).dump();
  EXPECT_EQ(PlainJson("{\"a\":" + letters + "}"), "{\"a\":" + letters + "}");
  const std::string ended = R"({"a\\":)" + std::string(300, '[');
  EXPECT_EQ(PlainJson(ended), ""); // the quote behind two backslashes ends the string
}

} // namespace
} // namespace voxelcore
