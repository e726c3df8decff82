#include "voxelcore/Compare/MaskComparison.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Shapes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

namespace voxelcore::testing
{
namespace
{

using Voxel = std::array<std::int32_t, 3>;

/** A square ring in the plane z = 1, 7 x 7 voxels with a hole of 3 x 3 x the height. */
VoxelShape
Ring()
{
  return ShapeWhere({ 7, 7, 3 }, [](int x, int y, int) { return x < 2 || x > 4 || y < 2 || y > 4; });
}

std::vector<std::tuple<PartKind, PartChange, std::uint64_t, Voxel>>
Listed(const std::vector<DifferingPart> & parts)
{
  std::vector<std::tuple<PartKind, PartChange, std::uint64_t, Voxel>> list;
  for (const DifferingPart & part : parts)
  {
    list.emplace_back(part.kind, part.change, part.voxels, part.place);
  }
  return list;
}

// ---- by their definitions, voxel by voxel

std::vector<Voxel>
VoxelsOf(const VoxelShape & shape)
{
  std::vector<Voxel> voxels;
  const auto & [lower, size] = shape.Box();
  for (std::int32_t z = lower[2]; z < lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y < lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x < lower[0] + size[0]; ++x)
      {
        if (shape.Contains(x, y, z))
        {
          voxels.push_back({ x, y, z });
        }
      }
    }
  }
  return voxels;
}

std::vector<Voxel>
BruteBoundary(const VoxelShape & shape)
{
  std::vector<Voxel> boundary;
  for (const auto & [x, y, z] : VoxelsOf(shape))
  {
    if (!(shape.Contains(x - 1, y, z) && shape.Contains(x + 1, y, z) && shape.Contains(x, y - 1, z) &&
          shape.Contains(x, y + 1, z) && shape.Contains(x, y, z - 1) && shape.Contains(x, y, z + 1)))
    {
      boundary.push_back({ x, y, z });
    }
  }
  return boundary;
}

std::vector<double>
BruteDistances(const std::vector<Voxel> & from, const std::vector<Voxel> & to, const Vector3 & spacing)
{
  std::vector<double> distances;
  for (const Voxel & a : from)
  {
    double least = HUGE_VAL;
    for (const Voxel & b : to)
    {
      double squared = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double d = spacing[k] * (a[k] - b[k]);
        squared += d * d;
      }
      least = std::min(least, squared);
    }
    distances.push_back(std::sqrt(least));
  }
  std::ranges::sort(distances);
  return distances;
}

/** NumPy's percentile, of sorted numbers. */
double
BrutePercentile95(const std::vector<double> & sorted)
{
  const double rank = 0.95 * static_cast<double>(sorted.size() - 1);
  const auto   low = static_cast<std::size_t>(std::floor(rank));
  const auto   high = static_cast<std::size_t>(std::ceil(rank));
  return sorted[low] + (rank - std::floor(rank)) * (sorted[high] - sorted[low]);
}

/** Betti numbers b0 and b2 of the closed voxels by flooding; b1 by corners, edges, faces and voxels one by one. */
TopologyNumbers
BruteClosedTopology(const VoxelShape & shape)
{
  TopologyNumbers numbers;
  VisitCorners(shape, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    // The cells with their least corner here: along each set of axes they reach one voxel up, along others they touch
    // the voxels to both sides.
    for (int axes = 0; axes < 8; ++axes)
    {
      const int          dx = axes & 1;
      const int          dy = axes >> 1 & 1;
      const int          dz = axes >> 2;
      const LatticePoint low{ x - 1 + dx, y - 1 + dy, z - 1 + dz };
      numbers.euler += CountIn(shape, low, { x, y, z }) > 0 ? ((dx + dy + dz) % 2 == 0 ? 1 : -1) : 0;
    }
  });
  numbers.betti[0] = BruteComponents(shape, true, 3);
  numbers.betti[2] = BruteComponents(shape, false, 1) - 1;
  numbers.betti[1] = numbers.betti[0] + numbers.betti[2] - numbers.euler;
  return numbers;
}

void
ExpectBruteForce(const RandomVolume & volume, Random & random)
{
  SCOPED_TRACE(volume.Describe());
  const VoxelShape & a = volume.shape;
  const Size3        size = a.Box().size;
  const Size3        lower{ static_cast<std::int32_t>(random.Between(-2, 2)),
                     static_cast<std::int32_t>(random.Between(-2, 2)),
                     static_cast<std::int32_t>(random.Between(-2, 2)) };
  const bool         isLike = random.Chance(0.5); // a few voxels of A flipped, or a mask of its own
  const VoxelShape   b = ShapeWhere(
    size,
    [&](int x, int y, int z) {
      return isLike ? a.Contains(lower[0] + x, lower[1] + y, lower[2] + z) != random.Chance(0.03)
                      : random.Chance(volume.density);
    },
    lower);
  const auto    voxelsA = VoxelsOf(a);
  const auto    voxelsB = VoxelsOf(b);
  std::uint64_t both = 0;
  for (const auto & [x, y, z] : voxelsA)
  {
    both += b.Contains(x, y, z) ? 1 : 0;
  }
  const MaskOverlap overlap = CountOverlap(a, b);
  EXPECT_EQ(overlap.a, voxelsA.size());
  EXPECT_EQ(overlap.b, voxelsB.size());
  EXPECT_EQ(overlap.both, both);
  EXPECT_EQ(overlap.Dice(), CountOverlap(b, a).Dice());
  EXPECT_EQ(overlap.Jaccard(), CountOverlap(b, a).Jaccard());

  const auto boundaryA = BruteBoundary(a);
  const auto boundaryB = BruteBoundary(b);
  EXPECT_EQ(BoundaryVoxels(a), boundaryA);
  const SurfaceDistances found = MeasureSurfaceDistances(a, b, volume.spacing);
  if (boundaryA.empty() || boundaryB.empty())
  {
    EXPECT_TRUE(std::isnan(found.hausdorff) && std::isnan(found.percentile95) && std::isnan(found.mean));
  }
  else
  {
    const auto fromA = BruteDistances(boundaryA, boundaryB, volume.spacing);
    const auto fromB = BruteDistances(boundaryB, boundaryA, volume.spacing);
    double     sum = 0;
    for (const auto * list : { &fromA, &fromB })
    {
      for (const double distance : *list)
      {
        sum += distance;
      }
    }
    EXPECT_EQ(found.hausdorff, std::max(fromA.back(), fromB.back()));
    EXPECT_DOUBLE_EQ(found.percentile95, std::max(BrutePercentile95(fromA), BrutePercentile95(fromB)));
    EXPECT_NEAR(found.mean, sum / static_cast<double>(fromA.size() + fromB.size()), 1e-12 * found.hausdorff);
    const SurfaceDistances back = MeasureSurfaceDistances(b, a, volume.spacing);
    EXPECT_EQ(back.hausdorff, found.hausdorff);
    EXPECT_EQ(back.percentile95, found.percentile95);
    EXPECT_EQ(back.mean, found.mean);
  }

  const TopologyComparison open = CompareTopology6(a, b);
  const TopologyComparison closed = CompareTopology26(a, b);
  const TopologyNumbers    bruteA = BruteTopology(a);
  const TopologyNumbers    bruteB = BruteTopology(b);
  EXPECT_EQ(open.a, bruteA);
  EXPECT_EQ(open.b, bruteB);
  EXPECT_EQ(closed.a, BruteClosedTopology(a));
  EXPECT_EQ(closed.b, BruteClosedTopology(b));
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_EQ(open.errors[k], std::abs(bruteA.betti[k] - bruteB.betti[k]));
    EXPECT_EQ(closed.errors[k], std::abs(closed.a.betti[k] - closed.b.betti[k]));
  }
  // Pieces of B = pieces of A - missed - joined + invented + broken would count each correspondence once where it is a
  // forest; in general every list is bounded by what there is.
  std::array<std::array<std::int64_t, 4>, 3> counted{};
  for (const DifferingPart & part : FindDifferingParts(a, b))
  {
    ++counted[static_cast<std::size_t>(part.kind)][static_cast<std::size_t>(part.change)];
    const bool ofA = part.change == PartChange::Missed || part.change == PartChange::Joined;
    EXPECT_EQ((ofA ? a : b).Contains(part.place[0], part.place[1], part.place[2]), part.kind == PartKind::Piece);
  }
  const auto backwards = FindDifferingParts(b, a);
  for (const PartKind kind : { PartKind::Piece, PartKind::Cavity })
  {
    const auto & one = counted[static_cast<std::size_t>(kind)];
    const auto   count = [&](PartChange change) {
      return std::ranges::count_if(backwards, [&](const DifferingPart & part) {
        return part.kind == kind && part.change == change;
      });
    };
    EXPECT_EQ(count(PartChange::Missed), one[1]);
    EXPECT_EQ(count(PartChange::Invented), one[0]);
    EXPECT_EQ(count(PartChange::Broken), one[3]);
    EXPECT_EQ(count(PartChange::Joined), one[2]);
  }
}

void
ExpectBruteForceOf(std::uint64_t firstSeed, int count, std::int32_t most)
{
  std::cout << "seeds from " << firstSeed << '\n';
  for (int i = 0; i < count; ++i)
  {
    const RandomVolume volume = MakeRandomVolume(firstSeed + static_cast<std::uint64_t>(i), 2, most);
    Random             random(volume.seed + 1);
    ExpectBruteForce(volume, random);
  }
}

TEST(MaskComparison, RandomPairsEqualBruteForce)
{
  ExpectBruteForceOf(6901, 50, 10);
}

TEST(HeavyMaskComparison, RandomPairsEqualBruteForce)
{
  ExpectBruteForceOf(69000, 2000, 24);
}

TEST(MaskComparison, OverlapOfTwoBoxesIsWhatOneCounts)
{
  // 4 x 2 x 1 = 8 voxels, and the same two further along x: 4 of them in both.
  const MaskOverlap overlap = CountOverlap(Box({ 4, 2, 1 }), Box({ 4, 2, 1 }, { 2, 0, 0 }));
  EXPECT_EQ(overlap.both, 4U);
  EXPECT_EQ(overlap.Dice(), 0.5);           // 2 x 4 / (8 + 8)
  EXPECT_EQ(overlap.Jaccard(), 4.0 / 12.0); // 4 / (8 + 8 - 4)
  EXPECT_EQ(overlap.MissingRatio(), 0.5);   // 4 of A's 8 are missed,
  EXPECT_EQ(overlap.LeakageRatio(), 0.5);   // and as many invented
}

TEST(MaskComparison, ShiftedBoxIsAsFarAsItsShift)
{
  const Vector3 spacing{ 0.7, 1.3, 2.5 };
  const Size3   size{ 9, 8, 7 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const int by : { 1, 3, 20 })
    {
      Size3 lower{ 0, 0, 0 };
      lower[axis] = by;
      const SurfaceDistances found = MeasureSurfaceDistances(Box(size), Box(size, lower), spacing);
      EXPECT_EQ(found.hausdorff, spacing[axis] * by) << axis << ' ' << by;
    }
  }
  const SurfaceDistances same = MeasureSurfaceDistances(Box(size), Box(size), spacing);
  EXPECT_EQ(same.hausdorff, 0);
  EXPECT_EQ(same.percentile95, 0);
  EXPECT_EQ(same.mean, 0);
}

TEST(MaskComparison, ABoxInAGreaterOneIsAsFarAsTheirCorners)
{
  // 10^3 voxels in the middle of 14^3: two voxels between them along each axis.
  const VoxelShape  inner = Box({ 10, 10, 10 }, { 2, 2, 2 });
  const VoxelShape  outer = Box({ 14, 14, 14 });
  const MaskOverlap overlap = CountOverlap(inner, outer);
  EXPECT_EQ(overlap.Dice(), 2000.0 / 3744.0);
  EXPECT_EQ(overlap.Jaccard(), 1000.0 / 2744.0);
  EXPECT_EQ(overlap.LeakageRatio(), 1.744);
  const SurfaceDistances found = MeasureSurfaceDistances(inner, outer, { 1, 2, 2 });
  EXPECT_EQ(found.hausdorff, 6); // sqrt((1 x 2)^2 + (2 x 2)^2 + (2 x 2)^2) between corners
}

TEST(MaskComparison, GrownRodIsAsFarAsItIsLonger)
{
  // A rod one voxel thick: its 10 voxels are 0 from the longer one's, whose 4 further ones are 2, 4, 6, 8 mm from it.
  const SurfaceDistances found = MeasureSurfaceDistances(Box({ 10, 1, 1 }), Box({ 14, 1, 1 }), { 2, 1, 1 });
  EXPECT_EQ(found.hausdorff, 8);
  EXPECT_DOUBLE_EQ(found.mean, (2 + 4 + 6 + 8) / 24.0);
  // Ranks 0 to 13; 0.95 x 13 = 12.35 lies between 6 and 8.
  EXPECT_DOUBLE_EQ(found.percentile95, 6 + 0.35 * 2);
}

TEST(MaskComparison, BrokenRingHasLostItsLoop)
{
  VoxelShape broken = Ring();
  for (std::int32_t z = 0; z < 3; ++z)
  {
    for (std::int32_t y = 0; y < 2; ++y)
    {
      broken.Row(y, z)[0] &= ~std::uint64_t{ 1U << 3U };
    }
  }
  const TopologyComparison open = CompareTopology6(Ring(), broken);
  EXPECT_EQ(open.a.betti, (std::array<std::int64_t, 3>{ 1, 1, 0 }));
  EXPECT_EQ(open.b.betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  EXPECT_EQ(open.errors, (std::array<std::int64_t, 3>{ 0, 1, 0 }));
  EXPECT_EQ(CompareTopology26(Ring(), broken).errors, open.errors);
}

TEST(MaskComparison, VoxelsThatTouchInACornerArePiecesBySix)
{
  const VoxelShape two = ShapeWhere({ 2, 2, 2 }, [](int x, int y, int z) { return x == y && y == z; });
  EXPECT_EQ(CompareTopology6(two, Box({ 2, 2, 2 })).errors, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
  EXPECT_EQ(CompareTopology26(two, Box({ 2, 2, 2 })).errors, (std::array<std::int64_t, 3>{ 0, 0, 0 }));
}

TEST(MaskComparison, PiecesThatDifferAreTold)
{
  // Along x: A is 0-9, 20-24; B is 0-3, 5-9, 40-41.
  const VoxelShape a = ShapeWhere({ 50, 1, 1 }, [](int x, int, int) { return x < 10 || (x >= 20 && x < 25); });
  const VoxelShape b =
    ShapeWhere({ 50, 1, 1 }, [](int x, int, int) { return (x < 10 && x != 4) || x == 40 || x == 41; });
  const auto expected = std::vector<std::tuple<PartKind, PartChange, std::uint64_t, Voxel>>{
    { PartKind::Piece, PartChange::Missed, 5, { 22, 0, 0 } },
    { PartKind::Piece, PartChange::Invented, 2, { 41, 0, 0 } },
    { PartKind::Piece, PartChange::Broken, 4, { 2, 0, 0 } } // 5-9 shares more with A's
  };
  EXPECT_EQ(Listed(FindDifferingParts(a, b)), expected);
  const auto backwards = std::vector<std::tuple<PartKind, PartChange, std::uint64_t, Voxel>>{
    { PartKind::Piece, PartChange::Missed, 2, { 41, 0, 0 } },
    { PartKind::Piece, PartChange::Invented, 5, { 22, 0, 0 } },
    { PartKind::Piece, PartChange::Joined, 4, { 2, 0, 0 } }
  };
  EXPECT_EQ(Listed(FindDifferingParts(b, a)), backwards);
}

TEST(MaskComparison, CavitiesThatDifferAreTold)
{
  const auto hollow = [](int middle) {
    return ShapeWhere({ 9, 5, 5 }, [=](int x, int y, int z) { return !(x == middle && y == 2 && z == 2); });
  };
  const auto expected = std::vector<std::tuple<PartKind, PartChange, std::uint64_t, Voxel>>{
    { PartKind::Cavity, PartChange::Missed, 1, { 2, 2, 2 } },
    { PartKind::Cavity, PartChange::Invented, 1, { 6, 2, 2 } }
  };
  EXPECT_EQ(Listed(FindDifferingParts(hollow(2), hollow(6))), expected);
  EXPECT_TRUE(FindDifferingParts(hollow(2), hollow(2)).empty());
}

TEST(MaskComparison, NothingIsFarFromNothing)
{
  const VoxelShape       nothing;
  const SurfaceDistances found = MeasureSurfaceDistances(Box({ 2, 2, 2 }), nothing, { 1, 1, 1 });
  EXPECT_TRUE(std::isnan(found.hausdorff));
  EXPECT_EQ(CountOverlap(Box({ 2, 2, 2 }), nothing).Dice(), 0);
  EXPECT_EQ(CountOverlap(nothing, nothing).Dice(), 1);
  EXPECT_TRUE(std::isnan(CountOverlap(nothing, nothing).MissingRatio()));
  EXPECT_EQ(FindDifferingParts(Box({ 2, 2, 2 }), nothing).size(), 1U);
}

} // namespace
} // namespace voxelcore::testing
