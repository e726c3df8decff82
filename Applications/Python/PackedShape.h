#pragma once
// A voxel shape in little memory, for as long as its core is held.

#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** The words of a shape's rows, by y, then z; each as often as it follows itself. */
struct PackedShape
{
  VoxelBox                   box;
  std::vector<std::uint64_t> words;
  std::vector<std::uint32_t> counts;
};

PackedShape
Pack(const VoxelShape & shape);

/** \throws std::length_error when these are not the rows of the box. */
VoxelShape
Unpack(const PackedShape & packed);

} // namespace voxelcore
