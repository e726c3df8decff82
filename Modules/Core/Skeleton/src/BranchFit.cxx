#include "voxelcore/Skeleton/PolynomialFit.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/OpenShape.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
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

// Points of lines as long, whose radius is more than so many windows, are off their fits by so many voxels at most,
// root mean square, where walls are smooth; in thin bodies with rough walls by more, as these move the lines to and fro
// over longer ways than windows even out. By each voxel more windows are so many times wider, where such fits foretell
// points that are left out better. Points along a line are as independent as one in so many voxels.
constexpr double kRoughRadius = 0.185;
constexpr double kZigzag = 0.24;
constexpr double kWindowsOff = 20;
constexpr double kMostWindows = 3.5;
constexpr double kIndependent = 2.5;

// With wider windows points may move by so many times the middle one of all their moves, if that is more.
constexpr double kReachInMiddle = 2.5;

// Nodes stay where they are, so a curve near one must heed it more than it heeds another point.
constexpr double kNodeWeight = 4;

// Where a segment leaves the shape its ends go back by half, by half of that, and then to the medial surface.
constexpr std::array<double, 3> kPartsBack{ 0.5, 0.5, 0 };

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

/** A smooth line through the points of another. */
struct LineFit
{
  std::vector<Vector3> places;
  double               squares = 0; ///< of the ways from points to their places, mm^2
  double               freedom = 0; ///< of how many points on their own the places would be as free
};

/** A line by the ways between the places `along` it, and the windows that go with it. */
class LineSmoothing
{
public:
  LineSmoothing(const MedialLine & line, const std::vector<Vector3> & along, double window)
    : m_Line(line)
    , m_Window(window)
    , m_Way(line.Last() + 1, 0)
  {
    const std::size_t last = line.Last();
    for (std::size_t i = 1; i <= last; ++i)
    {
      m_Way[i] = m_Way[i - 1] + Distance(along[i - 1], along[i]);
    }
    double meanWidth = 0;
    double meanRadius = 0;
    for (std::size_t i = 0; i <= last; ++i)
    {
      meanWidth += WidthAt(i) / static_cast<double>(last + 1);
      meanRadius += line.radius[i] / static_cast<double>(last + 1);
    }
    const bool isLong = m_Way[last] >= kQuarticFrom * meanWidth;
    m_IsQuartic = isLong && meanRadius >= kQuarticRadius * window;
    m_MayWiden = isLong && meanRadius >= kRoughRadius * window;
  }

  double
  Length() const
  {
    return m_Way.back();
  }

  bool
  MayWiden() const
  {
    return m_MayWiden;
  }

  double
  WidthAt(std::size_t i) const
  {
    return m_Window + kWindowGrowth * std::max(0.0, m_Line.radius[i] - m_Window);
  }

  /** Each point to the value of its polynomial, over so many windows. */
  LineFit
  Fit(double windows) const
  {
    LineFit           fit;
    const std::size_t last = m_Line.Last();
    fit.places = m_Line.points;
    for (std::size_t i = First(); i < last; ++i)
    {
      double leverage = 1;
      if (SumsAround(i, HalfAt(i, windows)).Value(m_IsQuartic ? 4 : 2, fit.places[i], leverage))
      {
        const Vector3 off = Minus(fit.places[i], m_Line.points[i]);
        fit.squares += Dot(off, off);
      }
      fit.freedom += leverage;
    }
    if (m_Line.isLoop)
    {
      fit.places[last] = fit.places[0];
    }
    return fit;
  }

  /** No place is further from the line than so many times `reach`, or where windows are wider as much more. */
  void
  KeepNear(const VoxelReach & reach, double times, double windows, std::vector<Vector3> & places) const
  {
    const std::size_t last = m_Line.Last();
    for (std::size_t i = First(); i < last; ++i)
    {
      const double most = times * WidthAt(i) / m_Window;
      Vector3      nearest = m_Line.points[i];
      double       away = HalfVoxels(reach, Minus(places[i], nearest));
      if (away <= most)
      {
        continue;
      }
      // Of a closed curve, too, between its ends.
      const auto [from, to] = Around(i, HalfAt(i, windows));
      for (std::size_t j = from; j < to && away > 0; ++j)
      {
        const Vector3 place = NearestOnSegment(reach, m_Line.points[j], m_Line.points[j + 1], places[i]);
        const double  there = HalfVoxels(reach, Minus(places[i], place));
        if (there < away)
        {
          away = there;
          nearest = place;
        }
      }
      const double part = away > most ? most / away : 1;
      places[i] = AddScaled(nearest, part, Minus(places[i], nearest));
    }
    if (m_Line.isLoop)
    {
      places[last] = places[0];
    }
  }

private:
  std::size_t
  First() const
  {
    return m_Line.isLoop ? 0 : 1;
  }

  /** A closed curve goes on where it began; at most half of it lies before and half behind a point. */
  double
  HalfAt(std::size_t i, double windows) const
  {
    const double half = windows * (m_IsQuartic ? kQuarticWindows : 1) * WidthAt(i);
    return m_Line.isLoop ? std::min(half, 0.5 * Length()) : half;
  }

  PolynomialFit
  SumsAround(std::size_t i, double half) const
  {
    PolynomialFit fit;
    const auto    last = static_cast<std::ptrdiff_t>(m_Line.Last());
    // Points 0 and `last` of a closed curve are one.
    const auto add = [&](std::ptrdiff_t k) {
      const int    round = !m_Line.isLoop ? 0 : k < 0 ? -1 : k >= last ? 1 : 0;
      const auto   j = static_cast<std::size_t>(k - round * last);
      const double u = (m_Way[j] + round * Length() - m_Way[i]) / half;
      if (std::abs(u) >= 1)
      {
        return false;
      }
      const bool isNode = !m_Line.isLoop && (k == 0 || k == last);
      fit.Add(u, (isNode ? kNodeWeight : 1) * Tricube(u), m_Line.points[j]);
      return true;
    };
    const auto           here = static_cast<std::ptrdiff_t>(i);
    const std::ptrdiff_t before = m_Line.isLoop ? here - last + 1 : 0;
    const std::ptrdiff_t behind = m_Line.isLoop ? here + last - 1 : last;
    for (std::ptrdiff_t k = here; k <= behind && add(k); ++k)
    {}
    for (std::ptrdiff_t k = here - 1; k >= before && add(k); --k)
    {}
    return fit;
  }

  /** The first and the last point within a way of one; of a closed curve between its ends. */
  std::pair<std::size_t, std::size_t>
  Around(std::size_t i, double half) const
  {
    const auto from = std::upper_bound(m_Way.begin(), m_Way.end(), m_Way[i] - half);
    const auto to = std::lower_bound(m_Way.begin(), m_Way.end(), m_Way[i] + half);
    return { static_cast<std::size_t>(from - m_Way.begin()), static_cast<std::size_t>(to - m_Way.begin()) - 1 };
  }

  const MedialLine &  m_Line;
  const double        m_Window;
  std::vector<double> m_Way;
  bool                m_IsQuartic = false;
  bool                m_MayWiden = false;
};

/** The side of the cube with a voxel's volume. */
double
VoxelSide(const VoxelReach & reach)
{
  double product = 1;
  for (const Vector3 & row : reach)
  {
    product *= 0.5 * Length(row);
  }
  return 1 / std::cbrt(product);
}

/** By generalized cross-validation (Craven, Wahba 1979): the error to be expected at points that were left out. */
double
ExpectedError(const LineFit & fit, double perPoint)
{
  const double left = 1 - fit.freedom * perPoint;
  return left > 0 ? fit.squares / (left * left) : std::numeric_limits<double>::infinity();
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

/** How far points are from their places, the middle one of all, in half voxels. */
double
MiddleOff(const MedialLine & line, const VoxelReach & reach, const std::vector<Vector3> & places)
{
  std::vector<double> off;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    off.push_back(HalfVoxels(reach, Minus(places[i], line.points[i])));
  }
  const auto middle = off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2);
  std::nth_element(off.begin(), middle, off.end());
  return *middle;
}

/** Takes places back towards the line until they, and the segments between them, lie in the shape. */
void
KeepInside(const MedialLine & line, const OpenShape & inside, std::vector<Vector3> & places)
{
  const std::size_t last = line.Last();
  const auto        isOwn = [&](std::size_t i) { return line.isLoop || (i > 0 && i < last); };
  const auto        take = [&](std::size_t i, double part) {
    if (isOwn(i))
    {
      places[i] = inside.Towards(line.points[i], AddScaled(line.points[i], part, Minus(places[i], line.points[i])));
    }
  };
  for (std::size_t i = 0; i <= last; ++i)
  {
    take(i, 1);
  }
  for (const double part : kPartsBack)
  {
    std::vector<std::uint8_t> leaves(last + 1, 0); // a segment at the point
    for (std::size_t i = 0; i < last; ++i)
    {
      if (!inside.HoldsSegment(places[i], places[i + 1]))
      {
        leaves[i] = leaves[i + 1] = 1;
      }
    }
    if (line.isLoop) // whose first point is its last
    {
      leaves[0] = leaves[last] = leaves[0] | leaves[last];
    }
    for (std::size_t i = 0; i <= last; ++i)
    {
      if (leaves[i] != 0)
      {
        take(i, part);
      }
    }
  }
}

/** The positions of a branch's own points, not of its nodes. */
void
FitBranch(SkeletonGraph & graph, std::size_t branch, double window, const VoxelReach & reach, const OpenShape * inside)
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
  // the ways of the first one's curve.
  const LineSmoothing smoothing(line, LineSmoothing(line, line.points, window).Fit(1).places, window);
  const double        voxel = VoxelSide(reach);
  LineFit             best = smoothing.Fit(1);
  const double        off = std::sqrt(best.squares / static_cast<double>(line.Last())) / voxel;
  double windows = smoothing.MayWiden() ? std::clamp(1 + kWindowsOff * (off - kZigzag), 1.0, kMostWindows) : 1;
  double times = 1;
  if (windows > 1)
  {
    LineFit      wider = smoothing.Fit(windows);
    const double perPoint = kIndependent * voxel / smoothing.Length();
    if (ExpectedError(wider, perPoint) < ExpectedError(best, perPoint))
    {
      best = std::move(wider);
      times = std::max(times, kReachInMiddle * MiddleOff(line, reach, best.places));
    }
    else
    {
      windows = 1;
    }
  }
  std::vector<Vector3> & to = best.places;
  smoothing.KeepNear(reach, times, windows, to);
  if (!line.isLoop)
  {
    KeepBefore(0, line, window, to);
    KeepBefore(line.Last(), line, window, to);
  }
  if (inside != nullptr)
  {
    KeepInside(line, *inside, to);
  }
  for (std::size_t i = line.isLoop ? 0 : 1; i < points.size() - 1; ++i)
  {
    graph.positions[points[i]] = to[i];
  }
}

void
FitAll(SkeletonGraph & graph, double window, const VoxelReach & reach, const OpenShape * inside)
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
  RunEach(graph.BranchCount(), [&](std::size_t branch) { FitBranch(graph, branch, window, reach, inside); });
}

} // namespace

void
FitBranches(SkeletonGraph & graph, double window, const VoxelReach & reach)
{
  FitAll(graph, window, reach, nullptr);
}

void
FitBranches(SkeletonGraph & graph, double window, const VoxelReach & reach, const OpenShape & inside)
{
  FitAll(graph, window, reach, &inside);
}

} // namespace voxelcore
