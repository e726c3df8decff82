#include "voxelcore/Formats/ScanFile.h"
#include "ScanBytes.h"
#include "VoxelCoreTesting/Messages.h"

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ScanFile, WarningsNameTheScan)
{
  ScanFile scan;
  scan.path = "/data/a.nrrd";
  scan.warnings = { "odd", "odder" };
  EXPECT_EQ(WarningsOf(scan), (std::vector<std::string>{ "a.nrrd: odd", "a.nrrd: odder" }));
  scan.path = "/data/slices/";
  EXPECT_EQ(WarningsOf(scan).front(), "slices: odd");
}

TEST(ScanFile, AVolumeOfSeveralMustBeChosenAndBeThere)
{
  ReadOptions options;
  EXPECT_EQ(ChooseVolume("a.nii", 1, options), 0U);
  EXPECT_NE(MessageOf([&] { ChooseVolume("a.nii", 3, options); }).find("--volume 0 to --volume 2"), std::string::npos);
  options.volume = 2;
  EXPECT_EQ(ChooseVolume("a.nii", 3, options), 2U);
  for (const std::int64_t wrong : { -1, 3 })
  {
    options.volume = wrong;
    const std::string text = MessageOf([&] { ChooseVolume("a.nii", 3, options); });
    EXPECT_NE(text.find("no volume " + std::to_string(wrong)), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(ScanFile, AComponentOfSeveralMustBeChosenAndBeThere)
{
  ReadOptions options;
  EXPECT_EQ(ChooseComponent("a.tif", 1, "colour image", options), 0U);
  EXPECT_NE(MessageOf([&] { ChooseComponent("a.tif", 3, "colour image", options); }).find("colour image (3 values"),
            std::string::npos);
  options.component = 2;
  EXPECT_EQ(ChooseComponent("a.tif", 3, "colour image", options), 2U);
  for (const std::int64_t wrong : { -1, 3 })
  {
    options.component = wrong;
    EXPECT_FALSE(MessageOf([&] { ChooseComponent("a.tif", 3, "colour image", options); }).empty());
  }
}

TEST(ScanFile, ItsGeometryIsTheHeadersUnlessTheUserGivesAnother)
{
  const std::array<Vector3, 3> axes{ { { 0, 1, 0 }, { -1, 0, 0 }, { 0, 0, 1 } } };
  ScanFile                     scan;
  scan.path = "a.nrrd";
  scan.geometry.size = { 4, 5, 6 };
  ReadOptions options;
  SetGeometry(scan, axes, { 1, 2, 3 }, { 7, 8, 9 }, options);
  ExpectNear(scan.geometry.spacing, { 1, 2, 3 });
  ExpectNear(scan.geometry.origin, { 7, 8, 9 });
  ExpectNear({ scan.geometry.direction[0], scan.geometry.direction[3], scan.geometry.direction[6] }, axes[0]);
  options.spacing = Vector3{ 0.5, 0.5, 0.5 };
  SetGeometry(scan, axes, { 1, 2, 3 }, { 7, 8, 9 }, options);
  ExpectNear(scan.geometry.spacing, { 0.5, 0.5, 0.5 });
  EXPECT_FALSE(MessageOf([&] { SetGeometry(scan, axes, { 1, 2, -3 }, { 7, 8, 9 }, {}); }).empty());
  EXPECT_FALSE(MessageOf([&] { SetGeometry(scan, { axes[0], axes[0], axes[2] }, { 1, 2, 3 }, {}, {}); }).empty());
}
