#include "voxelcore/Base/Base64.h"

#include <gtest/gtest.h>

#include <iostream>
#include <random>

using namespace voxelcore;

namespace
{

std::string
Encoded(const std::string & bytes)
{
  const auto * const from = reinterpret_cast<const std::uint8_t *>(bytes.data());
  return ToBase64({ from, bytes.size() });
}

std::string
Decoded(std::string_view text, std::uint64_t most = ~std::uint64_t{ 0 })
{
  return FromBase64(text, most);
}

} // namespace

TEST(Base64, HasTheWordsOfItsStandard)
{
  // RFC 4648, section 10.
  const std::pair<std::string, std::string> words[] = { { "", "" },
                                                        { "f", "Zg==" },
                                                        { "fo", "Zm8=" },
                                                        { "foo", "Zm9v" },
                                                        { "foob", "Zm9vYg==" },
                                                        { "fooba", "Zm9vYmE=" },
                                                        { "foobar", "Zm9vYmFy" } };
  for (const auto & [bytes, text] : words)
  {
    EXPECT_EQ(Encoded(bytes), text);
    EXPECT_EQ(Decoded(text), bytes);
  }
}

TEST(Base64, RandomBytesComeBackInPartsAndThroughBlanks)
{
  const unsigned seed = std::random_device()();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  for (int turn = 0; turn < 200; ++turn)
  {
    std::string bytes(random() % 100, '\0');
    for (char & byte : bytes)
    {
      byte = static_cast<char>(random());
    }
    std::string text = Encoded(bytes);
    for (std::size_t at = text.size() / 4 * 4; at > 0; at -= 4)
    {
      text.insert(at, random() % 3 == 0 ? "\n " : "");
    }
    EXPECT_EQ(Decoded(text), bytes);
    std::string_view    rest = text;
    const std::uint64_t first = random() % (bytes.size() + 1) / 3 * 3; // a group of four letters is three bytes
    std::string         both = FromBase64(rest, first);
    EXPECT_EQ(both.size(), first);
    both += FromBase64(rest, bytes.size());
    EXPECT_EQ(both, bytes);
  }
}

TEST(Base64, ARunEndsWithPaddingAndWhereItIsDamaged)
{
  std::string_view text = "Zg==Zm8=";
  EXPECT_EQ(FromBase64(text, 9), "f");
  EXPECT_EQ(text, "Zm8=");
  for (const char * damaged : { "Zm9vZm!v", "Zm9v=m9v", "Zm9vZ=9v", "Zm9vZm9", "Zm9v====" })
  {
    EXPECT_EQ(Decoded(damaged), "foo") << damaged;
  }
  EXPECT_EQ(Decoded("Zm9vYmFy", 4), "foob");
}
