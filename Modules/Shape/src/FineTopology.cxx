#include "voxelcore/FineTopology.h"

#include "voxelcore/ShapeOperations.h"
#include "voxelcore/ShapeSmoothing.h"

#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::uint64_t kMany = 50;
constexpr std::uint64_t kLargestPart = 10; ///< one in so many

} // namespace

std::optional<FineTopology>
FindFineTopology(const VoxelShape & shape, const TopologyNumbers & topology, const ProgressCallback & progress)
{
  const auto all = static_cast<std::uint64_t>(topology.betti[0] + topology.betti[1] + topology.betti[2]);
  if (all < kMany)
  {
    return std::nullopt;
  }
  MendedShape  mended = MendShape(shape, progress);
  FineTopology fine;
  fine.loops = mended.loopsClosed;
  fine.cavities = mended.cavitiesFilled;
  fine.joined = mended.piecesJoined;
  fine.specks = RemoveSmallComponents(std::move(mended.shape), kSpeckVoxels).componentsRemoved;
  if (fine.Sum() < kMany || kLargestPart * fine.Sum() < all)
  {
    return std::nullopt;
  }
  return fine;
}

} // namespace voxelcore
