#pragma once
// From a strided array in memory to voxel shapes.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Labels/LabelAssembler.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** An array of scalars as numpy holds it; axes are i, j, k. Strides may be negative or 0. */
struct ArrayView
{
  const std::byte *             data = nullptr; ///< of element (0,0,0)
  std::array<std::int64_t, 3>   size{};
  std::array<std::ptrdiff_t, 3> stride{}; ///< bytes
  LabelAssembler::Pixel         pixel{};
  bool                          swapped = false; ///< not in this machine's byte order
};

/** The shapes of the labels in an array. One pass; besides the shapes it takes a few MB.
 *  \throws InputError, UsageError as LabelAssembler; Cancelled */
std::vector<LabelShape>
LabelsOf(const ArrayView &        array,
         const ImageGeometry &    geometry,
         const LabelChoice &      options,
         const ProgressCallback & progress = {});

/** Values along i, from element (i, j, k) on. Thread-safe. */
void
ReadRow(const ArrayView & array, std::int32_t i, std::int32_t j, std::int32_t k, std::span<float> values);

/** \throws InputError for a value within this part that is no finite number */
void
RequireFiniteValues(const ArrayView & array, const VoxelBox & part);

} // namespace voxelcore
