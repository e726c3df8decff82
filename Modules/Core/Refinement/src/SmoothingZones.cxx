#include "SmoothingZones.h"

#include "DistanceTile.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr std::int32_t kSide = BrickGrid::kSide;
constexpr std::size_t  kCells = BrickGrid::kCells;
constexpr std::int32_t kMargin = 12; ///< cells
constexpr std::int32_t kNear = 5;    ///< cells: as far as anything is left out around a mark
using FlagRows = tile::Rows<kSide, kMargin>;
using NearRows = tile::Rows<kSide, kNear>;

VOXELCORE_EIGHT_LANES void
FindDistances(const FlagRows & rows, const std::array<float, 3> & squares, tile::Squared<kSide> & least)
{
  tile::FindSquaredDistances(rows, squares, least);
}

VOXELCORE_EIGHT_LANES void
FindDistances(const NearRows & rows, const std::array<float, 3> & squares, tile::Squared<kSide> & least)
{
  tile::FindSquaredDistances(rows, squares, least);
}

// 1 up to `from`, 0 from `to` on.
double
Ramp(double value, double from, double to)
{
  return std::clamp((to - value) / (to - from), 0.0, 1.0);
}

// Flags of the cells around a brick; `farInside` and `farOutside` where there is no brick. False when none is set.
template <std::int32_t Margin>
bool
GatherFlags(const BrickGrid &                     grid,
            const std::vector<BrickGrid::Flags> & flags,
            bool                                  farInside,
            bool                                  farOutside,
            std::size_t                           brick,
            tile::Rows<kSide, Margin> &           rows)
{
  constexpr std::int32_t beyond = (Margin + kSide - 1) / kSide;
  constexpr std::int32_t bricks = 2 * beyond + 1;
  constexpr std::int32_t skipped = beyond * kSide - Margin; // cells of the outermost bricks
  std::uint64_t          any = 0;
  rows.bits.fill(0);
  for (std::int32_t n = 0; n < bricks * bricks * bricks; ++n)
  {
    const std::array<std::int32_t, 3> place{ n % bricks, n / bricks % bricks, n / bricks / bricks };
    // By way of a neighbour: beyond one that has no brick, what can be nearer than it is of its kind.
    auto found = static_cast<std::int32_t>(brick);
    for (BrickGrid::Brick left{ place[0] - beyond, place[1] - beyond, place[2] - beyond };
         found >= 0 && left != BrickGrid::Brick{ 0, 0, 0 };)
    {
      std::size_t neighbour = BrickGrid::kSelf;
      for (std::size_t axis = 0, stride = 1; axis < 3; ++axis, stride *= 3)
      {
        neighbour += left[axis] > 0 ? stride : left[axis] < 0 ? -stride : 0;
        left[axis] -= std::clamp(left[axis], -1, 1);
      }
      found = grid.Neighbours(static_cast<std::size_t>(found))[neighbour];
    }
    const std::uint64_t all = (found == BrickGrid::kInside ? farInside : farOutside) ? 0xFF : 0;
    if (found < 0 ? all == 0 : flags[static_cast<std::size_t>(found)] == BrickGrid::Flags{})
    {
      continue;
    }
    for (std::int32_t row = 0; row < 64; ++row)
    {
      const std::int32_t     y = place[1] * kSide + (row & 7) - skipped;
      const std::int32_t     z = place[2] * kSide + (row >> 3) - skipped;
      constexpr std::int32_t side = tile::Rows<kSide, Margin>::kSide;
      if (y < 0 || y >= side || z < 0 || z >= side)
      {
        continue;
      }
      const std::uint64_t bits =
        found < 0 ? all : flags[static_cast<std::size_t>(found)][static_cast<std::size_t>(row)];
      const std::int32_t x = place[0] * kSide - skipped;
      any |= bits;
      rows.bits[static_cast<std::size_t>(z * side + y)] |= x < 0 ? bits >> -x : bits << x;
    }
  }
  return any != 0;
}

} // namespace

// A ball that touches the boundary nearest to a voxel has its centre farther from it by the voxel's own distance, or
// nearer by it on its own side.
SmoothingZones::SmoothingZones(const BoundaryDepth & depth, double radius, std::size_t which)
  : SmoothingZones(depth, radius, which, 2)
{}

SmoothingZones::SmoothingZones(const BoundaryDepth & depth, double radius, std::size_t which, double most)
  : m_Depth(&depth)
  , m_Parts(depth.Grid().Count() * kCells, 0)
{
  constexpr double  inCell = 1; // how much nearer a cell may seem than the voxel in it
  constexpr double  other = 3;  // what is farther from the boundary is asked on its own side alone
  const BrickGrid & grid = depth.Grid();
  const auto &      centres = depth.CentresOf(which);
  const auto &      in = centres.inside; // clang takes no structured bindings into parallel regions
  const auto &      out = centres.outside;
  if (std::all_of(in.begin(), in.end(), [](const BrickGrid::Flags & flags) { return flags == BrickGrid::Flags{}; }))
  {
    return;
  }
  const auto squares = tile::AsFloats(depth.Squares());
  const auto count = static_cast<std::ptrdiff_t>(grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto           brick = static_cast<std::size_t>(i);
    FlagRows             rows;
    tile::Squared<kSide> toIn;
    tile::Squared<kSide> toOut;
    const float * const  means = depth.Means(brick);
    if (means == nullptr || !GatherFlags(grid, in, true, false, brick, rows))
    {
      continue; // outside something else is always far enough
    }
    FindDistances(rows, squares, toIn);
    GatherFlags(grid, out, false, true, brick, rows);
    FindDistances(rows, squares, toOut);
    for (std::size_t cell = 0; cell < kCells; ++cell)
    {
      const double distance = means[cell];
      double       gap = 0;
      if (distance > -other)
      {
        gap = std::max(gap, std::sqrt(static_cast<double>(toIn[cell])) + inCell - (radius - distance));
      }
      if (distance < other)
      {
        gap = std::max(gap, std::sqrt(static_cast<double>(toOut[cell])) + inCell - (radius + distance));
      }
      m_Parts[brick * kCells + cell] = static_cast<std::uint8_t>(std::lround(255 * Ramp(gap, most - 1, most)));
    }
  }
}

bool
SmoothingZones::Any() const
{
  return std::any_of(m_Parts.begin(), m_Parts.end(), [](std::uint8_t part) { return part != 0; });
}

void
SmoothingZones::Mark(std::int32_t x, std::int32_t y, std::int32_t z)
{
  const BrickGrid & grid = m_Depth->Grid();
  m_Marks.resize(grid.Count(), BrickGrid::Flags{});
  const std::int32_t brick = grid.Find({ x >> 4, y >> 4, z >> 4 });
  m_Marks[static_cast<std::size_t>(brick)][static_cast<std::size_t>((y >> 1 & 7) + 8 * (z >> 1 & 7))] |=
    static_cast<std::uint8_t>(1U << (x >> 1 & 7));
}

void
SmoothingZones::LeaveOutAroundMarks(double near)
{
  if (m_Marks.empty())
  {
    return;
  }
  const BrickGrid & grid = m_Depth->Grid();
  const auto        squares = tile::AsFloats(m_Depth->Squares());
  const auto        most = static_cast<float>((near + 2) * (near + 2)); // beyond it all stays
  const auto        count = static_cast<std::ptrdiff_t>(grid.Count());
#pragma omp parallel for schedule(dynamic, 16) if (count > BrickGrid::kMany)
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const auto           brick = static_cast<std::size_t>(i);
    NearRows             rows;
    tile::Squared<kSide> toMark;
    if (!GatherFlags(grid, m_Marks, false, false, brick, rows))
    {
      continue;
    }
    FindDistances(rows, squares, toMark);
    for (std::size_t cell = 0; cell < kCells; ++cell)
    {
      std::uint8_t & part = m_Parts[brick * kCells + cell];
      if (part == 0 || toMark[cell] >= most)
      {
        continue;
      }
      part = static_cast<std::uint8_t>(
        std::lround(part * (1 - Ramp(std::sqrt(static_cast<double>(toMark[cell])), near, near + 2))));
    }
  }
  m_Marks.clear();
}

void
SmoothingZones::TakeAway(const SmoothingZones & other)
{
  std::transform(m_Parts.begin(), m_Parts.end(), other.m_Parts.begin(), m_Parts.begin(), [](auto own, auto taken) {
    return static_cast<std::uint8_t>(own - std::min(own, taken));
  });
}

const std::uint8_t *
SmoothingZones::PartsOf(int level, const BrickGrid::Brick & brick) const
{
  if (level == 1)
  {
    return m_Parts.data() + static_cast<std::size_t>(m_Depth->Grid().Find(brick)) * kCells;
  }
  const auto found = static_cast<std::size_t>(m_Depth->Grid().Find({ brick[0] >> 1, brick[1] >> 1, brick[2] >> 1 }));
  const auto first = ((brick[2] & 1) * kSide + (brick[1] & 1)) * kSide + (brick[0] & 1);
  return m_Parts.data() + found * kCells + static_cast<std::size_t>(kSide / 2 * first);
}

void
SmoothingZones::Fill(int level, const BrickGrid::Brick & brick, std::array<float, BrickGrid::kCells> & parts) const
{
  const std::uint8_t * const own = PartsOf(level, brick);
  if (level == 1)
  {
    for (std::size_t i = 0; i < kCells; ++i)
    {
      parts[i] = static_cast<float>(own[i]) / 255;
    }
    return;
  }
  // Two along each axis are of the same cell.
  for (std::size_t row = 0; row < 16; ++row)
  {
    const std::size_t y = row & 3;
    const std::size_t z = row >> 2;
    float * const     first = parts.data() + 2 * kSide * (y + kSide * z);
    for (std::size_t x = 0; x < 4; ++x)
    {
      first[2 * x] = first[2 * x + 1] = static_cast<float>(own[x + kSide * (y + kSide * z)]) / 255;
    }
    for (const std::int32_t other : { kSide, kSide * kSide, kSide * kSide + kSide })
    {
      std::copy_n(first, kSide, first + other);
    }
  }
}

template <typename TTest>
bool
SmoothingZones::AnyPart(int level, const BrickGrid::Brick & brick, TTest test) const
{
  const std::uint8_t * const own = PartsOf(level, brick);
  if (level == 1)
  {
    return std::any_of(own, own + kCells, test);
  }
  bool any = false;
  for (std::size_t row = 0; row < 16; ++row)
  {
    const std::uint8_t * const four = own + kSide * (row & 3) + kSide * kSide * (row >> 2);
    any = any || test(four[0]) || test(four[1]) || test(four[2]) || test(four[3]);
  }
  return any;
}

bool
SmoothingZones::AnyIn(int level, const BrickGrid::Brick & brick) const
{
  return AnyPart(level, brick, [](std::uint8_t part) { return part != 0; });
}

bool
SmoothingZones::AnyLeftOutIn(int level, const BrickGrid::Brick & brick) const
{
  return AnyPart(level, brick, [](std::uint8_t part) { return part != 255; });
}

} // namespace voxelcore
