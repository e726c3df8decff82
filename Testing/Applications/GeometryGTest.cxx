// Where things lie, from end to end: lone voxels of a scan written by hand are found in the .vtp, at the LPS
// millimetres that a person computes from the numbers of the header.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

using Point = std::array<double, 3>;

/** 7 x 6 x 5 voxels, a lone one of each label: its core is one vertex, its centre. */
constexpr std::array<std::array<std::size_t, 3>, 4> kLone{ { { 0, 0, 0 }, { 5, 1, 3 }, { 6, 5, 4 }, { 2, 4, 0 } } };

std::string
Voxels()
{
  TestScan scan({ 7, 6, 5 });
  for (std::size_t label = 0; label < kLone.size(); ++label)
  {
    const auto & [x, y, z] = kLone[label];
    scan.At(x, y, z) = static_cast<std::uint8_t>(label + 1);
  }
  return { scan.voxels.begin(), scan.voxels.end() };
}

/** The three numbers of a NIfTI header that place its voxels. */
struct NiftiPlace
{
  int                   units = 2;
  int                   qform = 0;
  int                   sform = 0;
  std::array<float, 4>  pixdim{};
  std::array<float, 3>  quaternion{};
  std::array<float, 3>  qoffset{};
  std::array<float, 12> srow{};
};

/** A NIfTI-1 file as https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h lays it out, in this machine's byte
 *  order. */
std::string
NiftiBytes(const NiftiPlace & place, const std::string & voxels)
{
  std::string bytes(352, '\0');
  const auto  put = [&bytes](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof value); };
  put(0, std::int32_t{ 348 });
  for (std::size_t i = 0; i < 4; ++i)
  {
    put(40 + 2 * i, std::array<std::int16_t, 4>{ 3, 7, 6, 5 }[i]);
    put(76 + 4 * i, place.pixdim[i]);
  }
  put(70, std::int16_t{ 2 }); // uint8
  put(72, std::int16_t{ 8 });
  put(108, 352.0F);
  put(123, static_cast<char>(place.units));
  put(252, static_cast<std::int16_t>(place.qform));
  put(254, static_cast<std::int16_t>(place.sform));
  for (std::size_t i = 0; i < 3; ++i)
  {
    put(256 + 4 * i, place.quaternion[i]);
    put(268 + 4 * i, place.qoffset[i]);
  }
  for (std::size_t i = 0; i < 12; ++i)
  {
    put(280 + 4 * i, place.srow[i]);
  }
  std::memcpy(bytes.data() + 344, "n+1", 3);
  return bytes + voxels;
}

/** The array Points of a .vtp with raw appended data: a text header, then behind `_` and the array's offset its length
 *  in bytes as uint64 and its doubles. */
std::vector<Point>
PointsOf(const std::string & path)
{
  const std::string file = UnpackedVtp(ReadAll(path));
  const auto        array = file.find("Name=\"Points\"");
  const auto        offset = file.find("offset=\"", array);
  const auto        data = file.find("<AppendedData encoding=\"raw\">");
  if (array == std::string::npos || offset == std::string::npos || data == std::string::npos)
  {
    ADD_FAILURE() << path << " holds no raw points";
    return {};
  }
  const std::size_t at = file.find('_', data) + 1 + std::stoul(file.substr(offset + 8, 20));
  std::uint64_t     bytes = 0;
  std::memcpy(&bytes, file.data() + at, sizeof bytes);
  std::vector<Point> points(bytes / sizeof(Point));
  std::memcpy(points.data(), file.data() + at + sizeof bytes, bytes);
  return points;
}

struct Case
{
  const char *           name;
  std::string            nrrd; ///< lines on space, directions, origin, units
  NiftiPlace             nifti;
  std::string            meta; ///< lines on spacing, matrix, offset, units
  std::array<double, 12> lps;  ///< rows of the matrix that takes (i, j, k, 1) to LPS mm, by hand
};

std::vector<Case>
Cases()
{
  const auto sform = [](int units, const std::array<float, 4> & pixdim, const std::array<float, 12> & rows) {
    NiftiPlace place;
    place.units = units;
    place.sform = 1;
    place.pixdim = pixdim;
    place.srow = rows;
    return place;
  };
  const auto qform = [](float qfac, const Point & sides, const Point & bcd, const Point & offset) {
    NiftiPlace place;
    place.qform = 1;
    place.pixdim = { qfac };
    for (std::size_t a = 0; a < 3; ++a)
    {
      place.pixdim[a + 1] = static_cast<float>(sides[a]);
      place.quaternion[a] = static_cast<float>(bcd[a]);
      place.qoffset[a] = static_cast<float>(offset[a]);
    }
    return place;
  };
  return {
    { "RAS",
      "space: right-anterior-superior\nspace directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (10,-20,30)\n",
      sform(2, { 1, 2, 3, 4 }, { 2, 0, 0, 10, 0, 3, 0, -20, 0, 0, 4, 30 }),
      "TransformMatrix = -1 0 0 0 -1 0 0 0 1\nOffset = -10 20 30\nElementSpacing = 2 3 4\n",
      { -2, 0, 0, -10, 0, -3, 0, 20, 0, 0, 4, 30 } },
    { "LPS",
      "space: left-posterior-superior\nspace directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (10,-20,30)\n",
      sform(2, { 1, 2, 3, 4 }, { -2, 0, 0, -10, 0, -3, 0, 20, 0, 0, 4, 30 }),
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 -20 30\nElementSpacing = 2 3 4\n",
      { 2, 0, 0, 10, 0, 3, 0, -20, 0, 0, 4, 30 } },
    // Axes that change places: i runs to the feet, j to the left, k to the back.
    { "permuted",
      "space: left-posterior-superior\nspace directions: (0,0,-2) (3,0,0) (0,4,0)\nspace origin: (1,2,3)\n",
      sform(2, { 1, 2, 3, 4 }, { 0, -3, 0, -1, 0, 0, -4, -2, -2, 0, 0, 3 }),
      "TransformMatrix = 0 0 -1 1 0 0 0 1 0\nOffset = 1 2 3\nElementSpacing = 2 3 4\n",
      { 0, 3, 0, 1, 0, 0, 4, 2, -2, 0, 0, 3 } },
    // A turn about the body's axis whose cosine is 0.8 and whose sine is 0.6. In RAS it is 180 degrees more: the
    // quaternion's a = sqrt(0.1), d = -sqrt(0.9).
    { "oblique",
      "space: left-posterior-superior\nspace directions: (0.4,0.3,0) (-0.9,1.2,0) (0,0,2.5)\nspace origin: (7,8,9)\n",
      qform(1, { 0.5, 1.5, 2.5 }, { 0, 0, -std::sqrt(0.9) }, { -7, -8, 9 }),
      "TransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 1\nOffset = 7 8 9\nElementSpacing = 0.5 1.5 2.5\n",
      { 0.4, -0.9, 0, 7, 0.3, 1.2, 0, 8, 0, 0, 2.5, 9 } },
    // RAS diag(-2, -3, -4) is half a turn about the body's axis, then the third axis reversed by qfac.
    { "left-handed",
      "space: left-posterior-superior\nspace directions: (2,0,0) (0,3,0) (0,0,-4)\nspace origin: (10,20,30)\n",
      qform(-1, { 2, 3, 4 }, { 0, 0, 1 }, { -10, -20, 30 }),
      "TransformMatrix = 1 0 0 0 1 0 0 0 -1\nOffset = 10 20 30\nElementSpacing = 2 3 4\n",
      { 2, 0, 0, 10, 0, 3, 0, 20, 0, 0, -4, 30 } },
    { "micron",
      "space: left-posterior-superior\nspace directions: (500,0,0) (0,600,0) (0,0,750)\nspace origin: "
      "(1000,2000,3000)\nspace units: \"um\" \"um\" \"um\"\n",
      sform(3, { 1, 500, 600, 750 }, { -500, 0, 0, -1000, 0, -600, 0, -2000, 0, 0, 750, 3000 }),
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1000 2000 3000\nElementSpacing = 500 600 750\nDistanceUnits = "
      "um\n",
      { 0.5, 0, 0, 1, 0, 0.6, 0, 2, 0, 0, 0.75, 3 } },
  };
}

} // namespace

TEST(Geometry, LoneVoxelsLieInTheResultWhereTheHeaderPutsThem)
{
  const TemporaryFolder folder;
  const std::string     voxels = Voxels();
  for (const Case & one : Cases())
  {
    WriteNrrd(folder / "a.nrrd", "type: uint8\ndimension: 3\nsizes: 7 6 5\n" + one.nrrd, voxels);
    WriteAll(folder / "a.nii", NiftiBytes(one.nifti, voxels));
    WriteAll(folder / "a.mha",
             "ObjectType = Image\nNDims = 3\nDimSize = 7 6 5\n" + one.meta +
               "ElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + voxels);
    for (const char * file : { "a.nrrd", "a.nii", "a.mha" })
    {
      SCOPED_TRACE(std::string(one.name) + ", " + file);
      const std::string   result = folder / "core.vtp";
      const ProgramResult run = RunProgram({ "core", folder / file, "--lambda", "0", "-o", result, "--force" });
      ASSERT_EQ(run.code, 0) << run.error;
      const auto points = PointsOf(result);
      ASSERT_EQ(points.size(), kLone.size());
      for (std::size_t p = 0; p < points.size(); ++p)
      {
        for (std::size_t c = 0; c < 3; ++c)
        {
          const double * row = one.lps.data() + 4 * c;
          const double   expected = row[0] * static_cast<double>(kLone[p][0]) +
                                  row[1] * static_cast<double>(kLone[p][1]) +
                                  row[2] * static_cast<double>(kLone[p][2]) + row[3];
          // NIfTI-1 has single precision.
          EXPECT_NEAR(points[p][c], expected, std::string(file) == "a.nii" ? 4e-6 : 1e-12) << "label " << p + 1;
        }
      }
      const ProgramResult verified = RunProgram({ "verify", folder / file, result });
      EXPECT_EQ(verified.code, 0) << verified.output << verified.error;
    }
  }
}

TEST(Geometry, ACropMovesNothing)
{
  // The voxel (5,1,3) alone, at 10 + 2 * 5, -20 + 3 * 1, 30 + 4 * 3.
  const TemporaryFolder folder;
  const Case            lps = Cases()[1];
  WriteNrrd(folder / "a.nrrd", "type: uint8\ndimension: 3\nsizes: 7 6 5\n" + lps.nrrd, Voxels());
  const ProgramResult run =
    RunProgram({ "core", folder / "a.nrrd", "--crop", "4:6,1:3,2:", "--lambda", "0", "-o", folder / "core.vtp" });
  ASSERT_EQ(run.code, 0) << run.error;
  const auto points = PointsOf(folder / "core.vtp");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0], (Point{ 20, -17, 42 }));
}

} // namespace voxelcore::testing
