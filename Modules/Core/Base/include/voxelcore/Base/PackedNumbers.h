#pragma once
// Arrays of numbers while nobody asks for them.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace voxelcore
{

/** Numbers to be looked up one by one, packed or not; they must outlive it. */
class NumberView
{
public:
  NumberView() = default;

  explicit(false) NumberView(std::span<const double> numbers)
    : m_Numbers(numbers.data())
  {}
  explicit(false) NumberView(const std::vector<double> & numbers)
    : m_Numbers(numbers.data())
  {}
  NumberView(const double * different, const std::uint8_t * places)
    : m_Numbers(different)
    , m_Short(places)
  {}
  NumberView(const double * different, const std::uint16_t * places)
    : m_Numbers(different)
    , m_Long(places)
  {}

  double
  operator[](std::size_t i) const
  {
    return m_Numbers[m_Short != nullptr ? m_Short[i] : m_Long != nullptr ? m_Long[i] : i];
  }

  /** What has to be fetched from memory for number i. */
  const void *
  Address(std::size_t i) const
  {
    return m_Short != nullptr  ? static_cast<const void *>(m_Short + i)
           : m_Long != nullptr ? static_cast<const void *>(m_Long + i)
                               : static_cast<const void *>(m_Numbers + i);
  }

private:
  const double *        m_Numbers = nullptr; ///< all, or those that differ
  const std::uint8_t *  m_Short = nullptr;
  const std::uint16_t * m_Long = nullptr;
};

/** Numbers in one or two bytes each where so few of them differ, as measures and places on a lattice do in a body that
 *  is nowhere thick. They come back to the last bit. Where a table of those that differ is full, those that follow have
 *  another: what lies together has much in common. */
class PackedNumbers
{
public:
  PackedNumbers() = default;

  /** False, and nothing is kept, where tables would be filled with numbers that come less than four times each. */
  bool
  Pack(std::span<const double> numbers);

  /** As many as were packed. */
  void
  Unpack(std::span<double> numbers) const;

  /** Of runs of `each` numbers those named, ascending. */
  void
  Unpack(std::span<const std::uint32_t> runs, std::size_t each, std::span<double> numbers) const;

  /** None where one table was not enough. */
  std::optional<NumberView>
  View() const;

private:
  std::size_t
  TableEnd(std::size_t table) const
  {
    return table + 1 < m_Tables.size() ? m_Tables[table + 1].firstNumber : m_Count;
  }

  struct Table
  {
    std::size_t firstNumber;
    std::size_t firstDifferent;
  };

  std::size_t                m_Count = 0;
  std::vector<Table>         m_Tables;
  std::vector<double>        m_Different;
  std::vector<std::uint8_t>  m_Short; ///< per number its place in its table: here where one byte is enough,
  std::vector<std::uint16_t> m_Long;  ///< else here
};

/** As many as are worth the time to pack them where they wait a moment only: 4 MB. */
inline constexpr std::size_t kManyNumbers = std::size_t{ 1 } << 19;

/** An array of numbers or points, packed where that can be. */
template <typename T>
class PackedArray
{
public:
  PackedArray() = default;

  /** Fewer numbers than `least` stay as they are. */
  explicit PackedArray(std::vector<T> values, std::size_t least = 0)
    : m_Count(values.size())
  {
    const std::span<const double> numbers = NumbersOf(values);
    if (numbers.size() < least || !m_Packed.Pack(numbers))
    {
      m_Plain = std::move(values);
    }
  }

  std::vector<T>
  Copy() const
  {
    if (!m_Plain.empty())
    {
      return m_Plain;
    }
    std::vector<T> values(m_Count);
    m_Packed.Unpack(NumbersOf(values));
    return values;
  }

  bool
  IsEmpty() const
  {
    return m_Count == 0;
  }
  bool
  IsPacked() const
  {
    return m_Count > 0 && m_Plain.empty();
  }

  /** Of numbers that can be looked up one by one. */
  std::optional<NumberView>
  View() const requires std::same_as<T, double>
  {
    return IsPacked() ? m_Packed.View() : NumberView(m_Plain);
  }

  /** Those named, ascending. */
  std::vector<T>
  Copy(std::span<const std::uint32_t> named) const
  {
    std::vector<T> values(named.size());
    if (m_Plain.empty())
    {
      // NOLINTNEXTLINE(bugprone-sizeof-expression): a T is one double or several
      m_Packed.Unpack(named, sizeof(T) / sizeof(double), NumbersOf(values));
      return values;
    }
    for (std::size_t i = 0; i < named.size(); ++i)
    {
      values[i] = m_Plain[named[i]];
    }
    return values;
  }

  std::vector<T>
  Take() &&
  {
    std::vector<T> values = m_Plain.empty() ? Copy() : std::move(m_Plain);
    *this = PackedArray();
    return values;
  }

private:
  static std::span<double>
  NumbersOf(std::vector<double> & values)
  {
    return values;
  }
  static std::span<double>
  NumbersOf(std::vector<std::array<double, 3>> & points)
  {
    return points.empty() ? std::span<double>() : std::span(points.front().data(), 3 * points.size());
  }

  std::size_t    m_Count = 0;
  PackedNumbers  m_Packed;
  std::vector<T> m_Plain; ///< all of it where too many differ
};

} // namespace voxelcore
