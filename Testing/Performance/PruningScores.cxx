#include "PruningScores.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

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

std::uint64_t
CubeOf(const Vector & p, double side)
{
  std::uint64_t cube = 0;
  for (const double x : p)
  {
    cube = (cube << 21U) + static_cast<std::uint64_t>(std::floor(x / side) + (1 << 20));
  }
  return cube;
}

// Which places lie farther from the truth than a limit: mostly the distance of a place nearby says it.
class FarFromTruth
{
public:
  FarFromTruth(const PointTree & truth, double limit)
    : m_Truth(truth)
    , m_Limit(limit)
  {}

  bool
  operator()(const Vector & p)
  {
    const auto [known, isNew] = m_Known.try_emplace(CubeOf(p, m_Limit / 4), p, 0.0);
    auto & [place, distance] = known->second;
    if (isNew)
    {
      distance = m_Truth.Distance(p);
    }
    const double away = Length(p, place);
    return distance - away > m_Limit || (distance + away > m_Limit && !m_Truth.IsWithin(p, m_Limit));
  }

private:
  const PointTree &                                            m_Truth;
  double                                                       m_Limit;
  std::unordered_map<std::uint64_t, std::pair<Vector, double>> m_Known;
};

void
ScoreRadii(const std::vector<double> & radius,
           const std::vector<Vector> & at,
           const Body &                body,
           FarFromTruth &              isSpur,
           double                      voxel,
           Scores &                    scores)
{
  double count = 0;
  double thin = 0;
  for (std::size_t v = 0; v < at.size(); ++v)
  {
    if (isSpur(at[v]))
    {
      continue;
    }
    const double depth = body.depth(at[v]) / voxel;
    const double off = radius[v] / voxel - depth;
    scores.radiusBias += off;
    scores.radiusOff += std::abs(off);
    ++count;
    if (depth < 3)
    {
      scores.thinOff += std::abs(off);
      ++thin;
    }
  }
  scores.radiusBias /= std::max(1.0, count);
  scores.radiusOff /= std::max(1.0, count);
  scores.thinOff /= std::max(1.0, thin);
}

// The first point in each cube of a grid.
std::vector<Vector>
Thinned(const std::vector<Vector> & points, double side)
{
  std::vector<Vector>               kept;
  std::unordered_set<std::uint64_t> cubes;
  for (const Vector & p : points)
  {
    if (cubes.insert(CubeOf(p, side)).second)
    {
      kept.push_back(p);
    }
  }
  return kept;
}

} // namespace

const std::array<ScoreColumn, 14> &
ScoreColumns()
{
  static const std::array<ScoreColumn, 14> columns{ { { "spur area", &Scores::spurArea, false },
                                                      { "spur length", &Scores::spurLength, false },
                                                      { "extra ends", &Scores::extraEnds, false },
                                                      { "lost ends", &Scores::lostEnds, false },
                                                      { "lost %", &Scores::lost, false },
                                                      { "core to truth", &Scores::toTruth, false },
                                                      { "truth to core", &Scores::toCore, false },
                                                      { "radius bias", &Scores::radiusBias, false },
                                                      { "radius off", &Scores::radiusOff, false },
                                                      { "thin off", &Scores::thinOff, false },
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
  FarFromTruth        isSpur(truth, 2 * voxel);
  std::vector<Vector> at;
  for (const auto & position : core.positions)
  {
    at.push_back(ToBody(placement, position));
  }
  std::vector<Vector> all = at;
  std::vector<int>    facesAt(cells.edges.size(), 0);
  std::vector<int>    edgesAt(cells.vertexCount, 0);
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const Vector middle = Middle(at, cells.FaceVertices(face));
    all.push_back(middle);
    if (isSpur(middle))
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
      all.push_back({ a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) });
    }
    if (facesAt[edge] == 0 && isSpur(Middle(at, cells.edges[edge])))
    {
      scores.spurLength += Length(a, b) / voxel;
    }
    ++edgesAt[cells.edges[edge][0]];
    ++edgesAt[cells.edges[edge][1]];
  }
  ScoreRadii(core.radius, at, body, isSpur, voxel, scores);
  scores.extraEnds = static_cast<double>(std::count(edgesAt.begin(), edgesAt.end(), 1));
  result.all = std::make_shared<const PointTree>(all);
  result.points = Thinned(all, voxel);
  const PointTree & found = *result.all;
  for (const Vector & tip : body.tips)
  {
    scores.lostEnds += found.IsWithin(tip, 3 * voxel) ? 0 : 1;
  }
  // An end that stands for a true one is none too many.
  scores.extraEnds -= static_cast<double>(body.tips.size()) - scores.lostEnds;
  scores.toTruth = Percentile95(result.points, truth) / voxel;
  std::vector<double> toCore;
  for (const Vector & p : Thinned(body.axis, voxel))
  {
    toCore.push_back(found.Distance(p));
  }
  const auto lost = std::count_if(toCore.begin(), toCore.end(), [&](double far) { return far > 2 * voxel; });
  scores.lost = 100.0 * static_cast<double>(lost) / static_cast<double>(toCore.size());
  scores.toCore = Percentile95(std::move(toCore)) / voxel;
  return result;
}

} // namespace voxelcore::evaluation
