#include "voxelcore/VoxelCore/PlacedCore.h"

#include "voxelcore/VoxelCore/CoreProvenance.h"

#include <utility>

namespace voxelcore
{

PlacedCore
ToPhysical(MedialComplex core, const ImageGeometry & geometry, std::int64_t label)
{
  return { label, PlaceInLps(std::move(core), geometry) };
}

} // namespace voxelcore
