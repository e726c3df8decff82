#include "PackedNumbers.h"

#include <bit>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostShort = std::size_t{ 1 } << 8;
constexpr std::size_t kMostLong = std::size_t{ 1 } << 16;

/** Finds numbers by their bits, so that -0 and 0 stay apart. */
class Finder
{
public:
  /** The place of a number among those that differ; kMostLong where it is one too many. */
  std::size_t
  PlaceOf(double number, std::vector<double> & different)
  {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (std::size_t slot = (bits * 0x9E3779B97F4A7C15U) >> (64 - kSlotBits);; slot = (slot + 1) % m_Places.size())
    {
      const std::size_t place = m_Places[slot];
      if (place == kNone && different.size() == kMostLong)
      {
        return kMostLong;
      }
      if (place == kNone)
      {
        m_Places[slot] = static_cast<std::uint32_t>(different.size());
        different.push_back(number);
        return different.size() - 1;
      }
      if (std::bit_cast<std::uint64_t>(different[place]) == bits)
      {
        return place;
      }
    }
  }

private:
  static constexpr unsigned      kSlotBits = 17; // never more than half full
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

  std::vector<std::uint32_t> m_Places = std::vector<std::uint32_t>(std::size_t{ 1 } << kSlotBits, kNone);
};

template <typename TPlace>
void
Look(const std::vector<TPlace> & places, const std::vector<double> & different, std::span<double> numbers)
{
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    numbers[i] = different[places[i]];
  }
}

} // namespace

bool
PackedNumbers::Pack(std::span<const double> numbers)
{
  *this = PackedNumbers();
  Finder                     finder;
  std::vector<double>        different;
  std::vector<std::uint16_t> places(numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    const std::size_t place = finder.PlaceOf(numbers[i], different);
    if (place == kMostLong)
    {
      return false;
    }
    places[i] = static_cast<std::uint16_t>(place);
  }
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

void
PackedNumbers::Unpack(std::span<double> numbers) const
{
  Look(m_Short, m_Different, numbers);
  Look(m_Long, m_Different, numbers);
}

} // namespace voxelcore
