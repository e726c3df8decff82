// A scan whose file gives no voxel size has its lengths in voxels: no output of any command names a millimetre, and
// none is taken.

#include "CommandFixture.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <filesystem>
#include <gmock/gmock.h>
#include <regex>

namespace voxelcore::testing
{
namespace
{

using ::testing::HasSubstr;

namespace fs = std::filesystem;

class VoxelUnit : public CommandFixture
{
protected:
  /** A ring with a rod and a plate, labels 1 and 2, in 24 x 20 x 12 voxels of no size. */
  std::string
  WithoutSpacing()
  {
    TestScan scan({ 24, 20, 12 });
    scan.Fill({ 2, 2, 2 }, { 14, 14, 5 }, 1);
    scan.Fill({ 6, 6, 2 }, { 10, 10, 5 }, 0);
    scan.Fill({ 14, 7, 3 }, { 22, 9, 5 }, 1);
    scan.Fill({ 2, 16, 2 }, { 20, 18, 9 }, 2);
    WriteNrrd(m_Folder / "a.nrrd",
              "type: uint8\ndimension: 3\nsizes: 24 20 12\n",
              std::string(scan.voxels.begin(), scan.voxels.end()));
    return m_Folder / "a.nrrd";
  }

  /** Runs a command that must succeed; adds what it says. */
  void
  Take(const std::vector<std::string> & arguments)
  {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << arguments[0] << ": " << result.error;
    m_Said[arguments[0]] += result.output + result.error;
  }

  /** Lines of a text that name a millimetre or a part of one. */
  std::string
  Millimetres(std::string text) const
  {
    const std::string folder = m_Folder / "";
    for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    {
      text.erase(at, folder.size());
    }
    static const std::regex unit("(^|[^A-Za-z])(mm|[uµ]m|nm)[0-9^²³]*([^A-Za-z]|$)|illimet|icromet");
    std::string             found;
    for (std::sregex_iterator at(text.begin(), text.end(), unit); at != std::sregex_iterator(); ++at)
    {
      const auto from = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, at->position() - 60));
      found += "..." + text.substr(from, 120) + "...\n";
    }
    return found;
  }

  std::map<std::string, std::string> m_Said;
};

TEST_F(VoxelUnit, NoOutputNamesAMillimetre)
{
  const std::string scan = WithoutSpacing();
  Take({ "info", scan });
  Take({ "info", scan, "--json" });
  Take({ "core",
         scan,
         "-o",
         Path("c.vtp"),
         "--keep-edges",
         "--lambda",
         "0",
         "--report",
         Path("c.json"),
         "--table",
         Path("c.csv") });
  Take({ "core", scan, "-o", Path("w.vtp"), "--with-skeleton", "--also", "csv,swc,mrk.json,graphml" });
  for (const char * extension : { "vtk", "ply", "obj", "stl", "ma" })
  {
    Take({ "core", scan, "-o", Path("c.") + extension, "--lambda", "2vox" });
  }
  Take({ "core", scan, "-o", Path("parts/"), "--tolerance", "1.2diag,30vox", "--report", Path("parts.json") });
  Take({ "core", scan, "-o", Path("r.vtp"), "--refine", "labels", "--lambda", "2.5vox", "--report", Path("r.json") });
  Take({ "skeleton",
         scan,
         "-o",
         Path("s.vtp"),
         "--also",
         "csv,swc,mrk.json,graphml,ma",
         "--cut-loops",
         "--report",
         Path("s.json") });
  Take({ "skeleton", Path("c.vtp"), "-o", Path("t.vtp"), "--plates", "3vox" });
  Take({ "measure", Path("s.vtp"), "-o", Path("m.csv"), "--prune-branches", "2vox" });
  Take({ "prune", Path("c.vtp"), "-o", Path("p.vtp"), "--lambda", "2vox,40%", "--report", Path("p.json") });
  Take({ "verify", scan, Path("c.vtp") });
  Take({ "verify", scan, Path("r.vtp") });
  Take({ "verify", scan, Path("parts/a_label-1_medial_tolerance-1.2diag.vtp") });
  Take({ "reconstruct", Path("c.vtp"), "-o", Path("v.nrrd"), "--scan", scan, "--report", Path("v.json") });
  Take({ "batch", scan, "-o", Path("cohort"), "--with-skeleton" });
#ifdef VOXELCORE_HAS_DISPLAY
  Take({ "core", scan, "-o", Path("d.vtp"), "--scene", Path("d.mrml"), "--html", Path("d.html"), "--with-skeleton" });
  Take({ "render", Path("c.vtp"), Path("s.vtp"), "-o", Path("d.png"), "--scan", scan, "--size", "400x300" });
#endif
  for (const auto & [command, text] : m_Said)
  {
    EXPECT_EQ(Millimetres(text), "") << command;
  }
  int files = 0;
  for (const auto & entry : fs::recursive_directory_iterator(m_Folder / ""))
  {
    const std::string extension = entry.path().extension();
    if (entry.is_regular_file() && extension != ".png" && extension != ".nrrd")
    {
      std::string text = ReadAll(entry.path());
      if (extension == ".html")
      {
        text = text.substr(0, text.find("<script id=\"data\"")); // not the numbers, which are letters there
      }
      if (extension == ".vtp")
      {
        text = UnpackedVtp(text);
        // Of what is appended the texts, not the numbers, whose bytes may be letters.
        const std::size_t provenance = text.find("{\"voxelcore\"");
        const std::size_t end = provenance == std::string::npos ? provenance : text.find('\0', provenance);
        text = text.substr(0, text.find("<AppendedData")) +
               (provenance == std::string::npos ? std::string() : text.substr(provenance, end - provenance));
      }
      EXPECT_EQ(Millimetres(text), "") << entry.path();
      ++files;
    }
  }
  EXPECT_GT(files, 40);
}

TEST_F(VoxelUnit, FilesAndReportsSayThatTheyAreInVoxels)
{
  const std::string scan = WithoutSpacing();
  Take({ "core",
         scan,
         "-o",
         Path("c.vtp"),
         "--keep-edges",
         "--lambda",
         "0",
         "--report",
         Path("c.json"),
         "--table",
         Path("c.csv") });
  Take({ "skeleton", Path("c.vtp"), "-o", Path("s.vtp"), "--also", "csv,mrk.json,swc" });
  Take({ "prune", Path("c.vtp"), "-o", Path("p.vtp"), "--lambda", "2vox" });
  Take({ "measure", Path("s.vtp"), "-o", Path("m.vtp") });
  for (const char * file : { "c.vtp", "s.vtp", "p.vtp", "m.vtp" })
  {
    EXPECT_THAT(UnpackedVtp(ReadAll(Path(file))), HasSubstr(R"("unit":"voxel")")) << file;
  }
  const auto report = Report("c.json");
  EXPECT_EQ(report["input"]["unit"], "voxel");
  EXPECT_EQ(report["input"]["spacing_vox"], (nlohmann::json{ 1.0, 1.0, 1.0 }));
  EXPECT_EQ(report["labels"][1]["volume_vox3"], report["labels"][1]["voxels"]);
  EXPECT_THAT(ReadAll(Path("c.csv")), HasSubstr("volume_vox3"));
  EXPECT_THAT(ReadAll(Path("s_columns.json")), HasSubstr(R"("Units": "vox^3")"));
  EXPECT_THAT(ReadAll(Path("s.mrk.json")), HasSubstr(R"("coordinateUnits": "voxel")"));
  EXPECT_THAT(ReadAll(Path("s.swc")), HasSubstr("# voxels, LPS axes"));
  EXPECT_EQ(nlohmann::json::parse(RunProgram({ "info", scan, "--json" }).output)["unit"], "voxel");
}

TEST_F(VoxelUnit, VolumesMadeOfVoxelsAreInVoxelsWhenTheyAreReadAgain)
{
  const std::string scan = WithoutSpacing();
  Take({ "core", scan, "-o", Path("c.vtp"), "--lambda", "0" });
  for (const char * name : { "v.nrrd", "v.nii", "v.nii.gz", "v.mha", "v.mhd", "v.tif" })
  {
    Take({ "reconstruct", Path("c.vtp"), "-o", Path(name) });
    const ProgramResult info = RunProgram({ "info", Path(name), "--json" });
    EXPECT_EQ(nlohmann::json::parse(info.output).value("unit", "mm"), "voxel") << name;
    EXPECT_THAT(info.error, HasSubstr("no voxel size in the file: all lengths are in voxels")) << name;
    // With a size they are as any other.
    const auto sized = nlohmann::json::parse(Run({ "info", Path(name), "--json", "--spacing", "1,1,2" }));
    EXPECT_FALSE(sized.contains("unit")) << name;
    EXPECT_EQ(sized["spacing_mm"], (nlohmann::json{ 1.0, 1.0, 2.0 })) << name;
  }
}

TEST_F(VoxelUnit, ALengthInMillimetresIsRefusedWithWhatToDo)
{
  const std::string scan = WithoutSpacing();
  Take({ "core", scan, "-o", Path("c.vtp"), "--keep-edges", "--lambda", "0" });
  Take({ "core", scan, "-o", Path("b.vtp"), "--tolerance", "0" });
  Take({ "skeleton", scan, "-o", Path("s.vtp") });
  const std::string                           out = Path("x.vtp");
  const std::vector<std::vector<std::string>> refused{
    { "core", scan, "-o", out, "--lambda", "2mm" },
    { "core", scan, "-o", out, "--lambda", "2" },
    { "core", scan, "-o", out, "--lambda", "1vox,2mm" },
    { "core", scan, "-o", Path("folder/"), "--lambda", "2mm" },
    { "core", scan, "-o", out, "--tolerance", "1mm" },
    { "core", scan, "-o", out, "--tolerance", "1" },
    { "skeleton", scan, "-o", out, "--lambda", "2mm" },
    { "skeleton", scan, "-o", out, "--plates", "2mm" },
    { "skeleton", scan, "-o", out, "--stand-out", "2mm" },
    { "skeleton", scan, "-o", out, "--smooth", "2" },
    { "skeleton", scan, "-o", out, "--prune-branches", "2mm" },
    { "skeleton", Path("c.vtp"), "-o", out, "--stand-out", "2mm" },
    { "prune", Path("c.vtp"), "-o", out, "--lambda", "2mm" },
    { "prune", Path("b.vtp"), "-o", out, "--tolerance", "2" },
    { "measure", Path("s.vtp"), "-o", out, "--prune-branches", "2mm" },
  };
  for (const auto & command : refused)
  {
    const ProgramResult result = RunProgram(command);
    EXPECT_EQ(result.code, 3) << command.back() << result.error;
    EXPECT_THAT(result.error, HasSubstr("is a length in mm, and the scan has no voxel size")) << command.back();
    EXPECT_THAT(result.error, HasSubstr("--spacing X,Y,Z")) << command.back();
    EXPECT_FALSE(fs::exists(out));
  }
  Take({ "core", scan, "-o", out, "--lambda", "0,2vox,3%" });
  Run({ "core", scan, "-o", Path("y.vtp"), "--lambda", "2mm", "--spacing", "1,1,1" });
  // A core in mm has nothing to do with the scan in voxels.
  const ProgramResult mixed = RunProgram({ "reconstruct", Path("y.vtp"), "-o", Path("z.nrrd"), "--like", scan });
  EXPECT_EQ(mixed.code, 3);
  EXPECT_THAT(mixed.error, HasSubstr("in voxels; give --spacing X,Y,Z"));
}

} // namespace
} // namespace voxelcore::testing
