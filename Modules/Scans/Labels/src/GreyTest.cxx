#include "GreyTest.h"

#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace voxelcore
{
namespace
{

constexpr std::uint64_t kMostValues = 1U << 21;
constexpr std::size_t   kMostOfARow = 1U << 16;
constexpr std::uint64_t kFirstLook = 1U << 17;
constexpr std::size_t   kFewestGreys = 24;
constexpr std::uint64_t kFewestNeighbours = 500;
constexpr std::uint64_t kNoRow = UINT64_MAX - 1;

/** Spreads numbers that follow each other: rows taken must not keep step with what repeats in a scan. */
std::uint64_t
Mixed(std::uint64_t number)
{
  number = (number ^ (number >> 31)) * 0x7FB5D329728EA185U;
  return (number ^ (number >> 27)) * 0x81DADEF4BC2DD44DU >> 16;
}

/** Stored values that follow each other. */
void
TakeValues(const StoredVoxels & scan, const std::byte * from, std::span<double> values)
{
  WithStoredType(scan.type, [values, from, slope = scan.slope, intercept = scan.intercept]<typename T>(T) {
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = slope * StoredValue<T>(from + i * sizeof(T)) + intercept;
    }
  });
}

} // namespace

GreyTest::GreyTest(const StoredVoxels & scan, const CropRange & part)
  : m_Scan(scan)
  , m_Part(part)
  , m_Width(std::min(static_cast<std::size_t>(part.end[0] - part.first[0]), kMostOfARow))
  , m_LastTaken(kNoRow)
  , m_NextLook(kFirstLook)
{
  const auto side = [&](std::size_t axis) { return static_cast<std::uint64_t>(part.end[axis] - part.first[axis]); };
  const std::uint64_t rows = side(1) * side(2);
  const std::uint64_t most = std::max<std::uint64_t>(2, kMostValues / m_Width);
  // Two rows at a time, to have neighbours along j.
  m_OneIn = rows <= most ? 1 : (2 * rows + most - 1) / most;
  m_Stored.reserve(std::min(rows, most) * m_Width * PixelBytes(scan.type));
}

std::size_t
GreyTest::ValueCount() const
{
  return m_Stored.size() / PixelBytes(m_Scan.type);
}

double
GreyTest::Value(std::size_t index) const
{
  const std::byte * const at = m_Stored.data() + index * PixelBytes(m_Scan.type);
  return m_Scan.slope * StoredValue(at, m_Scan.type) + m_Scan.intercept;
}

void
GreyTest::AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  const auto        sizeY = static_cast<std::uint64_t>(m_Scan.geometry.size[1]);
  const std::size_t bytes = PixelBytes(m_Scan.type);
  const std::size_t stride = bytes * m_Scan.interleaved;
  const std::size_t rowBytes = stride * static_cast<std::size_t>(m_Scan.geometry.size[0]);
  const std::size_t begin = stride * static_cast<std::size_t>(m_Part.first[0]) +
                            bytes * static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, m_Scan.component));
  for (std::size_t r = 0; r < rowCount; ++r)
  {
    const std::uint64_t row = firstRow + r;
    const auto          y = static_cast<std::int64_t>(row % sizeY);
    const auto          z = static_cast<std::int64_t>(row / sizeY);
    if (y < m_Part.first[1] || y >= m_Part.end[1] || z < m_Part.first[2] || z >= m_Part.end[2])
    {
      continue;
    }
    const bool chosen = m_OneIn == 1 || Mixed(row) % m_OneIn == 0;
    if (!chosen && (m_LastTaken + 1 != row || y == m_Part.first[1]))
    {
      continue;
    }
    m_LastTaken = chosen ? row : kNoRow;
    m_Rows.push_back(row);
    const std::byte * const from = rows + r * rowBytes + begin;
    const std::size_t       first = m_Stored.size();
    m_Stored.resize(first + m_Width * bytes);
    std::byte * const to = m_Stored.data() + first;
    m_NotZero += WithStoredType(
      m_Scan.type,
      [from, to, stride, width = m_Width, slope = m_Scan.slope, intercept = m_Scan.intercept]<typename T>(T) {
        std::uint64_t notZero = 0;
        for (std::size_t x = 0; x < width; ++x)
        {
          const std::byte * const at = from + x * stride;
          notZero += slope * StoredValue<T>(at) + intercept != 0 ? 1 : 0;
          std::memcpy(to + x * sizeof(T), at, sizeof(T));
        }
        return notZero;
      });
  }
}

bool
GreyTest::IsTimeToLook()
{
  if (m_NotZero < m_NextLook)
  {
    return false;
  }
  m_NextLook *= 2;
  return true;
}

GreyTest::Neighbours
GreyTest::CountNeighbours() const
{
  Neighbours found;
  const auto sizeY = static_cast<std::uint64_t>(m_Scan.geometry.size[1]);
  const auto pair = [&](Neighbours::OfValue & of, double a, double b) {
    // A number that is none is no neighbour.
    if (b != 0 && b == b)
    {
      ++of.pairs;
      of.equal += a == b ? 1 : 0;
      if (a != b && found.differences.size() < kMostValues)
      {
        found.differences.push_back(std::abs(a - b));
      }
    }
  };
  Neighbours::OfValue * last = nullptr;
  double                lastValue = 0;
  std::vector<double>   row(m_Width);
  std::vector<double>   next(m_Width);
  const auto            take = [&](std::size_t r, std::vector<double> & values) {
    TakeValues(m_Scan, m_Stored.data() + r * m_Width * PixelBytes(m_Scan.type), values);
  };
  for (std::size_t r = 0; r < m_Rows.size(); ++r)
  {
    row.swap(next);
    if (r == 0)
    {
      take(r, row);
    }
    if (r + 1 < m_Rows.size())
    {
      take(r + 1, next);
    }
    const bool hasNext = r + 1 < m_Rows.size() && m_Rows[r + 1] == m_Rows[r] + 1 && m_Rows[r + 1] % sizeY != 0;
    for (std::size_t x = 0; x < m_Width; ++x)
    {
      const double value = row[x];
      if (value == 0 || value != value)
      {
        continue;
      }
      if (last == nullptr || value != lastValue)
      {
        const auto place = found.values.find(value);
        if (place == found.values.end() && found.values.size() == GreyTest::kMostDistinct)
        {
          continue; // so many are no labels, or enough of them
        }
        last = place == found.values.end() ? &found.values[value] : &place->second;
        lastValue = value;
      }
      ++last->voxels;
      if (x + 1 < m_Width)
      {
        pair(*last, value, row[x + 1]);
      }
      if (hasNext)
      {
        pair(*last, value, next[x]);
      }
    }
  }
  return found;
}

bool
GreyTest::HasFewValues() const
{
  return WithStoredType(m_Scan.type, [&]<typename T>(T last) {
    std::vector<double>     values;
    const std::size_t       count = ValueCount();
    const std::byte * const from = m_Stored.data();
    for (std::size_t i = 0; i < count; ++i)
    {
      T stored;
      std::memcpy(&stored, from + i * sizeof(T), sizeof(T));
      if (stored == last && i > 0) // as most are
      {
        continue;
      }
      last = stored;
      const double value = m_Scan.slope * static_cast<double>(stored) + m_Scan.intercept;
      if (value == value && value != 0 && std::find(values.begin(), values.end(), value) == values.end())
      {
        values.push_back(value);
        if (values.size() == kFewestGreys)
        {
          return false;
        }
      }
    }
    return true;
  });
}

bool
GreyTest::LooksGrey() const
{
  if (HasFewValues())
  {
    return false;
  }
  Neighbours found = CountNeighbours();
  if (found.values.size() < kFewestGreys)
  {
    return false;
  }
  std::vector<double>              shares;
  std::vector<Neighbours::OfValue> values;
  for (const auto & [value, of] : found.values)
  {
    values.push_back(of);
    if (of.pairs > 0)
    {
      shares.push_back(static_cast<double>(of.equal) / static_cast<double>(of.pairs));
    }
  }
  // The two most frequent values may be air and what is clipped: all others say how the scan is, if there are some.
  std::partial_sort(values.begin(), values.begin() + 2, values.end(), [](const auto & a, const auto & b) {
    return a.voxels > b.voxels;
  });
  std::uint64_t pairs = 0;
  std::uint64_t equal = 0;
  std::uint64_t voxels = 0;
  for (std::size_t v = 2; v < values.size(); ++v)
  {
    voxels += values[v].voxels;
    pairs += values[v].pairs;
    equal += values[v].equal;
  }
  if (pairs < kFewestNeighbours || shares.size() < kFewestGreys || voxels * 50 < m_NotZero)
  {
    return false;
  }
  std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
  const double median = shares[shares.size() / 2];
  const double share = static_cast<double>(equal) / static_cast<double>(pairs);
  if (median < 0.3 && share < 0.6)
  {
    return true;
  }
  if (median >= 0.6 || share >= 0.65 || found.differences.empty())
  {
    return false;
  }
  // Voxels anywhere: the first half against the second.
  std::vector<double> anywhere;
  for (std::size_t i = 0; i < ValueCount() / 2; ++i)
  {
    const double a = Value(i);
    const double b = Value(ValueCount() - 1 - i);
    if (a != 0 && b != 0 && std::isfinite(a - b) && a != b)
    {
      anywhere.push_back(std::abs(a - b));
    }
  }
  const auto middle = [](std::vector<double> & numbers) {
    const auto place = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), place, numbers.end());
    return *place;
  };
  return !anywhere.empty() && middle(found.differences) < 0.25 * middle(anywhere);
}

void
RefuseGrey(const StoredVoxels & scan, const GreyTest & test)
{
  GreyScan          grey = test.Describe();
  const std::string message = Text(Printable(scan.path.string(), 4096),
                                   ": ",
                                   GreyScanText(grey),
                                   "; choose a range with --threshold LO:HI, for example --threshold ",
                                   ProposedRange(grey),
                                   ", of which 'voxelcore info' says what it gives, or give --labels all if its values "
                                   "are labels");
  throw GreyScanError(message, std::move(grey));
}

} // namespace voxelcore
