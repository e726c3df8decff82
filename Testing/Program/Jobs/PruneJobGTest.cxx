#include "JobFolder.h"

#include "voxelcore/Jobs/PruneJob.h"
#include "voxelcore/Jobs/VerifyJob.h"

namespace voxelcore::testing
{
namespace
{

class PruneJob : public JobFolder
{
protected:
  PruneResult
  Prune(const std::string & core,
        const std::string & output,
        ParameterValues     more,
        const JobContext &  context = {}) const
  {
    more.insert({ { "core", At(core) }, { "output", At(output) } });
    return RunPruneJob(PruneOptionsFrom(more), context);
  }
};

TEST_F(PruneJob, WritesTheBytesThatCoreWouldHaveWritten)
{
  Phantom("thick-and-thin", "a.nrrd", "24");
  Core("whole.vtp", { { "lambda", "0" }, { "keep-edges", "true" } });
  for (const char * lambda : { "0", "1vox", "2vox", "10%" })
  {
    Core("core.vtp", { { "lambda", lambda }, { "force", "true" } });
    const PruneResult result = Prune("whole.vtp", "pruned.vtp", { { "lambda", lambda }, { "force", "true" } });
    EXPECT_EQ(Bytes("pruned.vtp"), Bytes("core.vtp")) << lambda;
    ASSERT_EQ(result.report.labels.size(), 1U);
    EXPECT_EQ(result.report.labels[0].pruned.at(0).output, At("pruned.vtp"));
    EXPECT_EQ(result.report.labels[0].pruned.at(0).lambda, lambda);
  }
  Core("heights.vtp", { { "tolerance", "0" } });
  Core("core.vtp", { { "tolerance", "1.2diag" }, { "refine", "off" }, { "force", "true" } });
  Prune("heights.vtp", "pruned.vtp", { { "tolerance", "1.2diag" }, { "force", "true" } });
  EXPECT_EQ(ReadModel(At("pruned.vtp")).parts[0].core.positions, ReadModel(At("core.vtp")).parts[0].core.positions);
}

TEST_F(PruneJob, OfARefinedCoreGivesWhatVerifyFindsAgain)
{
  Phantom("thick-and-thin", "a.nrrd", "24");
  const auto verify = [&](const std::string & core) {
    const VerifyResult result = RunVerifyJob({ At("a.nrrd"), At(core) });
    EXPECT_TRUE(result.passed) << core << "\n" << VerifyText(result);
    EXPECT_NE(VerifyText(result).find("made again"), std::string::npos);
  };
  Core("l.vtp", { { "lambda", "0.5vox" }, { "refine", "labels" }, { "keep-edges", "true" } });
  Prune("l.vtp", "p.vtp", { { "lambda", "1vox,2vox" }, { "keep-edges", "true" } });
  Prune("p_lambda-1vox.vtp", "q.vtp", { { "lambda", "2vox" }, { "keep-edges", "true" } });
  EXPECT_EQ(Bytes("q.vtp"), Bytes("p_lambda-2vox.vtp"));
  verify("p_lambda-1vox.vtp");
  verify("q.vtp");
  // To what it is pruned to already: nothing changes.
  Prune("l.vtp", "same.vtp", { { "lambda", "0.5vox" }, { "keep-edges", "true" } });
  EXPECT_EQ(Bytes("same.vtp"), Bytes("l.vtp"));
  Core("t.vtp", { { "tolerance", "0" }, { "refine", "labels" }, { "keep-edges", "true" } });
  Prune("t.vtp", "h.vtp", { { "tolerance", "1.2diag" } });
  verify("h.vtp");
  Prune("t.vtp", "tl.vtp", { { "lambda", "1.5vox" } });
  verify("tl.vtp");
  const MedialModel read = ReadModel(At("h.vtp"));
  EXPECT_EQ(read.refined, "labels");
  Core("once.vtp", { { "tolerance", "1.2diag" }, { "refine", "labels" } });
  EXPECT_EQ(read.parts[0].core.cells.faceVertices, ReadModel(At("once.vtp")).parts[0].core.cells.faceVertices);
}

TEST_F(PruneJob, SeveralThresholdsGiveAFileEachAndWhatOneGives)
{
  Phantom("capsule", "a.nrrd");
  Core("whole.vtp", { { "lambda", "0" }, { "keep-edges", "true" } });
  Prune("whole.vtp", "one.vtp", { { "lambda", "2vox" } });
  Prune("whole.vtp", "p.vtp", { { "lambda", "1vox,2vox" }, { "report", At("p.json") } });
  EXPECT_EQ(Bytes("p_lambda-2vox.vtp"), Bytes("one.vtp"));
  EXPECT_TRUE(Names().contains("p_lambda-1vox.vtp"));
  EXPECT_TRUE(Names().contains("p.json"));
}

TEST_F(PruneJob, WhatAFileDoesNotHoldIsRefusedAndLeavesNothing)
{
  Phantom("capsule", "a.nrrd");
  Core("plain.vtp", { { "lambda", "0" } });
  Core("pruned.vtp", { { "lambda", "2vox" }, { "keep-edges", "true" } });
  Core("high.vtp", { { "tolerance", "1diag" } });
  const auto before = Names();
  EXPECT_THROW(Prune("plain.vtp", "p.vtp", { { "lambda", "2vox" } }), InputError) << "no measures of edges";
  EXPECT_THROW(Prune("plain.vtp", "p.vtp", { { "tolerance", "1diag" } }), InputError) << "no tolerances";
  EXPECT_THROW(Prune("pruned.vtp", "p.vtp", { { "lambda", "1vox" } }), InputError) << "pruned further already";
  EXPECT_THROW(Prune("high.vtp", "p.vtp", { { "tolerance", "0.5diag" } }), InputError);
  EXPECT_THROW(Prune("a.nrrd", "p.vtp", { { "lambda", "1vox" } }), InputError);
  EXPECT_THROW(Prune("none.vtp", "p.vtp", { { "lambda", "1vox" } }), InputError);
  EXPECT_THROW(Prune("pruned.vtp", "p.txt", { { "lambda", "2vox" } }), UsageError);
  EXPECT_THROW(Prune("pruned.vtp", "pruned.vtp", { { "lambda", "2vox" }, { "force", "true" } }), Error)
    << "its own input";
  EXPECT_THROW(Prune("pruned.vtp", "p.vtp", { { "lambda", "3vox" } }, StoppingAfter(2)), Cancelled);
  EXPECT_EQ(Names(), before);
  EXPECT_NO_THROW(Prune("pruned.vtp", "p.vtp", { { "lambda", "3vox" } }));
}

} // namespace
} // namespace voxelcore::testing
