#include "voxelcore/Jobs/CostModel.h"

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Jobs/OutputNames.h"
#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::Ellipsoid;
using testing::Size3;

CoreOptions
OptionsInto(const std::filesystem::path & output)
{
  CoreOptions options;
  options.lambdas = ParseLambdas("1.5vox");
  options.output = output;
  return options;
}

const std::filesystem::path kFile = "result.vtp";
const std::filesystem::path kFolder = "results/";

TEST(CostModel, LargerShapesCostMore)
{
  CostPrediction before = PredictLabel({}, 1);
  for (const std::int32_t side : { 4, 16, 64, 200 })
  {
    const CostPrediction next = PredictLabel(CountBoundary(Box({ side, side, side })), 1);
    EXPECT_GT(next.memoryBytes, before.memoryBytes) << side;
    EXPECT_GT(next.seconds, before.seconds) << side;
    before = next;
  }
}

/** The Delaunay cells that a shape has, over those expected of its counts. */
double
CellsOverExpected(const VoxelShape & shape)
{
  const auto   cells = ComputeDelaunayCells(shape, BoundaryVertices(shape), SpacingWeights{}, Engine::Auto);
  const double expected = ComputeCostTerms(CountBoundary(shape)).values[2];
  return static_cast<double>(cells.CellCount()) / expected;
}

TEST(CostModel, CellsExpectedAreNearThoseThatAreThere)
{
  EXPECT_NEAR(CellsOverExpected(Ellipsoid(64)), 1, 0.1);
  EXPECT_NEAR(CellsOverExpected(Box({ 40, 30, 9 })), 1, 0.2);
  // Of a sheet of one voxel each voxel is a cell, and there are no others.
  EXPECT_NEAR(CellsOverExpected(Box({ 20, 30, 1 })), 1, 0.03);
  for (const char * kind : { "root", "gyroid", "porous", "tanglecube" })
  {
    PhantomOptions options;
    options.kind = kind;
    EXPECT_NEAR(CellsOverExpected(CropToVoxels(MakePhantom(options))), 1, 0.25) << kind;
  }
}

TEST(CostModel, FlatSidesTakeTimeOnlyWhereTheyAreThick)
{
  const auto   seconds = [](const Size3 & size) { return PredictLabel(CountBoundary(Box(size)), 1).seconds; };
  const double rough = PredictLabel(CountBoundary(Ellipsoid(150)), 1).seconds; // 40 thousand boundary vertices
  EXPECT_LT(seconds({ 140, 140, 9 }), 0.6 * rough);                            // 45 thousand; half is measured
  EXPECT_GT(seconds({ 140, 140, 18 }), 2 * seconds({ 140, 140, 9 }));
}

TEST(CostModel, ThinShapesLeaveLittleToKeepOncePruned)
{
  const auto memory = [](const Size3 & size) {
    const std::vector<BoundaryCounts> labels(100, CountBoundary(Box(size)));
    return PredictJob(labels, OptionsInto(kFile), 1).memoryBytes -
           PredictJob(labels, OptionsInto(kFolder), 1).memoryBytes;
  };
  EXPECT_LT(5 * memory({ 60, 60, 2 }), memory({ 60, 60, 5 }));
}

TEST(CostModel, AJobOfOneLabelCostsWhatTheLabelDoes)
{
  const BoundaryCounts counts = CountBoundary(Box({ 90, 40, 60 }));
  const CostPrediction label = PredictLabel(counts, 1);
  const CostPrediction job = PredictJob({ counts }, OptionsInto(kFolder), 1);
  EXPECT_NEAR(static_cast<double>(job.memoryBytes), static_cast<double>(label.memoryBytes), 1);
  EXPECT_DOUBLE_EQ(job.seconds, label.seconds);
}

TEST(CostModel, ResultsThatWaitForTheirFileTakeMemoryInAFolderTheyDoNot)
{
  const std::vector<BoundaryCounts> labels(100, CountBoundary(Box({ 60, 60, 60 })));
  const auto                        one = PredictJob({ labels[0] }, OptionsInto(kFolder), 1);
  EXPECT_EQ(PredictJob(labels, OptionsInto(kFolder), 1).memoryBytes, one.memoryBytes);
  EXPECT_GT(PredictJob(labels, OptionsInto(kFile), 1).memoryBytes, 2 * one.memoryBytes);
}

TEST(CostModel, SmallLabelsRunSideBySide)
{
  const std::vector<BoundaryCounts> labels(64, CountBoundary(Box({ 30, 30, 30 })));
  const auto                        one = PredictJob(labels, OptionsInto(kFolder), 1);
  const auto                        four = PredictJob(labels, OptionsInto(kFolder), 4);
  EXPECT_LT(four.seconds, 0.3 * one.seconds);
  EXPECT_GT(four.memoryBytes, one.memoryBytes);
}

TEST(CostModel, EachThingAskedForCosts)
{
  const std::vector<BoundaryCounts> labels{ CountBoundary(Box({ 60, 60, 60 })) };
  const auto                        plain = PredictJob(labels, OptionsInto(kFile), 1);
  const auto                        expectMore = [&](const char * what, const CoreOptions & options) {
    const auto more = PredictJob(labels, options, 1);
    EXPECT_GT(more.memoryBytes, plain.memoryBytes) << what;
    EXPECT_GE(more.seconds, plain.seconds) << what;
  };
  CoreOptions options = OptionsInto(kFile);
  options.lambdas = ParseLambdas("0,1vox,2vox");
  expectMore("lambdas", options);
  options = OptionsInto(kFile);
  options.model.keepEdges = true;
  expectMore("edges", options);
  options = OptionsInto(kFile);
  options.tolerances = ParseTolerances("1.2diag");
  expectMore("tolerance", options);
  options = OptionsInto(kFile);
  options.crossCheck = true;
  expectMore("cross-check", options);
}

TEST(CostModel, SkeletonsAndPagesCost)
{
  const std::vector<BoundaryCounts> labels{ CountBoundary(Ellipsoid(100)) };
  const CostPrediction              plain = PredictJob(labels, OptionsInto(kFile), 1);
  CoreOptions                       options = OptionsInto(kFile);
  options.skeleton = SkeletonRequest();
  const CostPrediction skeleton = PredictJob(labels, options, 1);
  EXPECT_GT(skeleton.memoryBytes, plain.memoryBytes);
  EXPECT_GT(skeleton.seconds, plain.seconds);
  options = OptionsInto(kFile);
  options.display.html = "page.html";
  const CostPrediction page = PredictJob(labels, options, 1);
  EXPECT_GT(page.memoryBytes, plain.memoryBytes);
  EXPECT_GT(page.seconds, plain.seconds);
  // A page needs all labels at a time, in a folder as well.
  const std::vector<BoundaryCounts> many(100, labels.front());
  options.output = kFolder;
  EXPECT_GT(PredictJob(many, options, 1).memoryBytes, 10 * page.memoryBytes);
}

TEST(CostModel, MemoryIsReadWithItsUnit)
{
  EXPECT_EQ(ParseMemory("8GB"), 8000000000U);
  EXPECT_EQ(ParseMemory("1.5 gb"), 1500000000U);
  EXPECT_EQ(ParseMemory("512MiB"), 512U << 20);
  EXPECT_EQ(ParseMemory("2TiB"), std::uint64_t{ 2 } << 40);
  EXPECT_EQ(ParseMemory("900kB"), 900000U);
  EXPECT_EQ(ParseMemory("4096B"), 4096U);
  for (const char * text : { "",
                             "8",
                             "GB",
                             "8G",
                             "-1GB",
                             "8XB",
                             "8GBB",
                             "8 G B",
                             "nan",
                             "1e3GB",
                             "0MB",
                             "8GiBs",
                             "99999999999TB",
                             "1..5GB" })
  {
    EXPECT_THROW(ParseMemory(text), UsageError) << text;
  }
}

TEST(CostModel, MemoryIsSaidRoundedUp)
{
  EXPECT_EQ(MemoryText(1), "1 kB");
  EXPECT_EQ(MemoryText(999999), "1000 kB");
  EXPECT_EQ(MemoryText(1000000), "1 MB");
  EXPECT_EQ(MemoryText(849100000), "850 MB");
  EXPECT_EQ(MemoryText(2010000000), "2.1 GB");
}

} // namespace
} // namespace voxelcore
