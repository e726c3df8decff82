#include "voxelcore/Jobs/LabelGroups.h"
#include "VoxelCoreTesting/Threads.h"

#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/CoreJob.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <atomic>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <stdexcept>

namespace voxelcore
{
namespace
{

using testing::ReadAll;
using testing::TemporaryFolder;
using testing::Threads;
using testing::WriteAll;

TEST(GroupLabels, LargeLabelsStandAloneAndOrderIsKept)
{
  EXPECT_EQ(GroupLabels({}), (std::vector<std::size_t>{}));
  EXPECT_EQ(GroupLabels({ 8 }), (std::vector<std::size_t>{ 1 }));
  EXPECT_EQ(GroupLabels({ 8, 8, kSmallLabel }), (std::vector<std::size_t>{ 3 }));
  EXPECT_EQ(GroupLabels({ 8, kSmallLabel + 1, 8, 8 }), (std::vector<std::size_t>{ 1, 2, 4 }));
  EXPECT_EQ(GroupLabels({ kSmallLabel + 1, kSmallLabel + 1, 8 }), (std::vector<std::size_t>{ 1, 2, 3 }));
}

TEST(GroupLabels, NoGroupIsLargerThanItsBound)
{
  const std::vector<std::uint64_t> vertices(1000, 30000);
  std::size_t                      first = 0;
  for (const std::size_t end : GroupLabels(vertices))
  {
    EXPECT_LE((end - first) * 30000, kGroupVertices);
    EXPECT_TRUE(end == vertices.size() || (end + 1 - first) * 30000 > kGroupVertices) << "a group is filled";
    first = end;
  }
  EXPECT_EQ(first, vertices.size());
}

TEST(ProcessSideBySide, OutcomesComeInTheLabelsOrderFromOneThreadEach)
{
  const Threads                    threads(3);
  const std::vector<std::uint64_t> vertices{ 99, 5, 70, 8, 60, 50, 8, 8 };
  const auto                       outcomes = ProcessSideBySide(1,
                                          7,
                                          vertices,
                                          [](std::size_t label, const ProgressCallback &) {
                                            EXPECT_EQ(omp_get_max_threads(), 1);
                                            LabelOutcome outcome;
                                            outcome.record.label = static_cast<std::int64_t>(label);
                                            return outcome;
                                          },
                                          {});
  ASSERT_EQ(outcomes.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i)
  {
    EXPECT_EQ(outcomes[i].record.label, static_cast<std::int64_t>(i + 1));
  }
  EXPECT_EQ(omp_get_max_threads(), 3) << "as it was before";
}

TEST(ProcessSideBySide, TheFirstLabelThatFailsDecides)
{
  for (const int count : { 1, 2, 3, 7 })
  {
    const Threads threads(count);
    for (int round = 0; round < 50; ++round)
    {
      // The last label is the largest, so it fails first.
      const std::vector<std::uint64_t> vertices{ 8, 9, 10, 11, 12, 13, 1000 };
      std::atomic<int>                 ran = 0;
      try
      {
        ProcessSideBySide(0,
                          7,
                          vertices,
                          [&ran](std::size_t label, const ProgressCallback &) -> LabelOutcome {
                            ++ran;
                            if (label >= 2)
                            {
                              throw CertificateError("label " + std::to_string(label));
                            }
                            return {};
                          },
                          {});
        FAIL() << "no label failed";
      }
      catch (const CertificateError & error)
      {
        EXPECT_STREQ(error.what(), "label 2") << count << " threads";
        // And the largest, unless another thread has found label 2 to fail before it begins.
        EXPECT_GE(ran, count == 1 ? 4 : 3) << "0, 1 and 2";
      }
    }
  }
}

TEST(ProcessSideBySide, ProgressRunsForwardToOneAndStops)
{
  const Threads                    threads(3);
  const std::vector<std::uint64_t> vertices(40, 8);
  const LabelWork                  work = [](std::size_t, const ProgressCallback & progress) {
    // As stages do, on a copy of the callback, and more than once.
    const ProgressCallback copy = progress;
    ReportProgress(progress, "a", 0);
    ReportProgress(copy, "a", 0.5);
    ReportProgress(progress, "b", 0.5);
    ReportProgress(copy, "b", 1);
    return LabelOutcome{};
  };
  std::atomic<int> inside = 0;
  double           last = 0;
  int              calls = 0;
  ProcessSideBySide(0, 40, vertices, work, [&](std::string_view, double fraction) {
    EXPECT_EQ(++inside, 1) << "two calls at a time";
    EXPECT_GE(fraction, last);
    last = fraction;
    ++calls;
    --inside;
    return true;
  });
  EXPECT_DOUBLE_EQ(last, 1);
  EXPECT_EQ(calls, 160);
  for (const int stop : { 0, 1, 77, 159 })
  {
    int seen = 0;
    EXPECT_THROW(ProcessSideBySide(0, 40, vertices, work, [&](std::string_view, double) { return seen++ != stop; }),
                 Cancelled);
    EXPECT_EQ(seen, stop + 1) << "not asked again";
  }
}

/** A raw NRRD of bytes: 59 labels with holes. */
void
WriteManyLabels(const std::filesystem::path & path, std::uint64_t seed)
{
  constexpr std::size_t side = 40;
  std::mt19937_64       random(seed);
  std::string           voxels(side * side * side, '\0');
  for (std::size_t z = 0; z < side; ++z)
  {
    for (std::size_t y = 0; y < side; ++y)
    {
      for (std::size_t x = 0; x < side; ++x)
      {
        const std::size_t cell = 1 + x / 10 + 4 * (y / 10) + 16 * (z / 10);
        voxels[(z * side + y) * side + x] = static_cast<char>(random() % 16 == 0 ? 0 : cell % 60);
      }
    }
  }
  WriteAll(path,
           "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 40 40 40\nspace: left-posterior-superior\n"
           "space directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (3,4,5)\nencoding: raw\n\n" +
             voxels);
}

TEST(ParallelTasks, FilesDoNotDependOnTheNumberOfThreads)
{
  const std::uint64_t seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  std::cout << "seed " << seed << "\n";
  const TemporaryFolder folder;
  WriteManyLabels(folder / "s.nrrd", seed);
  std::string expected;
  for (const int count : { 1, 2, 3, 7 })
  {
    const Threads threads(count);
    CoreOptions   options;
    options.scan = folder / "s.nrrd";
    options.output = folder / ("out" + std::to_string(count) + ".vtp");
    options.lambdas = ParseLambdas("1.5vox");
    const CoreResult result = RunCoreJob(options);
    ASSERT_EQ(result.report.labels.size(), 59U);
    for (std::size_t i = 1; i < result.report.labels.size(); ++i)
    {
      EXPECT_LT(result.report.labels[i - 1].label, result.report.labels[i].label);
    }
    const StageSeconds & seconds = result.report.seconds;
    EXPECT_LE(seconds.read + seconds.shape + seconds.delaunay + seconds.core + seconds.prune + seconds.write,
              seconds.total * 1.001)
      << "wall-clock seconds, side by side or not";
    const std::string bytes = ReadAll(options.output);
    ASSERT_FALSE(bytes.empty());
    if (expected.empty())
    {
      expected = bytes;
    }
    EXPECT_TRUE(bytes == expected) << count << " threads";
  }
}

} // namespace
} // namespace voxelcore
