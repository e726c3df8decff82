#include "voxelcore/Base/PackedNumbers.h"

#include <bit>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostShort = std::size_t{ 1 } << 8;
constexpr std::size_t kMostLong = std::size_t{ 1 } << 16;

/** Finds numbers by their bits, so that -0 and 0 stay apart, in a table that begins where the last one was full. */
class Finder
{
public:
  explicit Finder(std::vector<double> & different)
    : m_Different(different)
  {}

  /** The place of a number in the table; kMostLong where it is one too many. */
  std::size_t
  PlaceOf(double number)
  {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (std::size_t slot = (bits * 0x9E3779B97F4A7C15U) >> (64 - kSlotBits);; slot = (slot + 1) % m_Places.size())
    {
      const std::size_t place = m_Places[slot];
      const std::size_t count = m_Different.size() - m_First;
      if (place == kNone && count == kMostLong)
      {
        return kMostLong;
      }
      if (place == kNone)
      {
        m_Places[slot] = static_cast<std::uint32_t>(count);
        m_Different.push_back(number);
        return count;
      }
      if (std::bit_cast<std::uint64_t>(m_Different[m_First + place]) == bits)
      {
        return place;
      }
    }
  }

  void
  BeginTable()
  {
    m_First = m_Different.size();
    m_Places.assign(m_Places.size(), kNone);
  }

private:
  static constexpr unsigned      kSlotBits = 17; // never more than half full
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::vector<double> &      m_Different;
  std::size_t                m_First = 0;
  std::vector<std::uint32_t> m_Places = std::vector<std::uint32_t>(std::size_t{ 1 } << kSlotBits, kNone);
};

} // namespace

bool
PackedNumbers::Pack(std::span<const double> numbers)
{
  constexpr std::size_t times = 4; // that a number is to come: two bytes each time and eight once
  *this = PackedNumbers();
  std::vector<Table>         tables{ { 0, 0 } };
  std::vector<double>        different;
  Finder                     finder(different);
  std::vector<std::uint16_t> places(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    std::size_t place = finder.PlaceOf(numbers[i]);
    if (place == kMostLong)
    {
      if (different.size() * times > i)
      {
        return false;
      }
      finder.BeginTable();
      tables.push_back({ i, different.size() });
      place = finder.PlaceOf(numbers[i]);
    }
    places[i] = static_cast<std::uint16_t>(place);
  }
  m_Count = numbers.size();
  m_Tables = std::move(tables);
  m_Different = std::move(different);
  if (m_Different.size() <= kMostShort)
  {
    m_Short.assign(places.begin(), places.end());
  }
  else
  {
    m_Long = std::move(places);
  }
  return true;
}

std::optional<NumberView>
PackedNumbers::View() const
{
  if (m_Tables.size() > 1)
  {
    return {};
  }
  return m_Long.empty() ? NumberView(m_Different.data(), m_Short.data())
                        : NumberView(m_Different.data(), m_Long.data());
}

void
PackedNumbers::Unpack(std::span<double> numbers) const
{
  const auto look = [&](const auto & places) {
    for (std::size_t table = 0; table < m_Tables.size(); ++table)
    {
      const double * const different = m_Different.data() + m_Tables[table].firstDifferent;
      for (std::size_t i = m_Tables[table].firstNumber; i < TableEnd(table); ++i)
      {
        numbers[i] = different[places[i]];
      }
    }
  };
  m_Long.empty() ? look(m_Short) : look(m_Long);
}

void
PackedNumbers::Unpack(std::span<const std::uint32_t> runs, std::size_t each, std::span<double> numbers) const
{
  const auto look = [&](const auto & places) {
    std::size_t table = 0;
    std::size_t to = 0;
    for (const std::uint32_t run : runs)
    {
      for (std::size_t i = each * run; i < each * run + each; ++i)
      {
        while (i >= TableEnd(table))
        {
          ++table;
        }
        numbers[to++] = m_Different[m_Tables[table].firstDifferent + places[i]];
      }
    }
  };
  m_Long.empty() ? look(m_Short) : look(m_Long);
}

} // namespace voxelcore
