// Meshes on the command line: volumes and cores of good ones, and one clear line for each bad one.

#include "MeshFiles.h"
#include "VoxelCoreTesting/TemporaryFolder.h"
#include "Program.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace voxelcore::testing
{
namespace
{

class MeshCommand : public ::testing::Test
{
protected:
  /** `voxelize` and `core` both refuse it with one line that names the file, exit code 3, and leave nothing. */
  void
  ExpectUnfit(const std::string & name, const std::vector<std::string> & words = {})
  {
    const auto before = m_Folder.Names();
    auto       all = words;
    all.push_back(name);
    ExpectRefusal(RunProgram({ "voxelize", m_Folder / name, "--resolution", "8", "-o", m_Folder / "out.nrrd" }),
                  3,
                  all);
    ExpectRefusal(RunProgram({ "core", m_Folder / name, "--resolution", "8", "-o", m_Folder / "out.vtp" }), 3, all);
    EXPECT_EQ(m_Folder.Names(), before);
  }

  void
  ExpectUnfitInEachFormat(const Solid & solid, const std::vector<std::string> & words = {})
  {
    for (const Format & format : Formats())
    {
      SCOPED_TRACE(format.name);
      WriteAll(m_Folder / format.name, format.write(solid));
      ExpectUnfit(format.name, words);
    }
  }

  TemporaryFolder m_Folder;
};

TEST_F(MeshCommand, EachFormatGivesTheSameVolume)
{
  std::string first;
  for (const Format & format : Formats())
  {
    SCOPED_TRACE(format.name);
    WriteAll(m_Folder / format.name, format.write(Box()));
    const auto result = RunProgram({ "voxelize",
                                     m_Folder / format.name,
                                     "--spacing",
                                     "0.5",
                                     "-o",
                                     m_Folder / "out.nrrd",
                                     "--force",
                                     "--report",
                                     m_Folder / "out.json" });
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_NE(result.output.find("8 x 6 x 4 voxels of 0.5 mm, 192 of them in"), std::string::npos) << result.output;
    const auto report = nlohmann::json::parse(ReadAll(m_Folder / "out.json"));
    EXPECT_EQ(report.at("volumes").at(0).at("doubtful_voxels"), 0);
    EXPECT_EQ(report.at("volumes").at(0).at("mesh").at("triangles"), 12);
    const std::string bytes = ReadAll(m_Folder / "out.nrrd");
    first = first.empty() ? bytes : first;
    EXPECT_TRUE(bytes == first);
  }
}

TEST_F(MeshCommand, ACoreOfAMeshIsTheCoreOfItsVolumeAndVerifies)
{
  WriteAll(m_Folder / "box.off", Off(Box()));
  ASSERT_EQ(RunProgram({ "voxelize", m_Folder / "box.off", "--resolution", "16", "-o", m_Folder / "box.nrrd" }).code,
            0);
  ASSERT_EQ(RunProgram({ "core", m_Folder / "box.off", "--resolution", "16", "-o", m_Folder / "mesh.obj" }).code, 0);
  ASSERT_EQ(RunProgram({ "core", m_Folder / "box.nrrd", "-o", m_Folder / "volume.obj" }).code, 0);
  const auto shape = [](const std::string & text) { return text.substr(text.find("\nv ")); };
  EXPECT_EQ(shape(ReadAll(m_Folder / "mesh.obj")), shape(ReadAll(m_Folder / "volume.obj")));
  ASSERT_EQ(RunProgram({ "core", m_Folder / "box.off", "--resolution", "16", "-o", m_Folder / "mesh.vtp" }).code, 0);
  const auto verified = RunProgram({ "verify", m_Folder / "box.off", m_Folder / "mesh.vtp" });
  EXPECT_EQ(verified.code, 0) << verified.error;
  EXPECT_EQ(RunProgram({ "skeleton", m_Folder / "box.off", "--resolution", "16", "-o", m_Folder / "s.vtp" }).code, 0);
  EXPECT_EQ(RunProgram({ "info", m_Folder / "box.off", "--spacing", "0.5" }).code, 0);
}

TEST_F(MeshCommand, AStudyWritesEachResolutionAndLambdaAndOneTable)
{
  WriteAll(m_Folder / "box.ply", PlyText(Box()));
  const std::vector<std::string> command{ "core", m_Folder / "box.ply",  "--resolution", "8,16", "--lambda", "1%,10%",
                                          "-o",   m_Folder / "study.vtp" };
  const auto                     result = RunProgram(command);
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_EQ(m_Folder.Names(),
            (std::set<std::string>{ "box.ply",
                                    "study.csv",
                                    "study_columns.json",
                                    "study_resolution-8_lambda-1pct.vtp",
                                    "study_resolution-8_lambda-10pct.vtp",
                                    "study_resolution-16_lambda-1pct.vtp",
                                    "study_resolution-16_lambda-10pct.vtp" }));
  std::istringstream table(ReadAll(m_Folder / "study.csv"));
  std::string        line;
  std::getline(table, line);
  EXPECT_EQ(line.rfind("resolution,spacing_mm,", 0), 0U);
  std::vector<std::string> starts;
  while (std::getline(table, line))
  {
    starts.push_back(line.substr(0, line.find(',', line.find('%'))));
  }
  EXPECT_EQ(starts, (std::vector<std::string>{ "8,0.5,0,1%", "8,0.5,0,10%", "16,0.25,0,1%", "16,0.25,0,10%" }));
  ExpectRefusal(RunProgram(command), 1, { "study" });
  // All or nothing: the coarse one has no voxel.
  Solid thin = Box();
  for (auto & p : thin.points)
  {
    p[2] = 0.05 * p[2] + 0.9 * p[0];
  }
  WriteAll(m_Folder / "thin.ply", PlyText(thin));
  const auto before = m_Folder.Names();
  ExpectRefusal(RunProgram({ "core", m_Folder / "thin.ply", "--resolution", "64,1", "-o", m_Folder / "thin.vtp" }),
                3,
                { "thin.ply" });
  EXPECT_EQ(m_Folder.Names(), before);
}

TEST_F(MeshCommand, FilesCutOffAnywhereAreRefused)
{
  for (const Format & format : Formats())
  {
    const std::string whole = format.write(Box());
    // In its last line, in the middle, early; text that lacks only its last line end is whole.
    for (const std::size_t length : { whole.size() - 4, whole.size() * 3 / 4, whole.size() / 2, whole.size() / 5 })
    {
      SCOPED_TRACE(format.name + " of " + std::to_string(length) + " bytes");
      WriteAll(m_Folder / format.name, whole.substr(0, length));
      ExpectUnfit(format.name);
    }
  }
}

TEST_F(MeshCommand, EmptyFilesAreRefused)
{
  for (const Format & format : Formats())
  {
    SCOPED_TRACE(format.name);
    WriteAll(m_Folder / format.name, "");
    ExpectUnfit(format.name);
    WriteAll(m_Folder / format.name, "Dear reader,\nthis is a letter and no mesh.\n");
    ExpectUnfit(format.name);
  }
  ExpectUnfit("none.stl", { "no such file" });
  ExpectUnfitInEachFormat({ Box().points, {} });
}

TEST_F(MeshCommand, OneTriangleBoundsNothing)
{
  ExpectUnfitInEachFormat({ Box().points, { { 0, 1, 7 } } }, { "" });
}

TEST_F(MeshCommand, CoordinatesThatCannotBeAreRefused)
{
  Solid solid = Box();
  solid.points[3][1] = 1e12;
  ExpectUnfitInEachFormat(solid, { "1e9" });
  solid.points[3][1] = std::numeric_limits<double>::quiet_NaN();
  ExpectUnfitInEachFormat(solid);
  solid.points[3][1] = std::numeric_limits<double>::infinity();
  ExpectUnfitInEachFormat(solid);
}

TEST_F(MeshCommand, CornersThatAreNoPointsAreRefused)
{
  for (const Format & format : Formats())
  {
    for (const int corner : { 8, -10, 2000000000 })
    {
      if (format.name.find(".stl") == std::string::npos)
      {
        SCOPED_TRACE(format.name);
        Solid solid = Box();
        solid.triangles[4][1] = corner;
        WriteAll(m_Folder / format.name, format.write(solid));
        ExpectUnfit(format.name);
      }
    }
  }
}

TEST_F(MeshCommand, CountsThatPromiseMoreThanThereIsAreRefusedAtOnce)
{
  const auto replaced = [](std::string text, const std::string & from, const std::string & to) {
    return text.replace(text.find(from), from.size(), to);
  };
  WriteAll(m_Folder / "a.off", replaced(Off(Box()), "8 12 0", "8 4000000000 0"));
  ExpectUnfit("a.off", { "12 of 4000000000" });
  WriteAll(m_Folder / "b.ply", replaced(PlyText(Box()), "vertex 8", "vertex 4000000000"));
  ExpectUnfit("b.ply");
  WriteAll(m_Folder / "c.ply", replaced(PlyBinary(Box(), false), "face 12", "face 13"));
  ExpectUnfit("c.ply", { "12 of 13" });
  WriteAll(m_Folder / "d.off", replaced(Off(Box()), "8 12 0", "8 11 0"));
  ExpectUnfit("d.off", { "more follows" });
  WriteAll(m_Folder / "e.vtk", replaced(Vtk(Box()), "POLYGONS 12 48", "POLYGONS 13 52"));
  ExpectUnfit("e.vtk");
}

TEST_F(MeshCommand, WhatIsDoubtfulIsSaid)
{
  Solid solid = Box();
  solid.triangles.pop_back();
  WriteAll(m_Folder / "open.stl", StlText(solid));
  const auto result =
    RunProgram({ "voxelize", m_Folder / "open.stl", "--resolution", "8", "-o", m_Folder / "open.nrrd" });
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.error.find("3 edges on an odd number"), std::string::npos) << result.error;
  EXPECT_NE(result.error.find("doubtful"), std::string::npos) << result.error;
}

TEST_F(MeshCommand, OptionsWithoutSenseAreRefused)
{
  WriteAll(m_Folder / "box.stl", StlText(Box()));
  const std::string mesh = m_Folder / "box.stl";
  const std::string out = m_Folder / "out.vtp";
  ExpectRefusal(RunProgram({ "core", mesh, "-o", out }), 2, { "--resolution", "--spacing" });
  ExpectRefusal(RunProgram({ "core", mesh, "--resolution", "8", "--spacing", "1", "-o", out }), 2, { "either" });
  ExpectRefusal(RunProgram({ "core", mesh, "--resolution", "8", "--binary", "-o", out }), 2, { "mesh" });
  for (const char * value : { "0", "-5", "x", "8,8", "8,", "1e3", "99999999" })
  {
    ExpectRefusal(RunProgram({ "core", mesh, std::string("--resolution=") + value, "-o", out }), 2, { value });
    ExpectRefusal(RunProgram({ "voxelize", mesh, std::string("--resolution=") + value, "-o", m_Folder / "out.nrrd" }),
                  2,
                  { value });
  }
  ExpectRefusal(RunProgram({ "voxelize", mesh, "-o", m_Folder / "out.nrrd" }), 2, { "either" });
  ExpectRefusal(RunProgram({ "voxelize", mesh, "--resolution", "8", "-o", m_Folder / "out.xyz" }), 2, { "out.xyz" });
  EXPECT_EQ(m_Folder.Names(), (std::set<std::string>{ "box.stl" }));
}

} // namespace
} // namespace voxelcore::testing
