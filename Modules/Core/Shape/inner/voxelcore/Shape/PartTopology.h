#pragma once
// Topology numbers of a shape from those of parts of it, none of which shows the whole.

#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Voxels at a face of a part, equal and in a row. */
struct FaceRun
{
  std::int32_t  row = 0; ///< z on faces across x and y, y on those across z
  std::int32_t  begin = 0;
  std::int32_t  end = 0; ///< begin <= place < end: y on faces across x, x on the others
  std::uint32_t set = 0; ///< number of its component within the part

  friend bool
  operator==(const FaceRun &, const FaceRun &) = default;
};

/** What a part says of the whole: a box of voxels, in indices of the scan. */
struct TopologyPart
{
  /** One layer of voxels at the end of the part. */
  struct Face
  {
    std::int32_t         plane = 0;  ///< x, y or z of its voxels
    std::vector<FaceRun> shape;      ///< sets are 6-connected
    std::vector<FaceRun> background; ///< sets are 26-connected

    friend bool
    operator==(const Face &, const Face &) = default;
  };

  /** Voxels - inner faces + inner edges - inner corners, each counted where its greatest voxel lies in the part. */
  std::int64_t euler = 0;
  /** Components that reach no face: 6-connected of the shape, 26-connected of the background. */
  std::int64_t closedShape = 0;
  std::int64_t closedBackground = 0;
  /** Sets of those that do. */
  std::uint32_t openShape = 0;
  std::uint32_t openBackground = 0;
  /** Low and high along x, then y, then z. */
  std::array<Face, 6> faces;

  /** A part of no voxels says nothing. */
  bool
  HasVoxels() const
  {
    return openShape > 0 || openBackground > 0; // what reaches its faces is the one or the other
  }

  friend bool
  operator==(const TopologyPart &, const TopologyPart &) = default;
};

/** The voxels of `shape` in the box `part`, which may reach beyond the shape's. The shape must also show the voxels one
 *  before the part along each axis, where the whole has any. */
TopologyPart
ComputeTopologyPart(const VoxelShape & shape, const VoxelBox & part);

/** The numbers of the whole, as ComputeShapeTopology gives them, from parts that together are a box and do not overlap;
 *  beyond it is background. Parts without voxels may be among them. */
TopologyNumbers
JoinTopologyParts(std::span<const TopologyPart> parts);

} // namespace voxelcore
