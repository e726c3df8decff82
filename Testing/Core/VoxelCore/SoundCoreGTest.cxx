#include "voxelcore/VoxelCore/SoundCore.h"

#include "VoxelCoreTesting/Cores.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace voxelcore::testing
{
namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** In mm from an origin. */
MedialComplex
Placed(MedialComplex core, const Spacing3 & spacing, double origin)
{
  for (auto & place : core.positions)
  {
    for (std::size_t a = 0; a < 3; ++a)
    {
      place[a] = origin + spacing[a] * place[a];
    }
  }
  return core;
}

TEST(SoundCore, OfEveryCoreTheRadiiAndLengthOfAnEdgeAreSidesOfATriangle)
{
  for (const RandomVolume & volume : RandomVolumes(5900, 24))
  {
    const double        origin = volume.seed % 3 == 0 ? -1e9 : 0;
    const MedialComplex core = Placed(CoreOf(volume.shape, volume.spacing), volume.spacing, origin);
    EXPECT_EQ(FaultOfNumbers(core), "") << volume.seed;
    for (const auto & edge : core.cells.edges)
    {
      const double length = Distance(core.positions[edge[0]], core.positions[edge[1]]);
      const double a = core.radius[edge[0]];
      const double b = core.radius[edge[1]];
      const double slack = 1e-6; // of an origin so far off
      EXPECT_LE(length, a + b + slack) << volume.seed;
      EXPECT_LE(std::abs(a - b), length + slack) << volume.seed;
    }
  }
}

TEST(SoundCore, ThatNoShapeHasAreNamed)
{
  const MedialComplex core = CoreOf(Box({ 9, 7, 5 }));
  ASSERT_GT(core.cells.FaceCount(), 0U);
  ASSERT_EQ(FaultOfNumbers(core), "");
  const auto expect = [&](const char * word, const std::function<void(MedialComplex &)> & change) {
    MedialComplex changed = core;
    change(changed);
    EXPECT_NE(FaultOfNumbers(changed, { .firstPoint = 100 }).find(word), std::string::npos)
      << word << ": '" << FaultOfNumbers(changed, { .firstPoint = 100 }) << "'";
  };
  for (const double value : { -1.0, -1e-300, 1e17, 1e300, kNan, kInfinity, -kInfinity })
  {
    SCOPED_TRACE(value);
    expect("adi", [&](MedialComplex & one) { one.radius.back() = value; });
    if (value < 0 || !(value < kInfinity))
    {
      expect("of its points", [&](MedialComplex & one) { one.vertexLambda.back() = value; });
      expect("of its faces", [&](MedialComplex & one) { one.faceLambda.back() = value; });
    }
    if (value < 0 || value == kInfinity)
    {
      expect("of its edges", [&](MedialComplex & one) { one.edgeLambda.back() = value; });
    }
    if (!(std::abs(value) < 2))
    {
      expect("point", [&](MedialComplex & one) { one.positions.back()[1] = value; });
    }
  }
  expect("point 103", [](MedialComplex & one) { one.radius[3] = -2; });
  // What an edge does not tell, as there is none.
  MedialComplex alone = CoreOf(Box({ 1, 1, 1 }));
  ASSERT_EQ(FaultOfNumbers(alone), "");
  alone.positions.front()[2] = 1e17;
  EXPECT_NE(FaultOfNumbers(alone).find("too far off"), std::string::npos);
}

TEST(SoundCore, OfRefinedOnesRadiiMayVanishButNoneIsFarOff)
{
  MedialComplex core = CoreOf(Box({ 9, 7, 5 }));
  std::fill(core.radius.begin(), core.radius.end() - 1, 0.01);
  EXPECT_NE(FaultOfNumbers(core), "");
  EXPECT_EQ(FaultOfNumbers(core, { .isRefined = true }), "");
  core.radius.front() = 1e17;
  EXPECT_NE(FaultOfNumbers(core, { .isRefined = true }), "");
  core.radius.front() = 1;
  core.positions.front()[0] = 1e17;
  EXPECT_NE(FaultOfNumbers(core, { .isRefined = true }), "");
}

TEST(SoundCore, MayBeOffByWhatWasRounded)
{
  MedialComplex core = CoreOf(Box({ 9, 7, 5 }));
  core.positions.front()[0] += 40;
  EXPECT_NE(FaultOfNumbers(core), "");
  EXPECT_EQ(FaultOfNumbers(core, { .rounding = 40 }), "");
}

} // namespace
} // namespace voxelcore::testing
