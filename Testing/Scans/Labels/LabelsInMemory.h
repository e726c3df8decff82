#pragma once
// Labels of values that lie in memory.

#include "VoxelCoreTesting/Messages.h"
#include "voxelcore/Labels/LabelAssembler.h"

#include <cstdint>
#include <vector>

namespace voxelcore::testing
{

inline ImageGeometry
SizedGeometry(std::int64_t x, std::int64_t y, std::int64_t z)
{
  ImageGeometry geometry;
  geometry.size = { x, y, z };
  return geometry;
}

/** The labels of values that lie in memory, x fastest. */
template <typename T>
std::vector<LabelShape>
LabelsOf(const std::vector<T> & values, const ImageGeometry & geometry, const LabelChoice & choice = {})
{
  LabelAssembler assembler("the image", geometry, LabelAssembler::Pixel::Of<T>(), choice);
  assembler.AddRows(values.data(), 0, static_cast<std::size_t>(geometry.size[1] * geometry.size[2]));
  return assembler.TakeShapes();
}

} // namespace voxelcore::testing
