#include "Uses/Phantom/PhantomFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

constexpr double kPi = 3.14159265358979323846;

/** mm^3 */
double
Volume(const PhantomOptions & options)
{
  return static_cast<double>(MakePhantom(options).CountVoxels()) * options.spacing[0] * options.spacing[1] *
         options.spacing[2];
}

TopologyNumbers
Topology(const std::string & kind, std::int32_t n)
{
  return ComputeShapeTopology(MakePhantom(Options(kind, { n, n, n })));
}

TopologyNumbers
Betti(std::int64_t b0, std::int64_t b1, std::int64_t b2)
{
  return { b0 - b1 + b2, { b0, b1, b2 } };
}

const std::vector<std::string> kSolids{ "ellipsoid", "ball",  "capsule", "box",        "plate",
                                        "rod",       "torus", "shell",   "tanglecube", "gyroid" };

} // namespace

TEST(Phantom, TheEllipsoidHasTheKnownBoundaryVertices)
{
  EXPECT_EQ(CountBoundaryVertices(MakePhantom(Options("ellipsoid", { 64, 64, 64 }))), 7354U);
  EXPECT_EQ(CountBoundaryVertices(MakePhantom(Options("ellipsoid", { 256, 256, 256 }))), 117410U);
}

TEST(Phantom, VolumesAgreeWithTheFormulas)
{
  // Sides of 90, 75 and 60 mm; the shortest is 60.
  const auto volume = [](const std::string & kind) {
    return Volume(Options(kind, { 100, 125, 75 }, { 0.9, 0.6, 0.8 }));
  };
  const auto expect = [&](const std::string & kind, double formula) {
    EXPECT_NEAR(volume(kind) / formula, 1, 0.02) << kind << " " << formula;
  };
  expect("ellipsoid", 4 * kPi / 3 * 0.45 * 90 * 0.30 * 75 * 0.20 * 60);
  expect("ball", 4 * kPi / 3 * 27 * 27 * 27);
  expect("capsule", kPi * 81 * (0.9 * 90 - 18) + 4 * kPi / 3 * 729);
  expect("rod", kPi * 36 * 54);
  expect("torus", 2 * kPi * kPi * 18 * 7.2 * 7.2);
  expect("shell", 4 * kPi / 3 * (27 * 27 * 27 - 18 * 18 * 18));
  // Counted by hand: centres lie at 0.45 (2k + 1), 0.6 k and 0.8 k mm from the middle.
  const auto count = [](const std::string & kind) {
    return MakePhantom(Options(kind, { 100, 125, 75 }, { 0.9, 0.6, 0.8 })).CountVoxels();
  };
  EXPECT_EQ(count("box"), 80U * 101 * 61);  // within 36, 30 and 24 mm
  EXPECT_EQ(count("plate"), 90U * 113 * 7); // within 40.5, 33.75 and 3 mm
}

TEST(Phantom, LengthsAreHeeded)
{
  PhantomOptions options = Options("ball", { 80, 80, 80 }, { 0.5, 0.5, 0.5 });
  options.radius = 10;
  EXPECT_NEAR(Volume(options) / (4 * kPi / 3 * 1000), 1, 0.01);
  options.kind = "shell";
  options.thickness = 2;
  EXPECT_NEAR(Volume(options) / (4 * kPi / 3 * (1000 - 512)), 1, 0.01);
  options.kind = "plate";
  options.radius.reset();
  EXPECT_EQ(MakePhantom(options).CountVoxels(), 72U * 72 * 4);
  options.kind = "rod";
  options.thickness.reset();
  options.radius = 10;
  EXPECT_NEAR(Volume(options) / (kPi * 100 * 36), 1, 0.01);
  options.kind = "torus";
  options.radius = 5;
  EXPECT_NEAR(Volume(options) / (2 * kPi * kPi * 12 * 25), 1, 0.01);
}

TEST(Phantom, TheGyroidSheetHasItsAreaTimesItsThickness)
{
  PhantomOptions options = Options("gyroid", { 96, 96, 96 });
  options.period = 48; // whole periods, so that the area is known: 3.0915 a^2 a period cubed
  options.thickness = 4;
  EXPECT_NEAR(Volume(options) / (8 * 3.0915 * 48 * 48 * 4), 1, 0.03); // bent: a little less
  const auto count = CountBoundaryVertices(MakePhantom(Options("gyroid", { 256, 256, 256 })));
  EXPECT_NEAR(static_cast<double>(count), 1.8e6, 0.1e6);
}

TEST(Phantom, SolidsHaveTheTopologyTheirNamesSay)
{
  for (const std::string kind : { "ellipsoid", "ball", "capsule", "box", "plate", "rod" })
  {
    EXPECT_EQ(Topology(kind, 50), Betti(1, 0, 0)) << kind;
  }
  EXPECT_EQ(Topology("torus", 50), Betti(1, 1, 0));
  EXPECT_EQ(Topology("shell", 50), Betti(1, 0, 1));
  // Eight corners, twelve edges: 12 - 8 + 1 loops.
  EXPECT_EQ(Topology("tanglecube", 50), Betti(1, 5, 0));
}

TEST(Phantom, SolidsAreExactlySymmetric)
{
  for (const std::string & kind : kSolids)
  {
    const std::array<std::int32_t, 3> size{ 41, 38, 33 };
    const VoxelShape                  shape = MakePhantom(Options(kind, size, { 0.7, 1.1, 0.9 }));
    ASSERT_GT(shape.CountVoxels(), 100U) << kind;
    std::uint64_t differences = 0;
    for (std::int32_t z = 0; z < size[2]; ++z)
    {
      for (std::int32_t y = 0; y < size[1]; ++y)
      {
        for (std::int32_t x = 0; x < size[0]; ++x)
        {
          const bool         in = shape.Contains(x, y, z);
          const std::int32_t mx = size[0] - 1 - x;
          const std::int32_t my = size[1] - 1 - y;
          const std::int32_t mz = size[2] - 1 - z;
          differences += in != shape.Contains(mx, my, mz);
          if (kind != "gyroid") // turned inside out by a mirror
          {
            differences += in != shape.Contains(mx, y, z);
            differences += in != shape.Contains(x, my, z);
          }
        }
      }
    }
    EXPECT_EQ(differences, 0U) << kind;
  }
}

TEST(Phantom, AGridThreeTimesCoarserSamplesTheSameBody)
{
  for (const std::string & kind : kSolids)
  {
    const VoxelShape fine = MakePhantom(Options(kind, { 48, 40, 60 }));
    const VoxelShape coarse = MakePhantom(Options(kind, { 48, 40, 20 }, { 1, 1, 3 }));
    std::uint64_t    differences = 0;
    for (std::int32_t z = 0; z < 20; ++z)
    {
      for (std::int32_t y = 0; y < 40; ++y)
      {
        for (std::int32_t x = 0; x < 48; ++x)
        {
          differences += fine.Contains(x, y, 3 * z + 1) != coarse.Contains(x, y, z);
        }
      }
    }
    EXPECT_EQ(differences, 0U) << kind;
  }
}

TEST(Phantom, NoiseHasTheDensityAskedFor)
{
  for (const double density : { 0.0, 0.03, 0.5, 0.9, 1.0 })
  {
    PhantomOptions options = Options("noise", { 61, 62, 63 });
    options.density = density;
    EXPECT_NEAR(Volume(options) / (61 * 62 * 63), density, 0.004);
    options.kind = "porous";
    EXPECT_NEAR(Volume(options) / (61 * 62 * 63), density, 0.004);
  }
}

TEST(Phantom, PorousIsSmoothAndNoiseIsNot)
{
  // At half density every other neighbour of a voxel of noise differs; in smooth noise few do.
  const auto changes = [](const std::string & kind) {
    const VoxelShape shape = MakePhantom(Options(kind, { 64, 64, 64 }));
    std::uint64_t    count = 0;
    for (std::int32_t z = 0; z < 64; ++z)
    {
      for (std::int32_t y = 0; y < 64; ++y)
      {
        for (std::int32_t x = 0; x < 63; ++x)
        {
          count += shape.Contains(x, y, z) != shape.Contains(x + 1, y, z);
        }
      }
    }
    return static_cast<double>(count) / (63 * 64 * 64);
  };
  EXPECT_NEAR(changes("noise"), 0.5, 0.01);
  EXPECT_LT(changes("porous"), 0.3);
}

TEST(Phantom, TheSeedDecidesAndNothingElse)
{
  for (const std::string kind : { "porous", "noise", "root" })
  {
    PhantomOptions options = Options(kind, { 50, 50, 50 });
    options.seed = 5;
    const VoxelShape first = MakePhantom(options);
    EXPECT_TRUE(SameVoxels(first, MakePhantom(options))) << kind;
    options.seed = 6;
    EXPECT_FALSE(SameVoxels(first, MakePhantom(options))) << kind;
  }
}

TEST(Phantom, EveryMachineMakesTheseVoxels)
{
  const std::vector<std::pair<std::string, std::uint64_t>> known{
    { "ellipsoid", 0x24354BAB7A46751BU }, { "ball", 0x6C3E0EDE2A71E4E2U },   { "capsule", 0x9C46E50DA951ECB5U },
    { "box", 0xEE44623386A16B9CU },       { "plate", 0x8F3A28FF1F6995EFU },  { "rod", 0xA182397CC4FD875DU },
    { "torus", 0x76C3AEDE46AB6958U },     { "shell", 0x3EC19E6949DB46BU },   { "tanglecube", 0x8F8B8CADCB2393D3U },
    { "gyroid", 0x7BB1A13E3FFFA720U },    { "porous", 0xBB79E2D8A2E9EA71U }, { "noise", 0x6DEFC85B03AB347BU },
    { "cells", 0xA7E47228BE244CA6U },     { "root", 0x5E15F5D3A943DC5DU },   { "thick-and-thin", 0x81620A29FF719EB9U },
    { "vessels", 0x49AAF1008C7FA2D4U },
  };
  ASSERT_EQ(known.size(), PhantomKinds().size());
  for (const auto & [kind, fingerprint] : known)
  {
    EXPECT_EQ(Fingerprint(MakePhantom(Options(kind, { 70, 50, 61 }, { 0.8, 1, 0.9 }))), fingerprint) << kind;
  }
}

TEST(Phantom, VesselsAreTwelveBodiesInOneRing)
{
  const PhantomOptions          options = Options("vessels", { 64, 64, 64 }, { 1, 1, 1 });
  const std::vector<VoxelShape> bodies = MakePhantomBodies(options);
  EXPECT_EQ(bodies.size(), 12U);
  std::uint64_t voxels = 0;
  for (const VoxelShape & body : bodies)
  {
    voxels += body.CountVoxels();
  }
  const VoxelShape all = MakePhantom(options);
  EXPECT_EQ(all.CountVoxels(), voxels); // none is of two bodies
  const TopologyNumbers numbers = ComputeShapeTopology(all);
  EXPECT_EQ(numbers.betti, (std::array<std::int64_t, 3>{ 1, 1, 0 }));
}

TEST(Phantom, EveryKindListedCanBeMade)
{
  for (const PhantomKind & kind : PhantomKinds())
  {
    EXPECT_GT(MakePhantom(Options(std::string(kind.name), { 40, 40, 40 })).CountVoxels(), 0U) << kind.name;
    EXPECT_EQ(kind.help.find('\n'), std::string_view::npos);
    EXPECT_FALSE(kind.help.empty());
  }
}

TEST(Phantom, OneVoxelGridsWork)
{
  for (const std::string & kind : kSolids)
  {
    if (kind != "torus" && kind != "shell" && kind != "tanglecube") // their middle is empty
    {
      EXPECT_EQ(MakePhantom(Options(kind, { 1, 1, 1 })).CountVoxels(), 1U) << kind;
    }
  }
}

TEST(Phantom, MakingCanBeWatchedAndStopped)
{
  for (const PhantomKind & kind : PhantomKinds())
  {
    const PhantomOptions options = Options(std::string(kind.name), { 40, 40, 40 });
    double               last = -1;
    std::string          lastStage;
    const VoxelShape     shape = MakePhantom(options, [&](std::string_view stage, double fraction) {
      EXPECT_TRUE(stage != lastStage || fraction >= last) << kind.name;
      EXPECT_TRUE(0 <= fraction && fraction <= 1) << kind.name;
      last = fraction;
      lastStage = stage;
      return true;
    });
    EXPECT_GT(last, 0.5) << kind.name;
    EXPECT_TRUE(SameVoxels(shape, MakePhantom(options))) << kind.name;
    EXPECT_THROW(MakePhantom(options, [](std::string_view, double fraction) { return fraction < 0.3; }), Cancelled);
  }
}

TEST(Phantom, ValuesWithoutSenseAreRefused)
{
  EXPECT_THROW(MakePhantom(Options("cow", { 8, 8, 8 })), UsageError);
  EXPECT_THROW(MakePhantom(Options("", { 8, 8, 8 })), UsageError);
  EXPECT_THROW(MakePhantom(Options("ball", { 8, 0, 8 })), UsageError);
  EXPECT_THROW(MakePhantom(Options("ball", { 8, 8, -8 })), UsageError);
  EXPECT_THROW(MakePhantom(Options("ball", { 8, 8, 8 }, { 1, 0, 1 })), UsageError);
  EXPECT_THROW(MakePhantom(Options("ball", { 8, 8, 8 }, { 1, 1, std::numeric_limits<double>::infinity() })),
               UsageError);
  PhantomOptions options = Options("noise", { 8, 8, 8 });
  options.density = 1.5;
  EXPECT_THROW(MakePhantom(options), UsageError);
  options = Options("ball", { 8, 8, 8 });
  options.radius = -1;
  EXPECT_THROW(MakePhantom(options), UsageError);
  options = Options("root", { 80, 80, 80 });
  options.laterals = -1;
  EXPECT_THROW(MakePhantom(options), UsageError);
  EXPECT_THROW(MakePhantom(Options("root", { 2, 2, 2 })), UsageError);
  EXPECT_THROW(RootCentreLines(Options("ball", { 80, 80, 80 })), UsageError);
}

// Otherwise an ellipsoid would keep its size without a word when it is given a radius.
TEST(Phantom, OptionsOfOtherKindsAreRefused)
{
  const auto takes = [](const std::string & kind, auto set) {
    PhantomOptions options = Options(kind, { 40, 40, 40 });
    set(options);
    try
    {
      (void)MakePhantom(options);
      return true;
    }
    catch (const UsageError &)
    {
      return false;
    }
  };
  const auto radius = [](PhantomOptions & options) { options.radius = 8; };
  const auto thickness = [](PhantomOptions & options) { options.thickness = 3; };
  const auto period = [](PhantomOptions & options) { options.period = 9; };
  const auto density = [](PhantomOptions & options) { options.density = 0.4; };
  const auto laterals = [](PhantomOptions & options) { options.laterals = 4; };
  const auto cells = [](PhantomOptions & options) { options.cells = 9; };
  for (const PhantomKind & kind : PhantomKinds())
  {
    const std::string name(kind.name);
    EXPECT_EQ(
      takes(name, radius),
      (std::set<std::string>{ "ball", "capsule", "rod", "torus", "shell", "thick-and-thin", "root", "vessels" }.count(
         name) == 1))
      << name;
    EXPECT_EQ(takes(name, thickness),
              (std::set<std::string>{ "plate", "shell", "gyroid", "thick-and-thin" }.count(name) == 1))
      << name;
    EXPECT_EQ(takes(name, period), name == "gyroid" || name == "porous") << name;
    EXPECT_EQ(takes(name, density), name == "porous" || name == "noise") << name;
    EXPECT_EQ(takes(name, laterals), name == "root") << name;
    EXPECT_EQ(takes(name, cells), name == "cells") << name;
  }
}

TEST(Phantom, PeriodsThatNoGridShowsAreRefused)
{
  for (const char * kind : { "gyroid", "porous" })
  {
    PhantomOptions options = Options(kind, { 16, 16, 16 }, { 0.5, 0.5, 1 });
    options.period = 1;
    EXPECT_NO_THROW(MakePhantom(options)) << kind;
    options.period = 0.99;
    EXPECT_THROW(MakePhantom(options), UsageError) << kind;
    options.period = 1e-300; // so many grains that no memory would hold them
    EXPECT_THROW(MakePhantom(options), UsageError) << kind;
  }
}
