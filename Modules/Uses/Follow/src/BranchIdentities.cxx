#include "voxelcore/Follow/BranchIdentities.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Refinement/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <utility>

namespace voxelcore
{

namespace
{

/** The hierarchy of a day's branches, each component begun where it began before. */
struct Hierarchy
{
  std::vector<ElementIndex>              parent; ///< kNoBranch: none
  std::vector<std::uint8_t>              isReversed;
  std::vector<ElementIndex>              next;  ///< along its axis; kNoBranch at a tip
  std::vector<std::vector<ElementIndex>> axes;  ///< branches from the base on
  std::vector<ElementIndex>              order; ///< parents before what springs from them
};

/** The end of a branch nearest to a place, and that branch. */
std::pair<ElementIndex, std::size_t>
EndAt(const SkeletonGraph & graph, const Vector3 & place)
{
  std::pair<ElementIndex, std::size_t> best;
  double                               nearest = std::numeric_limits<double>::infinity();
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    for (const ElementIndex node : graph.branchNodes[branch])
    {
      if (const double away = Distance(graph.positions[graph.nodePoints[node]], place); away < nearest)
      {
        nearest = away;
        best = { node, branch };
      }
    }
  }
  return best;
}

Hierarchy
HierarchyOf(const SkeletonGraph & graph, const std::vector<RootChoice> & roots, bool areKnown)
{
  const std::size_t         count = graph.BranchCount();
  Hierarchy                 found{ std::vector<ElementIndex>(count, kNoBranch),
                   std::vector<std::uint8_t>(count, 0),
                   std::vector<ElementIndex>(count, kNoBranch),
                   {},
                   {} };
  std::vector<std::uint8_t> isDone(count + 1, 0); // components
  for (const RootChoice & root : roots)
  {
    const bool isPlace = root.kind == RootChoice::Kind::Point;
    const auto [node, at] = EndAt(graph, root.point);
    SkeletonGraph begun = graph;
    if (isPlace && areKnown)
    {
      begun.nodeKinds[node] = NodeKind::Tip; // it was one, and is where this tree begins though it be none now
    }
    const BranchTable table = MeasureBranches(begun, { root });
    // A place speaks of the component nearest to it; without a place all that are left are meant.
    const ElementIndex        component = isPlace ? table.branches[at].component : 0;
    std::vector<std::uint8_t> isNow(count + 1, 0);
    for (const AxisRecord & axis : table.axes)
    {
      const bool isMeant = component == 0 || axis.component == component;
      if (!isMeant || (isDone[axis.component] != 0 && isNow[axis.component] == 0))
      {
        continue;
      }
      isDone[axis.component] = 1;
      isNow[axis.component] = 1;
      found.axes.push_back(axis.branches);
      for (std::size_t i = 0; i < axis.branches.size(); ++i)
      {
        const ElementIndex branch = axis.branches[i];
        found.parent[branch] = table.branches[branch].parent;
        found.isReversed[branch] = table.branches[branch].baseIsLast ? 1 : 0;
        found.next[branch] = i + 1 < axis.branches.size() ? axis.branches[i + 1] : kNoBranch;
      }
    }
  }
  std::vector<std::vector<ElementIndex>> children(count);
  for (ElementIndex branch = 0; branch < count; ++branch)
  {
    if (found.parent[branch] == kNoBranch)
    {
      found.order.push_back(branch);
    }
    else
    {
      children[found.parent[branch]].push_back(branch);
    }
  }
  for (std::size_t i = 0; i < found.order.size(); ++i)
  {
    const auto & more = children[found.order[i]];
    found.order.insert(found.order.end(), more.begin(), more.end());
  }
  return found;
}

/** What is known of a branch. */
struct Known
{
  std::int64_t id = 0;
  std::int32_t order = 0;
  Course       course;
  std::size_t  day = 0; ///< on which it was seen last
};

/** Where later lines lie along an earlier course. */
class CourseTree
{
public:
  CourseTree(const Course & course, double least)
    : m_Course(course)
    , m_Least(least)
    , m_Tree(course.places, PiecesOf(course))
    , m_Widest(std::max(least, *ranges::max_element(course.radii)))
  {}

  struct Foot
  {
    double arc = 0;
    double radius = 0;
  };
  /** None where no piece is within its tolerance. */
  std::optional<Foot>
  At(const Vector3 & place) const
  {
    Foot         foot;
    const double away = Nearest(place, m_Widest * (1 + 1e-9), foot);
    return away <= std::max(foot.radius, m_Least) ? std::optional(foot) : std::nullopt;
  }

  double
  ArcOf(const Vector3 & place) const
  {
    Foot foot;
    Nearest(place, std::numeric_limits<double>::infinity(), foot);
    return foot.arc;
  }

private:
  /** \returns the distance */
  double
  Nearest(const Vector3 & place, double within, Foot & foot) const
  {
    const auto found = m_Tree.FindNearest(place, within);
    if (found.triangle == TriangleTree::kNoTriangle)
    {
      return std::numeric_limits<double>::infinity();
    }
    const std::size_t piece = found.triangle;
    const double      length = m_Course.arcs[piece + 1] - m_Course.arcs[piece];
    const double      share = length > 0 ? Distance(found.point, m_Course.places[piece]) / length : 0;
    foot.arc = m_Course.arcs[piece] + share * length;
    foot.radius = m_Course.radii[piece] + share * (m_Course.radii[piece + 1] - m_Course.radii[piece]);
    return std::sqrt(found.squaredDistance);
  }

  static std::vector<std::array<std::uint32_t, 3>>
  PiecesOf(const Course & course)
  {
    std::vector<std::array<std::uint32_t, 3>> pieces;
    for (std::uint32_t i = 1; i < course.places.size(); ++i)
    {
      pieces.push_back({ i - 1, i, i });
    }
    return pieces;
  }

  const Course & m_Course;
  double         m_Least;
  TriangleTree   m_Tree;
  double         m_Widest;
};

/** Visits the pieces of a line, each in steps: the feet of both ends, where both have one, the step's length, and the
 *  later radius in its middle. */
template <typename TVisit>
void
WalkAlong(const CourseTree & tree, const Course & later, double step, const TVisit & visit)
{
  auto before = tree.At(later.places[0]);
  for (std::size_t i = 1; i < later.places.size(); ++i)
  {
    const Vector3 way = Minus(later.places[i], later.places[i - 1]);
    const double  length = later.arcs[i] - later.arcs[i - 1];
    const double  count = std::max(1.0, std::ceil(length / step));
    for (double k = 1; k <= count; ++k)
    {
      const auto here = tree.At(AddScaled(later.places[i - 1], k / count, way));
      if (before && here)
      {
        const double share = (k - 0.5) / count;
        visit(*before, *here, length / count, later.radii[i - 1] + share * (later.radii[i] - later.radii[i - 1]));
      }
      before = here;
    }
  }
}

double
AdvanceAlong(const CourseTree & tree, const Course & later, double step)
{
  double advance = 0;
  WalkAlong(tree, later, step, [&](const CourseTree::Foot & from, const CourseTree::Foot & to, double length, double) {
    advance += std::clamp(to.arc - from.arc, -length, length);
  });
  return advance;
}

class Follower
{
public:
  explicit Follower(double least)
    : m_Least(least)
  {}

  FollowedDay
  Follow(SkeletonGraph given, std::size_t day, const RootChoice & first)
  {
    FollowedDay result;
    result.graph = std::move(given);
    m_Graph = &result.graph;
    m_Tree = HierarchyOf(result.graph, RootsOf(first), !m_Known.empty());
    m_Owner.assign(result.graph.BranchCount(), 0);
    m_Whole = 0;
    for (std::size_t branch = 0; branch < result.graph.BranchCount(); ++branch)
    {
      m_Whole += result.graph.BranchLength(branch);
    }
    std::map<std::int64_t, std::vector<ElementIndex>> ways;
    ClaimKnown(ways);
    const std::int64_t firstNew = std::ssize(m_Known) + 1;
    ClaimRest(ways);
    MakeBranches(ways, firstNew, day, result);
    for (Known & known : m_Known)
    {
      if (known.day + 1 == day)
      {
        result.lost.push_back({ known.id, known.course.places.back() });
      }
    }
    return result;
  }

private:
  /** Where known trees begin, the longest first, then what is said of the first day, for all that are left. */
  std::vector<RootChoice>
  RootsOf(const RootChoice & first) const
  {
    std::vector<const Known *> bases;
    for (const Known & known : m_Known)
    {
      if (known.order == 0)
      {
        bases.push_back(&known);
      }
    }
    ranges::stable_sort(bases,
                        [](const Known * a, const Known * b) { return a->course.arcs.back() > b->course.arcs.back(); });
    std::vector<RootChoice> roots;
    for (const Known * known : bases)
    {
      roots.push_back({ RootChoice::Kind::Point, known->course.places.front() });
    }
    if (m_Known.empty() || first.kind != RootChoice::Kind::Point)
    {
      roots.push_back(first);
    }
    roots.emplace_back(); // pieces that a point does not speak of
    return roots;
  }

  Course
  BranchCourse(ElementIndex branch) const
  {
    std::vector<ElementIndex> points;
    Append(branch, points);
    return CourseOf(*m_Graph, points, false);
  }

  void
  Append(ElementIndex branch, std::vector<ElementIndex> & points) const
  {
    const auto line = m_Graph->Branch(branch);
    points.insert(points.end(), line.begin(), line.end());
    if (m_Tree.isReversed[branch] != 0)
    {
      std::reverse(points.end() - static_cast<std::ptrdiff_t>(line.size()), points.end());
    }
  }

  /** The way that a known branch would take. */
  struct Claim
  {
    double                    advance = 0;
    std::vector<ElementIndex> way; ///< branches from the base on
  };

  Claim
  BestClaim(const Known & known, const std::vector<double> & advance) const
  {
    std::vector<double> sum(advance.size(), 0);
    double              most = 0;
    Claim               claim;
    ElementIndex        best = kNoBranch;
    for (const ElementIndex branch : m_Tree.order)
    {
      if (m_Owner[branch] != 0)
      {
        continue;
      }
      const ElementIndex parent = m_Tree.parent[branch];
      const bool         goesOn = parent != kNoBranch && m_Owner[parent] == 0;
      sum[branch] = advance[branch] + (goesOn ? std::max(sum[parent], 0.0) : 0);
      // Which of several goes on is not told within the ball that they spring from.
      const bool isTold = !goesOn || sum[parent] <= 0 || advance[branch] > BallAt(branch);
      if (isTold && sum[branch] > most)
      {
        most = sum[branch];
        best = branch;
      }
    }
    if (best == kNoBranch)
    {
      return claim;
    }
    for (ElementIndex branch = best; branch != kNoBranch && m_Owner[branch] == 0; branch = m_Tree.parent[branch])
    {
      claim.way.push_back(branch);
    }
    // A lateral does not begin before its course does.
    const auto isBefore = [&](ElementIndex branch) {
      return advance[branch] <= 0 && m_Graph->BranchLength(branch) > BallAt(branch);
    };
    while (known.order > 0 && claim.way.size() > 1 && isBefore(claim.way.back()))
    {
      claim.way.pop_back();
    }
    ranges::reverse(claim.way);
    for (ElementIndex branch = m_Tree.next[best]; branch != kNoBranch && m_Owner[branch] == 0;
         branch = m_Tree.next[branch])
    {
      claim.way.push_back(branch);
    }
    for (const ElementIndex branch : claim.way)
    {
      claim.advance += advance[branch];
    }
    return claim;
  }

  /** The tolerance where a branch begins. */
  double
  BallAt(ElementIndex branch) const
  {
    const auto         line = m_Graph->Branch(branch);
    const ElementIndex base = m_Tree.isReversed[branch] != 0 ? line.back() : line.front();
    return std::max(SectionRadii(*m_Graph)[base], m_Least);
  }

  double
  LengthOf(const std::vector<ElementIndex> & way) const
  {
    double length = 0;
    for (const ElementIndex branch : way)
    {
      length += m_Graph->BranchLength(branch);
    }
    return length;
  }

  void
  ClaimKnown(std::map<std::int64_t, std::vector<ElementIndex>> & ways)
  {
    std::vector<Course> courses;
    for (ElementIndex branch = 0; branch < m_Graph->BranchCount() && !m_Known.empty(); ++branch)
    {
      courses.push_back(BranchCourse(branch));
    }
    std::map<std::int32_t, std::vector<std::size_t>> levels;
    for (std::size_t i = 0; i < m_Known.size(); ++i)
    {
      levels[m_Known[i].order].push_back(i);
    }
    for (const auto & [level, numbers] : levels)
    {
      // The longest first, of equal ones the first known; known ones by the opposite of their numbers.
      std::priority_queue<std::pair<double, std::int64_t>> queue;
      std::map<std::size_t, std::vector<double>>           advances;
      for (const std::size_t number : numbers)
      {
        const Known &    known = m_Known[number];
        const CourseTree tree(known.course, m_Least);
        const double     step = StepAlong(known.course, m_Whole, m_Least);
        auto &           advance = advances[number];
        for (const Course & course : courses)
        {
          advance.push_back(AdvanceAlong(tree, course, step));
        }
        queue.emplace(BestClaim(known, advance).advance, -static_cast<std::int64_t>(number));
      }
      while (!queue.empty())
      {
        const auto [expected, opposite] = queue.top();
        const auto number = static_cast<std::size_t>(-opposite);
        queue.pop();
        const Known & known = m_Known[number];
        Claim         claim = BestClaim(known, advances[number]);
        if (claim.advance < expected && !claim.way.empty()) // others have taken branches since
        {
          queue.emplace(claim.advance, opposite);
          continue;
        }
        if (!(claim.advance > 0) || !(claim.advance >= SharedNeed(known.course, LengthOf(claim.way))))
        {
          continue;
        }
        for (const ElementIndex branch : claim.way)
        {
          m_Owner[branch] = known.id;
        }
        ways.emplace(known.id, std::move(claim.way));
      }
    }
  }

  /** What no known branch has taken, axis by axis. */
  void
  ClaimRest(std::map<std::int64_t, std::vector<ElementIndex>> & ways)
  {
    for (const auto & axis : m_Tree.axes)
    {
      std::int64_t id = 0;
      for (const ElementIndex branch : axis)
      {
        if (m_Owner[branch] != 0)
        {
          id = 0;
          continue;
        }
        if (id == 0)
        {
          id = std::ssize(m_Known) + 1;
          m_Known.push_back({ id, 0, {}, 0 });
        }
        m_Owner[branch] = id;
        ways[id].push_back(branch);
      }
    }
  }

  void
  MakeBranches(const std::map<std::int64_t, std::vector<ElementIndex>> & ways,
               std::int64_t                                              firstNew,
               std::size_t                                               day,
               FollowedDay &                                             result)
  {
    std::map<std::int64_t, std::int32_t> orders;
    for (const ElementIndex branch : m_Tree.order)
    {
      const ElementIndex parent = m_Tree.parent[branch];
      orders.try_emplace(m_Owner[branch], parent == kNoBranch ? 0 : orders[m_Owner[parent]] + 1);
    }
    for (const auto & [id, way] : ways)
    {
      Known &        known = m_Known[static_cast<std::size_t>(id - 1)];
      FollowedBranch branch;
      branch.id = id;
      branch.order = orders[id];
      const ElementIndex above = m_Tree.parent[way.front()];
      branch.parent = above == kNoBranch ? 0 : m_Owner[above];
      for (const ElementIndex part : way)
      {
        branch.points.resize(branch.points.empty() ? 0 : branch.points.size() - 1); // both have the node
        Append(part, branch.points);
      }
      Course course = CourseOf(*m_Graph, branch.points, branch.parent != 0);
      branch.length = course.arcs.back();
      branch.meanRadius = MeanRadius(course);
      if (id < firstNew)
      {
        branch.state = known.day + 1 == day ? BranchState::Kept : BranchState::Back;
        branch.before = known.day;
        const CourseTree earlier(known.course, m_Least);
        const double     step = StepAlong(known.course, m_Whole, m_Least);
        branch.advance = AdvanceAlong(earlier, course, step);
        branch.radiusChange = RadiusChange(known.course, earlier, course, step);
        branch.growth = course.arcs.back() - CourseTree(course, m_Least).ArcOf(known.course.places.back());
        if (!(branch.growth > 0))
        {
          branch.growth = earlier.ArcOf(course.places.back()) - known.course.arcs.back();
        }
      }
      known.order = branch.order;
      known.day = day;
      known.course = std::move(course);
      result.branches.push_back(std::move(branch));
    }
  }

  static double
  MeanRadius(const Course & course)
  {
    for (const double base : { course.base, 0.0 })
    {
      double length = 0;
      double sum = 0;
      for (std::size_t i = 1; i < course.arcs.size(); ++i)
      {
        const double piece = course.arcs[i] - course.arcs[i - 1];
        if (course.arcs[i - 1] >= base)
        {
          length += piece;
          sum += piece * (course.radii[i - 1] + course.radii[i]) / 2;
        }
      }
      if (length > 0)
      {
        return sum / length;
      }
    }
    return course.radii.front();
  }

  static double
  RadiusChange(const Course & earlier, const CourseTree & tree, const Course & later, double step)
  {
    double whole = 0;
    double change = 0;
    WalkAlong(tree,
              later,
              step,
              [&](const CourseTree::Foot & from, const CourseTree::Foot & to, double length, double radius) {
                // Beyond the earlier tip all lies at that.
                if (std::min(from.arc, to.arc) >= earlier.base && from.arc != to.arc)
                {
                  whole += length;
                  change += length * (radius - (from.radius + to.radius) / 2);
                }
              });
    return whole > 0 ? change / whole : std::numeric_limits<double>::quiet_NaN();
  }

  double                    m_Least;
  std::vector<Known>        m_Known; ///< by id, from 1
  const SkeletonGraph *     m_Graph = nullptr;
  double                    m_Whole = 0; ///< length of the day's branches
  Hierarchy                 m_Tree;
  std::vector<std::int64_t> m_Owner; ///< id of each branch of the day; 0: none yet
};

} // namespace

Course
CourseOf(const SkeletonGraph & graph, std::span<const ElementIndex> points, bool hasParent)
{
  Course course;
  for (const ElementIndex point : points)
  {
    const double before = course.arcs.empty() ? 0 : course.arcs.back();
    const double piece = course.places.empty() ? 0 : Distance(course.places.back(), graph.positions[point]);
    course.places.push_back(graph.positions[point]);
    course.radii.push_back(SectionRadii(graph)[point]);
    course.arcs.push_back(before + piece);
  }
  course.base = hasParent ? course.radii.front() : 0;
  return course;
}

std::vector<FollowedDay>
FollowBranches(std::vector<SkeletonGraph> graphs, const RootChoice & root, double least)
{
  Follower                 follower(least);
  std::vector<FollowedDay> days;
  for (SkeletonGraph & graph : graphs)
  {
    days.push_back(follower.Follow(std::move(graph), days.size(), root));
  }
  return days;
}

} // namespace voxelcore
