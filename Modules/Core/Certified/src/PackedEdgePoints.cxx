#include "PackedEdgePoints.h"

#include <bit>
#include <span>

namespace voxelcore
{

namespace
{

// Of differences modulo 2^32, so that small ones either way are small numbers.
std::uint32_t
Folded(std::uint32_t difference)
{
  return difference << 1U ^ (difference >> 31U != 0 ? 0xFFFFFFFFU : 0U);
}

std::uint32_t
Unfolded(std::uint32_t folded)
{
  return folded >> 1U ^ ((folded & 1U) != 0 ? 0xFFFFFFFFU : 0U);
}

constexpr unsigned      kBits = 7; // of a number in a byte; the one above is set where more follow
constexpr std::uint32_t kMore = 1U << kBits;

std::uint32_t
Read(const std::uint8_t *& at)
{
  std::uint32_t number = *at & (kMore - 1);
  for (unsigned shift = kBits; (*at++ & kMore) != 0; shift += kBits)
  {
    number |= (*at & (kMore - 1)) << shift;
  }
  return number;
}

/** Calls write(number) for all that is kept, in order. */
template <typename TWrite>
void
WriteAll(const EdgePoints & plain, const TWrite & write)
{
  std::uint32_t before = 0;
  for (std::size_t edge = 0; edge + 1 < plain.offsets.size(); ++edge)
  {
    const auto points = plain.Of(edge);
    write(static_cast<std::uint32_t>(points.size()));
    for (const std::uint32_t point : points)
    {
      write(Folded(point - before));
      before = point;
    }
  }
}

} // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): taken, so that it is gone once packed
PackedEdgePoints::PackedEdgePoints(EdgePoints plain)
  : m_Edges(plain.offsets.size() - 1)
  , m_Points(plain.points.size())
{
  std::size_t bytes = 0;
  WriteAll(plain, [&](std::uint32_t number) { bytes += 1 + (std::bit_width(number | 1U) - 1) / kBits; });
  m_Bytes.reserve(bytes);
  WriteAll(plain, [&](std::uint32_t number) {
    for (; number >= kMore; number >>= kBits)
    {
      m_Bytes.push_back(static_cast<std::uint8_t>(number | kMore));
    }
    m_Bytes.push_back(static_cast<std::uint8_t>(number));
  });
}

EdgePoints
PackedEdgePoints::Take() &&
{
  EdgePoints plain;
  plain.offsets.reserve(m_Edges + 1);
  plain.points.reserve(m_Points);
  const std::uint8_t * at = m_Bytes.data();
  std::uint32_t        before = 0;
  for (std::size_t edge = 0; edge < m_Edges; ++edge)
  {
    for (std::uint32_t count = Read(at); count > 0; --count)
    {
      before += Unfolded(Read(at));
      plain.points.push_back(before);
    }
    plain.offsets.push_back(static_cast<std::uint32_t>(plain.points.size()));
  }
  std::vector<std::uint8_t>().swap(m_Bytes);
  return plain;
}

} // namespace voxelcore
