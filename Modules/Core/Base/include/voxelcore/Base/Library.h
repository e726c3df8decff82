#pragma once
// What C++20 has and the library of some compilers lacks: Emscripten's is LLVM's of 2021. All of VoxelCore takes it
// from here: `ranges::sort` and its like, `bit_cast`, `atomic_ref`, `make_unique_for_overwrite`, and `from_chars` and
// `to_chars` of real numbers. Where the library has them these are its own. `plain` has the same in terms of what every
// library has, as far as VoxelCore uses it; VOXELCORE_PLAIN_LIBRARY asks for it everywhere, as a test does.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

namespace voxelcore::plain
{

template <typename To, typename From>
To
bit_cast(const From & from)
{
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

template <typename TArray>
std::unique_ptr<TArray>
make_unique_for_overwrite(std::size_t size)
{
  return std::unique_ptr<TArray>(new std::remove_extent_t<TArray>[size]);
}

/** The order that is asked for may be a weaker one than it keeps. */
template <typename T>
class atomic_ref
{
public:
  explicit atomic_ref(T & value)
    : m_Value(&value)
  {}
  T
  load(std::memory_order) const
  {
    T value;
    __atomic_load(m_Value, &value, __ATOMIC_SEQ_CST);
    return value;
  }
  void
  store(T value, std::memory_order) const
  {
    __atomic_store(m_Value, &value, __ATOMIC_SEQ_CST);
  }
  T
  fetch_or(T bits, std::memory_order) const
  {
    return __atomic_fetch_or(m_Value, bits, __ATOMIC_SEQ_CST);
  }
  bool
  compare_exchange_weak(T & expected, T value, std::memory_order) const
  {
    return __atomic_compare_exchange(m_Value, &expected, &value, true, __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
  }

private:
  T * m_Value;
};

/** The length of the number that the text begins with; 0 where there is none. */
inline std::size_t
RealLength(std::string_view text)
{
  const auto digitsFrom = [&](std::size_t at) {
    return std::min(text.find_first_not_of("0123456789", at), text.size());
  };
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  for (const std::string_view word : { "infinity", "inf", "nan" })
  {
    const std::string_view here = text.substr(first, word.size());
    const auto             isSame = [](char a, char b) { return (a | 0x20) == b; };
    if (std::equal(here.begin(), here.end(), word.begin(), word.end(), isSame))
    {
      return first + word.size();
    }
  }
  std::size_t end = digitsFrom(first);
  std::size_t digits = end - first;
  if (end < text.size() && text[end] == '.')
  {
    const std::size_t point = end;
    end = digitsFrom(point + 1);
    digits += end - point - 1;
  }
  if (digits == 0)
  {
    return 0;
  }
  if (end < text.size() && (text[end] | 0x20) == 'e')
  {
    const std::size_t exponent =
      end + (end + 1 < text.size() && (text[end + 1] == '+' || text[end + 1] == '-') ? 2 : 1);
    const std::size_t last = exponent < text.size() ? digitsFrom(exponent) : exponent;
    end = last > exponent ? last : end;
  }
  return end;
}

template <std::floating_point TReal>
TReal
RealOf(const std::string & text)
{
  if constexpr (sizeof(TReal) == sizeof(float))
  {
    return std::strtof(text.c_str(), nullptr);
  }
  else
  {
    return std::strtod(text.c_str(), nullptr);
  }
}

using std::from_chars;
using std::to_chars;

template <std::floating_point TReal>
std::from_chars_result
from_chars(const char * first, const char * last, TReal & value)
{
  const std::size_t length = RealLength({ first, static_cast<std::size_t>(last - first) });
  if (length == 0)
  {
    return { first, std::errc::invalid_argument };
  }
  const std::string text(first, length);
  const TReal       read = RealOf<TReal>(text);
  const bool        isNumber = text.find_first_of("nN") == std::string::npos; // neither "inf" nor "nan"
  const bool isSomething = text.substr(0, text.find_first_of("eE")).find_first_of("123456789") != std::string::npos;
  if (isNumber && (std::isinf(read) || (read == 0 && isSomething)))
  {
    return { first + length, std::errc::result_out_of_range };
  }
  value = read;
  return { first + length, std::errc() };
}

/** As printf() writes it. */
template <std::floating_point TReal>
std::string
Printed(const char * format, int digits, TReal value)
{
  std::array<char, 512> text{};
  const int             length = std::snprintf(text.data(), text.size(), format, digits, static_cast<double>(value));
  return { text.data(), std::min(static_cast<std::size_t>(length), text.size() - 1) };
}

/** With as few digits as make the same number again, and of these the nearest: "1.25e-07". \param value from 0 on */
template <std::floating_point TReal>
std::string
ShortestScientific(TReal value)
{
  using Limits = std::numeric_limits<TReal>;
  int        exponent = 0;
  const bool isPowerOfTwo = std::frexp(value, &exponent) == TReal(0.5);
  // So many digits of a decimal number come back from a binary one that is not too small.
  for (int digits = value < Limits::min() ? 1 : Limits::digits10; digits < Limits::max_digits10; ++digits)
  {
    std::string       text = Printed("%.*e", digits - 1, value);
    const std::size_t mark = text.find('e');
    if (RealOf<TReal>(text) == value)
    {
      const std::size_t last = digits > 1 ? text.find_last_not_of('0', mark - 1) : 0;
      return text.substr(0, last + (text[last] == '.' ? 0 : 1)) + text.substr(mark);
    }
    // Below a power of two numbers lie twice as dense as above: the nearest decimal may be another's, and the next not.
    if (const std::size_t rising = text.find_last_not_of("9.", mark - 1); isPowerOfTwo && rising < mark)
    {
      ++text[rising];
      std::replace(text.begin() + static_cast<std::ptrdiff_t>(rising) + 1,
                   text.begin() + static_cast<std::ptrdiff_t>(mark),
                   '9',
                   '0');
      if (RealOf<TReal>(text) == value)
      {
        return text;
      }
    }
  }
  return Printed("%.*e", Limits::max_digits10 - 1, value);
}

/** The shorter of "0.00125" and "1.25e-03", the first where both are as short. \param value from 0 on */
template <std::floating_point TReal>
std::string
Shortest(TReal value)
{
  if (value == 0)
  {
    return "0";
  }
  std::string       scientific = ShortestScientific(value);
  const std::size_t mark = scientific.find('e');
  const int         exponent = std::atoi(scientific.c_str() + mark + 1);
  const int         decimals = static_cast<int>(mark > 1 ? mark - 2 : 0) - exponent;
  if (std::abs(exponent) > 30) // the text of such numbers is longer than that of any exponent
  {
    return scientific;
  }
  std::string fixed = Printed("%.*f", std::max(decimals, 0), value);
  return fixed.size() <= scientific.size() ? fixed : scientific;
}

template <std::floating_point TReal, typename TWrite>
std::to_chars_result
WriteReal(char * first, char * last, TReal value, const TWrite & write)
{
  const std::string sign = std::signbit(value) ? "-" : "";
  const std::string text = sign + (std::isnan(value) ? "nan" : std::isinf(value) ? "inf" : write(std::abs(value)));
  if (text.size() > static_cast<std::size_t>(last - first))
  {
    return { last, std::errc::value_too_large };
  }
  return { std::copy(text.begin(), text.end(), first), std::errc() };
}

template <std::floating_point TReal>
std::to_chars_result
to_chars(char * first, char * last, TReal value)
{
  return WriteReal(first, last, value, Shortest<TReal>);
}

/** In scientific form. */
template <std::floating_point TReal>
std::to_chars_result
to_chars(char * first, char * last, TReal value, std::chars_format)
{
  return WriteReal(first, last, value, ShortestScientific<TReal>);
}

/** In general form. */
template <std::floating_point TReal>
std::to_chars_result
to_chars(char * first, char * last, TReal value, std::chars_format, int digits)
{
  return WriteReal(first, last, value, [&](TReal size) { return Printed("%.*g", digits, size); });
}

namespace ranges
{

using greater = std::greater<>;
using greater_equal = std::greater_equal<>;

/** Calls with what `of` makes of the items. */
template <typename TCall, typename TOf>
auto
OfItems(TCall & call, TOf & of)
{
  return [&](auto &&... items) -> decltype(auto) {
    return std::invoke(call, std::invoke(of, std::forward<decltype(items)>(items))...);
  };
}

#define VOXELCORE_PLAIN(name, standard)                                               \
  template <typename TRange, typename TCall = standard, typename TOf = std::identity> \
  auto name(TRange && range, TCall call = {}, TOf of = {})                            \
  {                                                                                   \
    return std::name(std::begin(range), std::end(range), OfItems(call, of));          \
  }
VOXELCORE_PLAIN(sort, std::less<>)
VOXELCORE_PLAIN(stable_sort, std::less<>)
VOXELCORE_PLAIN(is_sorted, std::less<>)
VOXELCORE_PLAIN(min_element, std::less<>)
VOXELCORE_PLAIN(max_element, std::less<>)
VOXELCORE_PLAIN(push_heap, std::less<>)
VOXELCORE_PLAIN(pop_heap, std::less<>)
VOXELCORE_PLAIN(adjacent_find, std::equal_to<>)
VOXELCORE_PLAIN(all_of, std::identity)
VOXELCORE_PLAIN(any_of, std::identity)
VOXELCORE_PLAIN(none_of, std::identity)
VOXELCORE_PLAIN(find_if, std::identity)
VOXELCORE_PLAIN(count_if, std::identity)
VOXELCORE_PLAIN(for_each, std::identity)
VOXELCORE_PLAIN(partition_point, std::identity)
#undef VOXELCORE_PLAIN

/** A part of a range. */
template <typename TIterator>
struct Part
{
  TIterator first;
  TIterator last;
  TIterator
  begin() const
  {
    return first;
  }
  TIterator
  end() const
  {
    return last;
  }
  std::size_t
  size() const
  {
    return static_cast<std::size_t>(std::distance(first, last));
  }
};

template <typename TRange>
auto
unique(TRange && range)
{
  return Part<decltype(std::begin(range))>{ std::unique(std::begin(range), std::end(range)), std::end(range) };
}

template <typename TRange, typename TIterator, typename TOrder = std::less<>>
void
nth_element(TRange && range, TIterator nth, TOrder order = {})
{
  std::nth_element(std::begin(range), nth, std::end(range), order);
}

template <typename TRange, typename T, typename TOrder = std::less<>, typename TOf = std::identity>
auto
lower_bound(TRange && range, const T & value, TOrder order = {}, TOf of = {})
{
  return std::lower_bound(std::begin(range), std::end(range), value, [&](const auto & item, const T & limit) {
    return std::invoke(order, std::invoke(of, item), limit);
  });
}

template <typename TRange, typename T, typename TOrder = std::less<>, typename TOf = std::identity>
auto
upper_bound(TRange && range, const T & value, TOrder order = {}, TOf of = {})
{
  return std::upper_bound(std::begin(range), std::end(range), value, [&](const T & limit, const auto & item) {
    return std::invoke(order, limit, std::invoke(of, item));
  });
}

template <typename TRange, typename T, typename TOrder = std::less<>, typename TOf = std::identity>
auto
equal_range(TRange && range, const T & value, TOrder order = {}, TOf of = {})
{
  return Part<decltype(std::begin(range))>{ ranges::lower_bound(range, value, order, of),
                                            ranges::upper_bound(range, value, order, of) };
}

template <typename TRange, typename T>
bool
binary_search(TRange && range, const T & value)
{
  return std::binary_search(std::begin(range), std::end(range), value);
}

template <typename TRange, typename T, typename TOf = std::identity>
auto
find(TRange && range, const T & value, TOf of = {})
{
  return ranges::find_if(
    range,
    [&](const auto & item) { return item == value; },
    of);
}

template <typename TRange, typename T, typename TOf = std::identity>
auto
count(TRange && range, const T & value, TOf of = {})
{
  return ranges::count_if(
    range,
    [&](const auto & item) { return item == value; },
    of);
}

template <typename TRange, typename T>
void
fill(TRange && range, const T & value)
{
  std::fill(std::begin(range), std::end(range), value);
}

template <typename TRange, typename TTest, typename T>
void
replace_if(TRange && range, TTest test, const T & value)
{
  std::replace_if(std::begin(range), std::end(range), test, value);
}

template <typename TRange>
void
reverse(TRange && range)
{
  std::reverse(std::begin(range), std::end(range));
}

template <typename TRange, typename TTo>
void
copy(TRange && range, TTo to)
{
  std::copy(std::begin(range), std::end(range), to);
}

template <typename TRange, typename TTo, typename TTest>
void
copy_if(TRange && range, TTo to, TTest test)
{
  std::copy_if(std::begin(range), std::end(range), to, test);
}

template <typename TRange, typename TTo, typename TCall>
void
transform(TRange && range, TTo to, TCall call)
{
  std::transform(std::begin(range), std::end(range), to, [&](auto && item) { return std::invoke(call, item); });
}

template <typename TRange, typename TOther, typename TTo, typename TCall>
void
transform(TRange && range, TOther && other, TTo to, TCall call)
{
  std::transform(std::begin(range), std::end(range), std::begin(other), to, call);
}

struct Permuted
{
  bool found;
};

template <typename TRange>
Permuted
next_permutation(TRange && range)
{
  return { std::next_permutation(std::begin(range), std::end(range)) };
}

template <typename TRange, typename TOrder = std::less<>, typename TOf = std::identity>
auto
min(TRange && range, TOrder order = {}, TOf of = {})
{
  return *ranges::min_element(range, order, of);
}

template <typename TRange, typename TOrder = std::less<>, typename TOf = std::identity>
auto
max(TRange && range, TOrder order = {}, TOf of = {})
{
  return *ranges::max_element(range, order, of);
}

template <typename TRange>
auto
minmax(TRange && range)
{
  return std::pair(ranges::min(range), ranges::max(range));
}

} // namespace ranges

} // namespace voxelcore::plain

namespace voxelcore
{

#if defined(VOXELCORE_PLAIN_LIBRARY) || !defined(__cpp_lib_ranges) || !defined(__cpp_lib_to_chars)
namespace ranges = plain::ranges;
using plain::atomic_ref;
using plain::bit_cast;
using plain::from_chars;
using plain::make_unique_for_overwrite;
using plain::to_chars;
#else
namespace ranges = std::ranges;
using std::atomic_ref;
using std::bit_cast;
using std::from_chars;
using std::make_unique_for_overwrite;
using std::to_chars;
#endif

} // namespace voxelcore
