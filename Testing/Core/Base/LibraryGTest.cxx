// What stands for a library's own where it lacks it, held against a library that has all.

#include "voxelcore/Base/Library.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace voxelcore
{
namespace
{

#if !defined(VOXELCORE_PLAIN_LIBRARY) && defined(__cpp_lib_ranges) && defined(__cpp_lib_to_chars)

template <typename TReal, typename... TForm>
std::string
Ours(TReal value, TForm... form)
{
  char       text[400];
  const auto end = plain::to_chars(text, text + sizeof(text), value, form...);
  return { text, end.ptr };
}

template <typename TReal, typename... TForm>
std::string
Theirs(TReal value, TForm... form)
{
  char       text[400];
  const auto end = std::to_chars(text, text + sizeof(text), value, form...);
  return { text, end.ptr };
}

template <typename TReal>
void
ExpectSameText(TReal value)
{
  for (const TReal one : { value, -value })
  {
    EXPECT_EQ(Ours(one), Theirs(one));
    EXPECT_EQ(Ours(one, std::chars_format::scientific), Theirs(one, std::chars_format::scientific));
    EXPECT_EQ(Ours(one, std::chars_format::general, 9), Theirs(one, std::chars_format::general, 9));
  }
}

TEST(Library, NumbersAreWrittenAsTheStandardLibraryDoes)
{
  constexpr unsigned seed = 3;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int power = -1074; power < 1024; ++power) // below them numbers lie twice as dense as above
  {
    ExpectSameText(std::ldexp(1.0, power));
  }
  for (int power = -149; power < 128; ++power)
  {
    ExpectSameText(std::ldexp(1.0F, power));
  }
  for (int i = 0; i < 20000; ++i)
  {
    const double any = std::bit_cast<double>(random());
    const double usual = static_cast<double>(static_cast<std::int64_t>(random() % 2000001) - 1000000) / 1024;
    const double tenths = static_cast<double>(random() % 100000) / 1000;
    const float  single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    for (const double value : { any, usual, tenths, std::floor(usual) * 1e15 })
    {
      if (!std::isnan(value))
      {
        ExpectSameText(value);
      }
    }
    if (!std::isnan(single))
    {
      ExpectSameText(single);
    }
  }
  for (const double value : { 0.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::max() })
  {
    ExpectSameText(value);
  }
}

TEST(Library, NumbersAreReadAsTheStandardLibraryDoes)
{
  constexpr unsigned seed = 4;
  SCOPED_TRACE(seed);
  std::mt19937_64          random(seed);
  const std::string        signs = "0123456789999.eE+-infa x";
  std::vector<std::string> texts{ "",       "-",        ".",      "1.",    ".5",    "-.5e1",   "1e",
                                  "1e+",    "1e5x",     "0x10",   "inf",   "-inf",  "INFin",   "infini",
                                  "nan",    "-NaN",     "+1",     " 1",    "1e999", "-1e999",  "1e-999",
                                  "0e9999", "4.9e-324", "2e-324", "00012", "1e-5",  "infinity" };
  for (int i = 0; i < 30000; ++i)
  {
    std::string text;
    for (std::size_t k = 0, size = random() % 12; k < size; ++k)
    {
      text += signs[random() % signs.size()];
    }
    texts.push_back(text);
  }
  for (const std::string & text : texts)
  {
    double     ours = 7;
    double     theirs = 7;
    const auto a = plain::from_chars(text.data(), text.data() + text.size(), ours);
    const auto b = std::from_chars(text.data(), text.data() + text.size(), theirs);
    EXPECT_EQ(a.ptr - text.data(), b.ptr - text.data()) << text;
    EXPECT_EQ(a.ec, b.ec) << text;
    EXPECT_TRUE(ours == theirs || (std::isnan(ours) && std::isnan(theirs))) << text;
  }
}

TEST(Library, AlgorithmsDoWhatTheStandardLibraryDoes)
{
  constexpr unsigned seed = 6;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  struct Item
  {
    int key;
    int place;
    bool
    operator==(const Item &) const = default;
  };
  for (int round = 0; round < 200; ++round)
  {
    std::vector<Item> items(random() % 40);
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      items[i] = { static_cast<int>(random() % 10), static_cast<int>(i) };
    }
    const auto isEven = [](const Item & item) { return item.key % 2 == 0; };
    EXPECT_EQ(plain::ranges::count(items, 3, &Item::key), std::ranges::count(items, 3, &Item::key));
    EXPECT_EQ(plain::ranges::find(items, 3, &Item::key), std::ranges::find(items, 3, &Item::key));
    EXPECT_EQ(plain::ranges::find_if(items, isEven), std::ranges::find_if(items, isEven));
    EXPECT_EQ(plain::ranges::any_of(items, isEven), std::ranges::any_of(items, isEven));
    EXPECT_EQ(plain::ranges::min_element(items, {}, &Item::key), std::ranges::min_element(items, {}, &Item::key));
    EXPECT_EQ(plain::ranges::max_element(items, {}, &Item::key), std::ranges::max_element(items, {}, &Item::key));
    std::vector<Item> others = items;
    plain::ranges::stable_sort(items, plain::ranges::greater(), &Item::key);
    std::ranges::stable_sort(others, std::ranges::greater(), &Item::key);
    EXPECT_EQ(items, others);
    plain::ranges::reverse(items);
    std::ranges::reverse(others);
    EXPECT_EQ(items, others);
    const auto found = plain::ranges::equal_range(items, 4, {}, &Item::key);
    EXPECT_EQ(found.begin(), std::ranges::lower_bound(items, 4, {}, &Item::key));
    EXPECT_EQ(found.end(), std::ranges::upper_bound(items, 4, {}, &Item::key));
    std::vector<int> keys(items.size());
    plain::ranges::transform(items, keys.begin(), &Item::key);
    EXPECT_TRUE(plain::ranges::is_sorted(keys));
    EXPECT_EQ(plain::ranges::adjacent_find(keys), std::ranges::adjacent_find(keys));
    EXPECT_EQ(plain::ranges::binary_search(keys, 5), std::ranges::binary_search(keys, 5));
    keys.erase(plain::ranges::unique(keys).begin(), keys.end());
    EXPECT_EQ(plain::ranges::adjacent_find(keys), keys.end());
  }
}

#endif

TEST(Library, AnAtomicReferenceChangesWhatItRefersTo)
{
  double                          value = 1;
  const plain::atomic_ref<double> atomic(value);
  double                          old = 0;
  EXPECT_FALSE(atomic.compare_exchange_weak(old, 5, std::memory_order_relaxed));
  EXPECT_EQ(old, 1);
  while (!atomic.compare_exchange_weak(old, 5, std::memory_order_relaxed))
  {}
  EXPECT_EQ(value, 5);
  std::uint8_t                          bits = 1;
  const plain::atomic_ref<std::uint8_t> flags(bits);
  EXPECT_EQ(flags.fetch_or(6, std::memory_order_relaxed), 1);
  EXPECT_EQ(flags.load(std::memory_order_relaxed), 7);
  flags.store(2, std::memory_order_relaxed);
  EXPECT_EQ(bits, 2);
}

} // namespace
} // namespace voxelcore
