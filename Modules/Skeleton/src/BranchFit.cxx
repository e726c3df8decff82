#include "PolynomialFit.h"

#include "voxelcore/ParallelTasks.h"
#include "voxelcore/SkeletonGraph.h"
#include "voxelcore/Vectors.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxelcore
{

namespace
{

// Rough walls move the curve of a thick body by more than a voxel, over ways as long as the body is wide. So where the
// radius is more than the window, that grows by as many times what is more, and points may move by as much more.
constexpr double kWindowGrowth = 3;

// What parabolas leave of rough walls makes curves longer: a fourth degree over so many windows bends as a parabola
// over one does, and leaves a fifth of it. A line shorter than so many windows has not enough points for it.
constexpr double kQuarticWindows = 2.5;
constexpr double kQuarticFrom = 3;

// Rough walls break what is thinner than so many windows.
constexpr double kQuarticRadius = 0.25;

// Nodes stay where they are, so a curve near one must heed it more than it heeds another point.
constexpr double kNodeWeight = 4;

double
Tricube(double u)
{
  const double away = std::abs(u);
  const double a = 1 - away * away * away;
  return a * a * a;
}

/** A way in half voxels: at most 1 means half a voxel. */
double
HalfVoxels(const VoxelReach & reach, const Vector3 & way)
{
  double sum = 0;
  for (const Vector3 & row : reach)
  {
    sum += Dot(row, way) * Dot(row, way);
  }
  return std::sqrt(sum);
}

/** The place on a segment that is nearest to a point, measured in voxels. */
Vector3
NearestOnSegment(const VoxelReach & reach, const Vector3 & a, const Vector3 & b, const Vector3 & p)
{
  double along = 0;
  double squared = 0;
  for (const Vector3 & row : reach)
  {
    along += Dot(row, Minus(p, a)) * Dot(row, Minus(b, a));
    squared += Dot(row, Minus(b, a)) * Dot(row, Minus(b, a));
  }
  const double t = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0;
  return { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) };
}

/** A branch as it lies on the medial surface. Its points are of a closed curve, whose last is its first, or of an open
 *  one. */
struct MedialLine
{
  std::vector<Vector3> points;
  std::vector<double>  radius;
  bool                 isLoop = false;

  std::size_t
  Last() const
  {
    return points.size() - 1;
  }
};

/** One round: each point to the value of its polynomial, where ways are as long as between the places `along`; with a
 *  reach no further from the line. */
void
FitOnce(const MedialLine &           line,
        const std::vector<Vector3> & along,
        double                       window,
        const VoxelReach *           reach,
        std::vector<Vector3> &       to)
{
  const std::size_t   last = line.Last();
  const bool          isLoop = line.isLoop;
  std::vector<double> way(last + 1, 0);
  for (std::size_t i = 1; i <= last; ++i)
  {
    way[i] = way[i - 1] + Distance(along[i - 1], along[i]);
  }
  const auto wideAt = [&](std::size_t i) { return window + kWindowGrowth * std::max(0.0, line.radius[i] - window); };
  double     meanWidth = 0;
  double     meanRadius = 0;
  for (std::size_t i = 0; i <= last; ++i)
  {
    meanWidth += wideAt(i) / static_cast<double>(last + 1);
    meanRadius += line.radius[i] / static_cast<double>(last + 1);
  }
  const bool isLong = way[last] >= kQuarticFrom * meanWidth && meanRadius >= kQuarticRadius * window;
  // A closed curve goes on where it began; at most half of it lies before and half behind a point.
  for (std::size_t i = isLoop ? 0 : 1; i < last; ++i)
  {
    const double  wide = wideAt(i);
    const double  longer = isLong ? kQuarticWindows * wide : wide;
    const double  half = isLoop ? std::min(longer, 0.5 * way[last]) : longer;
    PolynomialFit fit;
    const auto    add = [&](std::size_t j, double shift) {
      const double u = (way[j] + shift - way[i]) / half;
      if (std::abs(u) >= 1)
      {
        return false;
      }
      const bool isNode = !isLoop && (j == 0 || j == last);
      fit.Add(u, (isNode ? kNodeWeight : 1) * Tricube(u), line.points[j]);
      return true;
    };
    // Points 0 and `last` of a closed curve are one.
    double      shift = 0;
    std::size_t firstUsed = i;
    std::size_t lastUsed = i;
    for (std::size_t j = i; add(j, shift);)
    {
      lastUsed = std::max(lastUsed, j);
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
      firstUsed = std::min(firstUsed, j);
    }
    Vector3 value{};
    if (!fit.Value(isLong ? 4 : 2, value))
    {
      to[i] = line.points[i];
      continue;
    }
    to[i] = value;
    if (reach == nullptr)
    {
      continue;
    }
    Vector3 nearest = line.points[i];
    double  away = HalfVoxels(*reach, Minus(value, nearest));
    for (std::size_t j = firstUsed; j < lastUsed && away > 0; ++j)
    {
      const Vector3 place = NearestOnSegment(*reach, line.points[j], line.points[j + 1], value);
      const double  there = HalfVoxels(*reach, Minus(value, place));
      if (there < away)
      {
        away = there;
        nearest = place;
      }
    }
    const double most = wide / window;
    const double part = away > most ? most / away : 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      to[i][axis] = nearest[axis] + part * (value[axis] - nearest[axis]);
    }
  }
  if (isLoop)
  {
    to[last] = to[0];
  }
}

/** Points up to the last that came to lie behind a node, which stays where it is, are put between it and the next: no
 *  curve turns back at its ends. `node` is the first or the last point of an open line. */
void
KeepBefore(std::size_t node, const MedialLine & line, double window, std::vector<Vector3> & places)
{
  const std::size_t half = line.Last() / 2;
  const auto        at = [&](std::size_t i) { return node == 0 ? i : node - i; };
  const Vector3     end = places[node];
  const double      far = std::max(window, line.radius[node]);
  std::size_t       ahead = 0;
  while (ahead < half && Distance(places[at(ahead)], end) < far)
  {
    ++ahead;
  }
  const Vector3 onwards = Minus(places[at(ahead)], end);
  std::size_t   first = ahead;
  while (first > 1 && Dot(Minus(places[at(first - 1)], end), onwards) > 0)
  {
    --first;
  }
  for (std::size_t i = 1; i < first; ++i)
  {
    const double part = static_cast<double>(i) / static_cast<double>(first);
    places[at(i)] = AddScaled(end, part, Minus(places[at(first)], end));
  }
}

/** The positions of a branch's own points, not of its nodes. */
void
FitBranch(SkeletonGraph & graph, std::size_t branch, double window, const VoxelReach & reach)
{
  const auto points = graph.Branch(branch);
  MedialLine line;
  line.isLoop = graph.nodeKinds[graph.branchNodes[branch][0]] == NodeKind::Loop;
  for (const ElementIndex point : points)
  {
    line.points.push_back(graph.medial[point]);
    line.radius.push_back(graph.radius[point]);
  }
  // Zigzag makes ways longer, by a third in tubes as thin as a voxel, and so windows shorter. The second round goes by
  // the ways of the first one's curve; that keeps no reach, as which place is nearest may be a matter of chance.
  std::vector<Vector3> along = line.points;
  std::vector<Vector3> to = line.points;
  FitOnce(line, line.points, window, nullptr, along);
  FitOnce(line, along, window, &reach, to);
  if (!line.isLoop)
  {
    KeepBefore(0, line, window, to);
    KeepBefore(line.Last(), line, window, to);
  }
  for (std::size_t i = line.isLoop ? 0 : 1; i < points.size() - 1; ++i)
  {
    graph.positions[points[i]] = to[i];
  }
}

} // namespace

void
FitBranches(SkeletonGraph & graph, double window, const VoxelReach & reach)
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
  RunEach(graph.BranchCount(), [&](std::size_t branch) { FitBranch(graph, branch, window, reach); });
}

} // namespace voxelcore
