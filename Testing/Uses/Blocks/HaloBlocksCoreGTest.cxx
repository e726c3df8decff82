// Whole cores from blocks, on every kind of phantom, and what cutting costs.

#include "HaloBlocksFixture.h"

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Phantom/Phantom.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace voxelcore
{
namespace
{

VoxelShape
PhantomOf(std::string_view kind, std::int32_t side)
{
  PhantomOptions options;
  options.kind = kind;
  options.size = { side, side, side };
  return MakePhantom(options);
}

// Every share through its file, as separate processes would.
JoinedCells
JoinThroughFiles(const VoxelShape & shape, const SpacingWeights & weights, std::size_t count)
{
  const BlockPlan          plan = PlanBlocks(shape, weights, count);
  std::vector<std::string> files;
  for (std::size_t block = 0; block < count; ++block)
  {
    std::ostringstream stream;
    WriteBlockShare(ComputeBlockShare(shape, weights, plan, block), stream);
    files.push_back(stream.str());
  }
  return JoinBlockShares(count, [&files](std::size_t i) {
    std::istringstream stream(files[i]);
    return ReadBlockShare(stream, "file " + std::to_string(i));
  });
}

void
ExpectSameCoreFromBlocks(const VoxelShape & shape, const testing::Spacing3 & spacing, std::size_t count)
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  JoinedCells          joined = JoinThroughFiles(shape, weights, count);
  ASSERT_NO_FATAL_FAILURE(
    testing::ExpectSameCore(BuildVoxelCore(shape, joined.points, std::move(joined.cells), weights),
                            ComputeVoxelCore(shape, weights, Engine::Lattice)));
}

TEST(CoreFromBlocks, IsThatOfOneRunOnEveryPhantom)
{
  for (const PhantomKind & kind : PhantomKinds())
  {
    SCOPED_TRACE(kind.name);
    const VoxelShape shape = PhantomOf(kind.name, kind.name == "root" ? 80 : 20);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCoreFromBlocks(shape, { 1, 1, 1 }, 3));
    ASSERT_NO_FATAL_FAILURE(ExpectSameCoreFromBlocks(shape, { 1, 1, 4 }, 2));
  }
}

TEST(HeavyCoreFromBlocks, IsThatOfOneRunOnEveryPhantom)
{
  for (const PhantomKind & kind : PhantomKinds())
  {
    SCOPED_TRACE(kind.name);
    const VoxelShape shape = PhantomOf(kind.name, kind.name == "root" ? 128 : kind.name == "noise" ? 32 : 48);
    for (const std::size_t count : { 1, 2, 3, 8 })
    {
      SCOPED_TRACE(count);
      ASSERT_NO_FATAL_FAILURE(ExpectSameCoreFromBlocks(shape, { 1, 1, 1 }, count));
      ASSERT_NO_FATAL_FAILURE(ExpectSameCoreFromBlocks(shape, { 2, 3, 5 }, count));
    }
  }
}

// Boundary vertices in all subshapes per boundary vertex of the whole, those the cuts make included or not.
struct Redundancy
{
  double all = 0;
  double real = 0;
  double bytes = 0; // of files
};

Redundancy
RedundancyOf(const VoxelShape & shape, std::size_t count, const std::string & name)
{
  const SpacingWeights weights;
  const BlockPlan      plan = PlanBlocks(shape, weights, count);
  const auto           vertices = static_cast<double>(plan.boundaryVertices);
  Redundancy           redundancy;
  for (std::size_t block = 0; block < count; ++block)
  {
    const BlockShare   share = ComputeBlockShare(shape, weights, plan, block);
    std::ostringstream stream;
    WriteBlockShare(share, stream);
    redundancy.all += static_cast<double>(share.subshapeVertices) / vertices;
    redundancy.real += static_cast<double>(share.subshapeReal) / vertices;
    redundancy.bytes += static_cast<double>(stream.str().size()) / vertices;
  }
  std::cout << name << ", " << count << " blocks: " << plan.boundaryVertices << " boundary vertices, redundancy "
            << redundancy.all << " (" << redundancy.real << " without the cuts' own), files " << redundancy.bytes
            << " bytes a vertex\n";
  return redundancy;
}

TEST(HeavyCoreFromBlocks, CostsWhatIsPromised)
{
  const Redundancy ellipsoid = RedundancyOf(PhantomOf("ellipsoid", 128), 2, "ellipsoid 128");
  EXPECT_LT(ellipsoid.all, 1.70);
  EXPECT_LT(ellipsoid.real, 1.40);
  const Redundancy gyroid = RedundancyOf(PhantomOf("gyroid", 128), 8, "gyroid 128");
  EXPECT_LT(gyroid.all, 1.30);
  const Redundancy root = RedundancyOf(PhantomOf("root", 256), 8, "root 256");
  EXPECT_LT(root.all, 1.40);
  for (const Redundancy & redundancy : { ellipsoid, gyroid, root })
  {
    EXPECT_LT(redundancy.bytes, 60);
  }
}

} // namespace
} // namespace voxelcore
