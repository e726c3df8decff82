// Whatever is wrong: one clear line, the right exit code, no output, no crash.

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "VoxelCoreTesting/UnpackedVtp.h"
#include "Program.h"
#include "Scans.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace voxelcore::testing
{
namespace
{

using Names = std::set<std::string>;

class BadInput : public ::testing::Test
{
protected:
  /** `voxelcore core <name> -o out.vtp` must be refused for the scan, which the line must name. */
  void
  ExpectUnfit(const std::string & name, const std::vector<std::string> & words = {}, const std::string & option = "")
  {
    const Names              before = m_Folder.Names();
    std::vector<std::string> arguments{ "core", m_Folder / name, "-o", m_Folder / "out.vtp" };
    if (!option.empty())
    {
      arguments.push_back(option);
    }
    std::vector<std::string> all = words;
    all.push_back(name);
    ExpectRefusal(RunProgram(arguments), 3, all);
    EXPECT_EQ(m_Folder.Names(), before);
    ExpectRefusal(RunProgram({ "info", m_Folder / name }), 3, { name });
  }

  TemporaryFolder m_Folder;
};

TEST_F(BadInput, MissingFile)
{
  ExpectUnfit("none.nrrd");
  ExpectUnfit("none.nii.gz");
  ExpectUnfit("none.tif");
}

TEST_F(BadInput, LengthsAndPlacesThatCannotBeExact)
{
  TestScan ball({ 9, 9, 9 });
  ball.Fill({ 2, 2, 2 }, { 6, 6, 6 }, 1);
  WriteNrrd(m_Folder / "a.nrrd", ball);
  const std::string bytes(ball.voxels.begin(), ball.voxels.end());
  const std::string sizes = "type: uint8\ndimension: 3\nspace: LPS\nsizes: 9 9 9\n";
  WriteNrrd(m_Folder / "far.nrrd",
            sizes + "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1.8446744e19,0,0)\n",
            bytes);
  WriteNrrd(m_Folder / "long.nrrd",
            sizes + "space directions: (1,0,0) (0,1e26,0) (0,0,2)\nspace origin: (0,0,0)\n",
            bytes);
  const Names before = m_Folder.Names();
  const auto  refused = [&](const std::string & command, const std::string & scan, const std::string & spacing) {
    std::vector<std::string> arguments{ command, m_Folder / scan, "-o", m_Folder / "out.vtp" };
    if (!spacing.empty())
    {
      arguments.insert(arguments.end(), { "--spacing", spacing });
    }
    ExpectRefusal(RunProgram(arguments), 3, { scan, scan == "far.nrrd" ? "correct its origin" : "--spacing X,Y,Z" });
    EXPECT_EQ(m_Folder.Names(), before);
  };
  for (const char * command : { "core", "skeleton" })
  {
    refused(command, "far.nrrd", "");
    refused(command, "long.nrrd", "");
    refused(command, "a.nrrd", "0.0001,1,1");
    refused(command, "a.nrrd", "1,1,4294967297");
    refused(command, "a.nrrd", "4.6e-41,1,2");
    refused(command, "a.nrrd", "4.6e-41,4.6e-41,4.6e-41");
  }
  const ProgramResult info = RunProgram({ "info", m_Folder / "far.nrrd" });
  EXPECT_EQ(info.code, 0);
  EXPECT_NE(info.error.find("no core can be made"), std::string::npos) << info.error;
  // A file made for another spacing is measured with that of the scan it is checked against.
  ASSERT_EQ(RunProgram({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "out.vtp" }).code, 0);
  ExpectRefusal(RunProgram({ "verify", m_Folder / "far.nrrd", m_Folder / "out.vtp" }), 3, { "far.nrrd" });
}

TEST_F(BadInput, DamagedGeometriesOfAnOutsideCampaign)
{
  const char * const data = std::getenv("VOXELCORE_TEST_DATA");
  if (data == nullptr || !std::filesystem::exists(std::filesystem::path(data) / "faults/11-602-raw.nrrd"))
  {
    GTEST_SKIP() << "VOXELCORE_TEST_DATA names no folder with faults/";
  }
  const std::filesystem::path folder = std::filesystem::path(data) / "faults";
  for (const char * name : { "11-602-raw.nrrd",
                             "11-681-raw.nrrd",
                             "12-1314-dgz.nhdr",
                             "11-2694-two.seg.nrrd",
                             "12-886-f.nii",
                             "11-2235-p.hdr" })
  {
    for (const char * command : { "core", "skeleton" })
    {
      const ProgramResult result = RunProgram({ command, folder / name, "-o", m_Folder / "out.vtp", "--quiet" });
      EXPECT_EQ(result.code, 3) << command << " " << name << ": " << result.error;
      EXPECT_LT(result.seconds, 10) << command << " " << name;
    }
  }
}

TEST_F(BadInput, EmptyFile)
{
  for (const char * name : { "a.nrrd", "a.nhdr", "a.nii", "a.nii.gz", "a.mha", "a.mhd", "a.tif" })
  {
    WriteAll(m_Folder / name, "");
    ExpectUnfit(name);
  }
}

TEST_F(BadInput, APipeIsNotWaitedFor)
{
  ASSERT_EQ(mkfifo((m_Folder / "a.nrrd").c_str(), 0600), 0);
  ProgramLimits limits;
  limits.time = std::chrono::seconds(30);
  ExpectRefusal(RunProgram({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "out.vtp" }, limits),
                3,
                { "a.nrrd", "not a regular file" });
}

TEST_F(BadInput, FolderWithoutSlices)
{
  std::filesystem::create_directory(m_Folder / "slices");
  WriteAll(m_Folder / "slices/readme.txt", "no slices here");
  ExpectUnfit("slices");
}

TEST_F(BadInput, TruncatedGzip)
{
  const std::filesystem::path atlas = "/usr/share/mricron/templates/aal.nii.gz";
  if (!std::filesystem::exists(atlas))
  {
    GTEST_SKIP() << "mricron-data is not installed";
  }
  const std::string whole = ReadAll(atlas);
  WriteAll(m_Folder / "cut.nii.gz", whole.substr(0, whole.size() / 2));
  ExpectUnfit("cut.nii.gz");
}

TEST_F(BadInput, TruncatedRawData)
{
  WriteNrrd(m_Folder / "cut.nrrd", "type: uint8\ndimension: 3\nsizes: 4 4 4\n", std::string(40, '\1'));
  ExpectUnfit("cut.nrrd");
}

TEST_F(BadInput, TextFileNamedNrrd)
{
  WriteAll(m_Folder / "text.nrrd", "Dear reader,\nthis is a letter and no scan.\n");
  ExpectUnfit("text.nrrd");
}

TEST_F(BadInput, UnknownExtension)
{
  WriteAll(m_Folder / "scan.xyz", "1 2 3\n");
  ExpectUnfit("scan.xyz");
}

TEST_F(BadInput, FlatImage)
{
  WriteNrrd(m_Folder / "flat.nrrd", "type: uint8\ndimension: 2\nsizes: 4 4\n", std::string(16, '\1'));
  ExpectUnfit("flat.nrrd");
}

TEST_F(BadInput, ColourImage)
{
  WriteNrrd(m_Folder / "colour.nrrd",
            "type: uint8\ndimension: 4\nsizes: 3 4 4 4\nkinds: RGB-color domain domain domain\n",
            std::string(192, '\1'));
  ExpectUnfit("colour.nrrd");
}

TEST_F(BadInput, NegativeLabels)
{
  std::string bytes(64, '\1');
  bytes[21] = '\xFF';
  WriteNrrd(m_Folder / "negative.nrrd", "type: int8\ndimension: 3\nsizes: 4 4 4\n", bytes);
  ExpectUnfit("negative.nrrd", { "-1" });
}

TEST_F(BadInput, FractionalLabels)
{
  std::vector<float> values(64, 1.0F);
  values[5] = 0.75F;
  WriteNrrd(m_Folder / "fraction.nrrd",
            "type: float\ndimension: 3\nsizes: 4 4 4\nendian: little\n",
            { reinterpret_cast<const char *>(values.data()), values.size() * sizeof(float) });
  ExpectUnfit("fraction.nrrd", { "0.75" });
}

TEST_F(BadInput, NothingButBackground)
{
  WriteNrrd(m_Folder / "empty.nrrd", TestScan({ 4, 5, 6 }));
  ExpectUnfit("empty.nrrd");
}

TEST_F(BadInput, LabelThatDoesNotOccur)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  for (const char * labels : { "3", "1,77", "liver" })
  {
    const std::string wrong = std::string(labels) == "1,77" ? "77" : labels;
    ExpectRefusal(RunProgram({ "core", m_Folder / "a.nrrd", "--labels", labels, "-o", m_Folder / "out.vtp" }),
                  3,
                  { "a.nrrd", wrong });
  }
  EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" });
}

TEST_F(BadInput, AThresholdThatNoVoxelLiesInIsNamed)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  ExpectRefusal(RunProgram({ "core", m_Folder / "a.nrrd", "--threshold", "70:inf", "-o", m_Folder / "out.vtp" }),
                3,
                { "a.nrrd", "no voxel lies within the threshold 70:inf" });
}

TEST_F(BadInput, ASkeletonGivenForAMedialSurfaceIsCalledSo)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  ASSERT_EQ(RunProgram({ "skeleton", m_Folder / "a.nrrd", "-o", m_Folder / "s.vtp" }).code, 0);
  ExpectRefusal(RunProgram({ "verify", m_Folder / "a.nrrd", m_Folder / "s.vtp" }), 3, { "s.vtp", "it is a skeleton" });
}

class BadUsage : public BadInput
{
protected:
  BadUsage()
  {
    WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  }
  void
  ExpectUsageError(std::vector<std::string> arguments, const std::vector<std::string> & words)
  {
    ExpectRefusal(RunProgram(arguments), 2, words);
    EXPECT_EQ(m_Folder.Names(), Names{ "a.nrrd" });
  }
  std::vector<std::string>
  Core(const std::vector<std::string> & more)
  {
    std::vector<std::string> arguments{ "core", m_Folder / "a.nrrd", "-o", m_Folder / "out.vtp" };
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
};

TEST_F(BadUsage, LambdaWithoutSense)
{
  ExpectUsageError(Core({ "--lambda", "3apples" }), { "3apples", "mm", "vox", "%" });
  ExpectUsageError(Core({ "--lambda", "-1" }), { "-1" });
  ExpectUsageError(Core({ "--lambda=-1mm" }), { "-1mm" });
  ExpectUsageError(Core({ "--lambda", "" }), { "ambda" });
  ExpectUsageError(Core({ "--lambda", "1,1mm" }), { "1mm", "twice" });
}

TEST_F(BadUsage, OptionsWithoutSense)
{
  ExpectUsageError(Core({ "--threads", "-1" }), { "--threads" });
  ExpectUsageError(Core({ "--threads", "many" }), { "--threads", "many" });
  ExpectUsageError(Core({ "--spacing", "1,2" }), { "--spacing", "1,2" });
  ExpectUsageError(Core({ "--threshold", "9:1" }), { "--threshold", "9:1" });
  ExpectUsageError(Core({ "--nifti-form", "xform" }), { "--nifti-form", "sform" });
  ExpectUsageError(Core({ "--engine", "cgal" }), { "--engine", "tetgen" });
  ExpectUsageError(Core({ "--progress", "loud" }), { "--progress", "plain" });
  ExpectUsageError(Core({ "--binary", "--labels", "2" }), { "--binary", "--labels" });
  ExpectUsageError(Core({ "--colour" }), { "--colour" });
  ExpectUsageError(Core({ "--lambda" }), { "--lambda" });
  ExpectUsageError(Core({ "--lambda", "1", "--lambda", "2" }), { "--lambda: is given more than once" });
  ExpectUsageError(Core({ "surplus" }), { "surplus" });
  ExpectUsageError(Core({ "two\nlines" }), {});
}

TEST_F(BadUsage, MissingOrUnknownParts)
{
  ExpectUsageError({}, { "--help" });
  ExpectUsageError({ "shrink" }, { "shrink" });
  ExpectUsageError({ "core" }, { "SCAN" });
  ExpectUsageError({ "core", m_Folder / "a.nrrd" }, { "--output" });
  ExpectUsageError({ "core", m_Folder / "a.nrrd", "-o", "" }, { "--output" });
  ExpectUsageError({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "out.xyz" }, { "out.xyz", ".vtp" });
  ExpectUsageError({ "core", m_Folder / "a.nrrd", "-o", m_Folder / "out" }, { "out", ".vtp" });
  ExpectUsageError({ "phantom", "moebius", "-o", m_Folder / "out.nrrd" }, { "moebius" });
  ExpectUsageError({ "phantom", "ball", "-o", m_Folder / "out.xyz" }, { "out.xyz" });
  ExpectUsageError({ "phantom", "ball" }, { "--output" });
  ExpectUsageError({ "prune", m_Folder / "a.nrrd", "-o", m_Folder / "out.vtp" }, { "--lambda" });
}

/** Puts another number at the place of the first value of an array that VTK wrote as appended doubles. */
void
SetFirst(const std::filesystem::path & from, const std::filesystem::path & to, const std::string & name, double value)
{
  std::string       bytes = UnpackedVtp(ReadAll(from));
  const std::string mark = "Name=\"" + name + "\"";
  const auto        array = bytes.find(mark);
  ASSERT_NE(array, std::string::npos);
  const auto        offset = bytes.find("offset=\"", array);
  const auto        begin = bytes.find('_', bytes.find("<AppendedData")) + 1;
  const std::size_t at = begin + std::stoul(bytes.substr(offset + 8)) + 8; // behind the count of bytes
  bytes.replace(at, sizeof(value), reinterpret_cast<const char *>(&value), sizeof(value));
  WriteAll(to, bytes);
}

TEST_F(BadInput, ACoreOrSkeletonWithANumberThatCannotBeIsRefusedByEveryCommand)
{
  TestScan ball({ 12, 11, 10 });
  ball.Fill({ 2, 2, 2 }, { 9, 8, 6 }, 1);
  WriteNrrd(m_Folder / "a.nrrd", ball);
  ASSERT_EQ(RunProgram({ "core", m_Folder / "a.nrrd", "--lambda", "0", "--keep-edges", "-o", m_Folder / "a.vtp" }).code,
            0);
  ASSERT_EQ(RunProgram({ "skeleton", m_Folder / "a.nrrd", "-o", m_Folder / "s.vtp" }).code, 0);
  for (const double value : { 1e17, -1.0, std::nan("") })
  {
    SetFirst(m_Folder / "a.vtp", m_Folder / "bad.vtp", "Radius", value);
    SetFirst(m_Folder / "s.vtp", m_Folder / "bent.vtp", "Radius", -1);
    const Names before = m_Folder.Names();
    const auto  refused = [&](const std::vector<std::string> & arguments, const char * file) {
      ExpectRefusal(RunProgram(arguments), 3, { file });
      EXPECT_EQ(m_Folder.Names(), before) << arguments[0];
    };
    refused({ "skeleton", m_Folder / "bad.vtp", "-o", m_Folder / "o.vtp" }, "bad.vtp");
    refused({ "sheets", m_Folder / "bad.vtp", "-o", m_Folder / "o.vtp" }, "bad.vtp");
    refused({ "reconstruct", m_Folder / "bad.vtp", "-o", m_Folder / "o.nrrd" }, "bad.vtp");
    refused({ "prune", m_Folder / "bad.vtp", "--lambda", "2vox", "-o", m_Folder / "o.vtp" }, "bad.vtp");
    refused({ "verify", m_Folder / "a.nrrd", m_Folder / "bad.vtp" }, "bad.vtp");
    refused({ "measure", m_Folder / "bent.vtp", "-o", m_Folder / "o.csv" }, "bent.vtp");
#ifdef VOXELCORE_HAS_DISPLAY
    refused({ "render", m_Folder / "bad.vtp", "-o", m_Folder / "o.png" }, "bad.vtp");
    ExpectRefusal(RunProgram({ "render", m_Folder / "bent.vtp", "-o", m_Folder / "o.png" }),
                  3,
                  { "bent.vtp", "a Radius or BallRadius is below 0" });
#endif
  }
}

} // namespace
} // namespace voxelcore::testing
