#include "JobFolder.h"

#include "voxelcore/Thickness/ThicknessCommand.h"
#include "voxelcore/Jobs/VerifyJob.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Thickness/ThicknessJob.h"

namespace voxelcore::testing
{
namespace
{

class VerifyJob : public JobFolder
{
protected:
  VerifyResult
  Verify(const std::string & scan, const std::string & core, const JobContext & context = {}) const
  {
    return RunVerifyJob({ At(scan), At(core) }, context);
  }
};

TEST_F(VerifyJob, WhatCoreWroteFromTheScanPassesLabelByLabel)
{
  Phantom("cells", "a.nrrd", "16");
  for (const ParameterValues & how : { ParameterValues{ { "lambda", "0" } },
                                       ParameterValues{ { "lambda", "1.5vox" } },
                                       ParameterValues{ { "tolerance", "1diag" } } })
  {
    ParameterValues more = how;
    more["force"] = "true";
    const CoreResult   made = Core("core.vtp", more);
    const VerifyResult result = Verify("a.nrrd", "core.vtp");
    EXPECT_TRUE(result.passed) << VerifyText(result);
    EXPECT_TRUE(result.notes.empty());
    ASSERT_EQ(result.labels.size(), made.report.labels.size());
    for (std::size_t i = 0; i < result.labels.size(); ++i)
    {
      EXPECT_EQ(result.labels[i].label, made.report.labels[i].label);
      EXPECT_EQ(result.labels[i].lambdaMm, made.report.labels[i].pruned.at(0).lambdaMm);
      EXPECT_EQ(result.labels[i].pruningTolerance, how.contains("tolerance") ? "1diag" : "");
    }
  }
}

TEST_F(VerifyJob, WhatThicknessWroteFromTheScanPassesAndOtherValuesFail)
{
  Phantom("ball", "a.nrrd", "16");
  for (const std::string refine : { "labels", "off" })
  {
    SCOPED_TRACE(refine);
    RunThicknessJob(ThicknessOptionsFrom({ { "scan", At("a.nrrd") },
                                           { "output", At("map.nrrd") },
                                           { "medial", At("medial.vtp") },
                                           { "refine", refine },
                                           { "force", "true" } }));
    const VerifyResult result = Verify("a.nrrd", "medial.vtp");
    EXPECT_TRUE(result.passed) << VerifyText(result);
    MedialModel model = ReadModel(At("medial.vtp"));
    ASSERT_FALSE(model.parts.at(0).thickness.empty());
    model.parts[0].thickness[0] *= 1.01;
    WriteModel(At("other.vtp"), At("other.vtp"), model, {});
    EXPECT_FALSE(Verify("a.nrrd", "other.vtp").passed);
  }
}

TEST_F(VerifyJob, OptionsAreThoseRecordedInTheFile)
{
  Phantom("noise", "a.nrrd", "8");
  Core("core.vtp", { { "crop", ":,:,2:6" }, { "fill-cavities", "true" }, { "largest", "1" } });
  EXPECT_TRUE(Verify("a.nrrd", "core.vtp").passed);
}

TEST_F(VerifyJob, TheMaskOfAGreyScanMayStandForIt)
{
  // A grey ball in noise, its mask by threshold as a scan of its own, and another mask.
  constexpr int kSide = 24;
  std::string   head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 24 24 24\nspacings: 1 1 1\nencoding: raw\n\n";
  std::string   grey = head;
  std::string   mask = head;
  std::string   other = head;
  std::uint32_t state = 1;
  for (int i = 0; i < kSide * kSide * kSide; ++i)
  {
    const int  x = i % kSide - 12;
    const int  y = i / kSide % kSide - 12;
    const int  z = i / kSide / kSide - 12;
    const bool isIn = x * x + y * y + z * z < 64;
    state = state * 1664525U + 1013904223U;
    grey += static_cast<char>((isIn ? 140 : 20) + (state >> 24U) % 40);
    mask += static_cast<char>(isIn ? 1 : 0);
    other += static_cast<char>(x * x + y * y + z * z < 49 ? 1 : 0);
  }
  WriteAll(At("grey.nrrd"), grey);
  WriteAll(At("mask.nrrd"), mask);
  WriteAll(At("other.nrrd"), other);
  Core("core.vtp", { { "scan", At("grey.nrrd") }, { "threshold", "100:inf" } });
  EXPECT_TRUE(Verify("grey.nrrd", "core.vtp").passed);
  const VerifyResult result = Verify("mask.nrrd", "core.vtp");
  EXPECT_TRUE(result.passed) << VerifyText(result);
  ASSERT_FALSE(result.notes.empty());
  EXPECT_NE(result.notes.front().find("taken as the mask itself"), std::string::npos) << result.notes.front();
  EXPECT_FALSE(Verify("other.nrrd", "core.vtp").passed);
}

TEST_F(VerifyJob, AnotherScanFailsAndThatItIsAnotherIsSaid)
{
  Phantom("ball", "a.nrrd", "16");
  Phantom("box", "b.nrrd", "16");
  Core("core.vtp");
  const VerifyResult result = Verify("b.nrrd", "core.vtp");
  EXPECT_FALSE(result.passed);
  ASSERT_FALSE(result.notes.empty());
  const std::string text = VerifyText(result);
  EXPECT_NE(text.find("label 1"), std::string::npos) << text;
  EXPECT_NE(text, VerifyText(Verify("a.nrrd", "core.vtp")));
}

TEST_F(VerifyJob, WhatIsMissingIsRefused)
{
  Phantom("cells", "a.nrrd", "16");
  Phantom("ball", "one.nrrd", "16");
  Core("core.vtp");
  EXPECT_THROW(Verify("one.nrrd", "core.vtp"), InputError) << "a label that the scan does not have";
  EXPECT_THROW(Verify("none.nrrd", "core.vtp"), InputError);
  EXPECT_THROW(Verify("a.nrrd", "none.vtp"), InputError);
  EXPECT_THROW(Verify("a.nrrd", "a.nrrd"), InputError);
  EXPECT_THROW(Verify("a.nrrd", "core.vtp", StoppingAfter(1)), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
