// From a scan to a file. usage: UsesFiles SCAN OUT.vtp

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cstdio>
#include <exception>

int
main(int argc, char ** argv)
{
  try
  {
    if (argc != 3)
    {
      return 2;
    }
    const voxelcore::LabelMap scan = voxelcore::ReadLabelVolume(argv[1]);
    const auto                weights = voxelcore::ComputeLatticeWeights(scan.geometry);
    const auto                core = voxelcore::ComputeVoxelCore(scan.labels[0].shape, weights);
    const auto                pruned = voxelcore::PruneByLambda(core, { 1.5 });
    voxelcore::WriteModel(argv[2], argv[2], { { voxelcore::ToPhysical(pruned[0], scan.geometry, 1) }, "" });
    return voxelcore::ReadModel(argv[2]).parts.at(0).core.cells.FaceCount() == pruned[0].cells.FaceCount() ? 0 : 1;
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
