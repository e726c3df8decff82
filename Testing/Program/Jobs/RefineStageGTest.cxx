#include "JobFolder.h"

#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Jobs/RefineStage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore::testing
{
namespace
{

class RefineStage : public JobFolder
{
protected:
  SurfaceSource
  Source(const RefineOptions & refine, const std::string & scan, const ReadOptions & reading = {}) const
  {
    return MakeSurfaceSource(refine, At(scan), reading, ReadScanOrMesh(At(scan), reading, {}));
  }
  static RefineOptions
  From(const std::string & surface)
  {
    RefineOptions options;
    options.surface = surface;
    return options;
  }
  /** A ball of 12 voxels across, whose values fall off by 10 a voxel from 160 in its middle; origin along x. */
  void
  GreyBall(const std::string & name, double origin = 0) const
  {
    std::string bytes =
      "NRRD0005\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 20 20 20\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (" +
      std::to_string(origin) + ",0,0)\nencoding: raw\n\n";
    for (int i = 0; i < 20 * 20 * 20; ++i)
    {
      const double d = std::hypot(i % 20 - 9.5, i / 20 % 20 - 9.5, i / 400 - 9.5);
      bytes += static_cast<char>(static_cast<std::uint8_t>(std::max(0.0, 160 - 10 * d)));
    }
    WriteAll(At(name), bytes);
  }
};

TEST_F(RefineStage, NothingIsRefinedUnlessAsked)
{
  Phantom("ball", "a.nrrd");
  EXPECT_FALSE(Source({}, "a.nrrd"));
}

TEST_F(RefineStage, LabelsAndGreyValuesGiveASurfaceForAShape)
{
  GreyBall("grey.nrrd");
  ReadOptions reading;
  reading.threshold = { 100, std::numeric_limits<double>::infinity() };
  const VoxelShape shape = ReadLabelVolume(At("grey.nrrd"), reading).labels.at(0).shape;
  for (const char * surface : { "labels", "grey" })
  {
    const SurfaceSource source = Source(From(surface), "grey.nrrd", reading);
    ASSERT_TRUE(source) << surface;
    EXPECT_TRUE(source(shape, {}, {})) << surface;
  }
  // Grey values of another file around labels.
  Phantom("ball", "labels.nrrd");
  RefineOptions other = From("grey");
  other.grey = At("grey.nrrd");
  other.greyRange = { 100, 255 };
  EXPECT_TRUE(Source(other, "labels.nrrd")(shape, {}, {}));
}

TEST_F(RefineStage, GreyValuesInMemoryAreThoseOfTheFile)
{
  GreyBall("grey.nrrd");
  ReadOptions reading;
  reading.threshold = { 100, std::numeric_limits<double>::infinity() };
  reading.crop = CropRange{ { 1, 2, 0 }, { 19, 20, 20 } };
  const VoxelShape    shape = ReadLabelVolume(At("grey.nrrd"), reading).labels.at(0).shape;
  const SurfaceSource ofFile = Source(From("grey"), "grey.nrrd", reading);
  InputScan           scan = ReadScanOrMesh(At("grey.nrrd"), reading, {});
  const VoxelBox      part = PartRead(scan);
  EXPECT_EQ(part.lower, (std::array<std::int32_t, 3>{ 1, 2, 0 }));
  EXPECT_EQ(part.size, (std::array<std::int32_t, 3>{ 18, 18, 20 }));
  const GreyVolume values = ReadGreyVolume(At("grey.nrrd"), part, reading);
  scan.greyRows = [&](std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> row) {
    ASSERT_GE(x, part.lower[0]);
    ASSERT_LE(x + static_cast<std::int32_t>(row.size()), part.lower[0] + part.size[0]);
    std::copy_n(values.Row(x, y, z), row.size(), row.begin());
  };
  const SurfaceSource ofMemory = MakeSurfaceSource(From("grey"), "no such file", reading, scan);
  const auto          one = ofFile(shape, {}, {}), other = ofMemory(shape, {}, {});
  int                 known = 0;
  for (double x = 2; x < 18; x += 1.7)
  {
    const SurfacePoint found = one->Project({ x, 9, 4.5 }, 3), again = other->Project({ x, 9, 4.5 }, 3);
    EXPECT_EQ(found.found, again.found) << x;
    EXPECT_EQ(found.position, again.position) << x;
    known += found.found ? 1 : 0;
  }
  EXPECT_GT(known, 2);
}

TEST_F(RefineStage, WhatTheInputDoesNotHaveIsRefused)
{
  Phantom("ball", "a.nrrd");
  GreyBall("grey.nrrd");
  EXPECT_THROW(Source(From("grey"), "a.nrrd"), UsageError) << "no threshold";
  EXPECT_THROW(Source(From("mesh"), "a.nrrd"), UsageError) << "no mesh";
  RefineOptions rangeless = From("grey");
  rangeless.grey = At("grey.nrrd");
  EXPECT_THROW(Source(rangeless, "a.nrrd"), UsageError) << "grey values without a range";
  constexpr double infinity = std::numeric_limits<double>::infinity();
  rangeless.greyRange = { -infinity, infinity };
  EXPECT_THROW(Source(rangeless, "a.nrrd"), UsageError) << "a range without an end";
}

TEST_F(RefineStage, AGreyScanElsewhereIsRefused)
{
  Phantom("ball", "a.nrrd");
  const VoxelShape shape = ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape;
  RefineOptions    options = From("grey");
  options.greyRange = { 100, 255 };
  for (const auto & [origin, fits] :
       std::vector<std::pair<double, bool>>{ { 0, true }, { 1e-4, true }, { 0.5, false } })
  {
    GreyBall("grey.nrrd", origin);
    options.grey = At("grey.nrrd");
    const SurfaceSource source = Source(options, "a.nrrd");
    if (fits)
    {
      EXPECT_NO_THROW(source(shape, {}, {})) << origin;
    }
    else
    {
      EXPECT_THROW(source(shape, {}, {}), InputError) << origin;
    }
  }
}

TEST_F(RefineStage, AMeshIsTheSurfaceOfEveryShapeOfItWhereverThatIsLookedAtFrom)
{
  BoxMesh("part.off");
  const InputScan input = ReadScanOrMesh(At("part.off"), {}, 12);
  const auto      source = MakeSurfaceSource(From("mesh"), At("part.off"), {}, input);
  const auto      surface = source(input.labels.at(0).shape, {}, {});
  const auto      moved = source(VoxelShape(), { 1, 2, 3 }, {});
  ASSERT_TRUE(surface);
  ASSERT_TRUE(moved);
  const Vector3 &    spacing = input.geometry.spacing;
  const auto &       first = input.labels.at(0).shape.Box().lower;
  const Vector3      corner{ first[0] * spacing[0], (first[1] + 5) * spacing[1], (first[2] + 5) * spacing[2] };
  const SurfacePoint here = surface->Project(corner, 2 * spacing[0]);
  const SurfacePoint there =
    moved->Project({ corner[0] - spacing[0], corner[1] - 2 * spacing[1], corner[2] - 3 * spacing[2] }, 2 * spacing[0]);
  ASSERT_TRUE(here.found);
  ASSERT_TRUE(there.found);
  EXPECT_NEAR(there.position[0] + spacing[0], here.position[0], 1e-9);
}

} // namespace
} // namespace voxelcore::testing
