// What is refined of a part of a core does not depend on the rest.

#include "RefinedCores.h"

#include <numeric>

namespace voxelcore::testing
{
namespace
{

struct WholeCore
{
  std::vector<LatticePoint> points;
  EdgePoints                edgePoints;
  MedialComplex             core;
};

WholeCore
MakeWholeCore(const VoxelShape & shape, const Spacing3 & spacing)
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  WholeCore            whole;
  whole.points = BoundaryVertices(shape);
  DelaunayCells cells = ComputeDelaunayCells(shape, whole.points, weights, Engine::Auto);
  whole.edgePoints = NearestToEdges(cells);
  whole.core = BuildVoxelCore(shape, whole.points, std::move(cells), weights);
  return whole;
}

void
ExpectSameOfParts(const VoxelShape & shape, const Spacing3 & spacing, std::size_t & dropped)
{
  const std::vector<double> thresholds{ 0.9, 1.7 };
  const WholeCore           whole = MakeWholeCore(shape, spacing);
  const auto                surface = SurfaceFromLabels(shape, spacing);
  std::vector<LiveElements> parts = LeftToRefine(whole.core, { 3.0 }, false);
  const auto                asked =
    RefineCore({ &shape, &whole.points, &whole.core, &whole.edgePoints, surface.get(), spacing, false, parts },
               thresholds);

  WholeCore                 kept = whole;
  std::vector<LiveElements> left = LeftToRefine(kept.core, thresholds, false);
  kept.core = KeepToRefine(spacing, whole.core, kept.edgePoints, kept.points, left, parts);
  dropped += whole.core.cells.edges.size() - kept.core.cells.edges.size();
  dropped += whole.points.size() - kept.points.size();
  const auto free = [&] {
    EXPECT_GT(kept.core.cells.vertexCount, 0U); // once
    kept.core = MedialComplex();
    kept.edgePoints = EdgePoints();
  };
  const auto found = RefineCore({ &shape,
                                  &kept.points,
                                  &kept.core,
                                  &kept.edgePoints,
                                  surface.get(),
                                  spacing,
                                  false,
                                  parts,
                                  left,
                                  &whole.points,
                                  free },
                                thresholds);
  EXPECT_EQ(kept.core.cells.vertexCount, 0U);
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    SCOPED_TRACE("part " + std::to_string(i));
    ExpectSameCore(found[i].core, asked[i].core);
    EXPECT_EQ(found[i].displacement, asked[i].displacement);
  }
}

TEST(KeepToRefine, ChangesNoBitOfWhatIsRefined)
{
  std::size_t dropped = 0;
  for (const RandomVolume & volume : RandomVolumes(4700, 24))
  {
    SCOPED_TRACE(volume.Describe());
    ExpectSameOfParts(volume.shape, volume.spacing, dropped);
  }
  EXPECT_GT(dropped, 0U);
}

// Of a ball one vertex is left, which lies between all that were around it in the whole core.
TEST(KeepToRefine, ChangesNoBitOfBalls)
{
  std::size_t dropped = 0;
  for (const double radius : { 3.0, 4.3, 6.1 })
  {
    VoxelShape   balls(VoxelBox{ { 0, 0, 0 }, { 60, 16, 16 } });
    const double half = 0.5 * 15;
    for (std::int32_t z = 0; z < 16; ++z)
    {
      for (std::int32_t y = 0; y < 16; ++y)
      {
        for (std::int32_t x = 0; x < 60; ++x)
        {
          const double away = std::hypot(x % 20 - half - 0.3 * (x / 20), y - half, z - half);
          if (away <= radius + 0.4 * (x / 20))
          {
            balls.Insert(x, y, z);
          }
        }
      }
    }
    ExpectSameOfParts(CropToVoxels(balls), { 1, 1, 1 }, dropped);
    ExpectSameOfParts(CropToVoxels(balls), { 0.9, 1, 1.2 }, dropped);
  }
  EXPECT_GT(dropped, 0U);
}

} // namespace
} // namespace voxelcore::testing
