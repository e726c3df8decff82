#pragma once
// Local thickness of a shape whose core has been certified.

#include "voxelcore/Certified/CertifiedCore.h"
#include "voxelcore/Sheets/MedialSheets.h"
#include "voxelcore/Thickness/CoreThickness.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

struct ThicknessRequest
{
  bool bounds = false; ///< the bracket, too
  bool alone = false;  ///< nothing else is wanted: no core is made, and the result has none
};

/** Of a map beside its bounds. */
struct VoxelsOutside
{
  std::uint64_t voxels = 0;
  double        farthest = 0; ///< mm
};

/** Where cores are refined, the map is that of balls inscribed in the smooth surface that the voxels stand for
 *  (SmoothBalls.h), and bounds are those of all smooth surfaces that the labels allow (SmoothBracket()), computed
 *  without these balls. A voxel outside them is refused; where grey values or a mesh tell the surface, which may be
 *  none that the labels allow, it is counted. Else the map is that of the truly inscribed balls about places of the
 *  whole core: each radius is the distance to the nearest square of the boundary, measured in the voxels. Lower bounds
 *  may be greater: they also come from a finer lattice. Neither asks how a core is pruned. */
struct CertifiedThickness
{
  VoxelShape         shape;
  PaintingBalls      balls;      ///< that give voxels their thickness; centres in lattice coordinates
  VoxelOwners        owners;     ///< among these balls; 0: the ball about the voxel's own centre
  VoxelValues        map;        ///< the estimate, mm
  ThicknessBracket   bracket;    ///< both empty where they were not asked for
  VoxelsOutside      outside;    ///< of these; only where the map is of a smooth surface
  std::vector<float> atVertices; ///< the map's value at each vertex of the first core, mm

  std::array<std::int32_t, 3> parts{ 1, 1, 1 }; ///< into which voxels were cut for the bounds (FineBracket.h)
};

/** The sheets of a core as it stands in a file, the same wherever its shape lies (BodyFrame.h); `sliver` in mm. */
MedialSheets
SheetsOf(const PlacedCore & core, const CertifiedShape & shape, double sliver);

/** To which of the balls about a core's vertices each voxel belongs; also the same wherever the shape lies. */
VoxelOwners
OwnersInCore(const PlacedCore & core, const CertifiedShape & shape, const VoxelShape & voxels);

/** The map of the voxels as they are. `bracket` is that of the shape, or holds only the lower bound and its balls.
 *  \throws CertificateError when bounds contradict each other or a voxel has no thickness; Cancelled */
CertifiedThickness
ThicknessOf(const CertifiedShape &   shape,
            VoxelShape               voxels,
            ThicknessBracket         bracket,
            const ProgressCallback & progress = {});

/** The map's values at places in LPS mm of the geometry. */
std::vector<float>
ThicknessAt(const CertifiedThickness & found, const std::vector<Vector3> & positions, const ImageGeometry & geometry);

} // namespace voxelcore
