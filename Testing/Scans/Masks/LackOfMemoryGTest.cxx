// Memory that runs out within a parallel loop: an exception that left its thread would end the program, so each loop
// that allocates keeps it and throws it on.

#include "VoxelCoreTesting/FailingMemory.h"
#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Masks/ShapeDenoising.h"
#include "voxelcore/Masks/ShapeEdits.h"
#include "voxelcore/Masks/ShapeMedian.h"
#include "voxelcore/Masks/ShapeSmoothing.h"
#include "voxelcore/Masks/SliceHoles.h"
#include "voxelcore/Roots/GreyLevels.h"

#ifdef VOXELCORE_FAILING_MEMORY

namespace voxelcore::testing
{
namespace
{

TEST(LackOfMemory, WithinAParallelLoopIsThrownOn)
{
  const Threads    scope(3);
  Random           random(7);
  const VoxelShape noise = RandomShape(random, { 70, 40, 40 }, 0.4);
  const auto       isInShell = [](int x, int y, int z, int at) {
    const int squared = (x - 20) * (x - 20) + (y - 20) * (y - 20) + (z - at) * (z - at);
    return squared > 100 && squared < 200;
  };
  std::vector<EditedLabel> hollow(2);
  for (int i = 0; i < 2; ++i)
  {
    EditedLabel & label = hollow[static_cast<std::size_t>(i)];
    label.label.value = i + 1;
    label.label.shape =
      ShapeWhere({ 40, 40, 80 }, [&](int x, int y, int z) { return isInShell(x, y, z, 20 + 40 * i); });
    label.label.voxels = label.label.shape.CountVoxels();
  }
  BandValues values{ VoxelShape(noise) };
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      std::vector<float> row(70);
      std::generate(row.begin(), row.end(), [&] { return static_cast<float>(random.Between(0, 99)); });
      values.SetRow(y, z, row);
    }
  }
  VoxelShape bright(noise.Box());
  for (std::int32_t z = 0; z < 40; ++z)
  {
    for (std::int32_t y = 0; y < 40; ++y)
    {
      for (std::int32_t x = 0; x < 70; ++x)
      {
        if (noise.Contains(x, y, z) && values.At(x, y, z) >= 50)
        {
          bright.Insert(x, y, z);
        }
      }
    }
  }
  const LatticeBall ball{ { 1, 1, 1 }, 9 };
  ExpectLackOfMemoryIsThrownOn({
    { "median", [&] { MedianShape(noise, { 3 }); } },
    { "denoise",
      [&] {
        DenoiseShape(noise, { 1, 1, 1 });
      } },
    { "mend", [&] { MendShape(noise); } },
    { "smooth", [&] { SmoothShape(noise); } },
    { "close", [&] { CloseShape(noise, ball); } },
    { "fill hollows", [&] { FillHollows(hollow[0].label.shape, ball); } },
    { "slices across x", [&] { FillSlices(noise, SliceAxis::I); } },
    { "slices across y", [&] { FillSlices(noise, SliceAxis::J); } },
    { "hollow labels",
      [&] {
        DiagnoseLabels(hollow, { 1, 1, 1 });
      } },
    { "levels", [&] { ProposeLevels(bright, values, 50); } },
  });
}

} // namespace
} // namespace voxelcore::testing

#endif
