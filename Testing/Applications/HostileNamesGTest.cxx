// Label names, file names and folders chosen to do harm: in tables, pages, scenes, records and messages they are text.

#include "CommandFixture.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Scans.h"

#include <filesystem>

namespace voxelcore::testing
{
namespace
{

using HostileNames = CommandFixture;

// From the mark on a terminal writes from right to left.
const std::string kTurn = "\xE2\x80\xAE";
const std::string kTurned = "liver" + kTurn + "nirt\xE2\x81\xA6";

const std::vector<std::string> kNames{ "=HYPERLINK(\"http://a.example\",\"b\")",
                                       "</script><script>alert(1)</script>",
                                       "\"><img src=x onerror=alert(1)>",
                                       "\x1b]0;owned\x07\x1b[2J",
                                       "$(touch owned) `touch owned` ; touch owned #",
                                       "../../../../tmp/owned",
                                       "%s%n%s%n {config} {0}",
                                       kTurned };

/** A segmentation with a block for each name. */
void
WriteSegments(const std::filesystem::path & path)
{
  std::string header =
    "type: uint8\ndimension: 3\nsizes: 32 6 6\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) "
    "(0,0,1)\nspace origin: (0,0,0)\nkinds: domain domain domain\n";
  for (std::size_t i = 0; i < kNames.size(); ++i)
  {
    const std::string segment = "Segment" + std::to_string(i) + "_";
    header += segment + "ID:=Segment_" + std::to_string(i) + "\n" + segment + "Name:=" + kNames[i] + "\n" + segment +
              "LabelValue:=" + std::to_string(i + 1) + "\n" + segment + "Layer:=0\n";
  }
  std::string voxels(32 * 6 * 6, '\0');
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const std::size_t x = i % 32;
    const std::size_t y = i / 32 % 6;
    const std::size_t z = i / 192;
    const bool        isIn = x % 4 < 3 && y > 0 && y < 5 && z > 0 && z < 5;
    voxels[i] = isIn ? static_cast<char>(1 + x / 4) : '\0';
  }
  WriteNrrd(path, header, voxels);
}

/** Nothing that a terminal would act on. */
void
ExpectPlain(const std::string & text)
{
  for (const char c : text)
  {
    EXPECT_TRUE(static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      << static_cast<int>(c) << " in " << text;
  }
  EXPECT_EQ(text.find(kTurn), std::string::npos) << text;
}

TEST_F(HostileNames, AreTextInAllThatIsWritten)
{
  WriteSegments(Path("a.seg.nrrd"));
  std::filesystem::create_directory(Path("out"));
  const auto run = [&](std::vector<std::string> arguments) {
    const ProgramResult result = RunProgram(arguments);
    EXPECT_EQ(result.code, 0) << arguments[0] << ": " << result.error;
    ExpectPlain(result.output);
    ExpectPlain(result.error);
  };
  run({ "info", Path("a.seg.nrrd") });
  run({ "core",
        Path("a.seg.nrrd"),
        "-o",
        Path("out/core.vtp"),
        "--report",
        Path("out/core.json"),
        "--table",
        Path("out/core.csv") });
  run({ "core", Path("a.seg.nrrd"), "-o", Path("out/folder/") });
  run({ "skeleton", Path("a.seg.nrrd"), "-o", Path("out/s.vtp"), "--also", "csv,swc,mrk.json,graphml,ma" });
  run({ "thickness", Path("a.seg.nrrd"), "-o", Path("out/t.nrrd"), "--table", Path("out/t.csv") });
  run({ "sheets",
        Path("a.seg.nrrd"),
        "-o",
        Path("out/sheets.vtp"),
        "--table",
        Path("out/sheets.csv"),
        "--graph",
        Path("out/sheets.graphml") });
  run({ "batch", Path("a.seg.nrrd"), "-o", Path("out/batch") });
#ifdef VOXELCORE_HAS_DISPLAY
  run({ "core", Path("a.seg.nrrd"), "-o", Path("out/h.vtp"), "--html", Path("out/h.html") });
  run({ "core", Path("a.seg.nrrd"), "-o", Path("out/m.vtp"), "--scene", Path("out/m.mrml") });
#endif
  EXPECT_FALSE(std::filesystem::exists("owned"));
  EXPECT_FALSE(std::filesystem::exists("/tmp/owned"));
  int tables = 0;
  int pages = 0;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(Path("out")))
  {
    const std::string extension = entry.path().extension().string();
    EXPECT_EQ(entry.path().string().find("owned"), std::string::npos) << entry.path();
    if (!entry.is_regular_file())
    {
      continue;
    }
    const std::string bytes = extension == ".vtp" ? UnpackedVtp(ReadAll(entry.path())) : ReadAll(entry.path());
    EXPECT_EQ(bytes.find(kTurn), std::string::npos) << entry.path();
    if (extension == ".csv")
    {
      ++tables;
      for (const char * field : { ",=", ",\"=", "\n=", "\n\"=", ",+", ",@", ",\"@" })
      {
        EXPECT_EQ(bytes.find(field), std::string::npos) << entry.path() << ": " << field;
      }
    }
    if (extension == ".html" || extension == ".mrml" || extension == ".graphml")
    {
      ++pages;
      EXPECT_EQ(bytes.find("<script>alert"), std::string::npos) << entry.path();
      EXPECT_EQ(bytes.find("<img src=x"), std::string::npos) << entry.path();
      EXPECT_EQ(bytes.find('\x1b'), std::string::npos) << entry.path();
    }
    if (extension == ".csv" || extension == ".json" || extension == ".swc")
    {
      EXPECT_EQ(bytes.find('\x1b'), std::string::npos) << entry.path();
    }
  }
  EXPECT_GE(tables, 7);
  EXPECT_GE(pages, 2);
}

TEST_F(HostileNames, OfFilesAreShownWithoutCommandsForTheTerminal)
{
  const std::string name = "a\x1b[2J\nb;$(touch owned)" + kTurn + "txt.nrrd";
  WriteNrrd(Path(name), ThreeBlocks());
  std::filesystem::create_directory(Path("out"));
  const ProgramResult done =
    RunProgram({ "core", Path(name), "-o", Path("out/a.vtp"), "--report", Path("out/a.json"), "--progress", "none" });
  EXPECT_EQ(done.code, 0) << done.error;
  ExpectPlain(done.error);
  ExpectPlain(done.output);
  WriteAll(Path(name), "NRRD0004\nnonsense\n\n");
  ExpectRefusal(RunProgram({ "core", Path(name), "-o", Path("out/b.vtp") }), 3, {});
  EXPECT_FALSE(std::filesystem::exists("owned"));
}

TEST_F(HostileNames, AHeaderThatTakesVoxelsFromAnotherFolderIsSaid)
{
  std::filesystem::create_directory(Path("headers"));
  WriteAll(Path("secret"), std::string(27, '\1'));
  WriteAll(Path("headers/own.raw"), std::string(27, '\1'));
  const std::string nrrd = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 3 3\nspacings: 1 1 1\nencoding: raw\n";
  const std::string meta = "NDims = 3\nDimSize = 3 3 3\nElementSpacing = 1 1 1\nElementType = MET_UCHAR\n";
  for (const std::string & elsewhere : { std::string("../secret"), Path("secret") })
  {
    WriteAll(Path("headers/a.nhdr"), nrrd + "data file: " + elsewhere + "\n");
    WriteAll(Path("headers/a.mhd"), meta + "ElementDataFile = " + elsewhere + "\n");
    for (const char * header : { "headers/a.nhdr", "headers/a.mhd" })
    {
      const ProgramResult result = RunProgram({ "core", Path(header), "-o", Path("a.vtp"), "--force" });
      EXPECT_EQ(result.code, 0) << result.error;
      EXPECT_NE(result.error.find("which is outside the header's folder"), std::string::npos) << result.error;
      EXPECT_NE(result.error.find("secret"), std::string::npos);
    }
  }
  for (const std::string & own : { std::string("own.raw"), std::string("./own.raw"), Path("headers/own.raw") })
  {
    WriteAll(Path("headers/a.nhdr"), nrrd + "data file: " + own + "\n");
    EXPECT_EQ(RunProgram({ "core", Path("headers/a.nhdr"), "-o", Path("a.vtp"), "--force" }).error, "") << own;
  }
}

} // namespace
} // namespace voxelcore::testing
