#include "PointGeometry.h"

#include "voxelcore/SkeletonGraph.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// Nodes stay where they are, so a curve near one must heed it more than it heeds another point.
constexpr double kNodeWeight = 4;

/** Sums of a weighted fit of 1, u, u^2. */
struct Parabola
{
  double moments[5]{};
  Point3 sums[3]{};

  void
  Add(double u, double weight, const Point3 & point)
  {
    double power = weight;
    for (int k = 0; k < 5; ++k)
    {
      moments[k] += power;
      for (std::size_t axis = 0; k < 3 && axis < 3; ++axis)
      {
        sums[k][axis] += power * point[axis];
      }
      power *= u;
    }
  }

  /** Its value at u = 0; false when too few points define it. */
  bool
  Value(Point3 & value) const
  {
    const double * m = moments;
    const double   c0 = m[2] * m[4] - m[3] * m[3];
    const double   c1 = m[2] * m[3] - m[1] * m[4];
    const double   c2 = m[1] * m[3] - m[2] * m[2];
    const double   determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
    if (!(determinant > 1e-9 * m[0] * m[0] * m[0]))
    {
      return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      value[axis] = (c0 * sums[0][axis] + c1 * sums[1][axis] + c2 * sums[2][axis]) / determinant;
    }
    return true;
  }
};

double
Tricube(double u)
{
  const double away = std::abs(u);
  const double a = 1 - away * away * away;
  return a * a * a;
}

} // namespace

void
FitBranches(SkeletonGraph & graph, double window, double reach)
{
  if (graph.medial.empty())
  {
    graph.medial = graph.positions;
  }
  graph.positions = graph.medial;
  if (!(window > 0))
  {
    return;
  }
  std::vector<double> way;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto        points = graph.Branch(branch);
    const bool        isLoop = graph.nodeKinds[graph.branchNodes[branch][0]] == NodeKind::Loop;
    const std::size_t last = points.size() - 1;
    way.assign(points.size(), 0);
    for (std::size_t i = 1; i <= last; ++i)
    {
      way[i] = way[i - 1] + Distance(graph.medial[points[i - 1]], graph.medial[points[i]]);
    }
    // A closed curve goes on where it began; at most half of it lies before and half behind a point.
    const double half = isLoop ? std::min(window, 0.5 * way[last]) : window;
    for (std::size_t i = isLoop ? 0 : 1; i < last; ++i)
    {
      Parabola   fit;
      const auto add = [&](std::size_t j, double shift) {
        const double u = (way[j] + shift - way[i]) / half;
        if (std::abs(u) >= 1)
        {
          return false;
        }
        const bool isNode = !isLoop && (j == 0 || j == last);
        fit.Add(u, (isNode ? kNodeWeight : 1) * Tricube(u), graph.medial[points[j]]);
        return true;
      };
      // Points 0 and `last` of a closed curve are one.
      double shift = 0;
      for (std::size_t j = i; add(j, shift);)
      {
        if (++j == (isLoop ? last : last + 1))
        {
          if (!isLoop)
          {
            break;
          }
          j = 0;
          shift += way[last];
        }
      }
      shift = 0;
      for (std::size_t j = i;;)
      {
        if (j == 0)
        {
          if (!isLoop)
          {
            break;
          }
          j = last;
          shift -= way[last];
        }
        --j;
        if (!add(j, shift))
        {
          break;
        }
      }
      Point3         value{};
      const Point3 & from = graph.medial[points[i]];
      if (!fit.Value(value))
      {
        continue;
      }
      const double moved = Distance(from, value);
      const double part = moved > reach ? reach / moved : 1;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        graph.positions[points[i]][axis] = from[axis] + part * (value[axis] - from[axis]);
      }
    }
  }
}

} // namespace voxelcore
