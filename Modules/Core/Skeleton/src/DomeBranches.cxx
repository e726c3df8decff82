#include "voxelcore/Skeleton/DomeBranches.h"

#include "GraphLines.h"
#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

/** By how much a ball of a refined surface is greater than the one in the voxels around its middle, which is no farther
 *  than `most` from them, mm. */
double
BeyondVoxels(const OpenShape & inside, const Vector3 & middle, double radius, double most)
{
  return radius - inside.DistanceToBoundary(middle, 0, most);
}

// Where balls grow by less than this of the way, it is the grid's doing: the middle of a dome.
constexpr double kGrowth = 0.1;

struct BallOnLine
{
  Vector3 middle{};
  double  radius = 0; ///< mm
};

/** Of a line of points: its greatest ball, and where the ways there meet. */
struct Dome
{
  std::size_t before = 0;
  std::size_t greatest = 0;
  std::size_t behind = 0;
  BallOnLine  foot;
  BallOnLine  ball; ///< the greatest to which balls grow from the line's on
};

void
PutAt(SkeletonGraph & graph, ElementIndex point, const BallOnLine & ball)
{
  graph.positions[point] = ball.middle;
  graph.radius[point] = ball.radius;
  if (!graph.medial.empty())
  {
    graph.medial[point] = ball.middle;
  }
}

class DomeSearch
{
public:
  DomeSearch(const SkeletonGraph & graph, const OpenShape & inside, double standOut)
    : m_Graph(graph)
    , m_Inside(inside)
    , m_StandOut(standOut)
  {}

  /** Those of a line that have no point in common, the greatest first, then in the line's order. */
  std::vector<Dome>
  Of(const std::vector<ElementIndex> & line) const
  {
    std::vector<double> way(line.size(), 0);
    for (std::size_t i = 1; i < line.size(); ++i)
    {
      way[i] = way[i - 1] + Distance(Place(line, i), Place(line, i - 1));
    }
    std::vector<Dome> domes;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
    {
      if (IsGreatest(line, way, i))
      {
        const auto dome = At(line, way, i);
        if (dome && IsGreatestAround(line[i]))
        {
          domes.push_back(*dome);
        }
      }
    }
    ranges::stable_sort(domes, ranges::greater(), [&](const Dome & dome) { return Radius(line, dome.greatest); });
    std::vector<Dome> apart;
    for (const Dome & dome : domes)
    {
      if (ranges::none_of(apart, [&](const Dome & other) {
            return dome.before <= other.behind && other.before <= dome.behind;
          }))
      {
        apart.push_back(dome);
      }
    }
    ranges::sort(apart, {}, &Dome::before);
    return apart;
  }

private:
  const Vector3 &
  Place(const std::vector<ElementIndex> & line, std::size_t at) const
  {
    return m_Graph.positions[line[at]];
  }

  double
  Radius(const std::vector<ElementIndex> & line, std::size_t at) const
  {
    return m_Graph.radius[line[at]];
  }

  /** At a way along the line, which lies between a point and the next. */
  BallOnLine
  BallAt(const std::vector<ElementIndex> & line, const std::vector<double> & way, std::size_t point, double at) const
  {
    const double length = way[point + 1] - way[point];
    const double part = length > 0 ? (at - way[point]) / length : 0;
    return { AddScaled(Place(line, point), part, Minus(Place(line, point + 1), Place(line, point))),
             Radius(line, point) + part * (Radius(line, point + 1) - Radius(line, point)) };
  }

  /** Of the balls whose centres lie in it; the first of equals. */
  bool
  IsGreatest(const std::vector<ElementIndex> & line, const std::vector<double> & way, std::size_t at) const
  {
    const double radius = Radius(line, at);
    for (std::size_t i = at; i-- > 0 && way[at] - way[i] <= radius;)
    {
      if (Radius(line, i) >= radius)
      {
        return false;
      }
    }
    for (std::size_t i = at + 1; i < line.size() && way[i] - way[at] <= radius; ++i)
    {
      if (Radius(line, i) > radius)
      {
        return false;
      }
    }
    return true;
  }

  /** The greatest ball to which balls grow from one on whose middle lies in it. In a dome's neck the medial surface may
   *  end before the dome's middle. Radii are greater by `beyond` than those in the voxels. */
  BallOnLine
  Grown(const BallOnLine & from, double beyond) const
  {
    const double voxel = m_Inside.VoxelDiagonal();
    BallOnLine   ball = from;
    for (double step = voxel / 2; step > voxel / 16;)
    {
      BallOnLine next = ball;
      for (int i = 0; i < 27; ++i)
      {
        const Vector3 direction{ i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0 };
        const double  length = Length(direction);
        const Vector3 middle = AddScaled(ball.middle, length > 0 ? step / length : 0, direction);
        if (length <= 0 || Distance(middle, from.middle) > from.radius || !m_Inside.HoldsSegment(ball.middle, middle))
        {
          continue;
        }
        const double inVoxels = ball.radius - beyond;
        const double radius =
          m_Inside.DistanceToBoundary(middle, std::max(0.0, inVoxels - step), inVoxels + step) + beyond;
        if (radius > next.radius && radius >= ball.radius + kGrowth * step)
        {
          next = { middle, radius };
        }
      }
      if (next.radius > ball.radius)
      {
        ball = next;
      }
      else
      {
        step /= 2;
      }
    }
    return ball;
  }

  /** Of all balls of the graph within kDomeGoesOn radii. */
  bool
  IsGreatestAround(ElementIndex point) const
  {
    const double radius = m_Graph.radius[point];
    for (ElementIndex other = 0; other < m_Graph.positions.size(); ++other)
    {
      if (m_Graph.radius[other] > radius &&
          Distance(m_Graph.positions[other], m_Graph.positions[point]) <= kDomeGoesOn * radius)
      {
        return false;
      }
    }
    return true;
  }

  std::optional<Dome>
  At(const std::vector<ElementIndex> & line, const std::vector<double> & way, std::size_t greatest) const
  {
    // To places as far from it on both sides, step by step from point to point of either. Where points are few, that
    // is between them.
    Dome       dome{ greatest, greatest, greatest, {}, {} };
    BallOnLine before{ Place(line, greatest), Radius(line, greatest) };
    BallOnLine behind = before;
    double     reached = 0;
    while (dome.before > 0 && dome.behind + 1 < line.size())
    {
      const double     toBefore = way[greatest] - way[dome.before - 1];
      const double     toBehind = way[dome.behind + 1] - way[greatest];
      const double     next = std::min(toBefore, toBehind);
      const BallOnLine nextBefore = BallAt(line, way, dome.before - 1, way[greatest] - next);
      const BallOnLine nextBehind = BallAt(line, way, dome.behind, way[greatest] + next);
      if (Distance(nextBefore.middle, nextBehind.middle) > std::min(nextBefore.radius, nextBehind.radius))
      {
        break;
      }
      before = nextBefore;
      behind = nextBehind;
      reached = next;
      dome.before -= toBefore <= next ? 1 : 0;
      dome.behind += toBehind <= next ? 1 : 0;
    }
    if (reached <= 0)
    {
      return std::nullopt;
    }
    // What of the line lies farther stays.
    dome.before -= way[greatest] - way[dome.before] < reached ? 1 : 0;
    dome.behind += way[dome.behind] - way[greatest] < reached ? 1 : 0;
    const Vector3 & last = Place(line, dome.before);
    dome.foot.middle = AddScaled(before.middle, 0.5, Minus(behind.middle, before.middle));
    dome.ball = { Place(line, greatest), Radius(line, greatest) };
    if (!m_Inside.Holds(dome.foot.middle) || !m_Inside.HoldsSegment(dome.foot.middle, last) ||
        !m_Inside.HoldsSegment(dome.foot.middle, Place(line, dome.behind)) ||
        !m_Inside.HoldsSegment(dome.foot.middle, Place(line, dome.before + 1)))
    {
      return std::nullopt;
    }
    const double ball = Radius(line, dome.before);
    const double beyond = BeyondVoxels(m_Inside, last, ball, ball + 2 * dome.ball.radius);
    // Only ways nearer to each other than to the middle lead back: others go on.
    if (Distance(before.middle, behind.middle) < reached)
    {
      dome.ball = Grown(dome.ball, beyond);
    }
    const double radius = dome.ball.radius;
    const double wayIn = Distance(dome.foot.middle, dome.ball.middle);
    dome.foot.radius = std::max(0.0, m_Inside.DistanceToBoundary(dome.foot.middle, 0, radius + wayIn) + beyond);
    if (!IsDomeBeside(radius, dome.foot.radius, wayIn) || wayIn + radius - dome.foot.radius < m_StandOut)
    {
      return std::nullopt;
    }
    return dome;
  }

  const SkeletonGraph & m_Graph;
  const OpenShape &     m_Inside;
  const double          m_StandOut; ///< mm
};

/** A branch from a junction on. */
struct DomeArm
{
  std::vector<ElementIndex> points;
  std::vector<double>       way; ///< mm, of each point
  bool                      endsInTip = false;
  std::size_t               greatest = 0; ///< its greatest ball
};

class DomePassing
{
public:
  DomePassing(SkeletonGraph & graph, const OpenShape & inside)
    : m_Graph(graph)
    , m_Inside(inside)
  {}

  /** Whether the three branches that end in a point are two of a tube and one that leads into a dome, and have been
   *  straightened. */
  bool
  Straighten(std::vector<DomeArm> arms)
  {
    ranges::stable_sort(arms, ranges::greater(), [&](const DomeArm & arm) {
      return arm.endsInTip ? BallAt(arm, arm.greatest) : 0.0;
    });
    const DomeArm & dome = arms[0];
    const double    radius = BallAt(dome, dome.greatest);
    if (!dome.endsInTip || dome.way.back() - dome.way[dome.greatest] > kDomeGoesOn * radius ||
        !IsDomeBeside(radius, BallAt(dome, 0), dome.way[dome.greatest]))
    {
      return false;
    }
    const Vector3     middle = Place(dome, dome.greatest);
    const std::size_t before = FirstApart(arms[1], middle, radius);
    const std::size_t behind = FirstApart(arms[2], middle, radius);
    if (before == 0 || behind == 0)
    {
      return false;
    }
    const Vector3 from = Place(arms[1], before);
    const Vector3 to = Place(arms[2], behind);
    const double  chord = Distance(from, to);
    // A cubic has at its ends these slopes.
    const Vector3 in = AddScaled({}, chord, Outwards(arms[1], before, Minus(from, to)));
    const Vector3 out = AddScaled({}, -chord, Outwards(arms[2], behind, Minus(to, from)));
    const auto    at = [&](double t) {
      const double  s = 1 - t;
      const Vector3 ends = AddScaled(AddScaled({}, s * s * (1 + 2 * t), from), t * t * (3 - 2 * t), to);
      return AddScaled(AddScaled(ends, -t * s * s, in), -t * t * s, out);
    };
    double           nearest = 0;
    constexpr double parts = 64;
    for (double part = 1; part < parts; ++part)
    {
      nearest = Distance(at(part / parts), middle) < Distance(at(nearest), middle) ? part / parts : nearest;
    }
    std::vector<std::pair<ElementIndex, Vector3>> moved;
    const Vector3                                 junction = at(nearest);
    Vector3                                       last = junction;
    bool                                          isIn = m_Inside.Holds(junction);
    const auto                                    move = [&](const DomeArm & arm, std::size_t end, const auto & place) {
      last = junction;
      for (std::size_t i = 1; i <= end && isIn; ++i)
      {
        const Vector3 next = place(arm.way[i] / arm.way[end]);
        isIn = m_Inside.HoldsSegment(last, next);
        moved.emplace_back(arm.points[i], next);
        last = next;
      }
    };
    moved.emplace_back(dome.points[0], junction);
    move(arms[1], before, [&](double part) { return at(nearest * (1 - part)); });
    move(arms[2], behind, [&](double part) { return at(nearest + (1 - nearest) * part); });
    move(dome, dome.greatest, [&](double part) { return AddScaled(junction, part, Minus(middle, junction)); });
    if (!isIn)
    {
      return false;
    }
    const double most = radius + dome.way.back() + chord;
    const double beyond = BeyondVoxels(m_Inside, from, BallAt(arms[1], before), most);
    for (const auto & [point, place] : moved)
    {
      m_Graph.positions[point] = place;
      m_Graph.radius[point] = std::max(0.0, m_Inside.DistanceToBoundary(place, 0, most) + beyond);
      if (!m_Graph.medial.empty())
      {
        m_Graph.medial[point] = place;
      }
    }
    return true;
  }

private:
  const Vector3 &
  Place(const DomeArm & arm, std::size_t at) const
  {
    return m_Graph.positions[arm.points[at]];
  }

  double
  BallAt(const DomeArm & arm, std::size_t at) const
  {
    return m_Graph.radius[arm.points[at]];
  }

  /** The first point whose ball is apart from a ball, which in voxels may be smaller by half a diagonal than in the
   *  body, each; 0 where none is before the branch's end. */
  std::size_t
  FirstApart(const DomeArm & arm, const Vector3 & middle, double radius) const
  {
    for (std::size_t i = 1; i + 1 < arm.points.size(); ++i)
    {
      if (Distance(Place(arm, i), middle) >= radius + BallAt(arm, i) + m_Inside.VoxelDiagonal())
      {
        return i;
      }
    }
    return 0;
  }

  /** The direction in which a branch leads on from a point, over two radii of its ball; where it ends before, the one
   *  given. */
  Vector3
  Outwards(const DomeArm & arm, std::size_t at, Vector3 direction) const
  {
    for (std::size_t i = at + 1; i < arm.points.size(); ++i)
    {
      if (arm.way[i] - arm.way[at] >= 2 * BallAt(arm, at))
      {
        direction = Minus(Place(arm, i), Place(arm, at));
        break;
      }
    }
    return AddScaled({}, 1 / Length(direction), direction);
  }

  SkeletonGraph &   m_Graph;
  const OpenShape & m_Inside;
};

} // namespace

std::vector<DomeBranch>
DomesOf(const SkeletonGraph & graph)
{
  std::vector<DomeBranch> domes;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const std::size_t end : { 0U, 1U })
    {
      const ElementIndex node = graph.branchNodes[branch][end];
      const ElementIndex other = graph.branchNodes[branch][1 - end];
      if (graph.nodeKinds[node] != NodeKind::Junction || graph.nodeKinds[other] != NodeKind::Tip)
      {
        continue;
      }
      const ElementIndex base = graph.nodePoints[node];
      const ElementIndex greatest =
        *ranges::max_element(graph.Branch(branch), {}, [&](ElementIndex point) { return graph.radius[point]; });
      const Vector3 & middle = graph.positions[greatest];
      const double    radius = graph.radius[greatest];
      if (IsDomeBeside(radius, graph.radius[base], Distance(middle, graph.positions[base])) &&
          Distance(middle, graph.positions[graph.nodePoints[other]]) <= kDomeGoesOn * radius)
      {
        domes.push_back({ branch, node, greatest });
      }
    }
  }
  return domes;
}

std::size_t
StraightenPastDomes(SkeletonGraph & graph, const OpenShape & inside)
{
  std::vector<std::vector<DomeArm>> arms(graph.nodePoints.size());
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto [first, last] = graph.branchNodes[branch];
    for (const std::size_t end : { 0U, 1U })
    {
      if (first == last)
      {
        continue;
      }
      const auto points = graph.Branch(branch);
      DomeArm    arm{ { points.begin(), points.end() },
                   { 0 },
                   graph.nodeKinds[graph.branchNodes[branch][1 - end]] == NodeKind::Tip };
      if (end == 1)
      {
        ranges::reverse(arm.points);
      }
      for (std::size_t i = 1; i < arm.points.size(); ++i)
      {
        arm.way.push_back(arm.way.back() +
                          Distance(graph.positions[arm.points[i]], graph.positions[arm.points[i - 1]]));
        arm.greatest = graph.radius[arm.points[i]] > graph.radius[arm.points[arm.greatest]] ? i : arm.greatest;
      }
      arms[graph.branchNodes[branch][end]].push_back(std::move(arm));
    }
  }
  std::size_t count = 0;
  DomePassing passing(graph, inside);
  for (std::size_t node = 0; node < arms.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Junction && arms[node].size() == 3)
    {
      count += passing.Straighten(std::move(arms[node])) ? 1 : 0;
    }
  }
  return count;
}

std::size_t
BranchIntoDomes(SkeletonGraph & graph, const OpenShape & inside, double standOut)
{
  std::size_t               count = 0;
  GraphLines                lines;
  std::vector<std::uint8_t> keep(graph.positions.size(), 1);
  const GraphLines          all = LinesOf(graph);
  for (const std::vector<ElementIndex> & line : all)
  {
    const std::vector<Dome>   domes = DomeSearch(graph, inside, standOut).Of(line);
    std::size_t               from = 0;
    std::vector<ElementIndex> begun;
    for (const Dome & dome : domes)
    {
      const ElementIndex foot = CopyPoint(graph, line[dome.before]);
      keep.push_back(1);
      PutAt(graph, foot, dome.foot);
      begun.insert(begun.end(),
                   line.begin() + static_cast<std::ptrdiff_t>(from),
                   line.begin() + static_cast<std::ptrdiff_t>(dome.before + 1));
      begun.push_back(foot);
      lines.push_back(std::move(begun));
      std::vector<ElementIndex> into{ foot };
      into.insert(into.end(),
                  line.begin() + static_cast<std::ptrdiff_t>(dome.before + 1),
                  line.begin() + static_cast<std::ptrdiff_t>(dome.greatest + 1));
      if (dome.ball.radius > graph.radius[line[dome.greatest]])
      {
        into.push_back(CopyPoint(graph, line[dome.greatest]));
        keep.push_back(1);
        PutAt(graph, into.back(), dome.ball);
      }
      lines.push_back(std::move(into));
      for (std::size_t i = dome.greatest + 1; i < dome.behind; ++i)
      {
        keep[line[i]] = 0;
      }
      begun = { foot };
      from = dome.behind;
      ++count;
    }
    begun.insert(begun.end(), line.begin() + static_cast<std::ptrdiff_t>(from), line.end());
    lines.push_back(std::move(begun));
  }
  if (count > 0)
  {
    KeepPoints(graph, lines, keep);
    SortBranches(graph, lines, false);
  }
  return count;
}

} // namespace voxelcore
