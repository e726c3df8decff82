#pragma once
// Volumes along a vessel (curved planar reformation: Kanitsar et al., IEEE Visualization 2002, page 37): a way through
// a skeleton, its smooth axis, planes across it that do not turn about it (Wang et al., ACM Trans Graphics 27 (2008),
// article 2: double reflection), and the map between places in the scan and in the volume of these planes.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/Skeleton/BranchTable.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace voxelcore
{

/** A line along branches: two places at least, no two next to each other the same. */
struct SkeletonWay
{
  std::vector<Vector3>      places;           ///< LPS mm
  std::vector<double>       radius;           ///< SectionRadii()
  std::vector<ElementIndex> branches;         ///< of each place; where two meet, the one before
  bool                      isClosed = false; ///< its last place is its first
};

/** Branches one after the other, the first turned so that the second goes on where it ends; one by itself as it
 *  stands in the graph. \throws UsageError unless all are there, and each begins where the one before ends */
SkeletonWay
WayAlong(const SkeletonGraph & graph, std::span<const ElementIndex> branches);

/** The shortest way along branches from the place on them that is nearest to `from` to that nearest to `to`.
 *  \throws UsageError where there is none, or both are one place */
SkeletonWay
WayBetween(const SkeletonGraph & graph, const Vector3 & from, const Vector3 & to);

/** Before it is smoothed, mm. */
double
WayLength(const SkeletonWay & way);

/** A plane across the axis. The three directions are of unit length, at right angles and right-handed. */
struct AxisPlane
{
  double  arc = 0;    ///< along the axis
  Vector3 place{};    ///< LPS mm
  Vector3 across{};   ///< first axis of the straight volume
  Vector3 up{};       ///< second
  Vector3 along{};    ///< third: where the axis goes
  double  radius = 0; ///< of the way there
  double  bend = 0;   ///< curvature of the axis, 1/mm: farther from it than 1 / bend, on the inner side, planes cross
  ElementIndex branch = 0;
};

/** Planes every `step` mm from the axis' begin on, none beyond its end; and how long it is. */
struct StraightAxis
{
  std::vector<AxisPlane> planes;
  double                 length = 0;
};

/** The axis is the way smoothed: at each place the cubic polynomial that fits the way best over a window of twice its
 *  radius to each side, and at least six times `side`, weighted by (1 - u^2)^2; round a closed way. `side` is that of a
 *  cube with a voxel's diagonal. The first plane's `across` is as near as can be to that of the directions L, P, S
 *  which the axis is farthest from; the others follow without turning about the axis. */
StraightAxis
StraightenWay(const SkeletonWay & way, double side, double step);

/** LPS mm of a place in the straight volume: across, up, and arc, mm. Between planes, and a little beyond the last one,
 *  places and directions are linear in arc. */
Vector3
FromStraight(std::span<const AxisPlane> planes, const Vector3 & straight);

/** The inverse: of all places in the straight volume that are this one in the scan the one nearest to the axis. None
 *  where no plane between the first and the last holds it. */
std::optional<Vector3>
ToStraight(std::span<const AxisPlane> planes, const Vector3 & place);

/** Values of a scan in a box, x fastest; `geometry` is that of the whole scan. */
struct ScanPart
{
  const ImageGeometry &  geometry;
  VoxelBox               box;
  std::span<const float> values;
};

/** Squares around the axis: so many to each side, and of so many mm. */
struct PlaneGrid
{
  std::array<std::int32_t, 2> half{};
  std::array<double, 2>       spacing{};

  std::array<std::int32_t, 2>
  Size() const
  {
    return { 2 * half[0] + 1, 2 * half[1] + 1 };
  }
};

/** The voxels of the scan that values on these planes depend on; of size 0 where all lie outside. */
VoxelBox
VoxelsAt(std::span<const AxisPlane> planes, const PlaneGrid & grid, const ImageGeometry & geometry);

/** Values at the squares of a plane, `across` fastest: linear between the middles of voxels, or that of the nearest
 *  voxel; of equally near ones the later. `outside` where there is no voxel. The part must hold what VoxelsAt()
 *  says. */
void
SamplePlane(const AxisPlane & plane,
            const PlaneGrid & grid,
            const ScanPart &  scan,
            bool              isLinear,
            float             outside,
            std::span<float>  values);

} // namespace voxelcore
