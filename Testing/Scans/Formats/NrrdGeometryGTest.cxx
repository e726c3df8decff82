#include "NrrdFixtures.h"

#include <cmath>

using namespace voxelcore;
using namespace voxelcore::testing;
using namespace voxelcore::testing::nrrd;

TEST(NrrdGeometry, SpacesAreTurnedToLps)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  // Voxel (2,1,1) lies at origin + 2 a + b + c in the file's space.
  const auto lines = [](const std::string & space) {
    auto l = With(Lines(), "space", space);
    l = With(l, "space directions", "(2,0,0) (0,3,0) (0,0,4)");
    return With(l, "space origin", "(10,20,30)");
  };
  const auto centre = [&](const std::string & space) {
    return CentreOf(ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines(space), data))), 2, 1, 1);
  };
  ExpectNear(centre("left-posterior-superior"), { 14, 23, 34 });
  ExpectNear(centre("RAS"), { -14, -23, 34 });
  ExpectNear(centre("left-anterior-superior"), { 14, -23, 34 });
}

TEST(NrrdGeometry, ObliqueAndLeftHandedAxesAreKept)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  auto              lines = With(Lines(), "space directions", "(1.2,1.6,0) (-2.4,1.8,0) (0,0,-0.5)"); // 3-4-5 triangles
  lines = With(lines, "space origin", "(1,2,3)");
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, data)));
  ExpectNear(volume.geometry.spacing, { 2, 3, 0.5 }, 1e-12);
  ExpectNear(CentreOf(volume, 2, 1, 1), { 1 + 2.4 - 2.4, 2 + 3.2 + 1.8, 2.5 }, 1e-12);
  EXPECT_TRUE(IsLeftHanded(volume.geometry));
}

TEST(NrrdGeometry, MicrometresBecomeMillimetres)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  auto              lines = With(Lines(), "space units", R"("um" "um" "um")");
  lines = With(lines, "space directions", "(5,0,0) (0,5,0) (0,0,10)");
  lines = With(lines, "space origin", "(1000,2000,3000)");
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, data)));
  ExpectNear(volume.geometry.spacing, { 0.005, 0.005, 0.01 }, 1e-15);
  ExpectNear(CentreOf(volume, 2, 1, 1), { 1.010, 2.005, 3.010 }, 1e-12);
  EXPECT_TRUE(HasNote(volume.notes, "um"));
  ExpectRefused(folder.Write("b.nrrd", Nrrd(With(lines, "space units", R"("um" "um" "furlong")"), data)),
                { "furlong", "--spacing" });
}

TEST(NrrdGeometry, SkewedAxesAreRefusedWithTheirDeviationUnlessAccepted)
{
  const TempFolder  folder;
  const std::string data = RawAll<std::uint8_t>(kValues);
  // j leans by atan(0.1) = 5.71059 degrees towards i.
  const auto path = folder.Write("a.nrrd", Nrrd(With(Lines(), "space directions", "(2,0,0) (0.1,1,0) (0,0,1)"), data));
  ExpectRefused(path, { "5.71059 degrees", "--orthonormalize" });
  ReadOptions accept;
  accept.orthonormalize = true;
  const LabelMap volume = ReadLabelVolume(path, accept);
  EXPECT_TRUE(HasNote(volume.notes, "5.71059 degrees"));
  // The nearest orthonormal pair shares the lean: both axes turn by half of it.
  const double half = std::atan(0.1) / 2;
  const auto & d = volume.geometry.direction;
  EXPECT_NEAR(d[0], std::cos(half), 1e-12);
  EXPECT_NEAR(d[3], -std::sin(half), 1e-12);
  EXPECT_NEAR(d[1], std::sin(half), 1e-12);
  EXPECT_NEAR(d[4], std::cos(half), 1e-12);
  EXPECT_NEAR(volume.geometry.spacing[1], std::sqrt(1.01), 1e-12);
}

TEST(NrrdGeometry, AlmostRightAnglesWithinATenThousandthAreTaken)
{
  const TempFolder folder;
  const auto       lines = With(Lines(), "space directions", "(1,0,0) (0.00009,1,0) (0,0,1)");
  EXPECT_NO_THROW(ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues)))));
  const auto more = With(Lines(), "space directions", "(1,0,0) (0.00011,1,0) (0,0,1)");
  ExpectRefused(folder.Write("b.nrrd", Nrrd(more, RawAll<std::uint8_t>(kValues))), { "0.0063", "degrees" });
}

TEST(NrrdGeometry, SingularAxesAreRefusedAlways)
{
  const TempFolder folder;
  const auto       lines = With(Lines(), "space directions", "(1,0,0) (1,0,0) (0,0,1)");
  ReadOptions      accept;
  accept.orthonormalize = true;
  ExpectRefused(folder.Write("a.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues))), { "one plane" }, accept);
  const auto zero = With(Lines(), "space directions", "(1,0,0) (0,0,0) (0,0,1)");
  ExpectRefused(folder.Write("b.nrrd", Nrrd(zero, RawAll<std::uint8_t>(kValues))), { "axis j", "is 0" });
  const auto nan = With(Lines(), "space directions", "(1,0,0) (0,nan,0) (0,0,1)");
  ExpectRefused(folder.Write("c.nrrd", Nrrd(nan, RawAll<std::uint8_t>(kValues))), { "axis j" });
}

TEST(NrrdGeometry, SpacingsWithoutDirectionsAreKeptAndNoted)
{
  const TempFolder folder;
  auto             lines = With(With(Lines(), "space directions", ""), "space", "");
  lines = With(With(lines, "space origin", ""), "spacings", "0.5 0.25 2");
  const LabelMap volume = ReadLabelVolume(folder.Write("a.nrrd", Nrrd(lines, RawAll<std::uint8_t>(kValues))));
  ExpectNear(volume.geometry.spacing, { 0.5, 0.25, 2 });
  EXPECT_EQ(volume.geometry.direction, (std::array<double, 9>{ 1, 0, 0, 0, 1, 0, 0, 0, 1 }));
  EXPECT_TRUE(HasNote(volume.notes, "spacings but no directions"));
  const LabelMap bare =
    ReadLabelVolume(folder.Write("b.nrrd", Nrrd(With(lines, "spacings", ""), RawAll<std::uint8_t>(kValues))));
  EXPECT_TRUE(HasNote(bare.warnings, "b.nrrd: no voxel size in the file: all lengths are in voxels"));
  for (const char * bad : { "0.5 0 2", "0.5 -1 2", "0.5 nan 2" })
  {
    const auto path = folder.Write("c.nrrd", Nrrd(With(lines, "spacings", bad), RawAll<std::uint8_t>(kValues)));
    ExpectRefused(path, { "axis j", "--spacing" });
    ReadOptions given;
    given.spacing = Vector3{ 1, 2, 3 };
    ExpectNear(ReadLabelVolume(path, given).geometry.spacing, { 1, 2, 3 });
  }
}
