// What the program says of scans that leave something open: no voxel size, or no labels.

#include "CommandFixture.h"
#include "Program.h"
#include "Scans.h"

#include <gmock/gmock.h>
#include <random>

namespace voxelcore::testing
{
namespace
{

using ::testing::HasSubstr;
using ::testing::Not;

class ScanWords : public CommandFixture
{
protected:
  /** A box of label 1 in 8^3 voxels of no size. */
  std::string
  WithoutSpacing()
  {
    TestScan scan({ 8, 8, 8 });
    scan.Fill({ 1, 1, 1 }, { 5, 6, 4 }, 1);
    WriteNrrd(m_Folder / "a.nrrd", Header(8), std::string(scan.voxels.begin(), scan.voxels.end()));
    return m_Folder / "a.nrrd";
  }

  /** A bright ball in noise, 8 bits. */
  std::string
  Grey(const std::string & name)
  {
    constexpr int                    side = 24;
    std::mt19937                     random(3);
    std::normal_distribution<double> noise(0, 9);
    std::string                      bytes;
    for (int i = 0; i < side * side * side; ++i)
    {
      const double x = i % side - 11.5;
      const double y = i / side % side - 11.5;
      const double z = i / side / side - 11.5;
      bytes += static_cast<char>(std::lround((x * x + y * y + z * z < 64 ? 170 : 70) + noise(random)));
    }
    WriteNrrd(m_Folder / name, Header(side) + "spacings: 1 1 1\n", bytes);
    return m_Folder / name;
  }

  static std::string
  Header(int side)
  {
    const std::string n = std::to_string(side);
    return "type: uint8\ndimension: 3\nsizes: " + n + " " + n + " " + n + "\n";
  }
};

TEST_F(ScanWords, AMissingVoxelSizeIsWarnedOfOnceByEveryCommand)
{
  const std::string scan = WithoutSpacing();
  const std::string warning =
    "a.nrrd: no voxel size in the file: all lengths are in voxels. Give the true size with --spacing X,Y,Z.";
  const std::vector<std::vector<std::string>> commands{
    { "info", scan },
    { "core", scan, "-o", Path("a.vtp"), "--lambda", "1vox" },
    { "skeleton", scan, "-o", Path("s.vtp") },
    { "verify", scan, Path("a.vtp") },
    { "reconstruct", Path("a.vtp"), "-o", Path("r.nrrd"), "--scan", scan },
    { "reconstruct", Path("a.vtp"), "-o", Path("l.nrrd"), "--like", scan },
#ifdef VOXELCORE_HAS_DISPLAY
    { "render", Path("a.vtp"), "-o", Path("a.png"), "--scan", scan, "--size", "64x64" },
#endif
  };
  for (const auto & command : commands)
  {
    const ProgramResult result = RunProgram(command);
    EXPECT_EQ(result.code, 0) << command[0];
    EXPECT_EQ(result.error, "voxelcore: warning: " + warning + "\n") << command[0];
  }
  Run({ "core", scan, "-o", Path("b.vtp"), "--spacing", "1,1,1" });
  Run({ "batch", scan, "-o", Path("cohort"), "--lambda", "1vox" });
  const auto record = Report("cohort/sub-a/sub-a_case.json");
  EXPECT_EQ(record["warnings"], (nlohmann::json{ "warning: " + warning }));
}

TEST_F(ScanWords, AGreyScanStopsCoreSkeletonAndItsCaseAlone)
{
  const std::string              scan = Grey("ct.nrrd");
  const std::vector<std::string> words{ "ct.nrrd",
                                        "looks like a grey scan",
                                        "--threshold LO:HI",
                                        ":inf, of which",
                                        "--labels all" };
  ExpectRefusal(RunProgram({ "core", scan, "-o", Path("a.vtp") }), 3, words);
  ExpectRefusal(RunProgram({ "skeleton", scan, "-o", Path("a.vtp") }), 3, words);
  const std::string   labels = WithoutSpacing();
  const ProgramResult batch = RunProgram({ "batch", scan, labels, "-o", Path("cohort"), "--lambda", "1vox" });
  EXPECT_EQ(batch.code, 1);
  EXPECT_THAT(std::string(Report("cohort/sub-ct/sub-ct_case.json")["reason"]), HasSubstr("looks like a grey scan"));
  EXPECT_EQ(Report("cohort/sub-a/sub-a_case.json")["status"], "done");
  Run({ "core", scan, "-o", Path("b.vtp"), "--threshold", "120:inf" });
  Run({ "info", scan, "--labels", "all" });
}

TEST_F(ScanWords, InfoShowsAGreyScansHistogramAndProposesAThreshold)
{
  const std::string scan = Grey("ct.nrrd");
  const std::string text = Run({ "info", scan });
  for (const char * word :
       { "24 x 24 x 24", "looks like a grey scan", "####", "proposed", "by Otsu", "pieces", "loops" })
  {
    EXPECT_THAT(text, HasSubstr(word));
  }
  EXPECT_THAT(text, Not(HasSubstr("core needs")));
  EXPECT_THAT(text, Not(HasSubstr("skeleton")));
  const auto info = nlohmann::json::parse(Run({ "info", scan, "--json" }));
  EXPECT_TRUE(info["labels"].empty());
  for (const char * job : { "core", "skeleton", "page" })
  {
    EXPECT_FALSE(info.contains(job)) << job;
  }
  EXPECT_GT(info["grey"]["otsu"], 95);
  EXPECT_LT(info["grey"]["otsu"], 145);
  std::uint64_t voxels = 0;
  for (const std::uint64_t count : info["grey"]["histogram"]["voxels"])
  {
    voxels += count;
  }
  EXPECT_EQ(voxels, 24U * 24 * 24);
  // What it proposes is the ball, not the noise.
  const auto ball =
    nlohmann::json::parse(Run({ "info", scan, "--json", "--threshold", std::string(info["grey"]["threshold"]) }));
  EXPECT_NEAR(static_cast<double>(ball["labels"][0]["voxels"]), 4.0 / 3 * 3.14159 * 512, 100);
}

} // namespace
} // namespace voxelcore::testing
