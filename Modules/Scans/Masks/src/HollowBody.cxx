#include "voxelcore/Masks/HollowBody.h"

#include "BallDilation.h"
#include "DenseBits.h"
#include "EditedBits.h"
#include "EnclosedShare.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/CountBits.h"
#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

constexpr double kMostVoxels = 1 << 24; // of a box that is looked at as it is
constexpr double kWorthThreads = 1 << 19;
constexpr double kLeastWall = 0.75; // of a lumen's surface, holes in walls stopped
constexpr double kLeastOwn = 0.8;   // of it as it is
constexpr double kLeastShare = 0.1; // of the body's volume
constexpr double kMostOfBox = 0.79; // of the background in the body's box: round tubes leave the corners, 1 - pi / 4
constexpr double kLeastLeft = 0.2;  // of lumens, once holes in walls are stopped: what is narrower is a gap

/** work(run, y, z) for each run of a box of that size. */
template <typename TWork>
void
ForRuns(const Runs & runs, const std::array<std::int32_t, 3> & size, const TWork & work)
{
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y);
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        work(run, y, z);
      }
    }
  }
}

/** The components of `holes` whose surface is wall, that is `body`, for the part asked. Both have one box. */
VoxelShape
WalledIn(const VoxelShape & holes, const VoxelShape & body, double least)
{
  struct Surface
  {
    std::int64_t wall = 0;
    std::int64_t open = 0;
  };
  const auto &         size = holes.Box().size;
  const Runs           runs = VoxelRuns(holes);
  UnionFind            sets = UniteRuns(runs, false);
  std::vector<Surface> surfaces(runs.begin.size());
  VoxelShape           walled(holes.Box());
  struct Beside
  {
    ConstShapeRow wall;
    ConstShapeRow holes;
  };
  std::array<Beside, 4> beside;
  std::size_t           rows = 0; // of them, in the box
  std::int32_t          ofY = -1; // whose they are
  std::int32_t          ofZ = -1;
  ForRuns(runs, size, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    const auto row = body.Row(y, z);
    if (y != ofY || z != ofZ)
    {
      rows = 0;
      for (const auto & [dy, dz] : { std::pair(-1, 0), std::pair(1, 0), std::pair(0, -1), std::pair(0, 1) })
      {
        if (y + dy >= 0 && z + dz >= 0 && y + dy < size[1] && z + dz < size[2])
        {
          beside[rows++] = { body.Row(y + dy, z + dz), holes.Row(y + dy, z + dz) };
        }
      }
      ofY = y;
      ofZ = z;
    }
    const std::int32_t begin = runs.begin[run];
    const std::int32_t end = runs.end[run];
    Surface &          surface = surfaces[sets.Find(run)];
    const auto         isWall = [&](std::int32_t x) {
      return x >= 0 && x < size[0] &&
             (row[static_cast<std::size_t>(x) / 64] >> (static_cast<unsigned>(x) & 63U) & 1U) != 0;
    };
    for (const std::int32_t x : { begin - 1, end })
    {
      isWall(x) ? ++surface.wall : ++surface.open;
    }
    std::uint32_t wall = 0;
    std::uint32_t inside = 0; // between voxels of holes
    ForWordsOfRun(begin, end, [&](std::size_t word, std::uint64_t own) {
      for (std::size_t i = 0; i < rows; ++i)
      {
        wall += CountBits(beside[i].wall[word] & own);
        inside += CountBits(beside[i].holes[word] & own);
      }
    });
    surface.wall += wall;
    surface.open += std::int64_t{ 4 } * (end - begin) - wall - inside;
  });
  ForRuns(runs, size, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    const Surface & surface = surfaces[sets.Find(run)];
    if (static_cast<double>(surface.wall) >= least * static_cast<double>(surface.wall + surface.open))
    {
      SetRun(walled.Row(y, z), runs.begin[run], runs.end[run], true);
    }
  });
  return walled;
}

/** Takes off the channels of labyrinths: components that reach all six sides of the body's box, or all if they come to
 *  `most` and are open anywhere. */
void
RemoveLabyrinths(const VoxelShape & body, double most, VoxelShape & lumens)
{
  const auto & size = lumens.Box().size;
  const Runs   runs = VoxelRuns(lumens);
  if (static_cast<double>(lumens.CountVoxels()) >= most && WalledIn(lumens, body, 1).CountVoxels() == 0)
  {
    lumens = VoxelShape(lumens.Box());
    return;
  }
  UnionFind                 sets = UniteRuns(runs, false);
  std::vector<std::uint8_t> sides(runs.begin.size(), 0);
  ForRuns(runs, size, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    const std::array<bool, 6> at{ runs.begin[run] == 0, runs.end[run] == size[0], y == 0, y + 1 == size[1], z == 0,
                                  z + 1 == size[2] };
    for (unsigned side = 0; side < 6; ++side)
    {
      sides[sets.Find(run)] |= static_cast<std::uint8_t>(at[side] ? 1U << side : 0U);
    }
  });
  ForRuns(runs, size, [&](std::size_t run, std::int32_t y, std::int32_t z) {
    if (sides[sets.Find(run)] == 63)
    {
      SetRun(lumens.Row(y, z), runs.begin[run], runs.end[run], false);
    }
  });
}

/** The lumens of a shape in its own box, once holes in its walls are stopped by a ball; none where they cannot come to
 *  `least` voxels. */
VoxelShape
LumensOf(const VoxelShape & shape, const BallRows & ball, double least)
{
  const VoxelBox & box = shape.Box();
  const DenseBits  bits = DilatedBits(shape, ball);
  const DenseBits  holes = HolesOfAllSlices(bits);
  const double     most = static_cast<double>(holes.Count()) / (ball.IsOneVoxel() ? 1 : kLeastLeft);
  if (most == 0 || most < least)
  {
    return VoxelShape(box);
  }
  const VoxelShape stopped = bits.ToShape();
  VoxelShape       lumens = CopyBox(WalledIn(holes.ToShape(), stopped, kLeastWall), box);
  const auto       left = static_cast<double>(lumens.CountVoxels());
  if (left == 0 || ball.IsOneVoxel())
  {
    return lumens;
  }
  // What the ball took goes back to the lumens and to the outside. Walls are what is neither.
  VoxelShape between = CopyBox(stopped, box);
  VoxelShape outside(box);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      SetRun(outside.Row(y, z), 0, box.size[0], true);
    }
  }
  const auto takeOff = [](std::uint64_t & word, std::uint64_t own) { word &= ~own; };
  ForWords(outside, between, takeOff);
  ForWords(outside, lumens, takeOff);
  ForWords(between, shape, takeOff);
  lumens = EnclosedShare(std::move(between), std::move(lumens), std::move(outside));
  return left >= kLeastLeft * static_cast<double>(lumens.CountVoxels()) ? WalledIn(lumens, shape, kLeastOwn)
                                                                        : VoxelShape(box);
}

double
VoxelsOfBox(const VoxelBox & box)
{
  return static_cast<double>(box.size[0]) * box.size[1] * box.size[2];
}

/** A voxel for each two by two by two of a shape, in where one of them is. */
VoxelShape
Halved(const VoxelShape & shape)
{
  const VoxelBox & from = shape.Box();
  VoxelBox         box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = from.lower[a] >> 1;
    box.size[a] = ((from.lower[a] + from.size[a] - 1) >> 1) - box.lower[a] + 1;
  }
  VoxelShape halved(box);
  const bool isOdd = (from.lower[0] & 1) != 0;
  for (std::int32_t z = 0; z < from.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < from.size[1]; ++y)
    {
      const auto row = shape.Row(y, z);
      const auto to = halved.Row(((from.lower[1] + y) >> 1) - box.lower[1], ((from.lower[2] + z) >> 1) - box.lower[2]);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        if (row.Brick(word) == BitBricks::Out() && !isOdd)
        {
          continue;
        }
        const std::uint64_t carried = isOdd && word > 0 ? row[word - 1] >> 63U : 0;
        std::uint64_t       pairs = isOdd ? row[word] << 1U | carried : row[word];
        pairs = (pairs | pairs >> 1U) & 0x5555555555555555U;
        for (const unsigned step : { 1U, 2U, 4U, 8U, 16U }) // even bits to the lower half
        {
          constexpr std::array<std::uint64_t, 5> kMasks{ 0x3333333333333333U,
                                                         0x0F0F0F0F0F0F0F0FU,
                                                         0x00FF00FF00FF00FFU,
                                                         0x0000FFFF0000FFFFU,
                                                         0x00000000FFFFFFFFU };
          pairs = (pairs | pairs >> step) & kMasks[static_cast<std::size_t>(std::countr_zero(step))];
        }
        to[word / 2] |= pairs << (32 * (word % 2));
      }
      if (isOdd && (from.size[0] & 63) == 0 && row.back() >> 63U != 0)
      {
        SetRun(to, box.size[0] - 1, box.size[0], true);
      }
    }
    if (const std::int32_t done = ((from.lower[2] + z + 1) >> 1) - box.lower[2]; (done & 7) == 0)
    {
      halved.Compact(std::max(done - 8, 0), done);
    }
  }
  return halved;
}

/** Takes a label's voxels off. */
void
Remove(const VoxelShape & label, VoxelShape & from)
{
  const VoxelBox & box = from.Box();
  const VoxelBox & other = label.Box();
  const Runs       runs = VoxelRuns(label);
  for (std::int32_t z = 0; z < other.size[2]; ++z)
  {
    const std::int32_t toZ = z + other.lower[2] - box.lower[2];
    for (std::int32_t y = 0; y < other.size[1] && toZ >= 0 && toZ < box.size[2]; ++y)
    {
      const std::int32_t toY = y + other.lower[1] - box.lower[1];
      if (toY < 0 || toY >= box.size[1])
      {
        continue;
      }
      const auto row =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(other.size[1]) + static_cast<std::size_t>(y);
      for (std::size_t run = runs.rowStart[row]; run < runs.rowStart[row + 1]; ++run)
      {
        const std::int32_t begin = std::max(runs.begin[run] + other.lower[0] - box.lower[0], 0);
        const std::int32_t end = std::min(runs.end[run] + other.lower[0] - box.lower[0], box.size[0]);
        if (begin < end)
        {
          SetRun(from.Row(toY, toZ), begin, end, false);
        }
      }
    }
  }
}

} // namespace

std::optional<HollowBody>
FindHollowBody(const VoxelShape &                  shape,
               const std::array<std::int64_t, 3> & weight,
               std::span<const VoxelShape * const> others)
{
  // Great bodies are looked at in voxels two, four, ... times as long, so that the look stays quick.
  std::int64_t              factor = 1;
  std::optional<VoxelShape> halved;
  const auto                looked = [&]() -> const VoxelShape & { return halved ? *halved : shape; };
  while (VoxelsOfBox(looked().Box()) > kMostVoxels)
  {
    halved = Halved(looked());
    factor *= 2;
  }
  const auto   smallest = *ranges::min_element(weight);
  const double own = static_cast<double>(shape.CountVoxels());
  const double atLeast = std::max(kLeastShare * own, 1.0);
  // With a voxel to spare for what rounds.
  const double least = atLeast / static_cast<double>(factor * factor * factor) - 1;
  const double most = kMostOfBox * (VoxelsOfBox(looked().Box()) - static_cast<double>(looked().CountVoxels()));
  // The three sizes of holes side by side, the dearest first.
  constexpr std::array<int, 3> kHoles{ 8, 4, 0 };
  std::array<std::uint64_t, 3> voxels{};
  const auto                   look = [&](std::size_t which) {
    const std::int64_t radius = kHoles[which] / 2 / factor;
    if (kHoles[which] > 0 && radius == 0)
    {
      return; // longer voxels have stopped them already
    }
    const BallRows ball(LatticeBall{ weight, radius * smallest * (radius * smallest) });
    VoxelShape     lumens = LumensOf(looked(), ball, least);
    const auto     count = [&] { return lumens.CountVoxels() * static_cast<std::uint64_t>(factor * factor * factor); };
    const auto     isEnough = [&] { return static_cast<double>(count()) >= atLeast; };
    if (!isEnough()) // what follows takes off
    {
      return;
    }
    RemoveLabyrinths(looked(), most, lumens);
    for (std::size_t i = 0; i < others.size() && isEnough(); ++i)
    {
      std::optional<VoxelShape> other;
      for (std::int64_t done = 1; done < factor; done *= 2)
      {
        other = Halved(other ? *other : *others[i]);
      }
      Remove(other ? *other : *others[i], lumens);
    }
    voxels[which] = isEnough() ? count() : 0;
  };
  if (VoxelsOfBox(looked().Box()) > kWorthThreads)
  {
    RunEach(kHoles.size(), look);
  }
  else
  {
    look(0);
    look(1);
    look(2);
  }
  HollowBody found;
  for (std::size_t which = kHoles.size(); which-- > 0;)
  {
    if (voxels[which] > found.voxels)
    {
      found = { voxels[which], static_cast<double>(voxels[which]) / own, kHoles[which] };
    }
  }
  return found.voxels > 0 ? std::optional(found) : std::nullopt;
}

std::string
HollowText(const HollowBody & body)
{
  std::string text = "looks hollow: it walls in " + RoughText(body.share) + " times its own volume (" +
                     Counted(body.voxels, "voxel", "voxels") + " of background), and its core follows the walls; ";
  return text + (body.holes == 0
                   ? "--fill-cavities or --fill-slices fills lumens"
                   : "--fill-hollows " + std::to_string(body.holes) + "vox or --fill-slices fills lumens");
}

} // namespace voxelcore
