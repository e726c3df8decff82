#include "PruningScores.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace voxelcore::evaluation
{
namespace
{

double
Percentile95(std::vector<double> values)
{
  if (values.empty())
  {
    return 0;
  }
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Vector
Middle(const std::vector<Vector> & at, std::span<const ElementIndex> corners)
{
  Vector sum{ 0, 0, 0 };
  for (const ElementIndex corner : corners)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      sum[i] += at[corner][i] / static_cast<double>(corners.size());
    }
  }
  return sum;
}

double
Length(const Vector & a, const Vector & b)
{
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

double
Area(const std::vector<Vector> & at, std::span<const ElementIndex> corners)
{
  Vector sum{ 0, 0, 0 };
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    const Vector & o = at[corners[0]];
    const Vector & p = at[corners[i]];
    const Vector & q = at[corners[i + 1]];
    for (std::size_t j = 0; j < 3; ++j)
    {
      const std::size_t k = (j + 1) % 3;
      const std::size_t l = (j + 2) % 3;
      sum[j] += 0.5 * ((p[k] - o[k]) * (q[l] - o[l]) - (p[l] - o[l]) * (q[k] - o[k]));
    }
  }
  return Length(sum, { 0, 0, 0 });
}

} // namespace

const std::array<ScoreColumn, 11> &
ScoreColumns()
{
  static const std::array<ScoreColumn, 11> columns{ { { "spur area", &Scores::spurArea, false },
                                                      { "spur length", &Scores::spurLength, false },
                                                      { "extra ends", &Scores::extraEnds, false },
                                                      { "lost ends", &Scores::lostEnds, false },
                                                      { "lost %", &Scores::lost, false },
                                                      { "core to truth", &Scores::toTruth, false },
                                                      { "truth to core", &Scores::toCore, false },
                                                      { "gap", &Scores::gap, true },
                                                      { "rotations", &Scores::rotations, true },
                                                      { "resolutions", &Scores::resolutions, true },
                                                      { "s", &Scores::seconds, false } } };
  return columns;
}

PointTree::PointTree(const std::vector<Vector> & points)
  : m_Radii(points.size(), 0.0)
  , m_Tree(points, m_Radii, SpacingWeights{})
{}

double
Percentile95(const std::vector<Vector> & from, const PointTree & to)
{
  std::vector<double> distances;
  for (const Vector & p : from)
  {
    distances.push_back(to.Distance(p));
  }
  return Percentile95(std::move(distances));
}

ScoredCore
ScoreCore(const MedialComplex & core,
          const Body &          body,
          const Placement &     placement,
          const PointTree &     truth,
          double                voxel)
{
  const CellComplex & cells = core.cells;
  ScoredCore          result;
  Scores &            scores = result.scores;
  std::vector<Vector> at;
  for (const auto & position : core.positions)
  {
    at.push_back(ToBody(placement, position));
  }
  result.points = at;
  std::vector<int> facesAt(cells.edges.size(), 0);
  std::vector<int> edgesAt(cells.vertexCount, 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const Vector middle = Middle(at, cells.FaceVertices(face));
    result.points.push_back(middle);
    if (truth.Distance(middle) > 2 * voxel)
    {
      scores.spurArea += Area(at, cells.FaceVertices(face)) / (voxel * voxel);
    }
    for (const ElementIndex edge : cells.FaceEdges(face))
    {
      ++facesAt[edge];
    }
  }
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    const Vector & a = at[cells.edges[edge][0]];
    const Vector & b = at[cells.edges[edge][1]];
    const int      steps = static_cast<int>(2 * Length(a, b) / voxel) + 1;
    for (int i = 1; i <= steps; ++i)
    {
      const double t = static_cast<double>(i) / (steps + 1);
      result.points.push_back({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) });
    }
    if (facesAt[edge] == 0 && truth.Distance(Middle(at, cells.edges[edge])) > 2 * voxel)
    {
      scores.spurLength += Length(a, b) / voxel;
    }
    ++edgesAt[cells.edges[edge][0]];
    ++edgesAt[cells.edges[edge][1]];
  }
  scores.extraEnds = static_cast<double>(std::count(edgesAt.begin(), edgesAt.end(), 1));
  const PointTree found(result.points);
  for (const Vector & tip : body.tips)
  {
    scores.lostEnds += found.Distance(tip) > 3 * voxel ? 1 : 0;
  }
  // An end that stands for a true one is none too many.
  scores.extraEnds -= static_cast<double>(body.tips.size()) - scores.lostEnds;
  for (const Vector & p : body.axis)
  {
    scores.lost += found.Distance(p) > 2 * voxel ? 100.0 / static_cast<double>(body.axis.size()) : 0;
  }
  scores.toTruth = Percentile95(result.points, truth) / voxel;
  scores.toCore = Percentile95(body.axis, found) / voxel;
  return result;
}

} // namespace voxelcore::evaluation
