#include "SurfaceFire.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

// In sample distances: so little of a block that fire has come through burns again, as fire comes over its border, and
// so rarely threads wait for each other.
constexpr double kWindow = 6;

} // namespace

SurfaceFire::SurfaceFire(const MedialComplex & complex, double sampling)
  : m_Complex(complex)
  , m_Cells(complex.cells)
  , m_Network(complex, sampling)
  , m_Window(kWindow * sampling)
  , m_Times(make_unique_for_overwrite<double[]>(m_Network.SectorCount()))
{
  const std::size_t sectors = m_Network.SectorCount();
  RunInParts(sectors > 10000, sectors, [&](std::size_t first, std::size_t last) {
    std::fill(m_Times.get() + first, m_Times.get() + last, kNever);
  });
  CutBlocks();
  FindFaces();
}

void
SurfaceFire::Ignite()
{
  RunEach(m_Blocks.size(), [&](std::size_t i) { Ignite(m_Blocks[i]); });
  m_Network.EndIgnition();
}

void
SurfaceFire::Ignite(Block & block)
{
  const auto ignite = [&](std::uint32_t sector, std::uint32_t point, double radius) {
    SetTime(sector, radius);
    block.waiting.push_back(point);
    block.next = std::min(block.next, radius);
  };
  for (std::uint32_t vertex = block.firstVertex; vertex < block.lastVertex; ++vertex)
  {
    const SectorRange range = m_Network.Sectors(vertex);
    for (std::uint32_t sector = range.first; sector < range.first + range.count; ++sector)
    {
      if (m_Network.openSector[sector])
      {
        ignite(sector, vertex, m_Complex.radius[vertex]);
      }
    }
  }
  for (ElementIndex edge = block.firstEdge; edge < block.lastEdge; ++edge)
  {
    if (m_Network.EdgeFaceCount(edge) == 1)
    {
      for (std::uint32_t i = 0; i < m_Network.SampleCount(edge); ++i)
      {
        ignite(m_Network.edgeFirst[edge].sector + i,
               m_Network.edgeFirst[edge].point + i,
               m_Network.SampleRadius(edge, i));
      }
    }
  }
  block.waiting.shrink_to_fit();
}

BurnTimes
SurfaceFire::Run(const ProgressCallback & progress)
{
  Ignite();
  if (!(m_Window > 0))
  {
    m_Window = kNever;
  }
  std::vector<std::size_t> active(m_Blocks.size());
  std::iota(active.begin(), active.end(), std::size_t{ 0 });
  const auto points = static_cast<double>(std::max<std::size_t>(1, m_Network.PointCount()));
  double     start = 0;
  double     end = 0;
  // NOLINTNEXTLINE(clang-analyzer-security.FloatLoopCounter,cert-flp30-c): a time, not a count
  for (double next = HandOver(active); next < kNever; next = HandOver(active))
  {
    if (next >= end)
    {
      std::uint64_t burned = 0;
      for (const Block & block : m_Blocks)
      {
        burned += block.burned;
      }
      ReportProgress(progress, "burning", std::min(1.0, static_cast<double>(burned) / points));
      start = next;
      end = std::max(next + m_Window, std::nextafter(next, kNever)); // what is next burns, however far it is off
    }
    active.clear();
    for (std::size_t i = 0; i < m_Blocks.size(); ++i)
    {
      if (m_Blocks[i].next < end)
      {
        active.push_back(i);
      }
    }
    const auto burn = [&](std::size_t i) { BurnBlock(m_Blocks[active[i]], start, end); };
    if (active.size() == 1)
    {
      burn(0);
    }
    else
    {
      RunEach(active.size(), burn);
    }
  }
  std::vector<Block>().swap(m_Blocks);
  std::vector<Entries>().swap(m_Entries);
  m_EntryPlaces = EntryPlaces();
  std::vector<std::uint16_t>().swap(m_Small);
  m_Network.EndFire();
  return Times();
}

double
SurfaceFire::HandOver(const std::vector<std::size_t> & from)
{
  for (const std::size_t i : from)
  {
    for (const Arrival & arrival : m_Blocks[i].out)
    {
      const double before = Time(arrival.sector);
      if (arrival.time < std::abs(before))
      {
        Block & to = m_Blocks[OwnerOf(arrival.point)];
        SetTime(arrival.sector, arrival.time);
        to.next = std::min(to.next, arrival.time);
        if (HasSpread(before) || before == kNever) // else it is in line
        {
          to.waiting.push_back(arrival.point);
        }
      }
    }
    std::vector<Arrival>().swap(m_Blocks[i].out);
  }
  double next = kNever;
  for (const Block & block : m_Blocks)
  {
    next = std::min(next, block.next);
  }
  return next;
}

void
SurfaceFire::BurnBlock(Block & block, double start, double end)
{
  thread_local Queue queue;
  queue.start = start;
  queue.end = end;
  queue.perTime = static_cast<double>(Queue::most) / (end - start);
  queue.present = 0;
  for (auto & bucket : queue.buckets)
  {
    bucket.clear(); // what a run left that was cut short
  }
  block.next = kNever;

  std::size_t kept = 0;
  for (const std::uint32_t point : block.waiting)
  {
    const double due = Due(point);
    if (due < end)
    {
      queue.buckets[queue.BucketOf(due)].push_back(point);
    }
    else if (due < kNever)
    {
      block.waiting[kept++] = point;
      block.next = std::min(block.next, due);
    }
  }
  block.waiting.resize(kept);
  for (; queue.present < Queue::most; ++queue.present)
  {
    std::vector<std::uint32_t> & bucket = queue.buckets[queue.present];
    while (!bucket.empty())
    {
      const std::uint32_t point = bucket.back();
      bucket.pop_back();
      BurnPoint(block, queue, point);
    }
  }
  KeepFirst(block.out);
}

void
SurfaceFire::KeepFirst(std::vector<Arrival> & out)
{
  std::sort(out.begin(), out.end(), [](const Arrival & a, const Arrival & b) {
    return a.sector != b.sector ? a.sector < b.sector : a.time < b.time;
  });
  const auto isSame = [](const Arrival & a, const Arrival & b) { return a.sector == b.sector; };
  out.erase(std::unique(out.begin(), out.end(), isSame), out.end());
  out.shrink_to_fit();
}

void
SurfaceFire::Send(Block & block, Queue & queue, const Arrival & arrival)
{
  std::uint32_t & place = queue.sent[arrival.sector % Queue::mostSent];
  if (place < block.out.size() && block.out[place].sector == arrival.sector)
  {
    block.out[place].time = std::min(block.out[place].time, arrival.time);
    return;
  }
  place = static_cast<std::uint32_t>(block.out.size());
  block.out.push_back(arrival);
}

double
SurfaceFire::Due(std::uint32_t point) const
{
  const SectorRange range = m_Network.Sectors(point);
  double            due = kNever;
  for (std::uint32_t i = 0; i < range.count; ++i)
  {
    const double time = Time(range.first + i * range.stride);
    due = !HasSpread(time) && time < due ? time : due;
  }
  return due;
}

void
SurfaceFire::Line(Block & block, Queue & queue, std::uint32_t point, double time)
{
  if (time >= queue.end)
  {
    block.next = std::min(block.next, time);
    block.waiting.push_back(point);
  }
  else
  {
    queue.buckets[std::max(queue.BucketOf(time), queue.present)].push_back(point);
  }
}

void
SurfaceFire::Arrive(Block & block, Queue & queue, const Arrival & arrival, double before)
{
  SetTime(arrival.sector, arrival.time);
  const bool waits = !HasSpread(before) && before < kNever;
  if (arrival.time >= queue.end && waits)
  {
    block.next = std::min(block.next, arrival.time); // it is in line
  }
  else if (!waits || before >= queue.end || arrival.time >= queue.end ||
           queue.BucketOf(before) != std::max(queue.BucketOf(arrival.time), queue.present))
  {
    Line(block, queue, arrival.point, arrival.time);
  }
}

void
SurfaceFire::BurnPoint(Block & block, Queue & queue, std::uint32_t point)
{
  const SectorRange range = m_Network.Sectors(point);
  queue.fresh.clear();
  for (std::uint32_t i = 0; i < range.count; ++i)
  {
    const std::uint32_t sector = range.first + i * range.stride;
    const double        time = Time(sector);
    if (!HasSpread(time) && time < queue.end && queue.BucketOf(time) <= queue.present)
    {
      SetTime(sector, -time);
      queue.fresh.push_back(sector);
    }
  }
  if (queue.fresh.empty())
  {
    return; // an earlier arrival has burned it
  }
  ++block.burned;
  while (range.count > 1 && BurnFreed(queue, point, range))
  {}
  Spread(block, queue, point, range);
  // The point was in line once for all of its sectors, perhaps.
  for (std::uint32_t i = 0; range.count > 1 && i < range.count; ++i)
  {
    const double time = Time(range.first + i * range.stride);
    if (!HasSpread(time) && time < kNever)
    {
      Line(block, queue, point, time);
    }
  }
}

template <typename TSectorAt>
bool
SurfaceFire::BurnLast(Queue & queue, std::uint32_t count, TSectorAt sectorAt)
{
  std::uint32_t last = 0;
  double        lastTime = -1;
  double        time = -1; // of the one before
  std::uint32_t ahead = 0; // have not spread
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t sector = sectorAt(i);
    const double        noted = Time(sector);
    const double        own = std::abs(noted);
    ahead += HasSpread(noted) ? 0 : 1;
    time = own > lastTime ? lastTime : std::max(time, own);
    last = own > lastTime ? sector : last;
    lastTime = std::max(lastTime, own);
  }
  if (ahead > (HasSpread(Time(last)) ? 0U : 1U) || time < 0 || !(time < lastTime))
  {
    return false;
  }
  SetTime(last, -time);
  if (std::find(queue.fresh.begin(), queue.fresh.end(), last) == queue.fresh.end())
  {
    queue.fresh.push_back(last);
  }
  return true;
}

bool
SurfaceFire::BurnFreed(Queue & queue, std::uint32_t point, const SectorRange & range)
{
  if (point >= m_Cells.vertexCount)
  {
    return BurnLast(queue, range.count, [&](std::uint32_t i) { return range.first + i * range.stride; });
  }
  const BurnNetwork::SeamEnd * ends = m_Network.seamEnds.data();
  const std::uint32_t          all = m_Network.seamEndOffsets[point + std::size_t{ 1 }];
  bool                         isNews = false;
  for (std::uint32_t first = m_Network.seamEndOffsets[point]; first < all;)
  {
    std::uint32_t next = first + 1;
    while ((ends[next - 1] & BurnNetwork::kLastAtSeam) == 0)
    {
      ++next;
    }
    isNews |= BurnLast(queue, next - first, [&](std::uint32_t i) {
      return range.first + (ends[first + i] & ~BurnNetwork::kLastAtSeam);
    });
    first = next;
  }
  return isNews;
}

} // namespace voxelcore
