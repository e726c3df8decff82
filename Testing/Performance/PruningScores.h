#pragma once
// A pruned core against the medial axis it should be.

#include "EvaluationBodies.h"

#include "voxelcore/VoxelCore/BallTree.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace voxelcore::evaluation
{

/** Lengths and areas in voxels; README.md says what each is. */
struct Scores
{
  double spurArea = 0;
  double spurLength = 0;
  double extraEnds = 0;
  double lostEnds = 0;
  double lost = 0; ///< %
  double toTruth = 0;
  double toCore = 0;
  double radiusBias = 0; ///< mean of stated less true radii, off spurs
  double radiusOff = 0;  ///< mean of their differences' sizes
  double thinOff = 0;    ///< the same where the true radius is below 3 voxels; 0 without such places
  double gap = 0;
  double rotations = 0;
  double resolutions = 0;
  double seconds = 0;
};

struct ScoreColumn
{
  const char * name;
  double Scores::*value;
  bool            worst; ///< of all samples; else the mean
};

const std::array<ScoreColumn, 14> &
ScoreColumns();

class PointTree
{
public:
  explicit PointTree(const std::vector<Vector> & points);

  double
  Distance(const Vector & p) const
  {
    return m_Tree.Gap(p);
  }
  bool
  IsWithin(const Vector & p, double distance) const
  {
    return m_Tree.Gap(p, distance) <= distance;
  }

private:
  std::vector<double> m_Radii;
  BallTree            m_Tree;
};

/** 95 % of the points lie within this distance of the others. */
double
Percentile95(const std::vector<Vector> & from, const PointTree & to);

/** A core in the body's place. */
struct ScoredCore
{
  Scores                           scores; ///< all but gap, rotations, resolutions and seconds
  std::vector<Vector>              points; ///< one for each cube of a voxel that the core meets
  std::shared_ptr<const PointTree> all;    ///< points about half a voxel apart or nearer
};

ScoredCore
ScoreCore(const MedialComplex & core,
          const Body &          body,
          const Placement &     placement,
          const PointTree &     truth,
          double                voxel);

} // namespace voxelcore::evaluation
