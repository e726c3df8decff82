#include "GreyTest.h"

#include "voxelcore/TextFields.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace voxelcore
{
namespace
{

constexpr std::uint64_t kMostValues = 1U << 21;
constexpr std::size_t   kMostOfARow = 1U << 16;
constexpr std::uint64_t kFirstLook = 1U << 17;
constexpr std::size_t   kMostDistinct = 1U << 16;
constexpr std::size_t   kFewestGreys = 24;
constexpr std::uint64_t kFewestNeighbours = 500;
constexpr std::size_t   kBins = 16;
constexpr std::uint64_t kNoRow = UINT64_MAX - 1;

/** Spreads numbers that follow each other: rows taken must not keep step with what repeats in a scan. */
std::uint64_t
Mixed(std::uint64_t number)
{
  number = (number ^ (number >> 31)) * 0x7FB5D329728EA185U;
  return (number ^ (number >> 27)) * 0x81DADEF4BC2DD44DU >> 16;
}

/** The value behind which the brighter class begins: Otsu's threshold, exactly, of ascending values. */
double
OtsuThreshold(const std::vector<double> & ascending)
{
  // Differences from the first value: sums stay short.
  const double base = ascending.front();
  double       total = 0;
  for (const double value : ascending)
  {
    total += value - base;
  }
  const auto  count = static_cast<double>(ascending.size());
  double      below = 0;
  double      best = -1;
  std::size_t split = 0; // the last of the darker class
  for (std::size_t i = 0; i + 1 < ascending.size(); ++i)
  {
    below += ascending[i] - base;
    if (ascending[i] == ascending[i + 1])
    {
      continue;
    }
    const double left = static_cast<double>(i + 1);
    const double difference = below / left - (total - below) / (count - left);
    const double between = left * (count - left) * difference * difference;
    if (between > best)
    {
      best = between;
      split = i;
    }
  }
  const double last = ascending[split];
  const double next = ascending[std::min(split + 1, ascending.size() - 1)];
  if (last == std::floor(last) && next == std::floor(next))
  {
    return last + 1;
  }
  return last + (next - last) / 2;
}

/** With so few digits as a person would give. */
double
Rounded(double value)
{
  if (value == 0 || value == std::floor(value))
  {
    return value;
  }
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3);
  return ParseReal(Number(std::round(value / unit) * unit)).value_or(value);
}

} // namespace

struct GreyTest::Neighbours
{
  struct OfValue
  {
    std::uint64_t voxels = 0;
    std::uint64_t pairs = 0; ///< with a neighbour that is not 0, counted from the first of the two
    std::uint64_t equal = 0;
  };
  std::unordered_map<double, OfValue> values;
  std::vector<double>                 differences; ///< of neighbours that are neither 0 nor equal
};

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
    const std::byte * at = rows + r * rowBytes + begin;
    for (std::size_t x = 0; x < m_Width; ++x, at += stride)
    {
      const double value = m_Scan.slope * StoredValue(at, m_Scan.type) + m_Scan.intercept;
      m_NotZero += value != 0 ? 1 : 0;
      m_Values.push_back(value);
    }
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
  for (std::size_t r = 0; r < m_Rows.size(); ++r)
  {
    const double * row = m_Values.data() + r * m_Width;
    const bool     hasNext = r + 1 < m_Rows.size() && m_Rows[r + 1] == m_Rows[r] + 1 && m_Rows[r + 1] % sizeY != 0;
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
        if (place == found.values.end() && found.values.size() == kMostDistinct)
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
        pair(*last, value, row[x + m_Width]);
      }
    }
  }
  return found;
}

bool
GreyTest::HasFewValues() const
{
  std::vector<double> values;
  double              last = 0;
  for (const double value : m_Values)
  {
    if (value != last && value == value && value != 0)
    {
      last = value;
      if (std::find(values.begin(), values.end(), value) == values.end())
      {
        values.push_back(value);
        if (values.size() == kFewestGreys)
        {
          return false;
        }
      }
    }
  }
  return true;
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
  for (std::size_t i = 0; i < m_Values.size() / 2; ++i)
  {
    const double a = m_Values[i];
    const double b = m_Values[m_Values.size() - 1 - i];
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

GreyScan
GreyTest::Describe() const
{
  GreyScan            grey;
  const Neighbours    found = CountNeighbours();
  std::vector<double> shares;
  for (const auto & [value, of] : found.values)
  {
    if (of.pairs > 0)
    {
      shares.push_back(static_cast<double>(of.equal) / static_cast<double>(of.pairs));
    }
  }
  grey.distinct = found.values.size();
  if (!shares.empty())
  {
    std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
    grey.equal = shares[shares.size() / 2];
  }
  std::vector<double> values;
  std::copy_if(m_Values.begin(), m_Values.end(), std::back_inserter(values), [](double v) { return std::isfinite(v); });
  if (values.empty())
  {
    return grey;
  }
  std::sort(values.begin(), values.end());
  grey.lowest = values.front();
  grey.highest = values.back();
  grey.otsu = Rounded(OtsuThreshold(values));
  grey.half = Rounded(HalfwayThreshold(values));
  // Bins between the 0.1st and 99.9th percentile, the outer ones open: a speck of metal must not flatten the rest.
  const auto at = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  const double low = at(0.001);
  const double high = at(0.999);
  for (std::size_t b = 0; b <= kBins; ++b)
  {
    grey.edges.push_back(low + (high - low) * static_cast<double>(b) / static_cast<double>(kBins));
  }
  grey.edges.front() = grey.lowest;
  grey.edges.back() = grey.highest;
  auto from = values.begin();
  for (std::size_t b = 0; b < kBins; ++b)
  {
    const auto to = b + 1 == kBins ? values.end() : std::lower_bound(from, values.end(), grey.edges[b + 1]);
    grey.counts.push_back(static_cast<std::uint64_t>(to - from));
    from = to;
  }
  return grey;
}

double
HalfwayThreshold(std::span<const double> sorted)
{
  if (sorted.empty())
  {
    return 0;
  }
  const auto at = [](std::span<const double> part, double share) {
    return part[static_cast<std::size_t>(share * static_cast<double>(part.size() - 1))];
  };
  const auto above = [](std::span<const double> part, double value) {
    return part.subspan(static_cast<std::size_t>(std::upper_bound(part.begin(), part.end(), value) - part.begin()));
  };
  std::span<const double> part = sorted;
  for (;;)
  {
    const double background = at(part, 0.5);
    const double deviation = background - at(part, 0.1587);
    const double least = background + 5 * deviation;
    const auto   brighter = above(part, least);
    if (brighter.empty())
    {
      return sorted.back();
    }
    if (static_cast<double>(brighter.size()) > 0.3 * static_cast<double>(sorted.size()))
    {
      part = brighter;
      continue;
    }
    // Noise may reach beyond half of what is bright: above three deviations it is still a seldom thing.
    const double lowest = background + 3 * deviation;
    double       threshold = least;
    for (int i = 0; i < 20; ++i)
    {
      const auto bright = above(part, threshold);
      threshold = bright.empty() ? threshold : std::max(lowest, (background + at(bright, 0.75)) / 2);
    }
    return threshold;
  }
}

std::string
OtsuRange(const GreyScan & grey)
{
  return Number(grey.otsu) + ":inf";
}

std::string
GreyScanText(const GreyScan & grey)
{
  return Text("looks like a grey scan (",
              grey.distinct >= kMostDistinct ? "more than " : "",
              grey.distinct >= kMostDistinct ? kMostDistinct : grey.distinct,
              " values from ",
              Number(grey.lowest),
              " to ",
              Number(grey.highest),
              ", neighbouring voxels are rarely equal)");
}

void
RefuseGrey(const StoredVoxels & scan, const GreyTest & test)
{
  GreyScan          grey = test.Describe();
  const std::string message = Text(Printable(scan.path.string(), 4096),
                                   ": ",
                                   GreyScanText(grey),
                                   "; choose a range with --threshold LO:HI, for example --threshold ",
                                   OtsuRange(grey),
                                   " (Otsu), or give --labels all if its values are labels");
  throw GreyScanError(message, std::move(grey));
}

} // namespace voxelcore
