#pragma once
// How near a core is to a known medial axis.

#include "KnownGrid.h"
#include "RefinementBodies.h"

#include "voxelcore/Refinement/TriangleTree.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore::evaluation
{

/** Of values with weights. */
struct Spread
{
  double mean = 0;
  double percentile99 = 0;
  double largest = 0;
};

struct Scores
{
  Spread forward;  ///< from the core to the axis, by area
  Spread backward; ///< from the axis' part of measure lambda or more to the core
  double bias = 0; ///< of radii: what is stated less what is true
  double seconds = 0;
  bool   topology = true;
};

/** A point of a surface, for `weight` of its area. */
struct Sample
{
  Vector3 place;
  double  radius;
  double  weight;
};

/** A body's surface and medial axis, to ask distances of. */
class Truth
{
public:
  explicit Truth(const KnownBody & body);

  /** In units of `voxel`. */
  Scores
  Score(const MedialComplex & core, const KnownGrid & grid, double voxel) const;

private:
  TriangleTree        m_Axis;
  TriangleTree        m_Surface;
  std::vector<Sample> m_Samples;
};

} // namespace voxelcore::evaluation
