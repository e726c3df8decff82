#include "Models/Models/ModelFixtures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/ReadMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <map>

namespace voxelcore::testing
{
namespace
{

/** Four corners, of coordinates that single precision and six digits do not hold. */
const std::vector<Vector3> kCorners{ { 0, 0, 0 },
                                     { 1.0 / 3, 0, 0 },
                                     { 0, 1e-7, 1 },
                                     { 0.1, 1.25, 12345.678901234567 } };

/** A tetrahedron, the corners of each side counter-clockwise seen from outside. */
const std::vector<std::array<std::uint32_t, 3>> kSides{ { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };

std::string
Digits(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string
Rows(const std::string & before)
{
  std::string text;
  for (const Vector3 & p : kCorners)
  {
    text += before + Digits(p[0]) + " " + Digits(p[1]) + " " + Digits(p[2]) + "\n";
  }
  return text;
}

std::string
AsOff()
{
  std::string text = "OFF\n4 4 6\n" + Rows("");
  for (const auto & side : kSides)
  {
    text += "3 " + std::to_string(side[0]) + " " + std::to_string(side[1]) + " " + std::to_string(side[2]) + "\n";
  }
  return text;
}

/** Two sides by places from the end, with texture and normal behind slashes. */
std::string
AsObj()
{
  std::string text = "# a tetrahedron\n" + Rows("v ") + "vn 0 0 1\nvt 0 0\n";
  for (std::size_t i = 0; i < kSides.size(); ++i)
  {
    text += "f";
    for (const std::uint32_t corner : kSides[i])
    {
      text += " " + (i < 2 ? std::to_string(static_cast<int>(corner) - 4) : std::to_string(corner + 1)) + "/1/1";
    }
    text += "\n";
  }
  return text;
}

template <typename T>
void
Append(std::string & bytes, T value, bool isBig)
{
  char at[sizeof(T)];
  std::memcpy(at, &value, sizeof(T));
  if (isBig == (std::endian::native == std::endian::little))
  {
    std::reverse(at, at + sizeof(T));
  }
  bytes.append(at, sizeof(T));
}

/** In text, or binary of either byte order. */
std::string
AsPly(const std::string & format)
{
  std::string text = "ply\nformat " + format +
                     " 1.0\ncomment made by hand\nelement vertex 4\nproperty double x\nproperty double y\n"
                     "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  if (format == "ascii")
  {
    const std::string off = AsOff();
    return text + off.substr(std::strlen("OFF\n4 4 6\n"));
  }
  const bool isBig = format == "binary_big_endian";
  for (const Vector3 & p : kCorners)
  {
    for (const double coordinate : p)
    {
      Append(text, coordinate, isBig);
    }
  }
  for (const auto & side : kSides)
  {
    Append(text, std::uint8_t{ 3 }, isBig);
    for (const std::uint32_t corner : side)
    {
      Append(text, corner, isBig);
    }
  }
  return text;
}

std::string
AsStlText()
{
  std::string text = "solid made by hand\n";
  for (const auto & side : kSides)
  {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t corner : side)
    {
      const Vector3 & p = kCorners[corner];
      text += "vertex " + Digits(p[0]) + " " + Digits(p[1]) + " " + Digits(p[2]) + "\n";
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid made by hand\n";
}

/** Single precision is all it has. */
std::string
AsStlBinary()
{
  std::string bytes(80, ' ');
  Append(bytes, std::uint32_t{ 4 }, false);
  for (const auto & side : kSides)
  {
    bytes.append(12, '\0');
    for (const std::uint32_t corner : side)
    {
      for (const double coordinate : kCorners[corner])
      {
        Append(bytes, static_cast<float>(coordinate), false);
      }
    }
    bytes.append(2, '\0');
  }
  return bytes;
}

const std::map<std::string, std::string> &
AllForms()
{
  static const std::map<std::string, std::string> forms{ { "a.off", AsOff() },
                                                         { "a.obj", AsObj() },
                                                         { "text.ply", AsPly("ascii") },
                                                         { "little.ply", AsPly("binary_little_endian") },
                                                         { "big.PLY", AsPly("binary_big_endian") },
                                                         { "text.stl", AsStlText() },
                                                         { "binary.stl", AsStlBinary() } };
  return forms;
}

/** The words of the refusal; nothing where it is read. */
std::string
Refusal(const std::filesystem::path & path)
{
  try
  {
    ReadMesh(path);
  }
  catch (const InputError & error)
  {
    const std::string what = error.what();
    EXPECT_NE(what.find(path.string()), std::string::npos) << what;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  }
  return "";
}

TEST(ReadMesh, CoordinatesAreReadInFullPrecisionFromEveryFormat)
{
  const TemporaryFolder folder;
  for (const auto & [name, bytes] : AllForms())
  {
    WriteAll(folder / name, bytes);
    const MeshFile read = ReadMesh(folder / name);
    EXPECT_EQ(read.polygons, 0U) << name;
    EXPECT_FALSE(read.mayBeCut) << name;
    ASSERT_EQ(read.mesh.triangles.size(), 4U) << name;
    for (std::size_t side = 0; side < 4; ++side)
    {
      for (std::size_t corner = 0; corner < 3; ++corner)
      {
        const Vector3 & found = read.mesh.points.at(read.mesh.triangles[side][corner]);
        const Vector3 & expected = kCorners[kSides[side][corner]];
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          EXPECT_EQ(found[axis],
                    name == "binary.stl" ? static_cast<double>(static_cast<float>(expected[axis])) : expected[axis])
            << name << ", side " << side;
        }
      }
    }
  }
}

TEST(ReadMesh, FormatsAreNamedAndKnownByTheirExtensionInAnyCase)
{
  const TemporaryFolder folder;
  for (const auto & [name, bytes] : AllForms())
  {
    WriteAll(folder / name, bytes);
    const std::string extension = name.substr(name.find('.') + 1);
    std::string       expected = extension;
    std::transform(expected.begin(), expected.end(), expected.begin(), [](char c) {
      return static_cast<char>(std::toupper(c));
    });
    EXPECT_EQ(ReadMesh(folder / name).format, expected);
  }
  for (const char * name : { "a.stl", "b/a.OBJ", "a.Ply", "a.off", "a.vtk", "a.b.vtp" })
  {
    EXPECT_TRUE(IsMeshPath(name)) << name;
  }
  for (const char * name : { "a.stl.gz", "stl", "", ".stl", "a.nrrd", "a.vtu", "a.off/b" })
  {
    EXPECT_FALSE(IsMeshPath(name)) << name;
  }
}

TEST(ReadMesh, PolygonsBecomeFans)
{
  const TemporaryFolder folder;
  const std::string     corners = "0 0 0\n1 0 0\n2 1 0\n1 2 0\n0 1 0\n";
  WriteAll(folder / "a.off", "OFF\n5 2 0\n" + corners + "5 0 1 2 3 4\n3 0 1 2\n");
  const MeshFile read = ReadMesh(folder / "a.off");
  EXPECT_EQ(read.polygons, 1U);
  // Over the same area, in the same sense: half the cross products add up to those of the polygon.
  double area = 0;
  for (std::size_t t = 0; t + 1 < read.mesh.triangles.size(); ++t)
  {
    const auto at = [&](int corner) {
      return read.mesh.points[read.mesh.triangles[t][static_cast<std::size_t>(corner)]];
    };
    const double twice = (at(1)[0] - at(0)[0]) * (at(2)[1] - at(0)[1]) - (at(1)[1] - at(0)[1]) * (at(2)[0] - at(0)[0]);
    EXPECT_GT(twice, 0);
    area += twice / 2;
  }
  EXPECT_EQ(read.mesh.triangles.size(), 4U);
  EXPECT_DOUBLE_EQ(area, 2.5);
}

TEST(ReadMesh, WhatIsCutOffIsRefusedOrSaidToBe)
{
  const TemporaryFolder folder;
  for (const auto & [name, bytes] : AllForms())
  {
    for (std::size_t length = 0; length + 2 < bytes.size(); length += length + 60 < bytes.size() ? 7 : 1)
    {
      WriteAll(folder / name, bytes.substr(0, length));
      if (Refusal(folder / name).empty())
      {
        // Of STL only the name behind "endsolid" may be missing. OBJ does not say how long it is: after a whole line
        // nothing is amiss.
        const MeshFile read = ReadMesh(folder / name);
        const bool     isLine = bytes[length - 1] == '\n' || bytes[length] == '\n';
        EXPECT_TRUE(read.mesh.triangles.size() == 4 || (name == "a.obj" && (isLine || read.mayBeCut)))
          << name << ' ' << length;
        EXPECT_TRUE(name == "a.obj" || name == "text.stl") << name << ' ' << length;
      }
    }
  }
}

TEST(ReadMesh, NumbersThatAreNoneAndCornersThatAreNoPointsAreRefused)
{
  const TemporaryFolder folder;
  for (const auto & [name, bytes] : AllForms())
  {
    const auto at = bytes.find("12345.678901234567");
    if (at == std::string::npos)
    {
      continue;
    }
    for (const char * number : { "nan", "inf", "-inf", "1e999", "0x10", "1,5", "--1" })
    {
      std::string damaged = bytes;
      damaged.replace(at, 18, number);
      WriteAll(folder / name, damaged);
      EXPECT_NE(Refusal(folder / name), "") << name << ' ' << number;
    }
  }
  for (const char * corners : { "0 1 4", "0 1 -1", "0 1", "0 1 4294967296", "0 1 x" })
  {
    WriteAll(folder / "a.off", "OFF\n4 1 0\n" + Rows("") + "3 " + corners + "\n");
    EXPECT_NE(Refusal(folder / "a.off"), "") << corners;
  }
  for (const char * corners : { "0 1 2", "1 2 5", "1 2 -5", "1 2" })
  {
    WriteAll(folder / "a.obj", Rows("v ") + "f " + corners + "\n");
    EXPECT_NE(Refusal(folder / "a.obj"), "") << corners;
  }
}

TEST(ReadMesh, PlyThatPromisesPointsWithoutCoordinatesIsRefused)
{
  const TemporaryFolder folder;
  for (const char * format : { "ascii", "binary_little_endian" })
  {
    WriteAll(folder / "a.ply",
             std::string("ply\nformat ") + format +
               " 1.0\nelement vertex 858993460\nelement face 1\n"
               "property list uchar int vertex_indices\nend_header\n" +
               (*format == 'a' ? "3 0 1 2\n" : std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13)));
    EXPECT_NE(Refusal(folder / "a.ply").find("vertex 0: it has no x, y and z"), std::string::npos) << format;
  }
}

TEST(ReadMesh, PlyWithListsLongerThanTheirTypeOfCountIsRefused)
{
  const TemporaryFolder folder;
  for (const char * count : { "-1", "4294967296", "9223372036854775807" })
  {
    WriteAll(folder / "a.ply",
             "ply\nformat ascii 1.0\nelement other 1\nproperty list uint uchar values\nend_header\n" +
               std::string(count) + " 1 2\n");
    EXPECT_NE(Refusal(folder / "a.ply").find("other 0: a list of " + std::string(1, *count)), std::string::npos);
  }
}

TEST(ReadMesh, WhatIsNoMeshIsRefusedByName)
{
  const TemporaryFolder folder;
  EXPECT_NE(Refusal(folder / "none.stl").find("there is no such file"), std::string::npos);
  EXPECT_NE(Refusal(folder.Path()).find("it is not a file"), std::string::npos);
  WriteAll(folder / "a.txt", AsOff());
  EXPECT_NE(Refusal(folder / "a.txt").find("unknown extension"), std::string::npos);
  WriteAll(folder / "points.obj", Rows("v "));
  EXPECT_NE(Refusal(folder / "points.obj").find("it has no triangles"), std::string::npos);
  for (const char * name : { "a.stl", "a.obj", "a.ply", "a.off", "a.vtk", "a.vtp" })
  {
    WriteAll(folder / name, "");
    EXPECT_NE(Refusal(folder / name).find("it is empty"), std::string::npos) << name;
    WriteAll(folder / name, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
    EXPECT_NE(Refusal(folder / name), "") << name;
  }
}

} // namespace
} // namespace voxelcore::testing
