#include "Uses/Phantom/PhantomFixtures.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

PhantomOptions
Cells(std::array<std::int32_t, 3> size, int count, std::uint64_t seed = 1)
{
  PhantomOptions options = Options("cells", size);
  options.cells = count;
  options.seed = seed;
  return options;
}

/** Which body a voxel belongs to, from 1; 0 for none, and the number of bodies + 1 for more than one. */
std::vector<std::uint32_t>
Owners(const PhantomOptions & options)
{
  const std::vector<VoxelShape> bodies = MakePhantomBodies(options);
  const auto &                  size = options.size;
  std::vector<std::uint32_t>    owners(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
                                    static_cast<std::size_t>(size[2]));
  for (std::uint32_t body = 0; body < bodies.size(); ++body)
  {
    const VoxelBox & box = bodies[body].Box();
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          if (bodies[body].Contains(x, y, z))
          {
            std::uint32_t & owner = owners[static_cast<std::size_t>((z * size[1] + y) * size[0] + x)];
            owner = owner == 0 ? body + 1 : static_cast<std::uint32_t>(bodies.size()) + 1;
          }
        }
      }
    }
  }
  return owners;
}

} // namespace

TEST(Cells, FillTheVolumeWithoutOverlap)
{
  const PhantomOptions             options = Cells({ 61, 48, 70 }, 150);
  const auto                       count = static_cast<std::uint32_t>(MakePhantomBodies(options).size());
  const std::vector<std::uint32_t> owners = Owners(options);
  EXPECT_EQ(*std::min_element(owners.begin(), owners.end()), 1U);
  EXPECT_EQ(*std::max_element(owners.begin(), owners.end()), count);
  // As one shape they are the volume.
  EXPECT_EQ(MakePhantom(options).CountVoxels(), owners.size());
}

TEST(Cells, AreAboutAsManyAsAskedFor)
{
  for (const int count : { 1, 2, 3, 10, 100, 400 })
  {
    const auto bodies = MakePhantomBodies(Cells({ 64, 64, 64 }, count));
    EXPECT_LE(bodies.size(), static_cast<std::size_t>(count));
    EXPECT_GE(static_cast<double>(bodies.size()), 0.9 * count);
    for (const VoxelShape & body : bodies)
    {
      EXPECT_GT(body.CountVoxels(), 0U);
      EXPECT_EQ(CropToVoxels(body).Box().size, body.Box().size) << "in its tight box";
    }
  }
}

TEST(Cells, DependOnTheSeedAloneNotOnThreads)
{
  const PhantomOptions             options = Cells({ 50, 40, 60 }, 100, 7);
  const std::vector<std::uint32_t> owners = Owners(options);
  for (const int threads : { 1, 2, 5 })
  {
    const Threads limit(threads);
    EXPECT_EQ(Owners(options), owners);
  }
  EXPECT_NE(Owners(Cells({ 50, 40, 60 }, 100, 8)), owners);
}

// The same on every machine.
TEST(Cells, HaveTheKnownBoundaryVertices)
{
  std::uint64_t vertices = 0;
  for (const VoxelShape & body : MakePhantomBodies(Cells({ 64, 64, 64 }, 100, 3)))
  {
    vertices += CountBoundaryVertices(body);
  }
  EXPECT_EQ(vertices, 197088U);
}

TEST(Cells, AreOfManyKinds)
{
  std::uint64_t tiny = 0;
  std::uint64_t slender = 0;
  std::uint64_t looped = 0;
  for (const VoxelShape & body : MakePhantomBodies(Cells({ 128, 128, 128 }, 200)))
  {
    const auto voxels = static_cast<double>(body.CountVoxels());
    const auto topology = ComputeShapeTopology(body);
    const auto longest = *std::max_element(body.Box().size.begin(), body.Box().size.end());
    tiny += voxels < 500;
    slender += longest > 40 && voxels < 0.1 * longest * longest * longest;
    looped += topology.betti[1] > 0;
  }
  EXPECT_GT(tiny, 20U);
  EXPECT_GT(slender, 40U);
  EXPECT_GT(looped, 20U);
}

TEST(Cells, RefuseNumbersWithoutSense)
{
  EXPECT_THROW(MakePhantomBodies(Cells({ 8, 8, 8 }, 0)), UsageError);
  EXPECT_THROW(MakePhantomBodies(Cells({ 8, 8, 8 }, 1000001)), UsageError);
  EXPECT_THROW(MakePhantomBodies(Cells({ 0, 8, 8 }, 10)), UsageError);
}
