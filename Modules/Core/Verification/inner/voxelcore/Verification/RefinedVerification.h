#pragma once
// Rechecks a refined core: that it is a voxel core whose vertices were moved, and how far.

#include "voxelcore/Verification/Verification.h"

namespace voxelcore
{

/** What is to be rechecked. Everything is borrowed and must outlive the call. */
struct RefinedVerificationInput
{
  const VoxelShape *                     shape = nullptr;
  SpacingWeights                         weights; ///< of the scan's spacing
  std::array<double, 3>                  spacing{ 1, 1, 1 };
  const CellComplex *                    cells = nullptr;
  std::span<const std::array<double, 3>> positions;    ///< lattice coordinates, per vertex
  std::span<const std::array<double, 3>> displacement; ///< lattice coordinates, per vertex: what moved it
  std::span<const double>                radius;       ///< mm, per vertex
  std::span<const double>                vertexLambda; ///< mm
  std::span<const double>                edgeLambda;   ///< mm; NaN = unknown, allowed for edges that lie on a face
  std::span<const double>                faceLambda;   ///< mm
  double                                 positionTolerance = 0; ///< as VerificationInput has it
  std::optional<double>                  threshold;             ///< mm; above 0 nothing is promised of the boundary
  std::optional<double>                  pruningTolerance;      ///< mm; the boundary is promised to lie that near
  bool                                   prunedOn = false;      ///< by tolerance, after it was refined
  std::span<const double>                vertexTolerance{};     ///< with it: what each element has, mm
  std::span<const double>                edgeTolerance{};
  std::span<const double>                faceTolerance{};
};

/** Checks, in this order:
 *  - arrays, numbers, edge ends, polygons, polygon edges: as VerifyComplex; triangles: all faces are
 *  - vertices inside: in the open shape
 *  - displacement: at most one voxel (its length in lattice coordinates)
 *  - origins equidistant: where each vertex was is the centre of an empty sphere through at least four affinely
 *    independent boundary vertices, exactly, so that the file is a moved voxel core and nothing else
 *  - faces not turned over: against where their corners were
 *  - radius: above 0, and within half a voxel's diagonal of the distance to the nearest boundary vertex: each of these
 *    has surface that near, and the surface has one of them
 *  - measures: not greater than how far the surface can lie where the vertex was, and they do not fall from faces to
 *    edges to vertices
 *  - with a tolerance, tolerances: as VerifyComplex
 *  - and coverage, where nothing was pruned by lambda before: no boundary vertex lies farther than RefinedGapBound(),
 *    weighed, from the nearest ball
 *  - shape Euler number, topology
 *  \throws InputError when shape and weights exceed the exact range; Cancelled when the callback says so. */
VerificationReport
VerifyRefinedCore(const RefinedVerificationInput & input, const ProgressCallback & progress = {});

} // namespace voxelcore
