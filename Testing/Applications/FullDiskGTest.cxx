// A disk without room: every writer says so in one line, by the file's own name, and leaves nothing behind.

#include "CommandFixture.h"
#include "Scans.h"

#include <fstream>
#include <sys/mount.h>

namespace voxelcore::testing
{
namespace
{

/** A disk of its own with nearly nothing left on it. */
class FullDisk : public CommandFixture
{
protected:
  void
  SetUp() override
  {
    std::filesystem::create_directory(m_Disk);
    m_IsMounted = mount("none", m_Disk.c_str(), "tmpfs", 0, "size=256k") == 0;
    if (!m_IsMounted)
    {
      GTEST_SKIP() << "cannot mount a small tmpfs here";
    }
    Run({ "phantom", "root", "--size", "48", "-o", Path("a.nrrd"), "--quiet" });
    Run({ "core", Path("a.nrrd"), "--lambda", "0", "-o", Path("core.vtp"), "--keep-edges", "--quiet" });
    Run({ "skeleton", Path("a.nrrd"), "-o", Path("skeleton.vtp"), "--quiet" });
  }
  void
  TearDown() override
  {
    if (m_IsMounted)
    {
      umount(m_Disk.c_str());
    }
  }

  /** Leaves `bytes` of room. */
  void
  Fill(std::size_t bytes)
  {
    std::filesystem::remove(m_Disk / "filler");
    const auto    room = std::filesystem::space(m_Disk).available;
    std::ofstream filler(m_Disk / "filler", std::ios::binary);
    filler << std::string(room - bytes, 'x');
    filler.close();
    ASSERT_TRUE(filler.good());
  }

  /** The arguments, of which those that begin with @ name files on the disk. Each must fail for lack of room, the last
   *  of them with the name of its file. */
  void
  ExpectNoRoom(const std::vector<std::string> & arguments, std::size_t room = 0)
  {
    Fill(room);
    std::vector<std::string> words;
    std::string              name;
    for (const std::string & argument : arguments)
    {
      words.push_back(argument.starts_with('@') ? (m_Disk / argument.substr(1)).string() : argument);
      name = argument.starts_with('@') ? words.back() : name;
    }
    SCOPED_TRACE(name);
    const ProgramResult result = RunProgram(words);
    ExpectRefusal(result,
                  1,
                  { "No space left on device", name.substr(0, name.rfind('.')) }); // a table may be out_nodes.csv
    EXPECT_EQ(result.error.find(".part"), std::string::npos) << result.error;
    std::set<std::string> left;
    for (const auto & entry : std::filesystem::directory_iterator(m_Disk))
    {
      left.insert(entry.path().filename().string());
    }
    EXPECT_EQ(left, std::set<std::string>{ "filler" });
  }

  const std::filesystem::path m_Disk = m_Folder / "disk";
  bool                        m_IsMounted = false;
};

TEST_F(FullDisk, SurfacesInEveryFormat)
{
  for (const std::string extension : { "vtp", "vtk", "ply", "obj", "stl", "ma" })
  {
    for (const std::size_t room : { 0, 8192 })
    {
      ExpectNoRoom({ "core", Path("a.nrrd"), "--lambda", "0", "--quiet", "-o", "@out." + extension }, room);
    }
  }
  ExpectNoRoom({ "prune", Path("core.vtp"), "--lambda", "1vox", "--quiet", "-o", "@out.vtp" });
}

TEST_F(FullDisk, WhatIsWrittenBesideASurface)
{
  const std::string out = Path("out.vtp");
  ExpectNoRoom({ "core", Path("a.nrrd"), "--quiet", "-o", out, "--report", "@report.json" });
  ExpectNoRoom({ "core", Path("a.nrrd"), "--quiet", "-o", out, "--table", "@table.csv" });
#ifdef VOXELCORE_HAS_DISPLAY
  ExpectNoRoom({ "core", Path("a.nrrd"), "--quiet", "-o", out, "--html", "@page.html" });
  ExpectNoRoom({ "core", Path("a.nrrd"), "--quiet", "-o", out, "--html", "@page.html" }, 65536);
  ExpectNoRoom({ "core", Path("a.nrrd"), "--quiet", "-o", out, "--scene", "@scene.mrb" });
#endif
  EXPECT_FALSE(std::filesystem::exists(out)); // all of the results or none
}

TEST_F(FullDisk, SkeletonsAndTheirTables)
{
  ExpectNoRoom({ "skeleton", Path("a.nrrd"), "--quiet", "-o", "@out.vtp" });
  ExpectNoRoom({ "skeleton", Path("a.nrrd"), "--quiet", "-o", Path("out.vtp"), "--report", "@report.json" });
  ExpectNoRoom({ "measure", Path("skeleton.vtp"), "--quiet", "-o", "@out.csv" });
}

TEST_F(FullDisk, VolumesInEveryFormat)
{
  for (const std::string extension : { "nrrd", "nii", "nii.gz", "mha", "mhd", "tif" })
  {
    for (const std::size_t room : { 0, 4096 })
    {
      ExpectNoRoom({ "phantom", "noise", "--size", "40", "-o", "@out." + extension }, room);
    }
  }
  ExpectNoRoom({ "reconstruct", Path("core.vtp"), "--quiet", "-o", "@out.nrrd" });
}

#ifdef VOXELCORE_HAS_DISPLAY
TEST_F(FullDisk, Pictures)
{
  ExpectNoRoom({ "render", Path("core.vtp"), "--quiet", "-o", "@out.png" });
}
#endif

TEST_F(FullDisk, BlocksOfAScan)
{
  Fill(0);
  const ProgramResult result =
    RunProgram({ "core", Path("a.nrrd"), "--blocks", "2", "--block", "1", "--quiet", "-o", (m_Disk / "").string() });
  ExpectRefusal(result, 1, { "No space left on device" });
}

TEST_F(FullDisk, ABatch)
{
  Fill(0);
  const ProgramResult result = RunProgram({ "batch", Path("a.nrrd"), "--quiet", "-o", m_Disk / "out" });
  EXPECT_EQ(result.code, 1) << result.error;
  EXPECT_NE(result.error.find("No space left on device"), std::string::npos) << result.error;
  EXPECT_EQ(result.error.find("No such file"), std::string::npos) << result.error;
}

} // namespace
} // namespace voxelcore::testing
