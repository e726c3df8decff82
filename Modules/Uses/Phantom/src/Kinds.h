#pragma once
// The makers behind MakePhantom, and what they share.

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Phantom/Phantom.h"

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

/** Writes the rows of layers begin to end - 1 along z and gives back what memory they do not need. */
template <typename MakeRow>
void
FillLayers(VoxelShape & shape, std::int32_t begin, std::int32_t end, const MakeRow & makeRow)
{
  const auto & size = shape.Box().size;
  for (std::int32_t z = begin; z < end; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      auto           inside = makeRow(static_cast<std::size_t>(y), static_cast<std::size_t>(z));
      const ShapeRow row = shape.Row(y, z);
      for (std::int32_t first = 0; first < size[0]; first += 64)
      {
        std::uint64_t      bits = 0;
        const std::int32_t count = std::min(64, size[0] - first);
        for (std::int32_t bit = 0; bit < count; ++bit)
        {
          bits |= std::uint64_t{ inside(static_cast<std::size_t>(first + bit)) } << bit;
        }
        row[static_cast<std::size_t>(first) / 64] = bits;
      }
    }
  }
  shape.Compact(begin, end);
}

/** Layers that threads fill apart: as high as the bricks of a shape, so that none is written by two. */
constexpr std::int32_t kPhantomSlab = BitBricks::side;

/** Fills a shape of the size asked for: `makeRow(y, z)` (indices) gives a function that says of index x whether it is
 *  in. Row by row in order. */
template <typename MakeRow>
VoxelShape
FillRows(const PhantomOptions & options, const ProgressCallback & progress, const MakeRow & makeRow)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, options.size });
  for (std::int32_t z = 0; z < options.size[2]; z += kPhantomSlab)
  {
    ReportProgress(progress, "sampling", static_cast<double>(z) / options.size[2]);
    FillLayers(shape, z, std::min(options.size[2], z + kPhantomSlab), makeRow);
  }
  return shape;
}

/** Calls work(begin, end) for all slabs of layers, on all threads; reports between them. */
template <typename Work>
void
ForSlabs(const PhantomOptions & options, const ProgressCallback & progress, const Work & work)
{
  const std::int32_t slabs = (options.size[2] + kPhantomSlab - 1) / kPhantomSlab;
  const std::int32_t atATime = std::clamp(slabs / 8, 2, 16);
  for (std::int32_t first = 0; first < slabs; first += atATime)
  {
    ReportProgress(progress, "sampling", static_cast<double>(first) / slabs);
    const std::int32_t end = std::min(slabs, first + atATime);
    RunEach(static_cast<std::size_t>(end - first), [&](std::size_t i) {
      const std::int32_t slab = first + static_cast<std::int32_t>(i);
      work(slab * kPhantomSlab, std::min(options.size[2], (slab + 1) * kPhantomSlab));
    });
  }
}

/** The same as FillRows for functions that many threads may ask at once, of rows in any order. */
template <typename MakeRow>
VoxelShape
FillRowsInParallel(const PhantomOptions & options, const ProgressCallback & progress, const MakeRow & makeRow)
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, options.size });
  ForSlabs(options, progress, [&](std::int32_t begin, std::int32_t end) { FillLayers(shape, begin, end, makeRow); });
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

/** Those of the kind vessels. */
std::vector<VoxelShape>
MakeVessels(const PhantomOptions & options, const ProgressCallback & progress);

std::vector<CentreLinePoint>
CentreLinesOfRoot(const PhantomOptions & options);

std::vector<RootContact>
ContactsOfRoot(const PhantomOptions & options);

/** \throws UsageError for a value without sense. */
void
CheckPhantomOptions(const PhantomOptions & options);

} // namespace voxelcore
