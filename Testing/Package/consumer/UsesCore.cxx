// A program that knows no file format: the pruned core of a torus has its one loop.
// usage: UsesCore

#include "voxelcore/Complex/ComplexTopology.h"
#include "voxelcore/Phantom/Phantom.h"
#include "voxelcore/Shape/ShapeTopology.h"
#include "voxelcore/Skeleton/CurveSkeleton.h"
#include "voxelcore/Verification/Verification.h"
#include "voxelcore/VoxelCore/LambdaPruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <cstdio>

int
main()
{
  using namespace voxelcore;
  PhantomOptions options;
  options.kind = "torus";
  options.size = { 48, 48, 24 };
  const VoxelShape      shape = MakePhantom(options);
  const TopologyNumbers expected = ComputeShapeTopology(shape);
  const auto            core = ComputeVoxelCore(shape, ComputeSpacingWeights({ 1, 1, 1 }));
  const auto            pruned = PruneByLambda(core, { 1.5 });
  const TopologyNumbers found = ComputeComplexTopology(pruned[0].cells);
  std::printf("core %zu faces, pruned %zu, euler %lld, loops %lld\n",
              core.cells.FaceCount(),
              pruned[0].cells.FaceCount(),
              static_cast<long long>(found.euler),
              static_cast<long long>(found.betti[1]));
  return found == expected && found.betti[1] == 1 && pruned[0].cells.FaceCount() > 0 ? 0 : 1;
}
