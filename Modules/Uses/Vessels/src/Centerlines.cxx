#include "voxelcore/Vessels/Centerlines.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/UnionFind.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace voxelcore
{

namespace
{

struct Ball
{
  Vector3 place{};
  double  radius = 0;
};

Ball
Between(const Ball & a, const Ball & b, double t)
{
  return { AddScaled(a.place, t, Minus(b.place, a.place)), (1 - t) * a.radius + t * b.radius };
}

/** The least t of 0 to 1 for which `is` holds, which changes once from no to yes. */
template <typename Is>
double
FirstBetween(const Is & is)
{
  double        low = 0;
  double        high = 1;
  constexpr int kSteps = 40;
  for (int step = 0; step < kSteps; ++step)
  {
    const double middle = 0.5 * (low + high);
    (is(middle) ? high : low) = middle;
  }
  return high;
}

/** A ball between two others, linear in place and radius. */
struct TubePiece
{
  Ball from;
  Ball to;

  bool
  Holds(const Vector3 & place) const
  {
    // The least of |place - c|^2 - r^2, c and r linear in t.
    const Vector3 way = Minus(to.place, from.place);
    const double  widening = to.radius - from.radius;
    const double  bend = Dot(way, way) - widening * widening;
    const double  slope = Dot(Minus(place, from.place), way) + from.radius * widening;
    const auto    isIn = [&](double t) {
      const Ball ball = Between(from, to, t);
      return Distance(place, ball.place) < ball.radius;
    };
    return isIn(0) || isIn(1) || (bend > 0 && isIn(std::clamp(slope / bend, 0.0, 1.0)));
  }
};

/** A way from an inlet to a tip. */
struct Path
{
  std::vector<ElementIndex> nodes;
  std::vector<ElementIndex> branches; ///< from each node to the next
  std::vector<Ball>         balls;    ///< its points
  std::vector<double>       arc;      ///< of these
  std::vector<std::size_t>  pointOfNode;

  /** The ball so far along it. */
  Ball
  At(double along) const
  {
    const auto        after = ranges::upper_bound(arc, along);
    const std::size_t last = std::clamp<std::size_t>(static_cast<std::size_t>(after - arc.begin()), 1, arc.size() - 1);
    const double      length = arc[last] - arc[last - 1];
    return Between(balls[last - 1],
                   balls[last],
                   length > 0 ? std::clamp((along - arc[last - 1]) / length, 0.0, 1.0) : 0);
  }
};

/** A bifurcation on a path. */
struct Blank
{
  double                    begin = 0;
  double                    end = 0;
  std::vector<ElementIndex> nodes;
};

class Splitting
{
public:
  Splitting(const MeasuredSkeleton & part, const FlowTree & tree)
    : m_Graph(part.graph)
    , m_Tree(tree)
    , m_Leading(part.graph.nodePoints.size())
    , m_Blanked(static_cast<ElementIndex>(part.graph.nodePoints.size()))
  {
    for (auto node = tree.order.rbegin(); node != tree.order.rend(); ++node)
    {
      if (IsEnd(*node) || (tree.into[*node] != kNoBranch && !m_Leading[*node].empty()))
      {
        m_Leading[Before(*node)].push_back(*node);
      }
    }
    for (auto & nodes : m_Leading)
    {
      ranges::sort(nodes, {}, [&](ElementIndex node) { return tree.into[node]; });
    }
  }

  void
  Split(std::vector<CenterlineTract> & tracts)
  {
    std::vector<Path>               paths;
    std::vector<std::vector<Blank>> blanks;
    for (ElementIndex node = 0; node < m_Graph.nodePoints.size(); ++node)
    {
      if (IsEnd(node))
      {
        paths.push_back(PathTo(node));
        blanks.push_back(BlanksOf(paths.back()));
        for (const Blank & blank : blanks.back())
        {
          for (const ElementIndex other : blank.nodes)
          {
            m_Blanked.Unite(blank.nodes.front(), other);
          }
        }
      }
    }
    std::map<std::pair<bool, ElementIndex>, std::int64_t> groups;
    const std::int64_t firstGroup = tracts.empty() ? 0 : 1 + ranges::max(tracts, {}, &CenterlineTract::group).group;
    const std::int64_t firstLine = tracts.empty() ? 0 : tracts.back().centerline + 1;
    for (std::size_t i = 0; i < paths.size(); ++i)
    {
      const Path & path = paths[i];
      double       from = 0;
      std::int64_t count = 0;
      const auto   add = [&](double to, bool isBlanked, ElementIndex key) {
        if (!(to > from))
        {
          return;
        }
        const auto group =
          groups.try_emplace({ isBlanked, key }, firstGroup + static_cast<std::int64_t>(groups.size())).first->second;
        tracts.push_back(Piece(path, from, to));
        tracts.back().centerline = firstLine + static_cast<std::int64_t>(i);
        tracts.back().tract = count++;
        tracts.back().group = group;
        tracts.back().isBlanked = isBlanked;
        tracts.back().label = m_Graph.labels.empty() ? 0 : m_Graph.BranchLabel(path.branches.back());
        from = to;
      };
      for (const Blank & blank : blanks[i])
      {
        add(blank.begin, false, BranchAt(path, from));
        add(blank.end, true, m_Blanked.Find(blank.nodes.front()));
      }
      add(path.arc.back(), false, BranchAt(path, from));
    }
  }

private:
  /** Where a line ends: at a tip that is no inlet of it. */
  bool
  IsEnd(ElementIndex node) const
  {
    return m_Graph.nodeKinds[node] == NodeKind::Tip && m_Tree.into[node] != kNoBranch;
  }

  /** The node from which another one is reached. */
  ElementIndex
  Before(ElementIndex node) const
  {
    const auto [first, last] = m_Graph.branchNodes[m_Tree.into[node]];
    return first == node ? last : first;
  }

  /** The balls of the branch into a node, towards that. */
  std::vector<Ball>
  BallsInto(ElementIndex node) const
  {
    const ElementIndex branch = m_Tree.into[node];
    std::vector<Ball>  balls;
    for (const ElementIndex point : m_Graph.Branch(branch))
    {
      balls.push_back({ m_Graph.positions[point], m_Graph.radius[point] });
    }
    if (m_Graph.branchNodes[branch][1] != node)
    {
      ranges::reverse(balls);
    }
    return balls;
  }

  Path
  PathTo(ElementIndex tip) const
  {
    Path path;
    for (ElementIndex node = tip; m_Tree.into[node] != kNoBranch; node = Before(node))
    {
      path.nodes.push_back(node);
      path.branches.push_back(m_Tree.into[node]);
    }
    ranges::reverse(path.nodes);
    ranges::reverse(path.branches);
    for (const ElementIndex node : path.nodes)
    {
      for (const Ball & ball : BallsInto(node))
      {
        const double way = path.balls.empty() ? 0 : Distance(path.balls.back().place, ball.place);
        if (path.balls.empty() || way > 0)
        {
          path.arc.push_back(path.balls.empty() ? 0 : path.arc.back() + way);
          path.balls.push_back(ball);
        }
      }
      path.pointOfNode.push_back(path.balls.size() - 1);
    }
    return path;
  }

  void
  AddSubtree(ElementIndex node, std::vector<TubePiece> & tubes) const
  {
    std::vector<ElementIndex> next{ node };
    while (!next.empty())
    {
      const ElementIndex at = next.back();
      next.pop_back();
      const std::vector<Ball> balls = BallsInto(at);
      for (std::size_t i = 1; i < balls.size(); ++i)
      {
        tubes.push_back({ balls[i - 1], balls[i] });
      }
      next.insert(next.end(), m_Leading[at].begin(), m_Leading[at].end());
    }
  }

  /** In order along it, and none overlaps with another. */
  std::vector<Blank>
  BlanksOf(const Path & path) const
  {
    std::vector<Blank> blanks;
    for (std::size_t k = 0; k + 1 < path.nodes.size(); ++k)
    {
      const ElementIndex junction = path.nodes[k];
      if (m_Leading[junction].size() < 2)
      {
        continue;
      }
      const std::size_t      first = path.pointOfNode[k];
      std::vector<TubePiece> tubes;
      for (std::size_t i = 1; i <= first; ++i)
      {
        tubes.push_back({ path.balls[i - 1], path.balls[i] });
      }
      for (const ElementIndex node : m_Leading[junction])
      {
        if (node != path.nodes[k + 1])
        {
          AddSubtree(node, tubes);
        }
      }
      const double end = Leaves(path, first, tubes);
      const double begin = std::min(path.arc[first], OneBallUpstream(path, end));
      if (!blanks.empty() && begin <= blanks.back().end)
      {
        blanks.back().end = std::max(blanks.back().end, end);
        blanks.back().nodes.push_back(junction);
      }
      else
      {
        blanks.push_back({ begin, end, { junction } });
      }
    }
    return blanks;
  }

  /** Where the path, from a point on, is first outside of all tubes; its end where it never is. */
  static double
  Leaves(const Path & path, std::size_t first, const std::vector<TubePiece> & tubes)
  {
    const auto isOut = [&](const Vector3 & place) {
      return ranges::none_of(tubes, [&](const TubePiece & piece) { return piece.Holds(place); });
    };
    for (std::size_t i = first + 1; i < path.balls.size(); ++i)
    {
      if (isOut(path.balls[i].place))
      {
        const double t =
          FirstBetween([&](double at) { return isOut(Between(path.balls[i - 1], path.balls[i], at).place); });
        return path.arc[i - 1] + t * (path.arc[i] - path.arc[i - 1]);
      }
    }
    return path.arc.back();
  }

  /** The nearest place before another one whose ball reaches just as far as that; the path's begin where none does. */
  static double
  OneBallUpstream(const Path & path, double from)
  {
    const Vector3 place = path.At(from).place;
    const auto    reaches = [&](const Ball & ball) { return Distance(place, ball.place) <= ball.radius; };
    for (std::size_t i = path.balls.size(); i-- > 0;)
    {
      if (path.arc[i] < from && !reaches(path.balls[i]))
      {
        const Ball   next = path.At(std::min(from, path.arc[i + 1]));
        const double t = FirstBetween([&](double at) { return reaches(Between(path.balls[i], next, at)); });
        return path.arc[i] + t * (std::min(from, path.arc[i + 1]) - path.arc[i]);
      }
    }
    return 0;
  }

  static ElementIndex
  BranchAt(const Path & path, double along)
  {
    std::size_t k = 0;
    while (k + 1 < path.branches.size() && path.arc[path.pointOfNode[k]] <= along)
    {
      ++k;
    }
    return path.branches[k];
  }

  static CenterlineTract
  Piece(const Path & path, double from, double to)
  {
    CenterlineTract piece;
    const auto      add = [&](const Ball & ball) {
      piece.places.push_back(ball.place);
      piece.radius.push_back(ball.radius);
    };
    add(path.At(from));
    for (std::size_t i = 0; i < path.balls.size(); ++i)
    {
      if (path.arc[i] > from && path.arc[i] < to)
      {
        add(path.balls[i]);
      }
    }
    add(path.At(to));
    return piece;
  }

  const SkeletonGraph &                  m_Graph;
  const FlowTree &                       m_Tree;
  std::vector<std::vector<ElementIndex>> m_Leading; ///< per node the next ones on ways to tips
  UnionFind                              m_Blanked; ///< junctions of one bifurcation
};

} // namespace

std::vector<CenterlineTract>
SplitCenterlines(const std::vector<MeasuredSkeleton> & parts, const std::vector<std::vector<ElementIndex>> & inlets)
{
  std::vector<CenterlineTract> tracts;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const FlowTree    tree = DirectFlow(parts[i], inlets[i]);
    const std::size_t before = tracts.size();
    Splitting(parts[i], tree).Split(tracts);
    for (std::size_t k = before; k < tracts.size() && parts[i].graph.labels.empty(); ++k)
    {
      tracts[k].label = parts[i].label;
    }
  }
  return tracts;
}

} // namespace voxelcore
