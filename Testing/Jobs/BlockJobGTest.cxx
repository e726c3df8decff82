#include "JobFolder.h"

#include "voxelcore/BlockJob.h"
#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/LabelVolume.h"

namespace voxelcore::testing
{
namespace
{

class BlockJob : public JobFolder
{
protected:
  BlockOptions
  Options(std::size_t block, std::size_t blocks, const std::string & scan = "a.nrrd") const
  {
    BlockOptions options;
    options.core = CoreOptionsFrom({ { "scan", At(scan) }, { "output", At("parts/") } });
    options.block = block;
    options.blocks = blocks;
    return options;
  }
  DelaunayCells
  Join(const std::vector<LatticePoint> & points, const std::string & scan = "a.nrrd") const
  {
    return JoinParts(At("parts"), At(scan), 1, 0, points);
  }
};

TEST_F(BlockJob, PartsJoinToTheCellsOfOneRun)
{
  Phantom("torus", "a.nrrd", "24");
  const VoxelShape shape = ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape;
  const auto       points = BoundaryVertices(shape);
  const auto       whole = ComputeDelaunayCells(shape, points, ComputeSpacingWeights({ 1, 1, 1 }), Engine::Auto);
  std::uint64_t    cells = 0;
  for (std::size_t block = 1; block <= 3; ++block)
  {
    if (block > 1)
    {
      EXPECT_THROW(Join(points), InputError) << "parts are missing";
    }
    const BlockOptions options = Options(block, 3);
    const BlockResult  result = RunBlockJob(options);
    ASSERT_EQ(result.parts.size(), 1U);
    EXPECT_EQ(result.parts[0].file, BlockPath(options, 1, 0));
    EXPECT_EQ(result.parts[0].boundaryVertices, points.size());
    EXPECT_LE(result.parts[0].subshapeVertices, points.size());
    cells += result.parts[0].cells;
    const std::string text = BlockText(result, options);
    EXPECT_NE(text.find("block " + std::to_string(block) + " of 3 of label 1"), std::string::npos) << text;
  }
  EXPECT_EQ(cells, whole.CellCount()) << "each is in one part";
  const DelaunayCells joined = Join(points);
  EXPECT_TRUE(joined.centres == whole.centres);
  EXPECT_TRUE(joined.facetCells == whole.facetCells);
  EXPECT_TRUE(joined.facetPoints == whole.facetPoints);
}

TEST_F(BlockJob, PartsAreNamedByScanLabelComponentAndCut)
{
  BlockOptions options = Options(2, 5);
  options.core.scan = "/somewhere/else/b.nii.gz";
  options.core.output = "out/";
  EXPECT_EQ(BlockPath(options, 7, 0), "out/b_label-7_block-2-of-5.vcb");
  EXPECT_EQ(BlockPath(options, 7, 3), "out/b_label-7_component-3_block-2-of-5.vcb");
}

TEST_F(BlockJob, PartsOfOtherCutsOrScansAreRefused)
{
  Phantom("ball", "a.nrrd", "16");
  const auto points = BoundaryVertices(ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape);
  EXPECT_THROW(Join(points), InputError) << "there is no folder";
  for (const std::size_t block : { 1, 2 })
  {
    RunBlockJob(Options(block, 2));
  }
  EXPECT_NO_THROW(Join(points));
  EXPECT_THROW(Join(points, "b.nrrd"), InputError) << "none of this scan";
  auto others = points;
  others.pop_back();
  EXPECT_THROW(Join(others), InputError) << "the scan has changed";
  RunBlockJob(Options(1, 3));
  EXPECT_THROW(Join(points), InputError) << "two cuts";
}

TEST_F(BlockJob, WhatFailsLeavesNothing)
{
  Phantom("ball", "a.nrrd", "16");
  EXPECT_THROW(RunBlockJob(Options(0, 2)), UsageError);
  EXPECT_THROW(RunBlockJob(Options(3, 2)), UsageError);
  BlockOptions file = Options(1, 2);
  file.core.output = At("part.vcb");
  EXPECT_THROW(RunBlockJob(file), UsageError);
  EXPECT_THROW(RunBlockJob(Options(1, 2, "none.nrrd")), InputError);
  EXPECT_THROW(RunBlockJob(Options(1, 2), StoppingAfter(1)), Cancelled);
  EXPECT_EQ(Names(), (std::set<std::string>{ "a.nrrd" }));
}

} // namespace
} // namespace voxelcore::testing
