#include "JobFolder.h"

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Jobs/BlockJob.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

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
  Join(const std::vector<LatticePoint> & points,
       const TopologyNumbers &           topology,
       const std::string &               scan = "a.nrrd") const
  {
    return JoinParts(At("parts"), At(scan), 1, 0, points, topology);
  }
};

TEST_F(BlockJob, PartsJoinToTheCellsOfOneRun)
{
  Phantom("torus", "a.nrrd", "24");
  const VoxelShape shape = ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape;
  const auto       points = BoundaryVertices(shape);
  const auto       topology = ComputeShapeTopology(shape);
  const auto       whole = ComputeDelaunayCells(shape, points, ComputeSpacingWeights({ 1, 1, 1 }), Engine::Auto);
  std::uint64_t    cells = 0;
  for (std::size_t block = 1; block <= 3; ++block)
  {
    if (block > 1)
    {
      EXPECT_THROW(Join(points, topology), InputError) << "parts are missing";
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
  TopologyNumbers other = topology;
  ++other.betti[1];
  EXPECT_THROW(Join(points, other), CertificateError);
  const DelaunayCells joined = Join(points, topology);
  EXPECT_TRUE(joined.centres == whole.centres);
  EXPECT_TRUE(joined.facetCells == whole.facetCells);
  EXPECT_TRUE(joined.facetPoints == whole.facetPoints);
}

TEST_F(BlockJob, PartsThatDoNotGoTogetherAreRefusedWithTheirFolder)
{
  Phantom("torus", "a.nrrd", "24");
  RunBlockJob(Options(1, 2));
  RunBlockJob(Options(2, 2));
  std::filesystem::copy_file(At("parts/a_label-1_block-1-of-2.vcb"),
                             At("parts/a_label-1_block-2-of-2.vcb"),
                             std::filesystem::copy_options::overwrite_existing);
  try
  {
    Join({}, {});
    FAIL() << "one part twice was joined";
  }
  catch (const InputError & error)
  {
    EXPECT_EQ(std::string(error.what()), At("parts") + ": block 1 was given twice; give it once");
  }
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
  const auto shape = ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape;
  const auto points = BoundaryVertices(shape);
  const auto topology = ComputeShapeTopology(shape);
  EXPECT_THROW(Join(points, topology), InputError) << "there is no folder";
  for (const std::size_t block : { 1, 2 })
  {
    RunBlockJob(Options(block, 2));
  }
  EXPECT_NO_THROW(Join(points, topology));
  EXPECT_THROW(Join(points, topology, "b.nrrd"), InputError) << "none of this scan";
  auto others = points;
  others.pop_back();
  EXPECT_THROW(Join(others, topology), InputError) << "the scan has changed";
  RunBlockJob(Options(1, 3));
  EXPECT_THROW(Join(points, topology), InputError) << "two cuts";
}

TEST_F(BlockJob, BlocksOfASizeJoinToTheCellsOfOneRun)
{
  Phantom("torus", "a.nrrd", "24");
  const VoxelShape shape = ReadLabelVolume(At("a.nrrd"), {}).labels.at(0).shape;
  const auto       points = BoundaryVertices(shape);
  BlockOptions     options = Options(1, 1);
  options.side = 9; // 24 voxels: 9, 9 and 6
  EXPECT_THROW(RunBlockJob(options), UsageError) << "of several shapes nobody knows all";
  options.core.reading.labels = "1";
  ASSERT_EQ(CountBlocks(options), 27U);
  std::uint64_t own = 0;
  for (options.block = 1; options.block <= 27; ++options.block)
  {
    const BlockResult result = RunBlockJob(options);
    ASSERT_EQ(result.parts.size(), 1U);
    own += result.parts[0].ownVertices;
    EXPECT_NE(BlockText(result, options).find("of 27 of label 1"), std::string::npos);
  }
  EXPECT_EQ(own, points.size());
  EXPECT_THROW(RunBlockJob(options), UsageError) << "there is no block 28";
  const auto whole = ComputeDelaunayCells(shape, points, ComputeSpacingWeights({ 1, 1, 1 }), Engine::Auto);
  EXPECT_TRUE(Join(points, ComputeShapeTopology(shape)).facetPoints == whole.facetPoints);
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

/** A rod along k in a store of Zarr, versions 2 and 3, a chunk for every 8 slices. */
struct RodStore
{
  std::filesystem::path folder;
  int                   version = 2;
  int                   chunks = 0;

  std::filesystem::path
  Chunk(int k) const
  {
    return folder / (version == 2 ? std::to_string(k) + ".0.0" : "c/" + std::to_string(k) + "/0/0");
  }
  void
  WriteChunks() const
  {
    std::string bytes;
    for (int n = 0; n < 8 * 12 * 12; ++n)
    {
      const int i = n % 12;
      const int j = n / 12 % 12;
      bytes += i > 2 && i < 9 && j > 3 && j < 8 ? '\1' : '\0';
    }
    for (int k = 0; k < chunks; ++k)
    {
      std::filesystem::create_directories(Chunk(k).parent_path());
      WriteAll(Chunk(k), bytes);
    }
  }
  void
  Write() const
  {
    WriteChunks();
    const std::string shape = R"("shape":[)" + std::to_string(8 * chunks) + ",12,12],";
    if (version == 2)
    {
      WriteAll(folder / ".zarray",
               R"({"zarr_format":2,)" + shape + R"("chunks":[8,12,12],"dtype":"|u1","order":"C",)" +
                 R"("compressor":null,"filters":null,"fill_value":null})");
      return;
    }
    WriteAll(folder / "zarr.json",
             R"({"zarr_format":3,"node_type":"array",)" + shape + R"("data_type":"uint8",)" +
               R"("chunk_grid":{"name":"regular","configuration":{"chunk_shape":[8,12,12]}},)" +
               R"("chunk_key_encoding":{"name":"default"},"codecs":[{"name":"bytes"}],"fill_value":0})");
  }
};

TEST_F(BlockJob, ABlockOfAStoreReadsItsChunksAlone)
{
  constexpr int blocks = 8;
  for (const int version : { 2, 3 })
  {
    SCOPED_TRACE("version " + std::to_string(version));
    const std::string name = "v" + std::to_string(version) + ".zarr";
    const RodStore    store{ At(name), version, 64 };
    store.Write();
    const auto shape = ReadLabelVolume(store.folder, {}).labels.at(0).shape;
    const auto points = BoundaryVertices(shape);
    const auto whole = ComputeDelaunayCells(shape, points, ComputeSpacingWeights({ 1, 1, 1 }), Engine::Auto);
    RunBlockJob(Options(1, blocks, name)); // plans
    for (int block = 1; block <= blocks; ++block)
    {
      // A chunk of another size is refused when it is read.
      store.WriteChunks();
      int damaged = 0;
      for (int k = 0; k < store.chunks; ++k)
      {
        const int first = (block - 1) * store.chunks / blocks;
        if (k < first - 1 || k > first + store.chunks / blocks)
        {
          WriteAll(store.Chunk(k), "damaged");
          ++damaged;
        }
      }
      EXPECT_GE(damaged, 54);
      BlockOptions options = Options(static_cast<std::size_t>(block), blocks, name);
      options.core.force = true;
      EXPECT_EQ(RunBlockJob(options).parts.at(0).boundaryVertices, points.size()) << "of the whole";
    }
    const DelaunayCells joined = Join(points, ComputeShapeTopology(shape), name);
    EXPECT_TRUE(joined.centres == whole.centres);
    EXPECT_TRUE(joined.facetCells == whole.facetCells);
    EXPECT_TRUE(joined.facetPoints == whole.facetPoints);
  }
}

TEST_F(BlockJob, APlanOfAnotherScanIsMadeAnew)
{
  const RodStore store{ At("a.zarr"), 2, 16 };
  store.Write();
  RunBlockJob(Options(1, 4, "a.zarr"));
  const std::string plan = ReadAll(At("parts/a_blocks-4.vcp"));
  // One voxel less, of which the plan's file knows nothing but the region's digest.
  std::string chunk = ReadAll(store.Chunk(8));
  chunk.at(6 * 12 + 6) = '\0';
  WriteAll(store.Chunk(8), chunk);
  BlockOptions options = Options(3, 4, "a.zarr");
  const auto   share = ReadAll(RunBlockJob(options).parts.at(0).file);
  EXPECT_NE(ReadAll(At("parts/a_blocks-4.vcp")), plan);
  std::filesystem::remove(At("parts/a_blocks-4.vcp"));
  options.core.force = true;
  EXPECT_EQ(ReadAll(RunBlockJob(options).parts.at(0).file), share) << "as without a plan";
  options.core.reading.spacing = Vector3{ 1, 1, 2 };
  EXPECT_NE(ReadAll(RunBlockJob(options).parts.at(0).file), share) << "other options";
}

} // namespace
} // namespace voxelcore::testing
