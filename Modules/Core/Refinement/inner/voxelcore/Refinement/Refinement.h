#pragma once
// Sub-voxel refinement: a finished core moved towards the medial axis of the smooth surface that the voxels stand for.
//
// The balls of a voxel core touch lattice points. Put the places where an estimate of the surface passes these points
// in their stead, and a core vertex belongs where its balls touch all of them: each vertex is moved there, its measures
// are taken again, and the complex is pruned once more. Only simple pairs go, so the topology stays that of the shape.

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace voxelcore
{

/** The boundary vertices nearest to each edge of a core: those of its dual facet. */
struct EdgePoints
{
  std::vector<std::uint32_t> offsets{ 0 }; ///< edges + 1
  std::vector<std::uint32_t> points;       ///< indices of boundary vertices

  std::span<const std::uint32_t>
  Of(std::size_t edge) const
  {
    return { points.data() + offsets[edge], points.data() + offsets[edge + 1] };
  }
};

/** For the core that BuildVoxelCore() will make of these cells; to be asked before they are moved in.
 *  \throws InputError above 2^32 - 1 points of all edges */
EdgePoints
NearestToEdges(const DelaunayCells & cells);

/** A refined core: faces are triangles, radii and measures are to the estimated surface. */
struct RefinedCore
{
  MedialComplex        core;         ///< vertices in the order they have in the whole core
  std::vector<Vector3> displacement; ///< per vertex, lattice coordinates: position less that in the whole core

  // By tolerance
  std::vector<ElementIndex> kept;           ///< per vertex, its number among those that the tolerance left
  std::vector<ElementIndex> polygons;       ///< per triangle, the number of its face among those
  std::size_t               hairsTaken = 0; ///< of these
};

/** What is refined; all borrowed. */
struct RefinementInput
{
  const VoxelShape *                shape = nullptr;
  const std::vector<LatticePoint> * points = nullptr; ///< boundary vertices
  const MedialComplex *             core = nullptr;   ///< the whole core, or what KeepToRefine() leaves of it
  const EdgePoints *                edgePoints = nullptr;
  const SurfaceEstimate *           surface = nullptr;
  Vector3                           spacing{ 1, 1, 1 };  ///< mm
  bool                              byTolerance = false; ///< thresholds are tolerances, whose heights the core has
  std::vector<LiveElements>         parts{};             ///< of the core, refined as they are
  std::vector<LiveElements>         left{};              ///< LeftToRefine(), if it is known
  const std::vector<LatticePoint> * boundary = nullptr;  ///< all boundary vertices, where `points` are some of them
  std::function<void()>             onLast{}; ///< called when core and edgePoints are asked for no more: may free them

  const std::vector<LatticePoint> &
  Boundary() const
  {
    return boundary != nullptr ? *boundary : *points;
  }
};

/** What each threshold, in ascending order, leaves of a core to be refined. By lambda that is more than in the end, as
 *  measures that are taken again may be greater. */
std::vector<LiveElements>
LeftToRefine(const MedialComplex &       core,
             const std::vector<double> & thresholds,
             bool                        byTolerance,
             const ProgressCallback &    progress = {});

/** What of a whole core is needed to refine parts of it. Drops the rest of what is nearest to its edges and of these
 *  boundary vertices, and names what stays anew, in the parts, too. What is refined of them stays the same to the last
 *  bit. */
MedialComplex
KeepToRefine(const Vector3 &             spacing,
             const MedialComplex &       core,
             EdgePoints &                edgePoints,
             std::vector<LatticePoint> & points,
             std::vector<LiveElements> & left,
             std::vector<LiveElements> & parts);

/** Refines the part of the core that a threshold leaves, for each threshold in mm, and then the parts of the input. A
 *  part by lambda is measured again where its vertices have moved to, and pruned once more. Other parts stay as they
 *  are. Of one by tolerance each boundary vertex that lay within the tolerance of its balls lies within it of the
 *  refined ones, or within half a voxel's diagonal where that is more, each over its weight (ToleranceWeights.h): else
 *  a ball that kept it goes back, as far as it must. The rims of its sheets are smoothed. Hairs and sharp corners of
 *  rims are collapsed where each boundary vertex stays covered without them. A curve goes to where all the boundary
 *  about it is equally far.
 *  Guarded: every vertex lies in the open shape, none is farther than one voxel (length of the displacement in lattice
 *  coordinates) from where it was, and no triangle's normal has turned by 90 degrees or more against that of the same
 *  triangle in the whole core; no radius differs from the distance of the nearest boundary vertex by more than half a
 *  voxel's diagonal. Where there is no estimate of the surface the boundary vertices themselves stand for it.
 *  The same bits for every number of threads.
 *  \throws Cancelled when the callback says so. */
std::vector<RefinedCore>
RefineCore(const RefinementInput &     input,
           const std::vector<double> & thresholds,
           const ProgressCallback &    progress = {});

} // namespace voxelcore
