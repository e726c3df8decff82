// Mistyped commands and options: the nearest name is suggested, and nothing else is blamed.

#include "CommandFixture.h"
#include "Scans.h"

namespace voxelcore::testing
{
namespace
{

class UnknownNames : public CommandFixture
{};

TEST_F(UnknownNames, CommandsSuggestTheNearest)
{
  ExpectRefusal(RunProgram({ "skeletn", "a.nrrd" }), 2, { "'skeletn' is not a command; did you mean 'skeleton'?" });
  ExpectRefusal(RunProgram({ "quantum" }), 2, { "'quantum' is not a command; see 'voxelcore --help'" });
  ExpectRefusal(RunProgram({ "--quiet", "core" }), 2, { "--quiet: a command comes first" });
}

TEST_F(UnknownNames, OptionsSuggestTheNearestAndDoNotBlameTheirValues)
{
  const ProgramResult result = RunProgram({ "core", "a.nrrd", "--lamda", "1mm", "-o", "a.vtp" });
  ExpectRefusal(result, 2, { "--lamda: unknown option; did you mean '--lambda'?; see 'voxelcore core --help'" });
  EXPECT_EQ(result.error.find("1mm"), std::string::npos) << result.error;
  ExpectRefusal(RunProgram({ "core", "a.nrrd", "--lamda=1mm", "-o", "a.vtp" }), 2, { "'--lambda'" });
  ExpectRefusal(RunProgram({ "core", "a.nrrd", "-lambda", "1mm", "-o", "a.vtp" }), 2, { "did you mean '--lambda'?" });
  ExpectRefusal(RunProgram({ "core", "a.nrrd", "-x", "-o", "a.vtp" }), 2, { "-x: unknown option" });
  ExpectRefusal(RunProgram({ "info", "a.nrrd", "--jason" }), 2, { "'--json'" });
}

TEST_F(UnknownNames, MissingValuesAndExtraArgumentsAreNamed)
{
  ExpectRefusal(RunProgram({ "core", "a.nrrd", "-o", "a.vtp", "--lambda" }), 2, { "--lambda: needs a value: L[,L..]" });
  ExpectRefusal(RunProgram({ "core", "a.nrrd", "b.nrrd", "-o", "a.vtp" }),
                2,
                { "'b.nrrd': one argument too many", "SCAN" });
}

TEST_F(UnknownNames, ValuesThatLookLikeOptionsAndNamesBehindTwoDashesAreTaken)
{
  TestScan scan({ 6, 6, 6 });
  scan.Fill({ 1, 1, 1 }, { 4, 4, 4 }, 1);
  WriteNrrd(Path("scan.nrrd"), scan);
  Run({ "core", Path("scan.nrrd"), "--threshold", "-5:5", "-o", Path("a.vtp"), "-q", "-l0" });
  Run({ "core", "-qo", Path("b.vtp"), "--", Path("scan.nrrd") });
}

TEST_F(UnknownNames, LengthsThatAreNoLambdaAreNotCalledSo)
{
  WriteNrrd(m_Folder / "a.nrrd", ThreeBlocks());
  ExpectRefusal(RunProgram({ "sheets", Path("a.nrrd"), "-o", Path("out.vtp"), "--sliver", "-1" }),
                2,
                { "--sliver: length '-1' is negative" });
  for (const std::string option : { "--plates", "--smooth", "--stand-out", "--prune-branches" })
  {
    ExpectRefusal(RunProgram({ "skeleton", Path("a.nrrd"), "-o", Path("out.vtp"), option, "-1" }),
                  2,
                  { option + ": length '-1' is negative" });
  }
}

TEST_F(UnknownNames, VolumesAreRefusedByTheirOwnNameBeforeAnythingIsComputed)
{
  const std::string refusal = Path("out.png") + ": unknown extension";
  ExpectRefusal(RunProgram({ "phantom", "ball", "-o", Path("out.png") }), 2, { refusal });
  ExpectRefusal(RunProgram({ "reconstruct", Path("none.vtp"), "-o", Path("out.png") }), 2, { refusal });
  ExpectRefusal(RunProgram({ "voxelize", Path("none.stl"), "--spacing", "1", "-o", Path("out.png") }), 2, { refusal });
}

TEST_F(UnknownNames, UsageNamesTheWholeCommand)
{
  EXPECT_NE(Run({ "core", "--help" }).find("Usage: voxelcore core [OPTIONS] SCAN -o OUT\n"), std::string::npos);
  EXPECT_NE(Run({ "verify", "--help" }).find("Usage: voxelcore verify [OPTIONS] SCAN CORE.vtp\n"), std::string::npos);
  EXPECT_NE(Run({ "batch", "--help" }).find("Usage: voxelcore batch [OPTIONS] [INPUT...] -o OUTDIR\n"),
            std::string::npos);
}

TEST_F(UnknownNames, HelpHasHeadingsInTheOrderOfNeed)
{
  const std::string text = Run({ "core", "--help" });
  std::size_t       last = 0;
  for (const char * heading :
       { "Arguments", "Input", "Output", "Pruning", "Shape edits", "Refinement", "Skeleton", "Running", "Examples" })
  {
    const std::size_t at = text.find("\n\n" + std::string(heading) + ":\n");
    ASSERT_NE(at, std::string::npos) << heading;
    EXPECT_LT(last, at) << heading;
    last = at;
  }
}

} // namespace
} // namespace voxelcore::testing
