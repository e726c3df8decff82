#include "LabelCollector.h"
#include "TextFields.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace voxelcore
{
namespace
{

constexpr std::int32_t kUnseen = -2;
constexpr std::int32_t kBackground = -1;
// Beyond these a volume holds grey values, not labels, and its shapes would take memory out of all proportion.
constexpr std::size_t   kMostLabels = 1U << 20;
constexpr std::uint64_t kShapeBytesAlways = 1ULL << 30;
constexpr std::uint64_t kShapeBytesPerVoxel = 16;

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

void
FillRow(std::span<std::uint64_t> words, std::int32_t begin, std::int32_t end)
{
  const auto          first = static_cast<std::size_t>(begin >> 6);
  const auto          last = static_cast<std::size_t>((end - 1) >> 6);
  const std::uint64_t head = ~std::uint64_t{ 0 } << (begin & 63);
  const std::uint64_t tail = ~std::uint64_t{ 0 } >> (63 - ((end - 1) & 63));
  if (first == last)
  {
    words[first] |= head & tail;
    return;
  }
  words[first] |= head;
  std::fill(words.begin() + static_cast<std::ptrdiff_t>(first) + 1,
            words.begin() + static_cast<std::ptrdiff_t>(last),
            ~std::uint64_t{ 0 });
  words[last] |= tail;
}

/** Puts the voxels of `part` into `shape`, whose box contains the part's. */
void
AddShape(const VoxelShape & part, VoxelShape & shape)
{
  const auto shift = static_cast<std::size_t>(part.Box().lower[0] - shape.Box().lower[0]);
  const auto bits = static_cast<int>(shift & 63U);
  for (std::int32_t z = 0; z < part.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < part.Box().size[1]; ++y)
    {
      const auto from = part.Row(y, z);
      const auto to =
        shape.Row(y + part.Box().lower[1] - shape.Box().lower[1], z + part.Box().lower[2] - shape.Box().lower[2]);
      for (std::size_t w = 0; w < from.size(); ++w)
      {
        to[(shift >> 6) + w] |= from[w] << bits;
        if (bits != 0 && (from[w] >> (64 - bits)) != 0)
        {
          to[(shift >> 6) + w + 1] |= from[w] >> (64 - bits);
        }
      }
    }
  }
}

std::uint64_t
BoxBytes(const std::array<std::int32_t, 3> & lower, const std::array<std::int32_t, 3> & upper)
{
  const auto side = [&](std::size_t a) { return static_cast<std::uint64_t>(upper[a] - lower[a] + 1); };
  return (side(0) + 63) / 64 * 8 * side(1) * side(2);
}

VoxelBox
Box(const std::array<std::int32_t, 3> & lower, const std::array<std::int32_t, 3> & upper)
{
  return { lower, { upper[0] - lower[0] + 1, upper[1] - lower[1] + 1, upper[2] - lower[2] + 1 } };
}

} // namespace

LabelCollector::LabelCollector(const ScanFile & scan, const ReadOptions & options)
  : m_Scan(scan)
  , m_Book(scan, options)
  , m_Binary(options.binary)
  , m_Threshold(options.threshold)
  , m_ZeroIsBackground(scan.intercept == 0)
{
  const bool layers = scan.interleaved > 1 && scan.component < 0;
  if (m_Threshold)
  {
    if (!(m_Threshold->first <= m_Threshold->second))
    {
      throw UsageError(Text("--threshold ",
                            Number(m_Threshold->first),
                            ":",
                            Number(m_Threshold->second),
                            ": the lower bound comes first"));
    }
    if (options.labels != "all" || layers)
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
      m_Found.push_back({ { 1, "label-1" }, 0 });
    }
  }
}

std::int32_t
LabelCollector::NewTarget(const LabelBook::Label & label)
{
  Target target;
  target.label = label;
  m_Targets.push_back(std::move(target));
  return static_cast<std::int32_t>(m_Targets.size() - 1);
}

double
LabelCollector::Value(std::uint64_t bits) const
{
  switch (m_Scan.type)
  {
    case PixelType::UInt8:
    case PixelType::UInt16:
    case PixelType::UInt32:
    case PixelType::UInt64:
      return static_cast<double>(bits);
    case PixelType::Int8:
      return static_cast<double>(static_cast<std::int8_t>(bits));
    case PixelType::Int16:
      return static_cast<double>(static_cast<std::int16_t>(bits));
    case PixelType::Int32:
      return static_cast<double>(static_cast<std::int32_t>(bits));
    case PixelType::Int64:
      return static_cast<double>(static_cast<std::int64_t>(bits));
    case PixelType::Float32:
      return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case PixelType::Float64:
      break;
  }
  return std::bit_cast<double>(bits);
}

void
LabelCollector::RefuseValue(double value, const char * what, std::int32_t x, std::int32_t y, std::int32_t z) const
{
  Refuse(m_Scan.path,
         Text("value ", Number(value), " at voxel (", x, ",", y, ",", z, ") ", what),
         "labels are whole numbers from 0 up; for a grey scan give --threshold LO:HI");
}

std::int64_t
LabelCollector::WholeNumber(std::uint64_t bits, std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const double stored = Value(bits);
  if (!m_Scan.IsScaled() && !IsFloat(m_Scan.type))
  {
    if (stored < 0)
    {
      RefuseValue(stored, "is negative", x, y, z);
    }
    if (bits > static_cast<std::uint64_t>(INT64_MAX))
    {
      RefuseValue(stored, "is too large for a label", x, y, z);
    }
    return static_cast<std::int64_t>(bits); // exact, where a double may not be
  }
  double value = m_Scan.slope * stored + m_Scan.intercept;
  if (m_Scan.IsScaled() && std::isfinite(value) && value != std::floor(value) && std::abs(stored) < (1 << 22))
  {
    // A slope such as 1/255 is itself rounded (to single precision in NIfTI-1): a product no further from a whole
    // number than that rounding explains is that number. ITK comes to the same, as it computes in single precision.
    const double nearest = std::round(value);
    const double rounding = (std::abs(m_Scan.slope * stored) +
                             (m_Scan.intercept == std::floor(m_Scan.intercept) ? 0.0 : std::abs(m_Scan.intercept))) *
                            std::ldexp(1.0, -24);
    if (std::abs(value - nearest) <= rounding && rounding < 0.01 * std::abs(m_Scan.slope))
    {
      value = nearest;
    }
  }
  if (!std::isfinite(value))
  {
    RefuseValue(value, "is no number", x, y, z);
  }
  if (value != std::floor(value))
  {
    RefuseValue(value, m_Scan.IsScaled() ? "(after scaling) is a fraction" : "is a fraction", x, y, z);
  }
  if (value < 0)
  {
    RefuseValue(value, "is negative", x, y, z);
  }
  if (value > 9007199254740992.0) // 2^53: from here on doubles skip whole numbers
  {
    RefuseValue(value, "is too large for a label", x, y, z);
  }
  return static_cast<std::int64_t>(value);
}

std::int32_t
LabelCollector::Classify(std::uint64_t bits, std::size_t layer, std::int32_t x, std::int32_t y, std::int32_t z)
{
  if (m_Threshold)
  {
    const double value = m_Scan.slope * Value(bits) + m_Scan.intercept;
    return value >= m_Threshold->first && value <= m_Threshold->second ? 0 : kBackground;
  }
  const std::int64_t value = WholeNumber(bits, x, y, z);
  if (value == 0)
  {
    return kBackground;
  }
  if (m_Found.size() == kMostLabels)
  {
    Refuse(m_Scan.path,
           Text("more than ", kMostLabels, " different values"),
           "this is no label volume; for a grey scan give --threshold LO:HI");
  }
  Found found;
  found.label = m_Book.Identify(layer, value);
  if (m_Book.IsWanted(found.label))
  {
    found.target = m_Binary ? 0 : NewTarget(found.label);
  }
  m_Found.push_back(std::move(found));
  return static_cast<std::int32_t>(m_Found.size() - 1);
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
  const auto size = static_cast<std::int32_t>(m_Scan.geometry.size[0]);
  for (std::int32_t x = 0;;)
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
    const std::int32_t found = Lookup<U>(row[x], layer, x, y, z);
    if (found >= 0)
    {
      if (const std::int32_t target = m_Found[static_cast<std::size_t>(found)].target; target >= 0)
      {
        Emit(m_Targets[static_cast<std::size_t>(target)], x, end, y, z);
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
  const auto size = static_cast<std::int32_t>(m_Scan.geometry.size[0]);
  const auto isIn = [&](std::int32_t x) {
    T stored;
    std::memcpy(&stored, row + static_cast<std::size_t>(x) * sizeof(T), sizeof(T));
    const double value = m_Scan.slope * static_cast<double>(stored) + m_Scan.intercept;
    return value >= m_Threshold->first && value <= m_Threshold->second;
  };
  for (std::int32_t x = 0; x < size;)
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
  FinishSlab();
}

void
LabelCollector::FinishSlab()
{
  const auto & size = m_Scan.geometry.size;
  const auto   voxels =
    static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) * static_cast<std::uint64_t>(size[2]);
  const std::uint64_t limit = std::max(kShapeBytesAlways, kShapeBytesPerVoxel * voxels);
  for (const std::int32_t index : m_Touched)
  {
    Target &                    target = m_Targets[static_cast<std::size_t>(index)];
    std::array<std::int32_t, 3> lower{ INT32_MAX, INT32_MAX, INT32_MAX };
    std::array<std::int32_t, 3> upper{ -1, -1, -1 };
    for (const Run & run : target.runs)
    {
      lower = { std::min(lower[0], run.x), std::min(lower[1], run.y), std::min(lower[2], run.z) };
      upper = { std::max(upper[0], run.end - 1), std::max(upper[1], run.y), std::max(upper[2], run.z) };
    }
    for (std::size_t a = 0; a < 3; ++a)
    {
      target.lower[a] = std::min(target.lower[a], lower[a]);
      target.upper[a] = std::max(target.upper[a], upper[a]);
    }
    m_Bytes -= target.bytes;
    target.bytes = BoxBytes(target.lower, target.upper);
    m_Bytes += target.bytes;
    if (m_Bytes > limit)
    {
      Refuse(m_Scan.path,
             Text(m_Targets.size(),
                  " labels scattered over the scan would take more than ",
                  limit >> 30,
                  " GB as shapes: these look like grey values"),
             "give --threshold LO:HI, or choose some with --labels");
    }
    Piece piece;
    if (target.runs.size() * sizeof(Run) < BoxBytes(lower, upper))
    {
      piece.runs = std::vector<Run>(target.runs.begin(), target.runs.end()); // without spare capacity
    }
    else
    {
      piece.bits = VoxelShape(Box(lower, upper));
      for (const Run & run : target.runs)
      {
        FillRow(piece.bits.Row(run.y - lower[1], run.z - lower[2]), run.x - lower[0], run.end - lower[0]);
      }
    }
    target.pieces.push_back(std::move(piece));
    target.runs.clear();
    target.touched = false;
  }
  m_Touched.clear();
}

std::vector<LabelShape>
LabelCollector::TakeShapes()
{
  std::vector<LabelBook::Label> present;
  for (const Found & found : m_Found)
  {
    present.push_back(found.label);
  }
  const bool nothing = m_Threshold ? m_Targets[0].pieces.empty() : present.empty();
  if (nothing && m_Threshold)
  {
    Refuse(m_Scan.path, "no voxel lies within the threshold", "choose other bounds");
  }
  if (nothing)
  {
    Refuse(m_Scan.path, "nothing but background: every voxel is 0", "name a scan with labels");
  }
  std::sort(present.begin(), present.end(), [](const auto & a, const auto & b) { return a.value < b.value; });
  m_Book.RefuseMissing(m_Scan.path, present);

  std::sort(m_Targets.begin(), m_Targets.end(), [](const Target & a, const Target & b) {
    return a.label.value < b.label.value;
  });
  std::vector<LabelShape> shapes;
  for (Target & target : m_Targets)
  {
    std::vector<Run>().swap(target.runs);
    LabelShape label;
    label.value = target.label.value;
    label.name = target.label.name;
    label.shape = VoxelShape(Box(target.lower, target.upper));
    for (Piece & piece : target.pieces)
    {
      for (const Run & run : piece.runs)
      {
        FillRow(label.shape.Row(run.y - target.lower[1], run.z - target.lower[2]),
                run.x - target.lower[0],
                run.end - target.lower[0]);
      }
      if (piece.runs.empty())
      {
        AddShape(piece.bits, label.shape);
      }
      piece = Piece(); // its memory goes while the shape's comes
    }
    label.voxels = label.shape.CountVoxels();
    shapes.push_back(std::move(label));
    target = Target();
  }
  return shapes;
}

} // namespace voxelcore
