#pragma once
// The makers behind MakePhantom, and what they share.

#include "voxelcore/Phantom.h"

#include <algorithm>

namespace voxelcore
{

/** The sides of the grid in mm. */
inline Vector3
Sides(const PhantomOptions & options)
{
  return { options.size[0] * options.spacing[0],
           options.size[1] * options.spacing[1],
           options.size[2] * options.spacing[2] };
}

inline double
ShortestSide(const PhantomOptions & options)
{
  const Vector3 sides = Sides(options);
  return std::min(sides[0], std::min(sides[1], sides[2]));
}

/** Coordinates of the voxel centres along an axis, in mm from the middle: exactly opposite for opposite voxels. */
inline std::vector<double>
Centres(const PhantomOptions & options, std::size_t axis)
{
  std::vector<double> centres(static_cast<std::size_t>(options.size[axis]));
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    centres[i] = (2.0 * static_cast<double>(i) + 1.0 - options.size[axis]) * 0.5 * options.spacing[axis];
  }
  return centres;
}

/** Fills a shape of the size asked for: `makeRow(y, z)` (indices) gives a function that says of index x whether it is
 *  in. */
template <typename MakeRow>
VoxelShape
FillRows(const PhantomOptions & options, const ProgressCallback & progress, MakeRow && makeRow)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, options.size });
  for (std::int32_t z = 0; z < options.size[2]; ++z)
  {
    ReportProgress(progress, "sampling", static_cast<double>(z) / options.size[2]);
    for (std::int32_t y = 0; y < options.size[1]; ++y)
    {
      auto       inside = makeRow(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
      const auto row = shape.Row(y, z);
      for (std::int32_t x = 0; x < options.size[0]; ++x)
      {
        row[static_cast<std::size_t>(x >> 6)] |= std::uint64_t{ inside(static_cast<std::size_t>(x)) } << (x & 63);
      }
    }
  }
  return shape;
}

/** ellipsoid, ball, capsule, box, plate, rod, torus, shell, tanglecube, gyroid, thick-and-thin; empty for another
 *  kind. */
std::optional<VoxelShape>
MakeSolid(const PhantomOptions & options, const ProgressCallback & progress);

VoxelShape
MakePorous(const PhantomOptions & options, const ProgressCallback & progress);

VoxelShape
MakeNoise(const PhantomOptions & options, const ProgressCallback & progress);

VoxelShape
MakeRoot(const PhantomOptions & options, const ProgressCallback & progress);

/** The bodies of the kind cells. */
std::vector<VoxelShape>
MakeCells(const PhantomOptions & options, const ProgressCallback & progress);

std::vector<CentreLinePoint>
CentreLinesOfRoot(const PhantomOptions & options);

std::vector<RootContact>
ContactsOfRoot(const PhantomOptions & options);

/** \throws UsageError for a value without sense. */
void
CheckPhantomOptions(const PhantomOptions & options);

} // namespace voxelcore
