#pragma once
// The values of a scan as numbers, where they are asked for.

#include "voxelcore/Imaging/LabelVolume.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

namespace voxelcore
{

/** Values of the voxels of a box, x fastest. */
struct GreyVolume
{
  ImageGeometry      geometry; ///< of the whole scan
  VoxelBox           box;
  std::vector<float> values;

  const float *
  Row(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    const auto at = [&](std::size_t axis, std::int32_t value) {
      return static_cast<std::size_t>(value - box.lower[axis]);
    };
    const auto sizeX = static_cast<std::size_t>(box.size[0]);
    return values.data() + (at(2, z) * static_cast<std::size_t>(box.size[1]) + at(1, y)) * sizeX + at(0, x);
  }
};

/** Reads the values within a box of a scan (any that ReadLabelVolume reads), slope and intercept applied. 4 bytes a
 *  voxel of the box. Of the options, those about geometry, volume and component count. May be called from several
 *  threads. \throws InputError when the scan is missing, damaged or unfit, does not hold the box, or has a value in it
 *  that is no finite number; Cancelled */
GreyVolume
ReadGreyVolume(const std::filesystem::path & path,
               const VoxelBox &              box,
               const ReadOptions &           options = {},
               const ProgressCallback &      progress = {});

/** Gives the values of a row from box.lower[0] on, at y, z in indices of the scan. */
using GreyRow = std::function<void(std::int32_t y, std::int32_t z, std::span<const float> values)>;

/** The same row by row, in order, keeping nothing. Gives the geometry of the whole scan. */
ImageGeometry
VisitGreyRows(const std::filesystem::path & path,
              const VoxelBox &              box,
              const ReadOptions &           options,
              const GreyRow &               take,
              const ProgressCallback &      progress = {});

/** Writes values, x fastest, as WriteLabelVolume writes labels: the same extensions and checks.
 *  \throws OutputError when it cannot be written; UsageError for an unknown extension or values that do not fill it */
void
WriteGreyVolume(const std::filesystem::path &  path,
                const ImageGeometry &          geometry,
                std::span<const std::uint16_t> values,
                bool                           compress = true);

/** Fills in the values of slice k, which are all zero, x fastest. */
using FloatSlice = std::function<void(std::int64_t k, std::span<float> values)>;

/** Writes float32 values slice by slice, as WriteLabelVolume writes labels. `slice` is called twice for each k.
 *  \throws OutputError when it cannot be written; UsageError for an unknown extension */
void
WriteFloatVolume(const std::filesystem::path & path, const ImageGeometry & geometry, const FloatSlice & slice);

/** The same with whole numbers, uint32. */
using NumberSlice = std::function<void(std::int64_t k, std::span<std::uint32_t> values)>;
void
WriteNumberVolume(const std::filesystem::path & path, const ImageGeometry & geometry, const NumberSlice & slice);

/** \throws UsageError unless the path has an extension that volumes are written with. */
void
RequireVolumePath(const std::filesystem::path & path);

/** \throws UsageError where the path's format cannot hold a volume of this size, or as above */
void
RequireVolumeFits(const std::filesystem::path & path, const std::array<std::int64_t, 3> & size);

/** What of the geometry the path's format cannot hold, as a note; empty where it holds all. */
std::string
WhatIsLeftOut(const std::filesystem::path & path, const ImageGeometry & geometry);

} // namespace voxelcore
