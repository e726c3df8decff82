// Meshes in VTK's formats: every form VTK writes reads as the same mesh, and damaged files are refused in one line, in
// time and in memory in proportion to the file.

#include "Models/Models/ModelFixtures.h"
#include "Models/Models/VtkMeshForms.h"
#include "VoxelCoreTesting/ProcessUse.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Models/ReadMesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** Turned until its smallest corner is first. */
std::array<std::uint32_t, 3>
Turned(std::array<std::uint32_t, 3> triangle)
{
  std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  return triangle;
}

TEST(VtkMeshes, EveryFormThatVtkWritesReadsAsTheSameMesh)
{
  const TemporaryFolder folder;
  auto                  forms = XmlForms();
  forms.insert(LegacyForms().begin(), LegacyForms().end());
  EXPECT_EQ(forms.size(), 2 + 3 * 7 + 8U);
  std::vector<std::array<std::uint32_t, 3>> expected = SheetTriangles();
  std::transform(expected.begin(), expected.end(), expected.begin(), Turned);
  for (const auto & [name, bytes] : forms)
  {
    WriteAll(folder / name, bytes);
    MeshFile read;
    ASSERT_NO_THROW(read = ReadMesh(folder / name)) << name;
    EXPECT_EQ(read.polygons, 12U) << name;
    EXPECT_EQ(read.format, name.ends_with(".vtp") ? "VTP" : "VTK");
    ASSERT_EQ(read.mesh.points.size(), std::size_t{ kSheetSide * kSheetSide }) << name;
    for (std::size_t i = 0; i < read.mesh.points.size(); ++i)
    {
      const auto x = static_cast<double>(i % kSheetSide);
      const auto y = static_cast<double>(i / kSheetSide);
      EXPECT_EQ(read.mesh.points[i], (Vector3{ x / 4, y / 2, x * y / 64 })) << name;
    }
    std::transform(read.mesh.triangles.begin(), read.mesh.triangles.end(), read.mesh.triangles.begin(), Turned);
    EXPECT_EQ(read.mesh.triangles, expected) << name;
  }
}

TEST(VtkMeshes, PiecesOfAFileAreOneMesh)
{
  const TemporaryFolder folder;
  const std::string     piece =
    "<Piece NumberOfPoints='3' NumberOfPolys='1'><Points><DataArray type='Float64' "
    "NumberOfComponents='3'>0 0 0 1 0 0 0 1e0 -0</DataArray></Points><Polys><DataArray "
    "type='Int32' Name='connectivity'>0 1 2</DataArray><DataArray type='UInt8' "
    "Name='offsets'>3</DataArray></Polys></Piece>";
  WriteAll(folder / "a.vtp", "<VTKFile type='PolyData'><PolyData>" + piece + piece + "</PolyData></VTKFile>");
  const MeshFile read = ReadMesh(folder / "a.vtp");
  EXPECT_EQ(read.mesh.points.size(), 6U);
  ASSERT_EQ(read.mesh.triangles.size(), 2U);
  EXPECT_EQ(read.mesh.triangles[1], (std::array<std::uint32_t, 3>{ 3, 4, 5 }));
}

/** Reads what may be damaged; whether it was refused. It must be so in one line and in time, or read as a mesh that
 *  fits together. */
bool
IsRefused(const std::filesystem::path & path)
{
  const double begin = ProcessorSeconds();
  bool         refused = false;
  try
  {
    const MeshFile read = ReadMesh(path);
    for (const Vector3 & point : read.mesh.points)
    {
      EXPECT_TRUE(std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]));
    }
    for (const auto & triangle : read.mesh.triangles)
    {
      EXPECT_LT(*std::max_element(triangle.begin(), triangle.end()), read.mesh.points.size());
    }
  }
  catch (const InputError & error)
  {
    refused = true;
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
  EXPECT_LT(ProcessorSeconds() - begin, 10.0); // of the processor: other work on the machine is no hang
  return refused;
}

const std::vector<std::string> kBadNumbers{ "-1",
                                            "0",
                                            "1",
                                            "7",
                                            "255",
                                            "65536",
                                            "2147483647",
                                            "2147483648",
                                            "4294967295",
                                            "4294967296",
                                            "9223372036854775807",
                                            "9223372036854775808",
                                            "18446744073709551615",
                                            "99999999999999999999999999",
                                            "1e308",
                                            "1e999",
                                            "nan",
                                            "inf",
                                            "" };

TEST(VtkMeshes, CountsThatTheFileDoesNotHoldAreRefused)
{
  const TemporaryFolder folder;
  const long            before = PeakMegabytes();
  const auto            expectRefused = [&](const std::string & name, std::string bytes, const std::string & key) {
    const std::size_t at = bytes.find(key);
    ASSERT_NE(at, std::string::npos) << name << " " << key;
    const std::size_t begin = at + key.size();
    const std::size_t end = bytes.find_first_not_of("0123456789", begin);
    ASSERT_GT(end, begin) << name << " " << key;
    for (const std::string & number : kBadNumbers)
    {
      std::string damaged = bytes;
      damaged.replace(begin, end - begin, number);
      WriteAll(folder / name, damaged);
      EXPECT_TRUE(IsRefused(folder / name) || damaged == bytes || number == "0") << name << " " << key << number;
    }
  };
  for (const auto & [name, bytes] : XmlForms())
  {
    for (const std::string key :
         { "NumberOfPoints=\"", "NumberOfStrips=\"", "NumberOfPolys=\"", "Name=\"Points\" NumberOfComponents=\"" })
    {
      expectRefused(name, bytes, key);
    }
  }
  for (const auto & [name, bytes] : LegacyForms())
  {
    for (const std::string key : { "\nPOINTS ",
                                   "\nPOLYGONS ",
                                   "\nTRIANGLE_STRIPS ",
                                   "\nVERTICES ",
                                   "\nPOINT_DATA ",
                                   "\nCELL_DATA ",
                                   "\nFIELD FieldData " })
    {
      expectRefused(name, bytes, key);
    }
  }
  EXPECT_LT(PeakMegabytes() - before, 200); // sanitizers hold back what is given back
}

TEST(VtkMeshes, PiecesThatNameTheSameBytesOverAndOverAreRefused)
{
  const TemporaryFolder folder;
  const long            before = PeakMegabytes();
  constexpr int         points = 4096;
  const std::uint64_t   length = points * 3 * sizeof(double);
  std::string           text = "<VTKFile type='PolyData' header_type='UInt64'><PolyData>";
  for (int piece = 0; piece < 4096; ++piece)
  {
    text += "<Piece NumberOfPoints='" + std::to_string(points) +
            "'><Points><DataArray type='Float64' NumberOfComponents='3' format='appended'/></Points></Piece>";
  }
  text += "</PolyData><AppendedData encoding='raw'>_";
  text.append(reinterpret_cast<const char *>(&length), sizeof(length));
  text.append(length, '\0');
  WriteAll(folder / "a.vtp", text + "</AppendedData></VTKFile>");
  EXPECT_TRUE(IsRefused(folder / "a.vtp"));
  EXPECT_LT(PeakMegabytes() - before, 100);
}

TEST(VtkMeshes, FilesThatAreCutOffAreRefused)
{
  const TemporaryFolder folder;
  auto                  forms = XmlForms();
  forms.insert(LegacyForms().begin(), LegacyForms().end());
  for (const auto & [name, bytes] : forms)
  {
    for (std::size_t length = 0; length + 100 < bytes.size(); length += 197)
    {
      WriteAll(folder / name, bytes.substr(0, length));
      // A text may be cut between two of its sections: that cannot be told.
      EXPECT_TRUE(IsRefused(folder / name) || name.ends_with(".vtk")) << name << " " << length;
    }
  }
}

/** Bits flipped, numbers replaced by the largest and strangest, parts left out, doubled or cut off. */
std::string
Damaged(std::string bytes, std::mt19937_64 & random)
{
  const auto place = [&] { return bytes.empty() ? 0 : random() % bytes.size(); };
  for (std::uint64_t changes = 1 + random() % 3; changes > 0 && !bytes.empty(); --changes)
  {
    switch (random() % 8)
    {
      case 0:
      case 1:
        bytes[place()] ^= static_cast<char>(1U << (random() % 8));
        break;
      case 2:
        bytes.erase(place(), 1 + random() % 40);
        break;
      case 3:
      {
        const std::string part = bytes.substr(place(), 1 + random() % 200);
        bytes.insert(place(), part);
        break;
      }
      case 4:
        bytes.resize(random() % 4 == 0 ? place() : bytes.size());
        break;
      default:
      {
        const bool        isInHeader = random() % 2 == 0;
        const std::size_t from = isInHeader ? random() % std::min<std::size_t>(bytes.size(), 1500) : place();
        const std::size_t begin = bytes.find_first_of("0123456789", from);
        if (begin != std::string::npos)
        {
          const std::size_t end = std::min(bytes.find_first_not_of("0123456789.-e", begin), bytes.size());
          bytes.replace(begin, end - begin, kBadNumbers[random() % kBadNumbers.size()]);
        }
      }
    }
  }
  return bytes;
}

/** `runs` damaged files of all forms together. */
void
ReadDamaged(const std::map<std::string, std::string> & forms, int runs, std::uint64_t seed)
{
  std::cout << "seed " << seed << "\n";
  std::mt19937_64       random(seed);
  const TemporaryFolder folder;
  const long            before = PeakMegabytes();
  int                   refused = 0;
  ::testing::internal::CaptureStderr();
  for (int run = 0; run < runs;)
  {
    for (auto form = forms.begin(); form != forms.end() && run < runs; ++form, ++run)
    {
      const auto path = folder / ("bad" + std::filesystem::path(form->first).extension().string());
      WriteAll(path, Damaged(form->second, random));
      refused += IsRefused(path) ? 1 : 0;
      ASSERT_FALSE(::testing::Test::HasFailure()) << form->first << " " << run;
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  std::cout << runs - refused << " read, " << refused << " refused, " << PeakMegabytes() - before << " MB more\n";
  EXPECT_GT(refused, runs / 4);
  EXPECT_LT(refused, runs);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(PeakMegabytes() - before, 100);
#endif
}

TEST(VtkMeshes, DamagedFilesAreRefusedOrReadInTimeAndMemory)
{
  ReadDamaged(XmlForms(), 1000, 1);
  ReadDamaged(LegacyForms(), 1000, 2);
}

TEST(HeavyHostileMeshes, ThirtyThousandDamagedFilesOfEachVtkFormat)
{
  const unsigned seed = std::random_device()();
  RecordProperty("seed", std::to_string(seed));
  ReadDamaged(XmlForms(), 30000, seed);
  ReadDamaged(LegacyForms(), 30000, seed);
}

/** Files that made programs crash, hang or fill the memory. */
TEST(VtkMeshes, FilesThatCrashedReadersAreRefused)
{
  const char * const data = std::getenv("VOXELCORE_TEST_DATA");
  if (data == nullptr || !std::filesystem::is_directory(std::filesystem::path(data) / "faults"))
  {
    GTEST_SKIP() << "VOXELCORE_TEST_DATA has no folder 'faults'";
  }
  for (const std::string name : { "11-489-b.vtp",
                                  "31-223-z.vtp",
                                  "11-3166-b.vtp",
                                  "41-174-a.vtp",
                                  "42-72-z.vtp",
                                  "42-83-z.vtp",
                                  "12-699-b.vtk",
                                  "12-2784-b.vtk" })
  {
    const auto path = std::filesystem::path(data) / "faults" / name;
    if (std::filesystem::exists(path))
    {
      EXPECT_TRUE(IsRefused(path)) << name;
    }
  }
}

} // namespace
