#pragma once
// The curve skeleton of a medial surface (Yan, Sykes, Chambers, Letscher, Ju: "Erosion Thickness on Medial Axes of 3D
// Shapes", SIGGRAPH 2016, section 6), without a change of topology.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/VoxelCore/ExtractPart.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Lengths in mm. */
struct CurveOptions
{
  /** Branches end where they no longer stand out by so much: fire along the curve reaches the end of a branch that
   *  stands out by h later than fire on the surface burns it, by about h. 0 keeps all. */
  double branchThreshold = 0;

  /** Faces at least so erosion-thick stay: plates. Infinite: curves only. */
  double plateThreshold = std::numeric_limits<double>::infinity();

  double sampling = 0; ///< distance of sample points on edges when the surface burns; 0: one on each edge

  ImageGeometry geometry; ///< of the scan, for the axes and the lattice that its turning on the grid leaves alike

  double voxel = 0; ///< side of the cube with a voxel's diagonal: by about so much shapes end beyond their last ball
};

/** A part of a medial surface that the surface collapses to: vertices, edges, and the faces that stay. */
struct CurveSkeleton
{
  MedialComplex                      complex; ///< a subset of the surface, its order kept; positions in mm
  std::vector<std::array<double, 3>> places; ///< mm per vertex: its position; of an end the place on the surface's edge
                                             ///< beyond it, no further than the next vertex, where the body's end is
  std::vector<double> erosionThickness;      ///< mm per vertex; infinite where the surface never burns
  std::vector<double> branchThickness;       ///< mm per vertex: burn time along the curve less that on the surface;
                                             ///< infinite on cycles, between them, and on faces that stay
  std::vector<std::uint8_t> closedFace;      ///< per face: 1 when it is part of a closed surface, which cannot be
                                             ///< collapsed; 0 for plates
  PartElements inSurface;                    ///< indices in the surface

  std::size_t
  ClosedFaceCount() const;
};

/** Burns the surface, collapses free faces in the order in which fire comes to their free edges, burns the curves that
 *  are left from their ends, and takes off the branches whose fire never falls behind by the threshold.
 *
 *  Every step removes simple pairs only, whatever the burn times are, so the result has the surface's topology. Ties go
 *  by the canonical index in the one of the 48 places on the grid, turned and mirrored, that the surface's own shape
 *  picks: a turned scan has the same skeleton, turned, or one that a symmetry of the shape makes of it. A component
 *  without cycles keeps at least one vertex; of the branches that stay the outermost part, where the curve runs into a
 *  corner of the surface instead of along its middle, goes too.
 *  Positions of `surface` in LPS mm of the geometry, radii in mm. \throws InputError when it is too large; Cancelled */
CurveSkeleton
ComputeCurveSkeleton(const MedialComplex &    surface,
                     const CurveOptions &     options,
                     const ProgressCallback & progress = {});

/** The same, with the surface's cells and radii in memory once: they are in another order meanwhile, and come back to
 *  the bit. What is thrown leaves a surface without them. */
CurveSkeleton
ComputeCurveSkeleton(MedialComplex & surface, const CurveOptions & options, const ProgressCallback & progress = {});

/** The curves of the surface followed into a part of it that pruning has left: burn times are those of all of it, and
 *  each end is the part's place nearest to one of its ends, as the ragged rim of what is left is no end. Without a
 *  branch threshold all curves of the part stay. `part` may be null: all of it. */
CurveSkeleton
ComputeCurveSkeleton(const MedialComplex &    surface,
                     const LiveElements *     part,
                     const CurveOptions &     options,
                     const ProgressCallback & progress = {});

} // namespace voxelcore
