#include "voxelcore/Base/Error.h"
#include "voxelcore/Meshes/Voxelization.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace voxelcore
{
namespace
{

constexpr std::int64_t kMostVoxels = std::int64_t{ 1 } << 20U;
constexpr double       kFarthest = 1e9; // mm: a thousand kilometres is a damaged number or a wrong unit

struct Bounds
{
  Vector3 lower;
  Vector3 upper;
};

Bounds
BoundsOf(const TriangleMesh & mesh)
{
  if (mesh.triangles.empty())
  {
    throw InputError("it has no triangles; save its surface as triangles");
  }
  Bounds bounds{ mesh.points[mesh.triangles.front()[0]], mesh.points[mesh.triangles.front()[0]] };
  for (const auto & triangle : mesh.triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double value = mesh.points[corner][axis];
        if (!std::isfinite(value))
        {
          throw InputError("a coordinate is not a finite number; write it anew");
        }
        if (std::abs(value) > kFarthest)
        {
          throw InputError(
            "a coordinate lies beyond 1e9 mm; the file is damaged, or its unit is none for a scan: scale it to mm");
        }
        bounds.lower[axis] = std::min(bounds.lower[axis], value);
        bounds.upper[axis] = std::max(bounds.upper[axis], value);
      }
    }
  }
  return bounds;
}

VoxelGrid
GridOver(const Bounds & bounds, const Vector3 & spacing)
{
  // The longest side divided by a rounded spacing may come out a hair above a whole number; no centre lies in that
  // hair.
  constexpr double hair = 1e-6;
  VoxelGrid        grid{ bounds.lower, spacing, {} };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double voxels = (bounds.upper[axis] - bounds.lower[axis]) / spacing[axis];
    if (!(voxels <= static_cast<double>(kMostVoxels)))
    {
      throw InputError("more than " + std::to_string(kMostVoxels) + " voxels on a side; give a greater spacing");
    }
    grid.size[axis] = std::max(1, static_cast<std::int32_t>(std::ceil(voxels - hair)));
  }
  return grid;
}

} // namespace

VoxelGrid
GridOfResolution(const TriangleMesh & mesh, std::int64_t resolution)
{
  if (resolution < 1 || resolution > kMostVoxels)
  {
    throw UsageError("resolution " + std::to_string(resolution) + ": expected 1 to " + std::to_string(kMostVoxels));
  }
  const Bounds bounds = BoundsOf(mesh);
  double       longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, bounds.upper[axis] - bounds.lower[axis]);
  }
  const double spacing = longest / static_cast<double>(resolution);
  if (!(spacing > 1e-9))
  {
    throw InputError("it has no extent; write it anew");
  }
  return GridOver(bounds, { spacing, spacing, spacing });
}

VoxelGrid
GridOfSpacing(const TriangleMesh & mesh, const Vector3 & spacing)
{
  for (const double side : spacing)
  {
    if (!(side > 1e-9 && side < kFarthest))
    {
      throw UsageError("voxel size " + std::to_string(side) + " mm: expected more than 0");
    }
  }
  return GridOver(BoundsOf(mesh), spacing);
}

} // namespace voxelcore
