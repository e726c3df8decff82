#pragma once
// Local thickness of a shape whose core has been certified.

#include "voxelcore/CertifiedCore.h"
#include "voxelcore/CoreThickness.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

struct ThicknessRequest
{
  bool bounds = false; ///< the bracket, too
  bool alone = false;  ///< nothing else is wanted: where the map needs no core, none is made, and the result has none;
                       ///< a refined one has no radiusMargin
};

/** The estimate is that of the first core asked for: of a refined one the diameters of its balls (CoreThickness.h),
 *  else those of the truly inscribed balls about places of the whole core: each radius is the distance to the nearest
 *  square of the boundary, measured in the voxels. Lower bounds may be greater: they also come from a finer lattice. */
struct CertifiedThickness
{
  VoxelShape         shape;
  PaintingBalls      balls;      ///< that give voxels their thickness; centres in lattice coordinates
  VoxelOwners        owners;     ///< among these balls; 0: the ball about the voxel's own centre
  VoxelValues        map;        ///< the estimate, mm
  ThicknessBracket   bracket;    ///< both empty where they were not asked for
  std::vector<float> atVertices; ///< the map's value at each vertex of the first core, mm

  std::array<std::int32_t, 3> parts{ 1, 1, 1 }; ///< into which voxels were cut for the bounds (FineBracket.h)
};

/** The map of a certified core. `bracket` is that of the shape, or empty; of a core that is not refined it holds the
 *  lower bound and its balls.
 *  \throws CertificateError when bounds contradict each other or a voxel has no thickness; Cancelled */
CertifiedThickness
ThicknessOf(const CertifiedCore &    core,
            const CertifiedShape &   shape,
            VoxelShape               voxels,
            ThicknessBracket         bracket,
            const ProgressCallback & progress = {});

} // namespace voxelcore
