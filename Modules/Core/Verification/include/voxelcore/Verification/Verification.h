#pragma once
// Rechecks a finished core against its voxel shape by other means than the code that made it: a kd-tree over the
// boundary vertices instead of a Delaunay tessellation, spheres through nearest boundary vertices in exact integers,
// and Betti numbers by column reduction.
//
// Every vertex must be the centre of an empty sphere through at least four affinely independent boundary vertices, its
// nearest set. All else follows from these sets: the nearest set of an edge is what its two ends share (3 or more), of
// a face what all its corners share (exactly 2, the ends of its dual edge), and the radius measure of an element is the
// radius of the smallest ball enclosing its nearest set (paper, section 4, step 3).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxelcore
{

/** What is to be rechecked. Everything is borrowed and must outlive the call. */
struct VerificationInput
{
  const VoxelShape *                     shape = nullptr;
  SpacingWeights                         weights;            ///< of the scan's spacing
  std::array<double, 3>                  spacing{ 1, 1, 1 }; ///< mm; lengths are measured with it again
  const CellComplex *                    cells = nullptr;
  std::span<const std::array<double, 3>> positions;    ///< lattice coordinates (voxel index + 1/2), per vertex
  std::span<const double>                radius;       ///< mm, per vertex
  std::span<const double>                vertexLambda; ///< mm
  std::span<const double>                edgeLambda;   ///< mm; NaN = unknown, allowed for edges that lie on a face
  std::span<const double>                faceLambda;   ///< mm
  /** Largest error of a coordinate of a position, in lattice units; see PositionTolerance(). 0: positions come straight
   *  from a computation, and only the rounding of the coordinates themselves is allowed for. */
  double positionTolerance = 0;
  /** Polygons run the other way round (a file whose index-to-LPS matrix is left-handed). */
  bool polygonsReversed = false;
  /** The pruning threshold in mm; none or 0: a whole core, which is then also checked for completeness. */
  std::optional<double> threshold;
  /** With tolerances: the height it is pruned to in mm, and what each element has. */
  std::optional<double>   pruningTolerance;
  std::span<const double> vertexTolerance;
  std::span<const double> edgeTolerance;
  std::span<const double> faceTolerance;
};

/** One property and what violates it. */
struct VerificationCheck
{
  std::string   name;
  bool          passed = true;
  std::uint64_t offenders = 0; ///< elements that violate it; 0 with passed == false: it could not be checked
  std::string   firstOffender; ///< one sentence; empty when passed
};

/** All checks, in a fixed order. */
struct VerificationReport
{
  bool                           passed = true;
  TopologyNumbers                shapeTopology;   ///< from the voxels
  TopologyNumbers                complexTopology; ///< by column reduction
  std::vector<VerificationCheck> checks;
  std::optional<double>          boundaryGap; ///< mm; with tolerances: of any boundary vertex to the balls, the largest
  /** Where voxels are no cubes: the largest of a gap's shares in what is promised there. */
  std::optional<double> boundaryGapShare;
};

/** Stored radii and measures may differ from recomputed ones by this relative amount. Both come from exact integers by
 *  a dozen roundings (about 1e-15); the slack is for another order of operations in the unit of length. */
inline constexpr double kMeasureTolerance = 1e-10;

/** Error bound, in lattice units, of positions that went to LPS mm and back. They are rounded to OnPlaces() before, by
 *  half a kPlaceStep at most. Each way multiplies and adds a dozen
 *  numbers no larger than M, the largest coordinate in mm met on the way (origin plus extent), so an error stays below
 *  64 eps M in mm, divided by the smallest spacing. For a scan of a metre at 0.5 mm: 6e-11 of a voxel. */
double
PositionTolerance(const ImageGeometry & geometry);

/** Checks, in this order (those that need a missing part are reported as not checked):
 *  - arrays, numbers, edge ends, polygons, polygon edges: the data fit together
 *  - distinct vertices, distinct edges, distinct faces
 *  - vertices inside: in the open shape
 *  - vertices equidistant: centres of empty spheres through 4 affinely independent boundary vertices, exactly
 *  - nothing nearer, radius: no boundary vertex nearer than the stated radius, and the radius is attained
 *  - true spacing: every radius is the distance to the nearest boundary vertex, and every face's measure half that of
 *    its two, measured with the spacing instead of the weights; within the deviation of the weights, and never more
 *    than kLargestDeviation
 *  - edges dual, faces dual: ends share 3 or more, corners exactly 2 nearest boundary vertices
 *  - faces planar, faces convex, faces oriented
 *  - vertex measures, edge measures, face measures, measures monotone
 *  - vertex order, edge order, face order: canonical
 *  - completeness: no element with a measure >= threshold is missing beside a vertex that is there. For a whole core
 *    nothing is missing: together with the topology check this proves that it is the voxel core.
 *  - pruning: no simple pair with both measures below the threshold is left
 *  With tolerances, instead of the last two, as lambda does not say what is left:
 *  - tolerances: numbers, none below that of the whole, and they do not fall from faces to edges to vertices
 *  - coverage: no boundary vertex lies farther than the height, weighed as LargestWeighedGap() does, from the ball of a
 *    vertex (where a threshold > 0 took elements first nothing is promised, and this is not checked)
 *  - shape Euler number: recounted corner by corner
 *  - topology: shape and complex agree in Euler and Betti numbers
 *  \throws InputError when shape and weights exceed the exact range (72 w^2 N^5 >= 2^127); Cancelled when the callback
 *  says so. */
VerificationReport
VerifyComplex(const VerificationInput & input, const ProgressCallback & progress = {});

} // namespace voxelcore
