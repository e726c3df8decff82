#pragma once
// Two skeletons against each other, by places along their lines. A is the reference: how near is near is told by A's
// radii. Distances of axes alone do not depend on the order.

#include "voxelcore/Compare/MaskComparison.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A place of A is found where a line of B passes within A's radius there, or within `least` mm where that is more; a
 *  place of B is found where the nearest place of A is so near. Where this changes along a line is found by bisection,
 *  between places a quarter of the smaller median radius apart. */
struct TreeTolerance
{
  double least = 0; ///< mm
};

/** A branch of either. */
struct BranchMatch
{
  double length = 0; ///< mm
  double found = 0;  ///< mm of it that are found
  /** The greatest share of it that one connected run of the other follows: a part of the other's lines that hangs
   *  together within the tolerance of this branch. */
  double share = 0;

  /** \returns whether that is kDetectedShare at least */
  bool
  IsFound() const;
};

/** A tip, or a bifurcation (a node of three branches or more). */
struct PlaceMatch
{
  Vector3 place{};      ///< in A; of one that only B has, in B
  double  radius = 0;   ///< there
  double  distance = 0; ///< to its partner, mm; NaN without one
  /** Of a bifurcation, degrees: how much the angle between two of its branches differs from their partners', mean
   *  over every two. A branch's direction is that from the bifurcation to two tolerances along it; the nearest
   *  directions are partners, then the nearest of those left. NaN without two partners. */
  double angleError = 0;
  bool   inA = true;
  bool   inB = true;
};

/** Distances in mm; NaN where there is nothing to measure. */
struct AxisDistances
{
  double mean = 0;
  double percentile95 = 0;
  double max = 0;
};

struct TreeComparison
{
  std::vector<BranchMatch> a;
  std::vector<BranchMatch> b;

  /** Partners lie within the tolerance at A's; the nearest pair is taken first, then the nearest of those left. */
  std::vector<PlaceMatch> tips;
  std::vector<PlaceMatch> bifurcations;

  AxisDistances axis; ///< from places of either that are found to the other's lines
  AxisDistances all;  ///< from all places of both: max is the symmetric Hausdorff distance, between the places

  double radiusBias = 0;  ///< radius of B at the nearest place less A's, mean over A's found length
  double radiusError = 0; ///< the same without sign
};

/** \throws InputError where A has no radius and `least` is 0, or a point is more than 1e15 mm from the origin */
TreeComparison
CompareTrees(const SkeletonGraph & a, const SkeletonGraph & b, const TreeTolerance & tolerance);

/** Sums over branches. */
struct BranchTotals
{
  std::int64_t branches = 0;
  std::int64_t found = 0;
  double       length = 0;
  double       foundLength = 0;
};

BranchTotals
TotalsOf(const std::vector<BranchMatch> & branches);

} // namespace voxelcore
