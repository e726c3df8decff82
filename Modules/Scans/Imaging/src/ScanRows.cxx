#include "voxelcore/Imaging/ScanRows.h"

#include "OpenScan.h"
#include "SlabReader.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Labels/LabelNaming.h"
#include "voxelcore/Labels/ScaledValue.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <utility>

namespace voxelcore
{
namespace
{

constexpr std::size_t kBlockBytes = 1U << 20;

} // namespace

struct ScanRows::State
{
  State(const std::filesystem::path & name, const ReadOptions & how)
    : path(name)
    , options(how)
    , scan(OpenScan(path, options))
    , naming(scan, {})
    , rowBytes(static_cast<std::size_t>(scan.geometry.size[0]) * scan.interleaved * PixelBytes(scan.type))
    , sizeY(static_cast<std::uint64_t>(scan.geometry.size[1]))
  {
    for (const Segment & segment : scan.segments)
    {
      numbers[{ segment.layer, segment.value }] = naming.Identify(segment.layer, segment.value).value;
    }
  }

  PixelType
  Type() const
  {
    return scan.HasLayers() ? PixelType::Int64 : scan.IsScaled() ? PixelType::Float64 : scan.type;
  }

  /** Rows as they are stored. */
  void
  ReadStored(std::uint64_t firstRow, std::size_t rowCount, std::byte * to)
  {
    if (firstRow < at || !scan.voxels)
    {
      scan = OpenScan(path, options);
      at = 0;
    }
    scan.voxels->Skip((firstRow - at) * rowBytes);
    scan.voxels->Read(to, rowCount * rowBytes);
    at = firstRow + rowCount;
    if (scan.swapBytes)
    {
      SwapValues(to, rowCount * rowBytes, scan.type);
    }
    if (at == sizeY * static_cast<std::uint64_t>(scan.geometry.size[2]))
    {
      if (!scan.moreVolumes)
      {
        scan.voxels->Finish();
      }
      scan.voxels.reset(); // closes the file
    }
  }

  [[noreturn]] void
  RefuseVoxel(const std::string & what, std::int64_t x, std::uint64_t row, const std::string & remedy) const
  {
    RefuseInput(path, Text(what, " at voxel (", x, ",", row % sizeY, ",", row / sizeY, ")"), remedy);
  }

  /** The number of the label that a value of a layer stands for. It must not depend on the order of reading. */
  std::int64_t
  NumberOf(std::size_t layer, double value, std::int64_t x, std::uint64_t row)
  {
    const std::string what = Text("value ", Number(value), " of layer ", layer);
    if (!(value > 0) || value != std::floor(value) || value > 9007199254740992.0) // 2^53
    {
      RefuseVoxel(what + ", which is no label,", x, row, "labels are whole numbers from 0 up");
    }
    const auto [place, isNew] = numbers.try_emplace({ layer, static_cast<std::int64_t>(value) }, 0);
    if (isNew)
    {
      place->second = naming.Identify(layer, place->first.second).value;
      if (place->second != place->first.second)
      {
        RefuseVoxel(what + ", a number another segment has,",
                    x,
                    row,
                    "name its segment in 3D Slicer, or read the file with voxelcore::ReadLabelVolume");
      }
    }
    return place->second;
  }

  /** One row of layers as the numbers of their labels. */
  void
  MergeLayers(const std::byte * stored, std::uint64_t row, std::byte * merged)
  {
    const std::size_t bytes = PixelBytes(scan.type);
    for (std::int64_t x = 0; x < scan.geometry.size[0]; ++x, merged += sizeof(std::int64_t))
    {
      std::int64_t number = 0;
      for (std::size_t layer = 0; layer < scan.interleaved; ++layer, stored += bytes)
      {
        const double value = StoredValue(stored, scan.type);
        if (value != 0 && number != 0)
        {
          RefuseVoxel("two segments overlap",
                      x,
                      row,
                      "an image holds one value a voxel; read the file with voxelcore::ReadLabelVolume");
        }
        number = value != 0 ? NumberOf(layer, value, x, row) : number;
      }
      std::memcpy(merged, &number, sizeof number);
    }
  }

  /** One row as values of Type(). */
  const std::byte *
  Delivered(const std::byte * stored, std::uint64_t row)
  {
    if (scan.interleaved == 1 && !scan.IsScaled())
    {
      return stored;
    }
    const auto        sizeX = static_cast<std::size_t>(scan.geometry.size[0]);
    const std::size_t bytes = PixelBytes(scan.type);
    delivered.resize(sizeX * PixelBytes(Type()));
    if (scan.HasLayers())
    {
      MergeLayers(stored, row, delivered.data());
      return delivered.data();
    }
    stored += static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, scan.component)) * bytes;
    for (std::size_t x = 0; x < sizeX; ++x, stored += scan.interleaved * bytes)
    {
      if (scan.IsScaled())
      {
        const double value = ScaledValue(scan, StoredValue(stored, scan.type));
        std::memcpy(delivered.data() + x * sizeof value, &value, sizeof value);
      }
      else
      {
        std::memcpy(delivered.data() + x * bytes, stored, bytes);
      }
    }
    return delivered.data();
  }

  std::filesystem::path  path;
  ReadOptions            options;
  ScanFile               scan;
  LabelNaming            naming;
  std::size_t            rowBytes; ///< as stored
  std::uint64_t          sizeY;
  std::uint64_t          at = 0; ///< the row where the stream stands
  std::vector<std::byte> delivered;

  std::map<std::pair<std::size_t, std::int64_t>, std::int64_t> numbers; ///< of labels, by layer and value
};

bool
IsScanFormat(const std::filesystem::path & path)
{
  const ScanKind kind = ScanKindOf(path);
  return kind != ScanKind::Unknown && kind != ScanKind::Picture; // programs read pictures by other means
}

ScanRows::ScanRows(const std::filesystem::path & path, const ReadOptions & options)
  : m_State(std::make_unique<State>(path, options))
{}

ScanRows::~ScanRows() = default;

const ImageGeometry &
ScanRows::Geometry() const
{
  return m_State->scan.geometry;
}

PixelType
ScanRows::Type() const
{
  return m_State->Type();
}

std::vector<Segment>
ScanRows::Segments() const
{
  std::vector<Segment> segments = m_State->scan.segments;
  for (Segment & segment : segments)
  {
    if (m_State->scan.HasLayers())
    {
      segment.value = m_State->numbers.at({ segment.layer, segment.value });
    }
    segment.layer = 0;
  }
  return segments;
}

const std::vector<std::string> &
ScanRows::Notes() const
{
  return m_State->scan.notes;
}

std::vector<std::string>
ScanRows::Warnings() const
{
  return WarningsOf(m_State->scan);
}

void
ScanRows::Read(std::uint64_t firstRow, std::uint64_t rowCount, const RowFunction & take)
{
  const std::uint64_t    step = std::max<std::size_t>(1, kBlockBytes / m_State->rowBytes);
  std::vector<std::byte> stored;
  for (std::uint64_t row = firstRow; row < firstRow + rowCount;)
  {
    const auto count = static_cast<std::size_t>(std::min(step, firstRow + rowCount - row));
    stored.resize(count * m_State->rowBytes);
    m_State->ReadStored(row, count, stored.data());
    for (std::size_t n = 0; n < count; ++n, ++row)
    {
      take(m_State->Delivered(stored.data() + n * m_State->rowBytes, row), row);
    }
  }
}

} // namespace voxelcore
