#pragma once
// From what a file or an image says of its voxels' places to a geometry that can be worked on.

#include "voxelcore/Lattice/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

/** What a user says instead. */
struct GeometryOptions
{
  std::optional<Vector3> spacing;                ///< mm, instead of the one stated
  bool                   orthonormalize = false; ///< accept the nearest orthonormal direction
};

struct StatedGeometry
{
  std::array<std::int64_t, 3> size{};
  std::array<Vector3, 3>      axes{}; ///< directions of i, j, k in LPS, of any length
  Vector3                     spacing{};
  Vector3                     origin{}; ///< LPS mm
  SpatialUnit                 unit = SpatialUnit::Millimetres;
};

/** `scan` names it in errors; what was changed is added to `notes`.
 *  \throws InputError when this is no geometry, or axes are off a right angle by more than 1e-4 (ITK's tolerance);
 *  UsageError for a spacing of the options that is none. Sizes are not looked at. */
ImageGeometry
CheckedGeometry(const std::filesystem::path & scan,
                const StatedGeometry &        stated,
                const GeometryOptions &       options,
                std::vector<std::string> &    notes);

/** The same of an image in memory, whose sizes are checked as CheckSize() does and whose axes have length 1. */
ImageGeometry
CheckedGeometry(const std::filesystem::path & image, const ImageGeometry & geometry, bool orthonormalize);

/** Sides as a header claims them, checked: each 1 to 2^30, and their product (times bytesPerVoxel) at most
 *  bytesPossible. Returns the product. */
std::uint64_t
CheckSize(const std::filesystem::path &       path,
          const std::array<std::int64_t, 3> & size,
          std::uint64_t                       bytesPerVoxel,
          std::uint64_t                       bytesPossible);

/** The largest cosine between two of the three directions: 0 when they are orthogonal. */
double
LargestCosine(const std::array<Vector3, 3> & directions);

} // namespace voxelcore
