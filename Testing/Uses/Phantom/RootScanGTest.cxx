#include "Uses/Phantom/PhantomFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Phantom/RootScan.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

RootScanOptions
ScanOptions(std::int32_t size, std::uint64_t seed, const Vector3 & spacing = { 1, 1, 1 })
{
  RootScanOptions options;
  options.root = Options("root", { size, size, static_cast<std::int32_t>(size / spacing[2]) }, spacing);
  options.root.seed = seed;
  return options;
}

double
Apart(const CentreLinePoint & a, const CentreLinePoint & b)
{
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    sum += std::pow(a.position[k] - b.position[k], 2);
  }
  return std::sqrt(sum);
}

} // namespace

TEST(RootScan, HalfTheContrastGivesNearlyTheVoxelsOfTheMask)
{
  for (const double slice : { 1.0, 2.0 })
  {
    const RootScanOptions options = ScanOptions(96, 3, { 1, 1, slice });
    const VoxelShape      mask = MakePhantom(options.root);
    const VoxelShape      grey = Brighter(MakeRootScan(options), options.root);
    std::uint64_t         differences = 0;
    for (std::int32_t z = 0; z < options.root.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < options.root.size[1]; ++y)
      {
        for (std::int32_t x = 0; x < options.root.size[0]; ++x)
        {
          differences += mask.Contains(x, y, z) != grey.Contains(x, y, z);
        }
      }
    }
    EXPECT_LT(static_cast<double>(differences), 0.01 * static_cast<double>(mask.CountVoxels()));
  }
}

TEST(RootScan, SumsOfValuesAreVolumes)
{
  // Partial volumes: the values above air add up to the volume of the body, as those of a mask need not.
  PhantomOptions root = Options("root", { 60, 60, 60 });
  root.laterals = 0;
  root.radius = 7;
  root.detail = 3;
  RootScanOptions options;
  options.root = root;
  const RootScan scan = MakeRootScan(options);
  double         sum = 0;
  for (const std::uint16_t value : scan.values)
  {
    sum += (value - kRootScanAir) / static_cast<double>(kRootScanRoot - kRootScanAir);
  }
  double volume = 0;
  for (std::size_t i = 1; i < scan.lines.size(); ++i)
  {
    const double a = scan.lines[i - 1].radius;
    const double b = scan.lines[i].radius;
    double       length = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      length += std::pow(scan.lines[i].position[k] - scan.lines[i - 1].position[k], 2);
    }
    volume += M_PI / 3 * (a * a + a * b + b * b) * std::sqrt(length);
  }
  volume += 2 * M_PI / 3 * (std::pow(scan.lines.front().radius, 3) + std::pow(scan.lines.back().radius, 3));
  EXPECT_NEAR(sum, volume, 0.03 * volume);
}

TEST(RootScan, ContactsTouchAndCloseALoopEach)
{
  std::int64_t wanted = 0;
  std::int64_t found = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    RootScanOptions without = ScanOptions(128, seed);
    without.root.laterals = 12;
    without.root.subLaterals = 1;
    RootScanOptions with = without;
    with.root.contacts = 5;
    const RootScan                     scan = MakeRootScan(with);
    const std::vector<CentreLinePoint> before = RootCentreLines(without.root);
    EXPECT_GE(scan.contacts.size(), 4U) << "seed " << seed;
    ASSERT_GT(scan.lines.size(), before.size());
    EXPECT_EQ(scan.lines[before.size() - 1].position, before.back().position); // the rest is as it was
    for (const RootContact & contact : scan.contacts)
    {
      double gap = std::numeric_limits<double>::infinity();
      for (const CentreLinePoint & a : scan.lines)
      {
        for (const CentreLinePoint & b : scan.lines)
        {
          if (a.branch == contact.branches[0] && b.branch == contact.branches[1])
          {
            gap = std::min(gap, Apart(a, b) - a.radius - b.radius);
          }
        }
      }
      EXPECT_LT(gap, 0);
      EXPECT_NE(contact.branches[0], contact.branches[1]);
    }
    wanted += static_cast<std::int64_t>(scan.contacts.size());
    found += ComputeShapeTopology(Brighter(scan, with.root)).betti[1] -
             ComputeShapeTopology(Brighter(MakeRootScan(without), without.root)).betti[1];
  }
  EXPECT_NEAR(static_cast<double>(found), static_cast<double>(wanted), 0.1 * static_cast<double>(wanted));
}

TEST(RootScan, HollowRootsHaveACavityThatHolesOpen)
{
  RootScanOptions options = ScanOptions(96, 2);
  options.root.radius = 8;
  options.hollow = 0.7;
  const TopologyNumbers closed = ComputeShapeTopology(Brighter(MakeRootScan(options), options.root));
  EXPECT_EQ(closed.betti[0], 1);
  EXPECT_EQ(closed.betti[2], 1);
  options.holes = 6;
  const RootScan        scan = MakeRootScan(options);
  const TopologyNumbers open = ComputeShapeTopology(Brighter(scan, options.root));
  EXPECT_EQ(scan.holes.size(), 6U);
  EXPECT_EQ(open.betti[2], 0);
  EXPECT_GE(open.betti[1] - closed.betti[1], 4); // two holes may meet
}

TEST(RootScan, BreaksTearRootsWhereTheyAreSaidToBe)
{
  RootScanOptions options = ScanOptions(128, 4);
  options.root.laterals = 10;
  options.root.subLaterals = 0;
  options.breaks = 5;
  const RootScan scan = MakeRootScan(options);
  ASSERT_EQ(scan.breaks.size(), 5U);
  const VoxelShape shape = Brighter(scan, options.root);
  for (const Vector3 & place : scan.breaks)
  {
    EXPECT_FALSE(shape.Contains(static_cast<std::int32_t>(place[0]),
                                static_cast<std::int32_t>(place[1]),
                                static_cast<std::int32_t>(place[2])));
  }
  EXPECT_GE(ComputeShapeTopology(shape).betti[0], 5);
}

TEST(RootScan, WhorlsAreHeightsManyLateralsSpringFrom)
{
  PhantomOptions options = Options("root", { 160, 160, 160 });
  options.laterals = 12;
  options.subLaterals = 0;
  options.whorls = 3;
  std::vector<double> heights;
  const auto          lines = RootCentreLines(options);
  for (const CentreLinePoint & point : lines)
  {
    if (point.parent >= 0 && point.branch != lines[static_cast<std::size_t>(point.parent)].branch)
    {
      heights.push_back(point.position[2]);
    }
  }
  ASSERT_GE(heights.size(), 7U);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  EXPECT_EQ(heights.size(), 3U);
}

TEST(RootScan, NoiseRingsAndSoilAreAsWideAndHighAsAsked)
{
  RootScanOptions plain = ScanOptions(48, 1);
  RootScanOptions noisy = plain;
  noisy.noise = 0.1;
  RootScanOptions soil = plain;
  soil.soil = 20;
  RootScanOptions rings = plain;
  rings.rings = 0.05;
  const auto   a = MakeRootScan(plain).values;
  const auto   b = MakeRootScan(noisy).values;
  const auto   c = MakeRootScan(soil).values;
  const auto   d = MakeRootScan(rings).values;
  const double contrast = kRootScanRoot - kRootScanAir;
  double       squares = 0;
  double       largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    squares += std::pow((b[i] - a[i]) / contrast, 2);
    largest = std::max(largest, std::abs(d[i] - a[i]) / contrast);
    const bool below = static_cast<double>(i / (48 * 48)) + 0.5 < 20;
    EXPECT_EQ(c[i], a[i] == kRootScanAir && below ? kRootScanSoil : c[i]);
    EXPECT_TRUE(below || c[i] == a[i]);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(a.size())), 0.1, 0.002);
  EXPECT_NEAR(largest, 0.05, 0.005);
  EXPECT_EQ(MakeRootScan(noisy).values, b);
}

TEST(RootScan, RefusesWhatMakesNoSense)
{
  RootScanOptions options = ScanOptions(48, 1);
  options.hollow = 0.95;
  EXPECT_THROW(MakeRootScan(options), UsageError);
  options = ScanOptions(48, 1);
  options.noise = -1;
  EXPECT_THROW(MakeRootScan(options), UsageError);
  options = ScanOptions(48, 1);
  options.root.kind = "ball";
  EXPECT_THROW(MakeRootScan(options), UsageError);
}
