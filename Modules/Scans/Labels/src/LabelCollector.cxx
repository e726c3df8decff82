#include "LabelCollector.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace voxelcore
{
namespace
{

/** The first x at or behind `from` where row[x] != value. Words at a time: most of a scan is background. */
template <typename U>
std::int32_t
EndOfRun(const U * row, std::int32_t from, std::int32_t size, U value)
{
  constexpr std::int32_t perWord = 8 / sizeof(U);
  std::uint64_t          pattern = value;
  for (std::size_t width = sizeof(U); width < 8; width *= 2)
  {
    pattern |= pattern << (8 * width);
  }
  std::int32_t x = from;
  while (x + 4 * perWord <= size)
  {
    std::array<std::uint64_t, 4> words;
    std::memcpy(words.data(), row + x, sizeof words);
    if (((words[0] ^ pattern) | (words[1] ^ pattern) | (words[2] ^ pattern) | (words[3] ^ pattern)) != 0)
    {
      break;
    }
    x += 4 * perWord;
  }
  while (x + perWord <= size)
  {
    std::uint64_t word;
    std::memcpy(&word, row + x, sizeof word);
    const std::uint64_t difference = word ^ pattern;
    if (difference != 0)
    {
      const int bit =
        std::endian::native == std::endian::little ? std::countr_zero(difference) : std::countl_zero(difference);
      return x + bit / static_cast<int>(8 * sizeof(U));
    }
    x += perWord;
  }
  while (x < size && row[x] == value)
  {
    ++x;
  }
  return x;
}

} // namespace

LabelCollector::LabelCollector(const StoredVoxels & scan, const LabelChoice & choice, const CropRange & part)
  : m_Scan(scan)
  , m_Part(part)
  , m_IsPart(choice.crop.has_value())
  , m_Naming(scan, choice)
  , m_Binary(choice.binary)
  , m_Threshold(choice.threshold)
  , m_MayBeMissing(choice.mayBeMissing)
  , m_ZeroIsBackground(scan.intercept == 0)
{
  const bool layers = scan.HasLayers();
  if (m_Threshold)
  {
    if (!(m_Threshold->first <= m_Threshold->second))
    {
      throw UsageError(Text("--threshold ",
                            Number(m_Threshold->first),
                            ":",
                            Number(m_Threshold->second),
                            ": put the lower bound first"));
    }
    if (choice.labels != "all" || layers)
    {
      throw UsageError("--threshold makes one shape of a grey scan: it cannot be used with --labels or with layers");
    }
    m_ZeroIsBackground = m_ZeroIsBackground && (m_Threshold->first > 0 || m_Threshold->second < 0);
  }
  m_Tables.resize(layers ? scan.interleaved : 1);
  const std::size_t width = PixelBytes(scan.type);
  for (Table & table : m_Tables)
  {
    table.dense.assign(width == 1 ? 256 : width == 2 ? 65536 : 0, kUnseen);
  }
  if (m_Binary || m_Threshold)
  {
    NewTarget({ 1, "label-1" });
    if (m_Threshold)
    {
      m_Found.push_back({ { 1, "label-1" }, 0, false });
    }
  }
}

std::int32_t
LabelCollector::NewTarget(const LabelNaming::Label & label)
{
  Target target;
  target.label = label;
  m_Targets.push_back(std::move(target));
  return static_cast<std::int32_t>(m_Targets.size() - 1);
}

template <typename U>
std::int32_t
LabelCollector::Lookup(U bits, std::size_t layer, std::int32_t x, std::int32_t y, std::int32_t z)
{
  Table & table = m_Tables[layer];
  if constexpr (sizeof(U) <= 2)
  {
    std::int32_t & index = table.dense[bits];
    if (index == kUnseen)
    {
      index = Classify(bits, layer, x, y, z);
    }
    return index;
  }
  else
  {
    if (table.last == kUnseen || table.lastBits != bits)
    {
      const auto [at, isNew] = table.sparse.try_emplace(bits, kUnseen);
      if (isNew)
      {
        at->second = Classify(bits, layer, x, y, z);
      }
      table.lastBits = bits;
      table.last = at->second;
    }
    return table.last;
  }
}

void
LabelCollector::Emit(Target & target, std::int32_t x, std::int32_t end, std::int32_t y, std::int32_t z)
{
  if (!target.touched)
  {
    target.touched = true;
    m_Touched.push_back(static_cast<std::int32_t>(&target - m_Targets.data()));
  }
  else if (Run & last = target.runs.back(); last.end == x && last.y == y && last.z == z)
  {
    last.end = end;
    return;
  }
  target.runs.push_back({ x, end, y, z });
}

template <typename U>
void
LabelCollector::ScanRow(const U * row, std::size_t layer, std::int32_t y, std::int32_t z)
{
  const bool whole = NeedsAllRows();
  const bool rowIsIn = y >= m_Part.first[1] && y < m_Part.end[1] && z >= m_Part.first[2] && z < m_Part.end[2];
  const auto size = whole ? static_cast<std::int32_t>(m_Scan.geometry.size[0]) : m_Part.end[0];
  for (std::int32_t x = whole ? 0 : m_Part.first[0];;)
  {
    if (m_ZeroIsBackground)
    {
      x = EndOfRun<U>(row, x, size, 0);
    }
    if (x >= size)
    {
      return;
    }
    const std::int32_t end = EndOfRun<U>(row, x + 1, size, row[x]);
    const std::int32_t index = Lookup<U>(row[x], layer, x, y, z);
    const std::int32_t from = std::max(x, m_Part.first[0]);
    const std::int32_t to = std::min(end, m_Part.end[0]);
    if (index >= 0 && rowIsIn && from < to)
    {
      Found & found = m_Found[static_cast<std::size_t>(index)];
      found.isIn = true;
      if (found.target >= 0)
      {
        Emit(m_Targets[static_cast<std::size_t>(found.target)], from, to, y, z);
      }
    }
    x = end;
  }
}

template <typename T>
void
LabelCollector::ThresholdRow(const std::byte * row, std::int32_t y, std::int32_t z)
{
  // Grey values of 32 bits and more are too many for a table.
  const std::int32_t size = m_Part.end[0];
  const auto         isIn = [&](std::int32_t x) {
    T stored;
    std::memcpy(&stored, row + static_cast<std::size_t>(x) * sizeof(T), sizeof(T));
    const double value = m_Scan.slope * static_cast<double>(stored) + m_Scan.intercept;
    return value >= m_Threshold->first && value <= m_Threshold->second;
  };
  for (std::int32_t x = m_Part.first[0]; x < size;)
  {
    while (x < size && !isIn(x))
    {
      ++x;
    }
    const std::int32_t begin = x;
    while (x < size && isIn(x))
    {
      ++x;
    }
    if (x > begin)
    {
      Emit(m_Targets[0], begin, x, y, z);
    }
  }
}

template <typename U>
void
LabelCollector::AddRowsOf(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  const auto        sizeX = static_cast<std::size_t>(m_Scan.geometry.size[0]);
  const auto        sizeY = static_cast<std::uint64_t>(m_Scan.geometry.size[1]);
  const std::size_t interleaved = m_Scan.interleaved;
  auto              y = static_cast<std::int32_t>(firstRow % sizeY);
  auto              z = static_cast<std::int32_t>(firstRow / sizeY);
  m_Layer.resize(sizeX * sizeof(U));
  for (std::size_t r = 0; r < rowCount; ++r)
  {
    const std::byte * row = rows + r * sizeX * interleaved * sizeof(U);
    const std::size_t first = m_Scan.component < 0 ? 0 : static_cast<std::size_t>(m_Scan.component);
    const std::size_t last = m_Scan.component < 0 ? interleaved : first + 1;
    for (std::size_t layer = first; layer < last; ++layer)
    {
      const std::byte * values = row;
      if (interleaved > 1)
      {
        for (std::size_t x = 0; x < sizeX; ++x)
        {
          std::memcpy(m_Layer.data() + x * sizeof(U), row + (x * interleaved + layer) * sizeof(U), sizeof(U));
        }
        values = m_Layer.data();
      }
      if (m_Threshold && sizeof(U) > 2)
      {
        switch (m_Scan.type)
        {
          case PixelType::UInt32:
            ThresholdRow<std::uint32_t>(values, y, z);
            break;
          case PixelType::Int32:
            ThresholdRow<std::int32_t>(values, y, z);
            break;
          case PixelType::UInt64:
            ThresholdRow<std::uint64_t>(values, y, z);
            break;
          case PixelType::Int64:
            ThresholdRow<std::int64_t>(values, y, z);
            break;
          case PixelType::Float32:
            ThresholdRow<float>(values, y, z);
            break;
          default:
            ThresholdRow<double>(values, y, z);
            break;
        }
        continue;
      }
      // Rows begin at multiples of the value's size in buffers from the heap: aligned.
      ScanRow<U>(reinterpret_cast<const U *>(values), m_Scan.component < 0 ? layer : 0, y, z);
    }
    if (++y == static_cast<std::int32_t>(sizeY))
    {
      y = 0;
      ++z;
    }
  }
}

void
LabelCollector::AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  switch (PixelBytes(m_Scan.type))
  {
    case 1:
      AddRowsOf<std::uint8_t>(rows, firstRow, rowCount);
      break;
    case 2:
      AddRowsOf<std::uint16_t>(rows, firstRow, rowCount);
      break;
    case 4:
      AddRowsOf<std::uint32_t>(rows, firstRow, rowCount);
      break;
    default:
      AddRowsOf<std::uint64_t>(rows, firstRow, rowCount);
      break;
  }
}

} // namespace voxelcore
