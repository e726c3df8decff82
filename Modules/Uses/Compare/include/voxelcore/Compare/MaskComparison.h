#pragma once
// Two voxel shapes on one grid against each other: overlap, distances of their surfaces, topology, and the pieces and
// cavities that one has and the other has not. A is the reference where a number needs one.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Numbers of voxels. */
struct MaskOverlap
{
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  std::uint64_t both = 0;

  /** 2 both / (a + b); 1 where neither has a voxel. */
  double
  Dice() const;
  /** both / (a + b - both); 1 where neither has a voxel. */
  double
  Jaccard() const;
  /** Voxels of A that B lacks, of those of A (ATM'22: airway missing ratio, AMR); NaN where A has none. */
  double
  MissingRatio() const;
  /** Voxels of B that A lacks, of those of A (ATM'22: airway leakage ratio); NaN where A has none. */
  double
  LeakageRatio() const;
};

MaskOverlap
CountOverlap(const VoxelShape & a, const VoxelShape & b);

/** Voxels of a shape with a face on the background, which all outside the box is, in scan order. */
std::vector<std::array<std::int32_t, 3>>
BoundaryVoxels(const VoxelShape & shape);

/** Distances between the centres of boundary voxels, mm: from each of either shape to the nearest of the other. This
 *  is what the challenges compute (MedPy, MONAI, Metrics Reloaded); distances between surfaces of voxels would depend
 *  on how these are triangulated. Each is sqrt of the sum of (spacing x difference)^2 over the axes, of whole
 *  differences: nothing else is rounded. All are NaN where a shape has no voxel. */
struct SurfaceDistances
{
  double hausdorff = 0;    ///< the greatest of all
  double percentile95 = 0; ///< the greater of both directions' 95th percentiles (between two ranks linearly)
  double mean = 0;         ///< over the boundary voxels of both
};

SurfaceDistances
MeasureSurfaceDistances(const VoxelShape & a, const VoxelShape & b, const Vector3 & spacing);

/** The value below which a part of the numbers lies (0 to 1), between two ranks linearly; NaN of none. */
double
QuantileOf(std::vector<double> values, double part);

/** Topology of both, and |b_k(A) - b_k(B)|, as TopCoW counts Betti errors. */
struct TopologyComparison
{
  TopologyNumbers             a;
  TopologyNumbers             b;
  std::array<std::int64_t, 3> errors{};
};

/** Of the open shapes: pieces hang together over faces. */
TopologyComparison
CompareTopology6(const VoxelShape & a, const VoxelShape & b);

/** Of the closed shapes: pieces hang together over edges and corners, too, as the challenges count. */
TopologyComparison
CompareTopology26(const VoxelShape & a, const VoxelShape & b);

/** What is not the same in both. */
enum class PartKind : std::uint8_t
{
  Piece,
  Loop,
  Cavity
};
enum class PartChange : std::uint8_t
{
  Missed,   ///< A has it, B has nothing of it
  Invented, ///< B has it, A has nothing of it
  Broken,   ///< B has several where A has one: each but that which shares most with A's
  Joined    ///< A has several where B has one: each but that which shares most with B's
};

const char *
NameOf(PartKind kind);
const char *
NameOf(PartChange change);

struct DifferingPart
{
  PartKind                    kind = PartKind::Piece;
  PartChange                  change = PartChange::Missed;
  std::uint64_t               voxels = 0; ///< of the part; of a loop, those of its line that the other mask lacks
  std::array<std::int32_t, 3> place{};    ///< a voxel of it, in the middle of its scan order (of a loop, of its line)
};

/** The pieces (26-connected) and the cavities (6-connected parts of the background that do not reach the outside) that
 *  differ, pieces first, by kind of change, then in scan order. Parts correspond where they share a voxel. */
std::vector<DifferingPart>
FindDifferingParts(const VoxelShape & a, const VoxelShape & b);

} // namespace voxelcore
