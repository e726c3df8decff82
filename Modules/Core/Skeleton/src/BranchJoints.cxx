#include "voxelcore/Skeleton/BranchJoints.h"

#include "ForkPlace.h"
#include "JointAxes.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/OpenShape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace voxelcore
{

namespace
{

// A branch that leaves is nothing but itself so many of its radii less half a voxel outside the junction's ball, the
// one it leaves so many of them and a voxel from the junction.
constexpr double kApartInRadii = 1.5;
constexpr double kSoonerInVoxels = 0.5;
constexpr double kThroughInRadii = 1.5;

// Over what ways axes are fitted: radii of the branch that leaves, at least four voxels.
constexpr double kAxisInRadii = 2;
constexpr double kThroughAxisInRadii = 1.5;
constexpr double kAxisInVoxels = 4;
constexpr double kShortestInVoxels = 2;

// From no to yes, in degrees: how much the branch that goes through bends at most; by how much its axes are straighter
// than those of any way into one that leaves; how large the angle is at which the axes meet.
constexpr std::array<double, 2> kBend{ 70, 40 };
constexpr std::array<double, 2> kStraighter{ 10, 20 };
constexpr std::array<double, 2> kMeetingAngle{ 15, 28 };

// From no to yes: by how many degrees a way that seems straight is straighter as its arms bend; how much alike the arms
// of a way bend that does not seem straight.
constexpr std::array<double, 2> kNotCrooked{ -20, -10 };
constexpr std::array<double, 2> kAlike{ 0.2, 0.5 };

// So many radii of the ball and a voxel the axes meet away from the junction, and pass each other, at most: bodies a
// voxel apart are one in the voxels.
constexpr std::array<double, 2> kMove{ 2.5, 1.5 };
constexpr std::array<double, 2> kGap{ 1.5, 0.5 };
constexpr std::array<double, 2> kForkMove{ 2.5, 1.5 };

double
Degrees(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

/** By how many degrees a way bends that comes out of one direction and goes on into the other, both outwards. */
double
Bend(const Vector3 & a, const Vector3 & b)
{
  return Degrees(-Dot(a, b));
}

/** The points of a joint and by how much each shall move. */
using JointMove = std::vector<std::pair<ElementIndex, Vector3>>;

class JointPlacing
{
public:
  JointPlacing(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
    : m_Graph(graph)
    , m_Shape(shape)
    , m_Geometry(geometry)
    , m_Diagonal(Length(geometry.spacing))
    , m_Voxel(m_Diagonal / std::sqrt(3.0))
  {}

  /** Of a junction and the branches that end there, each with which of its ends: as far as no branch goes through, it
   *  may be a fork. */
  JointMove
  Of(ElementIndex node, const std::vector<std::pair<std::size_t, std::size_t>> & ends) const
  {
    const ElementIndex point = m_Graph.nodePoints[node];
    std::vector<Arm>   arms;
    for (const auto & [branch, end] : ends)
    {
      arms.push_back(ArmOf(m_Graph, branch, end, m_Diagonal));
      if (arms.back().leaves <= 0)
      {
        return {};
      }
    }
    std::vector<Arm> forked = arms;
    const auto       fork = PlaceFork(forked, m_Voxel);
    JointMove        moves = fork ? OfFork(std::move(forked), *fork, point) : JointMove();
    const double     isFork = moves.empty() ? 0 : fork->isSo;
    const double     through = isFork < 1 ? (1 - isFork) * PutThroughFirst(arms) : 0;
    const JointMove  more = through > 0 ? OfThrough(arms, through, point) : JointMove();
    moves.insert(moves.end(), more.begin(), more.end());
    return moves;
  }

private:
  JointMove
  OfThrough(const std::vector<Arm> & arms, double yes, ElementIndex point) const
  {
    ThroughAxis through;
    if (!through.Fit(arms[0], arms[1], m_Graph.positions[point]))
    {
      return {};
    }
    // A junction may lie far to one side, where balls are small.
    const double body = std::max(m_Graph.radius[point], std::min(arms[0].radius, arms[1].radius));
    double       meeting = 0;
    for (std::size_t k = 2; k < arms.size(); ++k)
    {
      const auto [way, isSo] = Meeting(through, AxisOf(arms[k]), body);
      meeting += way / static_cast<double>(arms.size() - 2);
      yes *= isSo;
    }
    return yes > 0 ? Moved(arms, through, meeting, yes, point) : JointMove();
  }

  JointMove
  OfFork(std::vector<Arm> arms, const ForkPlace & fork, ElementIndex point) const
  {
    const double most = m_Graph.radius[point] + m_Voxel;
    const double far = Distance(fork.place, m_Graph.positions[point]);
    arms[0].from = std::min(arms[0].leaves + far, arms[0].free);
    const double yes = fork.isSo * FromNoToYes(kForkMove, far / most);
    JointMove    move;
    AddMove(move, point, fork.place, yes);
    for (const Arm & arm : arms)
    {
      const auto & [places, way] = arm.line;
      const std::size_t last = FirstFrom(arm);
      for (std::size_t i = 1; i < last; ++i)
      {
        AddMove(move, arm.points[i], AddScaled(fork.place, way[i] / way[last], Minus(places[last], fork.place)), yes);
      }
    }
    return yes > 0 && StaysIn(move) ? move : JointMove();
  }

  /** The two arms of the branch that goes through to the front, with all axes. Gives whether there is one, from 0 to 1.
   *  Directions near the junction alone tell little of it: that lies to one side, or it would need no other place. They
   *  say what is tried first. */
  double
  PutThroughFirst(std::vector<Arm> & arms) const
  {
    std::vector<std::array<std::size_t, 2>> pairs;
    for (std::size_t i = 0; i < arms.size(); ++i)
    {
      for (std::size_t k = i + 1; k < arms.size(); ++k)
      {
        pairs.push_back({ i, k });
      }
    }
    const auto bend = [&](const auto & pair) { return Bend(arms[pair[0]].direction, arms[pair[1]].direction); };
    std::stable_sort(pairs.begin(), pairs.end(), [&](const auto & a, const auto & b) { return bend(a) < bend(b); });
    double           best = 0;
    std::vector<Arm> ordered;
    for (const auto & [i, k] : pairs)
    {
      std::vector<Arm> tried = arms;
      std::swap(tried[0], tried[i]);
      std::swap(tried[1], tried[k]);
      const double yes = PlaceAxes(tried) ? GoesThrough(tried) : 0;
      if (yes > best)
      {
        best = yes;
        ordered = std::move(tried);
      }
    }
    if (best > 0)
    {
      arms = std::move(ordered);
    }
    return best;
  }

  /** By how many degrees the way through the first two arms bends less than any into a branch that leaves. */
  static double
  StraighterBy(const std::vector<Vector3> & directions)
  {
    double next = 180;
    for (std::size_t k = 2; k < directions.size(); ++k)
    {
      next = std::min({ next, Bend(directions[0], directions[k]), Bend(directions[1], directions[k]) });
    }
    return next - Bend(directions[0], directions[1]);
  }

  /** Whether the first two arms are one branch: it bends little, and so much less than any way into a branch that
   *  leaves that there is no doubt about it. Where bodies run together curves tell little of that, so it is their axes
   *  that are compared: straight on, unless they bend otherwise; or as they bend, if both do so alike, as those of a
   *  ring. */
  double
  GoesThrough(const std::vector<Arm> & arms) const
  {
    std::vector<Vector3> straight;
    std::vector<Vector3> bent;
    std::vector<ArmBend> bends;
    for (const Arm & arm : arms)
    {
      bends.push_back(BendOf(arm, m_Voxel));
      straight.push_back(AxisOf(arm).direction);
      bent.push_back(bends.back().direction);
    }
    const double asTheyBend = StraighterBy(bent);
    const double isStraight = FromNoToYes(kStraighter, StraighterBy(straight)) * FromNoToYes(kNotCrooked, asTheyBend);
    const double isBent = FromNoToYes(kStraighter, asTheyBend) * FromNoToYes(kAlike, BendAlike(bends[0], bends[1]));
    const double bend =
      std::min({ Bend(arms[0].direction, arms[1].direction), Bend(straight[0], straight[1]), Bend(bent[0], bent[1]) });
    return FromNoToYes(kBend, bend) * std::max(isStraight, isBent);
  }

  /** False where an arm is too short to have one. */
  bool
  PlaceAxes(std::vector<Arm> & arms) const
  {
    double leaving = 0;
    for (std::size_t k = 2; k < arms.size(); ++k)
    {
      leaving = std::max(leaving, arms[k].radius);
    }
    for (std::size_t k = 0; k < arms.size(); ++k)
    {
      Arm &  arm = arms[k];
      double length = 0;
      if (k < 2)
      {
        arm.from = std::min(kThroughInRadii * leaving + m_Voxel, arm.leaves + kApartInRadii * leaving);
        length = std::max(kThroughAxisInRadii * leaving, 0.5 * arm.radius);
      }
      else
      {
        arm.from = arm.leaves + kApartInRadii * arm.radius - kSoonerInVoxels * m_Voxel;
        length = kAxisInRadii * arm.radius;
      }
      arm.to = std::min(arm.from + std::max(length, kAxisInVoxels * m_Voxel), arm.free);
      const bool endsInTip = arm.free == arm.line.way.back();
      if (endsInTip)
      {
        // A short end has its axis as near to its tip as it can be.
        arm.from = std::min(arm.from, std::max(arm.leaves, arm.to - kShortestInVoxels * m_Voxel));
      }
      if (arm.to - arm.from < kShortestInVoxels * m_Voxel || (!endsInTip && arm.from > 0.5 * arm.line.way.back()))
      {
        return false;
      }
    }
    return true;
  }

  /** Where along `through` an axis comes nearest to it, and whether they meet there, from 0 to 1. */
  std::pair<double, double>
  Meeting(const ThroughAxis & through, const Axis & axis, double ball) const
  {
    constexpr int kSteps = 200;
    const double  most = ball + m_Voxel;
    const double  reach = kMove[0] * most;
    double        gap = std::numeric_limits<double>::infinity();
    double        at = 0;
    for (int step = 0; step <= kSteps; ++step)
    {
      const double  way = reach * (2.0 * step / kSteps - 1);
      const Vector3 there = Minus(through.At(way), axis.middle);
      const double  off = Length(AddScaled(there, -Dot(there, axis.direction), axis.direction));
      if (off < gap)
      {
        gap = off;
        at = way;
      }
    }
    const double angle = Degrees(std::abs(Dot(through.DirectionAt(at), axis.direction)));
    return { at,
             FromNoToYes(kMove, std::abs(at) / most) * FromNoToYes(kGap, gap / most) *
               FromNoToYes(kMeetingAngle, angle) };
  }

  JointMove
  Moved(const std::vector<Arm> & arms, const ThroughAxis & through, double meeting, double yes, ElementIndex point)
    const
  {
    const Vector3 to = through.At(meeting);
    JointMove     move;
    AddMove(move, point, to, yes);
    for (std::size_t k = 0; k < arms.size(); ++k)
    {
      const auto & [places, way] = arms[k].line;
      const std::size_t last = FirstFrom(arms[k]);
      const double      end = (k == 0 ? -1 : 1) * Distance(places[last], places[0]);
      for (std::size_t i = 1; i < last; ++i)
      {
        const double part = way[i] / way[last];
        if (k < 2)
        {
          // Along the parabola, which the points behind the joint do not meet exactly.
          const Vector3 on = through.At(meeting + part * (end - meeting));
          AddMove(move, arms[k].points[i], AddScaled(on, part, Minus(places[last], through.At(end))), yes);
        }
        else
        {
          AddMove(move, arms[k].points[i], AddScaled(to, part, Minus(places[last], to)), yes);
        }
      }
    }
    return StaysIn(move) ? move : JointMove();
  }

  /** The point from which on an arm is nothing but itself. */
  static std::size_t
  FirstFrom(const Arm & arm)
  {
    const auto & way = arm.line.way;
    const auto   first = static_cast<std::size_t>(std::lower_bound(way.begin(), way.end(), arm.from) - way.begin());
    return std::min(first, way.size() - 1);
  }

  /** A point goes so much of the way to a place. */
  void
  AddMove(JointMove & move, ElementIndex point, const Vector3 & place, double part) const
  {
    move.emplace_back(point, AddScaled({}, part, Minus(place, m_Graph.positions[point])));
  }

  bool
  StaysIn(const JointMove & move) const
  {
    return std::all_of(move.begin(), move.end(), [&](const auto & moved) {
      return IsIn(AddScaled(m_Graph.positions[moved.first], 1, moved.second));
    });
  }

  bool
  IsIn(const Vector3 & place) const
  {
    return OpenShape(m_Shape, m_Geometry).Holds(place);
  }

  const SkeletonGraph & m_Graph;
  const VoxelShape &    m_Shape;
  const ImageGeometry & m_Geometry;
  const double          m_Diagonal;
  const double          m_Voxel; ///< side of the cube with the same diagonal
};

} // namespace

std::size_t
PlaceJoints(SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
{
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> ends(graph.nodePoints.size());
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const std::size_t end : { 0, 1 })
    {
      ends[graph.branchNodes[branch][end]].emplace_back(branch, end);
    }
  }
  const JointPlacing     placing(graph, shape, geometry);
  std::vector<JointMove> moves;
  for (std::size_t node = 0; node < ends.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Junction && ends[node].size() > 2)
    {
      JointMove move = placing.Of(static_cast<ElementIndex>(node), ends[node]);
      if (!move.empty())
      {
        moves.push_back(std::move(move));
      }
    }
  }
  const OpenShape inside(shape, geometry);
  for (const JointMove & move : moves)
  {
    for (const auto & [point, by] : move)
    {
      // Two moves of one point may lead out where neither does.
      graph.positions[point] = inside.Towards(graph.medial[point], AddScaled(graph.positions[point], 1, by));
      graph.medial[point] = graph.positions[point];
    }
  }
  return moves.size();
}

} // namespace voxelcore
