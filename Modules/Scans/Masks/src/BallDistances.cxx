#include "BallDistances.h"

#include "voxelcore/Shape/LowerEnvelope.h"
#include "NearestAlongZ.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/StagePlan.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace voxelcore
{

namespace
{

// Rows of a ball from which on distances are faster. Measured, both take as long at 700 rows on a gyroid of 256 x 256 x
// 256 voxels, at 800 in slices three times as thick, and at 1200 on the AAL atlas as one shape.
constexpr std::size_t kManyRows = 1000;

constexpr std::int32_t kNone = NearestAlongZ::none;
constexpr std::int32_t kBatch = 32; // slices that threads share

std::int64_t
Square(std::int64_t number)
{
  return number * number;
}

/** How far along an axis the ball reaches when so much of its squared radius is used; kNone when more is. */
std::int32_t
LeftOver(const LatticeBall & ball, std::int64_t used, std::size_t axis)
{
  return used <= ball.squaredRadius ? LatticeReach(ball.squaredRadius - used, ball.weight[axis]) : kNone;
}

/** Calls work(first, end) for a few slices at a time, and reports before. */
template <typename TWork>
void
ForBatches(std::int32_t slices, const ProgressCallback & progress, const TWork & work)
{
  for (std::int32_t first = 0; first < slices; first += kBatch)
  {
    ReportProgress(progress, "closing", static_cast<double>(first) / slices);
    work(first, std::min(slices, first + kBatch));
  }
}

/** Puts in the places x < count of a row, counted from a word on, of which isIn(x), which is asked in their order. */
template <typename TIsIn>
void
OrBits(const ShapeRow & row, std::size_t firstWord, std::size_t count, const TIsIn & isIn)
{
  for (std::size_t word = 0; 64 * word < count; ++word)
  {
    std::uint64_t bits = 0;
    for (std::size_t bit = 0; bit < std::min<std::size_t>(64, count - 64 * word); ++bit)
    {
      bits |= (isIn(64 * word + bit) ? std::uint64_t{ 1 } : 0) << bit;
    }
    row[firstWord + word] |= bits;
  }
}

/** Of a row, the places x - half[x] to x + half[x] for each x; half is kNone for none. Bit 0 is place -room; the
 *  room is whole words. */
void
SetIntervals(std::span<const std::int32_t> half, std::int32_t room, std::vector<std::int32_t> & steps, ShapeRow row)
{
  const auto   count = static_cast<std::int32_t>(half.size());
  std::int32_t lowest = count;
  std::int32_t highest = -1;
  steps.assign(half.size() + 1, 0);
  for (std::int32_t x = 0; x < count; ++x)
  {
    const std::int32_t reach = half[static_cast<std::size_t>(x)];
    if (reach != kNone)
    {
      lowest = std::min(lowest, x - reach);
      highest = std::max(highest, x + reach);
      ++steps[static_cast<std::size_t>(std::max(0, x - reach))];
      --steps[static_cast<std::size_t>(std::min(count, x + reach + 1))];
    }
  }
  if (highest < 0)
  {
    return;
  }
  // Beyond the voxels' own places what reaches farthest has all before it.
  if (lowest < 0)
  {
    SetRun(row, room + lowest, room, true);
  }
  if (highest >= count)
  {
    SetRun(row, room + count, room + highest + 1, true);
  }
  std::int32_t over = 0;
  OrBits(row, static_cast<std::size_t>(room) / 64, half.size(), [&](std::size_t x) { return (over += steps[x]) > 0; });
}

/** For each place of a row from bit `room` on, how far the nearest bit that is out is; kNone when more than `most`. */
void
DistancesToBackground(ConstShapeRow row, std::int32_t room, std::int32_t most, std::span<std::int32_t> distances)
{
  const auto count = static_cast<std::int32_t>(distances.size());
  const auto isIn = [&](std::int32_t place) {
    const auto bit = static_cast<std::size_t>(room + place);
    return (row[bit / 64] >> (bit % 64) & 1U) != 0;
  };
  std::int32_t far = 1;
  while (far <= most && isIn(-far))
  {
    ++far;
  }
  --far; // places in a row that are in
  std::uint64_t word = 0;
  for (std::int32_t x = 0; x < count; ++x)
  {
    word = (x & 63) == 0 ? row[static_cast<std::size_t>(room + x) / 64] : word >> 1U;
    far = (word & 1U) != 0 ? far + 1 : 0;
    distances[static_cast<std::size_t>(x)] = far;
  }
  far = 0;
  while (far < most && isIn(count + far))
  {
    ++far;
  }
  for (std::int32_t x = count; x-- > 0;)
  {
    std::int32_t & distance = distances[static_cast<std::size_t>(x)];
    far = distance > 0 ? far + 1 : 0;
    distance = std::min(distance, far);
    distance = distance <= most ? distance : kNone;
  }
}

/** How far along z balls about the places of a slice reach; what one thread needs for it. */
class SliceReach
{
public:
  SliceReach(const BallRows & ball, const VoxelBox & box)
    : m_Ball(ball)
    , m_Width(static_cast<std::size_t>(box.size[0]))
    , m_Rows(box.size[1])
    , m_AlongX(m_Width * static_cast<std::size_t>(box.size[1] + 2 * ball.reach[1]))
    , m_Least(ball.ball.weight[1], box.size[1])
  {}

  /** Of the background in a slice of what was dilated: at each column of the box, kNone where no ball gets to. */
  void
  OfBackground(const VoxelShape & dilated, std::int32_t slice, std::span<SliceNumber> reach)
  {
    const LatticeBall & ball = m_Ball.ball;
    const std::int32_t  rows = dilated.Box().size[1];
    for (std::int32_t y = 0; y < rows; ++y)
    {
      DistancesToBackground(dilated.Row(y, slice),
                            m_Ball.Room()[0],
                            m_Ball.reach[0],
                            std::span(m_AlongX).subspan(static_cast<std::size_t>(y) * m_Width, m_Width));
    }
    ranges::fill(reach, static_cast<SliceNumber>(kNone));
    for (std::size_t x = 0; x < m_Width; ++x)
    {
      m_Least.Clear();
      for (std::int32_t y = 0; y < rows; ++y)
      {
        const std::int32_t way = m_AlongX[static_cast<std::size_t>(y) * m_Width + x];
        if (way != kNone)
        {
          m_Least.Add(y - m_Ball.reach[1], Square(ball.weight[0] * way));
        }
      }
      m_Least.ForAll([&](std::int32_t y, std::int64_t squared) {
        reach[static_cast<std::size_t>(y) * m_Width + x] = static_cast<SliceNumber>(LeftOver(ball, squared, 2));
      });
    }
  }

private:
  const BallRows &          m_Ball;
  std::size_t               m_Width;
  std::int32_t              m_Rows;
  std::vector<std::int32_t> m_AlongX;
  LowerEnvelope             m_Least;
};

} // namespace

bool
DistancesAreFaster(const BallRows & ball, const VoxelBox & box)
{
  std::size_t rows = 0;
  for (const auto & some : ball.ofHalfLength)
  {
    rows += some.size();
  }
  // Squares of the longest way in the grown box, twice, must be 64-bit integers.
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double places = static_cast<double>(box.size[axis]) + 2.0 * ball.reach[axis];
    longest = std::max(longest, places * static_cast<double>(ball.ball.weight[axis]));
  }
  return rows > kManyRows && longest * longest < 0x1p60 && ball.reach[2] < std::numeric_limits<SliceNumber>::max();
}

void
DilateByDistances(const VoxelShape &       shape,
                  const BallRows &         ball,
                  VoxelShape &             dilated,
                  const ProgressCallback & progress)
{
  const auto &             size = shape.Box().size;
  const auto               width = static_cast<std::size_t>(size[0]);
  const std::size_t        area = width * static_cast<std::size_t>(size[1]);
  const auto               room = ball.Room();
  const std::int32_t       rows = dilated.Box().size[1];
  const auto &             weight = ball.ball.weight;
  NearestAlongZ            nearest(shape, -room[2]);
  std::vector<SliceNumber> ways(kBatch * area); // along z to the nearest voxel
  ForBatches(dilated.Box().size[2], progress, [&](std::int32_t first, std::int32_t end) {
    nearest.Next(end - first, ball.reach[2], ways);
#pragma omp parallel
    {
      std::vector<std::int32_t> half(width * static_cast<std::size_t>(rows)); // of the ball's rows along x
      std::vector<std::int32_t> steps;
      LowerEnvelope             least(weight[1], rows);
#pragma omp for schedule(dynamic, 1)
      for (std::int32_t slice = first; slice < end; ++slice)
      {
        ranges::fill(half, kNone);
        const SliceNumber * way = ways.data() + static_cast<std::size_t>(slice - first) * area;
        for (std::size_t x = 0; x < width; ++x)
        {
          least.Clear();
          for (std::int32_t y = 0; y < size[1]; ++y)
          {
            const SliceNumber along = way[static_cast<std::size_t>(y) * width + x];
            if (along != kNone)
            {
              least.Add(y + room[1], Square(weight[2] * along));
            }
          }
          least.ForAll([&](std::int32_t y, std::int64_t squared) {
            half[static_cast<std::size_t>(y) * width + x] = LeftOver(ball.ball, squared, 0);
          });
        }
        for (std::int32_t y = 0; y < rows; ++y)
        {
          SetIntervals(std::span<const std::int32_t>(half).subspan(static_cast<std::size_t>(y) * width, width),
                       room[0],
                       steps,
                       dilated.Row(y, slice));
        }
      }
    }
    dilated.Compact(first, end);
  });
}

void
ErodeByDistances(const VoxelShape &       dilated,
                 const BallRows &         ball,
                 VoxelShape &             shape,
                 const ProgressCallback & progress)
{
  const auto &              size = shape.Box().size;
  const auto                width = static_cast<std::size_t>(size[0]);
  const std::size_t         area = width * static_cast<std::size_t>(size[1]);
  const std::int32_t        room = ball.reach[2];
  VoxelShape                open(shape.Box()); // where a ball about background gets to
  std::vector<SliceNumber>  reach(kBatch * area);
  std::vector<std::int32_t> until(area);
  // Of the balls about background in the slices so far, that which reaches farthest: upwards, then downwards.
  const auto sweep = [&](std::int32_t start, std::int32_t direction, const ProgressCallback & part) {
    ranges::fill(until, std::numeric_limits<std::int32_t>::min());
    ForBatches(size[2] + room, part, [&](std::int32_t first, std::int32_t end) {
#pragma omp parallel
      {
        SliceReach one(ball, shape.Box());
#pragma omp for schedule(dynamic, 1)
        for (std::int32_t i = first; i < end; ++i)
        {
          one.OfBackground(dilated,
                           start + direction * i + room,
                           std::span(reach).subspan(static_cast<std::size_t>(i - first) * area, area));
        }
#pragma omp for schedule(static)
        for (std::int32_t y = 0; y < size[1]; ++y)
        {
          for (std::int32_t i = first; i < end; ++i)
          {
            const std::int32_t  z = start + direction * i;
            const std::size_t   row = static_cast<std::size_t>(y) * width;
            const SliceNumber * far = reach.data() + static_cast<std::size_t>(i - first) * area + row;
            for (std::size_t x = 0; x < width; ++x)
            {
              until[row + x] = far[x] == kNone ? until[row + x] : std::max(until[row + x], direction * z + far[x]);
            }
            if (z >= 0 && z < size[2])
            {
              OrBits(open.Row(y, z), 0, width, [&](std::size_t x) { return until[row + x] >= direction * z; });
            }
          }
        }
      }
    });
  };
  sweep(-room, 1, PartOfProgress(progress, 0, 0.5));
  sweep(size[2] - 1 + room, -1, PartOfProgress(progress, 0.5, 1));
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto target = shape.Row(y, z);
      const auto beside = std::as_const(open).Row(y, z);
      for (std::size_t word = 0; word < target.size(); ++word)
      {
        const std::size_t left = width - 64 * word;
        target[word] |= ~beside[word] & (left >= 64 ? ~std::uint64_t{ 0 } : (std::uint64_t{ 1 } << left) - 1);
      }
    }
  }
}

} // namespace voxelcore
