// What jobs tell of their progress: it never goes back, ends at 1, and its stages have parts of their own.

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Compare/CompareCommand.h"
#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Vessels/StraightenCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/JobContext.h"
#include "voxelcore/Options/Requests.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <map>
#include <set>

namespace voxelcore::testing
{
namespace
{

/** Everything a job reports. */
struct Recorder
{
  std::vector<std::pair<std::string, double>> reports;

  JobContext
  Context()
  {
    JobContext context;
    context.progress = [this](std::string_view stage, double fraction) {
      reports.emplace_back(stage, fraction);
      return true;
    };
    return context;
  }
  /** The part of the bar of the stages whose names hold a word. */
  double
  Share(const std::string & word) const
  {
    double share = 0;
    for (std::size_t i = 0; i + 1 < reports.size(); ++i)
    {
      share += reports[i].first.find(word) != std::string::npos ? reports[i + 1].second - reports[i].second : 0.0;
    }
    return share;
  }
};

void
ExpectForward(const Recorder & recorder, const std::string & what)
{
  ASSERT_GE(recorder.reports.size(), 2U) << what;
  double last = 0;
  for (const auto & [stage, fraction] : recorder.reports)
  {
    EXPECT_GE(fraction, last) << what << ": " << stage;
    EXPECT_LE(fraction, 1.0) << what << ": " << stage;
    EXPECT_FALSE(stage.empty()) << what;
    last = fraction;
  }
  EXPECT_EQ(last, 1.0) << what;
  EXPECT_EQ(recorder.reports.back().first, "done") << what;
}

class Progress : public ::testing::Test
{
protected:
  std::string
  At(const std::string & name) const
  {
    return (m_Folder.Path() / name).string();
  }
  void
  Make(const std::string & kind, const std::string & name, const std::string & size) const
  {
    ParameterValues values{ { "kind", kind }, { "size", size }, { "output", At(name) } };
    if (values.at("kind") == "cells")
    {
      values["cells"] = "60"; // bodies of some hundred voxels
    }
    RunPhantomJob(PhantomOptionsFrom(values));
  }
  /** Runs a job, with 1 and with 3 threads, and looks at its reports; gives the last ones. */
  template <typename TJob>
  Recorder
  Watch(const std::string & what, const TJob & job) const
  {
    const int threads = omp_get_max_threads();
    Recorder  recorder;
    for (const int count : { 1, 3 })
    {
      omp_set_num_threads(count);
      recorder = Recorder();
      job(recorder.Context());
      ExpectForward(recorder, what + " with threads: " + std::to_string(count));
    }
    omp_set_num_threads(threads);
    return recorder;
  }
  Recorder
  Core(ParameterValues more) const
  {
    const std::string what = more.begin()->first + " " + more.begin()->second;
    more.insert({ { "scan", At("a.nrrd") }, { "output", At("a.vtp") }, { "force", "true" } });
    return Watch("core " + what, [&](const JobContext & context) { RunCoreJob(CoreOptionsFrom(more), context); });
  }

  TemporaryFolder m_Folder;
};

TEST_F(Progress, OfCoresNeverGoesBackAndEndsAtOne)
{
  Make("root", "a.nrrd", "48");
  Core({ { "lambda", "0,1vox,2vox" }, { "keep-edges", "true" } });
  Core({ { "tolerance", "0,1.2diag" } });
  Core({ { "refine", "labels" } });
  Core({ { "with-skeleton", "true" }, { "lambda", "0,2vox" } });
  Core({ { "mend-shape", "true" }, { "fill-cavities", "true" }, { "smooth-shape", "true" } });
}

TEST_F(Progress, OfSeveralLabelsNeverGoesBackAndEndsAtOne)
{
  Make("cells", "a.nrrd", "40");
  Core({ { "lambda", "1vox" } });
  Core({ { "with-skeleton", "true" }, { "mend-shape", "true" }, { "split-components", "true" } });
}

TEST_F(Progress, OfSkeletonsGivesEachStageItsPart)
{
  Make("root", "a.nrrd", "64");
  const Recorder recorder = Watch("skeleton", [&](const JobContext & context) {
    RunSkeletonJob(SkeletonOptionsFrom({ { "scan", At("a.nrrd") },
                                         { "output", At("s.vtp") },
                                         { "mend-shape", "true" },
                                         { "smooth-shape", "true" },
                                         { "force", "true" } }),
                   context);
  });
  Watch("compare", [&](const JobContext & context) {
    RunCompareJob(CompareOptionsFrom({ { "a", At("a.nrrd") }, { "b", At("a.nrrd") } }), context);
  });
  Watch("straighten", [&](const JobContext & context) {
    RunStraightenJob(StraightenOptionsFrom({ { "scan", At("a.nrrd") },
                                             { "skeleton", At("s.vtp") },
                                             { "from", "0,0,0" },
                                             { "to", "99,99,99" },
                                             { "output", At("v.nrrd") },
                                             { "force", "true" } }),
                     context);
  });
  EXPECT_GT(recorder.Share("mending"), 0.02);
  EXPECT_GT(recorder.Share("smoothing"), 0.01);
  EXPECT_GT(recorder.Share("delaunay"), 0.1);
  EXPECT_GT(recorder.Share("burning"), 0.25);
  EXPECT_LT(recorder.Share("burning"), 0.6);
}

TEST_F(Progress, OfFinishedFilesNeverGoesBackAndEndsAtOne)
{
  Make("cells", "a.nrrd", "32");
  Core({ { "lambda", "0" }, { "keep-edges", "true" } });
  Watch("prune", [&](const JobContext & context) {
    RunPruneJob(
      PruneOptionsFrom(
        { { "core", At("a.vtp") }, { "lambda", "1vox,2vox" }, { "output", At("p.vtp") }, { "force", "true" } }),
      context);
  });
  Watch("verify", [&](const JobContext & context) {
    RunVerifyJob(VerifyOptionsFrom({ { "scan", At("a.nrrd") }, { "core", At("a.vtp") } }), context);
  });
  Watch("skeleton of a core", [&](const JobContext & context) {
    RunSkeletonJob(SkeletonOptionsFrom({ { "scan", At("a.vtp") }, { "output", At("s.vtp") }, { "force", "true" } }),
                   context);
  });
  Watch("measure", [&](const JobContext & context) {
    RunMeasureJob(MeasureOptionsFrom({ { "skeleton", At("s.vtp") }, { "output", At("m.csv") }, { "force", "true" } }),
                  context);
  });
  Watch("reconstruct", [&](const JobContext & context) {
    RunReconstructJob(
      ReconstructOptionsFrom(
        { { "core", At("a.vtp") }, { "scan", At("a.nrrd") }, { "output", At("r.nrrd") }, { "force", "true" } }),
      context);
  });
  Watch("info", [&](const JobContext & context) {
    RunInfoJob(InfoOptionsFrom({ { "scan", At("a.nrrd") }, { "mend-shape", "true" } }), context);
  });
}

TEST(JobContext, ForwardOnlyKeepsAllButStepsBack)
{
  std::vector<double> seen;
  JobContext          context;
  TemporaryRegistry   registry;
  context.temporaries = &registry;
  context.progress = [&](std::string_view, double fraction) {
    seen.push_back(fraction);
    return fraction < 0.9;
  };
  double admitted = 0;
  context.admit = [&](double megabytes) { admitted = megabytes; };
  const JobContext forward = ForwardOnly(context);
  for (const double fraction : { 0.2, 0.5, 0.3, 0.6 })
  {
    EXPECT_TRUE(forward.progress("stage", fraction));
  }
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 0.6);
  EXPECT_FALSE(forward.progress("stage", 0.95)) << "a wish to stop comes through";
  EXPECT_EQ(forward.temporaries, &registry);
  forward.admit(7);
  EXPECT_EQ(admitted, 7);
  EXPECT_FALSE(ForwardOnly(JobContext{}).progress) << "of nobody is nobody";
}

TEST_F(Progress, MemoryIsAskedForOnceAndFilesAreNamedWhenAllIsDone)
{
  Make("cells", "a.nrrd", "24");
  int                                admissions = 0;
  std::vector<std::filesystem::path> written;
  JobContext                         context;
  context.admit = [&](double megabytes) {
    ++admissions;
    EXPECT_GT(megabytes, 0);
    EXPECT_FALSE(std::filesystem::exists(At("a.vtp")));
  };
  context.wrote = [&](const std::vector<std::filesystem::path> & files) {
    EXPECT_TRUE(written.empty()) << "once";
    written = files;
    for (const auto & file : files)
    {
      EXPECT_TRUE(std::filesystem::exists(file)) << file;
    }
  };
  const ParameterValues values{ { "scan", At("a.nrrd") }, { "output", At("a.vtp") }, { "report", At("a.json") } };
  RunCoreJob(CoreOptionsFrom(values), context);
  EXPECT_EQ(admissions, 1);
  EXPECT_EQ((std::set<std::filesystem::path>(written.begin(), written.end())),
            (std::set<std::filesystem::path>{ At("a.vtp"), At("a.json") }));
  // What is not admitted is not done.
  context.admit = [](double) { throw Cancelled(); };
  ParameterValues other = values;
  other["output"] = At("b.vtp");
  other["report"] = At("b.json");
  EXPECT_THROW(RunCoreJob(CoreOptionsFrom(other), context), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(At("b.vtp")));
}

} // namespace
} // namespace voxelcore::testing
