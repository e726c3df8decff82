#include "voxelcore/Formats/StatedSpacing.h"
#include "ScanBytes.h"

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(StatedSpacing, InFullIsTakenAndItsSourceNoted)
{
  ScanFile      scan;
  StatedSpacing stated{ { 0.5, 0.75, 2.0 }, "ImageJ" };
  ExpectNear(CompleteSpacing(stated, {}, scan), { 0.5, 0.75, 2 });
  EXPECT_TRUE(HasNote(scan.notes, "from ImageJ"));
  EXPECT_TRUE(scan.warnings.empty());
  EXPECT_EQ(scan.geometry.unit, SpatialUnit::Millimetres);
}

TEST(StatedSpacing, WithoutADistanceOfSlicesIsCubicWithAWarning)
{
  ScanFile      scan;
  StatedSpacing stated{ { 0.5, 0.75, std::nullopt }, "resolution tags" };
  ExpectNear(CompleteSpacing(stated, {}, scan), { 0.5, 0.75, 0.5 });
  ASSERT_EQ(scan.warnings.size(), 1U);
  EXPECT_TRUE(HasNote(scan.warnings, "not the distance between slices"));
  EXPECT_EQ(scan.geometry.unit, SpatialUnit::Millimetres);
}

TEST(StatedSpacing, WithoutTheSizeOfAPixelLengthsAreInVoxels)
{
  for (const auto & mm :
       { std::array<std::optional<double>, 3>{}, { std::nullopt, 1.0, 1.0 }, { 1.0, std::nullopt, 1.0 } })
  {
    ScanFile      scan;
    StatedSpacing stated{ mm, "", "unit 'furlong' is unknown" };
    ExpectNear(CompleteSpacing(stated, {}, scan), { 1, 1, 1 });
    EXPECT_EQ(scan.geometry.unit, SpatialUnit::Voxels);
    EXPECT_TRUE(HasNote(scan.warnings, "--spacing"));
    EXPECT_TRUE(HasNote(scan.notes, "furlong"));
  }
}

TEST(StatedSpacing, GivenByTheUserNeedsNoWarning)
{
  ScanFile    scan;
  ReadOptions options;
  options.spacing = Vector3{ 1, 1, 3 };
  CompleteSpacing({}, options, scan);
  EXPECT_TRUE(scan.warnings.empty());
  EXPECT_EQ(scan.geometry.unit, SpatialUnit::Millimetres);
}
