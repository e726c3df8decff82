#include "SlabReader.h"

#include "voxelcore/Base/SystemCalls.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

constexpr std::size_t   kSlabBytes = 1U << 20;
constexpr std::size_t   kShortRow = 4096;       // bytes: reading what is not needed costs less than passing over it
constexpr std::uint64_t kSkipBytes = 64U << 20; // between two looks whether to go on

template <std::size_t Width>
void
SwapValues(std::byte * bytes, std::size_t count)
{
  for (std::size_t at = 0; at + Width <= count; at += Width)
  {
    std::reverse(bytes + at, bytes + at + Width);
  }
}

} // namespace

void
SwapValues(std::byte * bytes, std::size_t count, PixelType type)
{
  switch (PixelBytes(type))
  {
    case 2:
      return SwapValues<2>(bytes, count);
    case 4:
      return SwapValues<4>(bytes, count);
    case 8:
      return SwapValues<8>(bytes, count);
    default:
      return;
  }
}

SlabReader::SlabReader(ScanFile & scan, const CropRange & part)
  : m_Scan(scan)
  , m_SizeY(static_cast<std::uint64_t>(scan.geometry.size[1]))
  , m_Rows(m_SizeY * static_cast<std::uint64_t>(scan.geometry.size[2]))
  , m_FirstY(static_cast<std::uint64_t>(part.first[1]))
  , m_EndY(static_cast<std::uint64_t>(part.end[1]))
  , m_EndZ(static_cast<std::uint64_t>(part.end[2]))
  , m_PartRows((m_EndY - m_FirstY) * (m_EndZ - static_cast<std::uint64_t>(part.first[2])))
  , m_RowBytes(static_cast<std::size_t>(scan.geometry.size[0]) * scan.interleaved * PixelBytes(scan.type))
  , m_PartStart(static_cast<std::size_t>(part.first[0]) * scan.interleaved * PixelBytes(scan.type))
  , m_PartBytes(static_cast<std::size_t>(part.end[0] - part.first[0]) * scan.interleaved * PixelBytes(scan.type))
  , m_Next(static_cast<std::uint64_t>(part.first[2]) * m_SizeY + m_FirstY)
{
  if (m_PartRows > kSlabBytes / m_RowBytes && CanStartThreads())
  {
    m_Thread = std::thread(&SlabReader::Run, this);
  }
}

SlabReader::~SlabReader()
{
  if (m_Thread.joinable())
  {
    {
      const std::lock_guard lock(m_Mutex);
      m_Stop = true;
    }
    m_Changed.notify_all();
    m_Thread.join();
  }
}

const Slab *
SlabReader::Next()
{
  const auto give = [this](const Slab & slab) {
    for (const RowSpan & span : slab.spans)
    {
      m_Given += span.rowCount;
    }
    return &slab;
  };
  if (!m_Thread.joinable())
  {
    return Fill(m_Slabs[0]) ? give(m_Slabs[0]) : nullptr;
  }
  std::unique_lock lock(m_Mutex);
  // The slab given out last is free from now on.
  m_Taken += m_Given > 0 ? 1 : 0;
  m_Changed.notify_all();
  m_Changed.wait(lock, [this] { return m_Filled > m_Taken || m_Ended; });
  if (m_Filled > m_Taken)
  {
    return give(m_Slabs[m_Taken % kSlabs]);
  }
  if (m_Error)
  {
    std::rethrow_exception(m_Error);
  }
  return nullptr;
}

void
SlabReader::Run()
{
  try
  {
    for (;;)
    {
      Slab * slab = nullptr;
      {
        std::unique_lock lock(m_Mutex);
        m_Changed.wait(lock, [this] { return m_Stop || m_Filled - m_Taken < kSlabs; });
        if (m_Stop)
        {
          return;
        }
        slab = &m_Slabs[m_Filled % kSlabs];
      }
      const bool            more = Fill(*slab);
      const std::lock_guard lock(m_Mutex);
      m_Filled += more ? 1 : 0;
      m_Ended = !more;
      m_Changed.notify_all();
      if (!more)
      {
        return;
      }
    }
  }
  catch (...)
  {
    const std::lock_guard lock(m_Mutex);
    m_Error = std::current_exception();
    m_Ended = true;
    m_Changed.notify_all();
  }
}

bool
SlabReader::Fill(Slab & slab)
{
  slab.used = 0;
  slab.spans.clear();
  const bool    wholePlanes = m_FirstY == 0 && m_EndY == m_SizeY;
  std::uint64_t left = std::max<std::size_t>(1, kSlabBytes / m_RowBytes);
  while (left > 0 && m_Next < m_EndZ * m_SizeY)
  {
    if (!SkipTo(m_Next, [this] { return !IsStopped(); }))
    {
      return false;
    }
    const std::uint64_t z = m_Next / m_SizeY;
    const std::uint64_t end = wholePlanes ? m_EndZ * m_SizeY : z * m_SizeY + m_EndY;
    const auto          count = static_cast<std::size_t>(std::min(left, end - m_Next));
    ReadRows(slab, count);
    slab.spans.push_back({ m_Next, count });
    left -= count;
    m_Next += count;
    if (m_Next == end && !wholePlanes)
    {
      m_Next = (z + 1) * m_SizeY + m_FirstY;
    }
  }
  return !slab.spans.empty();
}

void
SlabReader::ReadRows(Slab & slab, std::size_t count)
{
  // It grows as bytes come: a row may be long, and a header may lie.
  constexpr std::size_t step = 16U << 20;
  const std::size_t     first = slab.used;
  const std::size_t     end = first + count * m_RowBytes;
  if (m_PartBytes < m_RowBytes / 4 && m_RowBytes > kShortRow)
  {
    ReadPartOfRows(slab, count);
  }
  while (slab.used < end)
  {
    const std::size_t now = std::min(step, end - slab.used);
    slab.bytes.resize(std::max(slab.bytes.size(), slab.used + now));
    m_Scan.voxels->Read(slab.bytes.data() + slab.used, now);
    slab.used += now;
  }
  if (m_Scan.swapBytes)
  {
    SwapValues(slab.bytes.data() + first, end - first, m_Scan.type);
  }
  m_At += count;
}

void
SlabReader::ReadPartOfRows(Slab & slab, std::size_t count)
{
  slab.bytes.resize(std::max(slab.bytes.size(), slab.used + count * m_RowBytes));
  for (std::size_t row = 0; row < count; ++row) // all at a time, so that a disk need not be waited for row by row
  {
    m_Scan.voxels->Announce(row * m_RowBytes + m_PartStart, m_PartBytes);
  }
  for (std::size_t row = 0; row < count; ++row, slab.used += m_RowBytes)
  {
    m_Scan.voxels->Skip(m_PartStart);
    m_Scan.voxels->Read(slab.bytes.data() + slab.used + m_PartStart, m_PartBytes);
    m_Scan.voxels->Skip(m_RowBytes - m_PartStart - m_PartBytes);
  }
}

template <typename GoOn>
bool
SlabReader::SkipTo(std::uint64_t row, const GoOn & goOn)
{
  const std::uint64_t step = std::max<std::uint64_t>(1, kSkipBytes / m_RowBytes);
  while (m_At < row && goOn())
  {
    const std::uint64_t now = std::min(step, row - m_At);
    m_Scan.voxels->Skip(now * m_RowBytes);
    m_At += now;
  }
  return m_At >= row;
}

bool
SlabReader::IsStopped()
{
  const std::lock_guard lock(m_Mutex);
  return m_Stop;
}

void
SlabReader::Finish(const ProgressCallback & progress)
{
  if (m_Thread.joinable())
  {
    m_Thread.join();
  }
  SkipTo(m_Rows, [&] {
    ReportProgress(progress, "read", 1.0);
    return true;
  });
}

} // namespace voxelcore
