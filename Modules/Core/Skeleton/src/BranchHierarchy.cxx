#include "BranchHierarchy.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/LoopClosers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/** Builds the hierarchy of all components. */
class Hierarchy
{
public:
  Hierarchy(const SkeletonGraph & graph, const MeasureOptions & options, BranchTable & table)
    : m_Graph(graph)
    , m_Options(options)
    , m_Table(table)
    , m_Hubs(NodeHubs(graph))
    , m_Components(graph.nodePoints.size())
  {}

  void
  Build()
  {
    ChooseTree();
    NumberComponents();
    m_Visited.assign(m_Graph.BranchCount(), 0);
    for (const auto & nodes : m_ComponentNodes)
    {
      const ElementIndex root = ChooseRoot(nodes);
      if (!m_HubBranches[m_Hubs[root]].empty())
      {
        Grow(root);
      }
    }
    FinishAxes();
  }

private:
  // A branch seen from one of its ends.
  struct End
  {
    ElementIndex branch;
    std::uint8_t last; ///< 1: from its last node
  };

  /** Thickest branches first, as CutLoops has it. */
  void
  ChooseTree()
  {
    m_HubBranches.resize(m_Hubs.empty() ? 0 : *std::max_element(m_Hubs.begin(), m_Hubs.end()) + std::size_t{ 1 });
    const std::vector<std::uint8_t> closes = FindLoopClosers(m_Graph, m_Hubs, LeastRadii(m_Graph));
    UnionFind                       trees(m_HubBranches.size());
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      const auto & nodes = m_Graph.branchNodes[branch];
      for (const std::uint8_t last : { std::uint8_t{ 0 }, std::uint8_t{ 1 } })
      {
        m_HubBranches[m_Hubs[nodes[last]]].push_back({ static_cast<ElementIndex>(branch), last });
      }
      trees.Unite(m_Hubs[nodes[0]], m_Hubs[nodes[1]]);
      m_Table.branches[branch].closesLoop = closes[branch] != 0;
      m_Table.numbers.cycles += closes[branch];
    }
    for (std::size_t node = 0; node < m_Hubs.size(); ++node)
    {
      m_Components[node] = static_cast<ElementIndex>(trees.Find(m_Hubs[node]));
    }
  }

  void
  NumberComponents()
  {
    std::vector<ElementIndex> number(m_HubBranches.size(), 0);
    for (std::size_t node = 0; node < m_Hubs.size(); ++node)
    {
      ElementIndex & component = number[m_Components[node]];
      if (component == 0)
      {
        m_ComponentNodes.emplace_back();
        component = static_cast<ElementIndex>(m_ComponentNodes.size());
      }
      m_ComponentNodes[component - 1].push_back(static_cast<ElementIndex>(node));
      m_Components[node] = component;
    }
    for (std::size_t branch = 0; branch < m_Graph.BranchCount(); ++branch)
    {
      m_Table.branches[branch].component = m_Components[m_Graph.branchNodes[branch][0]];
    }
    m_Table.numbers.components = static_cast<std::int64_t>(m_ComponentNodes.size());
    if (m_Options.root.kind == RootChoice::Kind::Point)
    {
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t point = 0; point < m_Hubs.size(); ++point)
      {
        const double away = Distance(m_Graph.positions[m_Graph.nodePoints[point]], m_Options.root.point);
        if (away < best)
        {
          best = away;
          m_PointComponent = m_Components[point];
        }
      }
    }
  }

  /** The best tip, or any node when there is none; the first of equals. */
  ElementIndex
  ChooseRoot(const std::vector<ElementIndex> & nodes) const
  {
    using Kind = RootChoice::Kind;
    Kind kind = m_Options.root.kind;
    if (kind == Kind::Point && m_Components[nodes[0]] != m_PointComponent)
    {
      kind = Kind::Thickest;
    }
    const bool   hasTip = std::any_of(nodes.begin(), nodes.end(), [&](ElementIndex node) {
      return m_Graph.nodeKinds[node] == NodeKind::Tip;
    });
    ElementIndex best = nodes[0];
    double       bestValue = -std::numeric_limits<double>::infinity();
    for (const ElementIndex node : nodes)
    {
      if (hasTip && m_Graph.nodeKinds[node] != NodeKind::Tip)
      {
        continue;
      }
      const auto & position = m_Graph.positions[m_Graph.nodePoints[node]];
      double       value = m_Graph.radius[m_Graph.nodePoints[node]];
      if (kind == Kind::Top)
      {
        value = position[2];
      }
      else if (kind == Kind::Bottom)
      {
        value = -position[2];
      }
      else if (kind == Kind::Point)
      {
        value = -Distance(position, m_Options.root.point);
      }
      else if (hasTip)
      {
        for (const End & end : m_HubBranches[m_Hubs[node]])
        {
          value = m_Table.branches[end.branch].meanRadius;
        }
      }
      if (value > bestValue)
      {
        bestValue = value;
        best = node;
      }
    }
    return best;
  }

  ElementIndex
  PointFrom(const End & end, std::size_t i) const
  {
    const auto points = m_Graph.Branch(end.branch);
    return end.last ? points[points.size() - 1 - i] : points[i];
  }

  /** From the end of a branch to its first point outside the ball there, or as far as it goes. */
  Vector3
  Direction(const End & end) const
  {
    const auto      points = m_Graph.Branch(end.branch);
    const Vector3 & from = m_Graph.positions[PointFrom(end, 0)];
    const double    reach = 1.5 * m_Graph.radius[PointFrom(end, 0)] + 2 * m_Table.branches[end.branch].meanRadius;
    std::size_t     i = 1;
    while (i + 1 < points.size() && Distance(from, m_Graph.positions[PointFrom(end, i)]) < reach)
    {
      ++i;
    }
    return Minus(m_Graph.positions[PointFrom(end, i)], from);
  }

  struct Task
  {
    End          end; ///< grow this branch away from this end
    ElementIndex parent;
    ElementIndex axis;
  };

  void
  Grow(ElementIndex root)
  {
    // From the root on every branch of the hub begins an axis of level 0; there is one unless the root is a junction.
    std::vector<Task>         tasks;
    std::vector<ElementIndex> order;
    for (const End & end : m_HubBranches[m_Hubs[root]])
    {
      if (!m_Visited[end.branch])
      {
        m_Visited[end.branch] = 1;
        tasks.push_back({ end, kNoBranch, NewAxis(0, kNoBranch, end.branch) });
      }
    }
    for (std::size_t at = 0; at < tasks.size(); ++at)
    {
      const Task     task = tasks[at];
      BranchRecord & record = m_Table.branches[task.end.branch];
      record.parent = task.parent;
      record.axis = task.axis;
      record.baseIsLast = task.end.last != 0;
      record.level = m_Table.axes[task.axis].level;
      m_Table.axes[task.axis].branches.push_back(task.end.branch);
      m_Bases.resize(m_Graph.BranchCount(), 0);
      m_Bases[task.end.branch] = task.end.last;
      order.push_back(task.end.branch);
      if (record.closesLoop)
      {
        continue; // it ends where it meets the tree again
      }
      const End          far{ task.end.branch, static_cast<std::uint8_t>(1 - task.end.last) };
      const ElementIndex hub = m_Hubs[m_Graph.branchNodes[far.branch][far.last]];
      std::vector<End>   next;
      for (const End & end : m_HubBranches[hub])
      {
        if (!m_Visited[end.branch])
        {
          m_Visited[end.branch] = 1;
          next.push_back(end);
        }
      }
      const Vector3 back = Direction(far);
      const Vector3 ahead{ -back[0], -back[1], -back[2] };
      std::size_t   heir = next.size();
      double        best = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < next.size(); ++i)
      {
        BranchRecord & child = m_Table.branches[next[i].branch];
        const Vector3  direction = Direction(next[i]);
        child.parentAngle = AngleDegrees(ahead, direction);
        child.centrifugal = record.centrifugal + 1;
        const double lengths = std::sqrt(Dot(ahead, ahead)) * std::sqrt(Dot(direction, direction));
        const double cosine = lengths > 0 ? Dot(ahead, direction) / lengths : 0;
        const double ratio = record.meanRadius > 0 ? std::min(1.0, child.meanRadius / record.meanRadius) : 1;
        if (!child.closesLoop && cosine + 2 * ratio > best)
        {
          best = cosine + 2 * ratio;
          heir = i;
        }
      }
      for (std::size_t i = 0; i < next.size(); ++i)
      {
        const ElementIndex axis =
          i == heir ? task.axis : NewAxis(m_Table.axes[task.axis].level + 1, task.axis, next[i].branch);
        tasks.push_back({ next[i], task.end.branch, axis });
      }
    }
    // Strahler from the outside in.
    std::vector<std::array<std::int32_t, 2>> & strahler = m_Strahler;
    strahler.resize(m_Graph.BranchCount(), { 0, 0 });
    for (auto branch = order.rbegin(); branch != order.rend(); ++branch)
    {
      BranchRecord & record = m_Table.branches[*branch];
      const auto &   two = strahler[*branch];
      record.strahler = std::max(1, two[0] == two[1] && two[0] > 0 ? two[0] + 1 : two[0]);
      if (record.parent != kNoBranch)
      {
        auto & above = strahler[record.parent];
        if (record.strahler > above[0])
        {
          above = { record.strahler, above[0] };
        }
        else
        {
          above[1] = std::max(above[1], record.strahler);
        }
      }
    }
  }

  ElementIndex
  NewAxis(std::int32_t level, ElementIndex parent, ElementIndex firstBranch)
  {
    AxisRecord axis;
    axis.level = level;
    axis.parent = parent;
    axis.component = m_Table.branches[firstBranch].component;
    m_Table.axes.push_back(axis);
    if (parent != kNoBranch)
    {
      ++m_Table.axes[parent].children;
    }
    return static_cast<ElementIndex>(m_Table.axes.size() - 1);
  }

  void
  FinishAxes()
  {
    for (AxisRecord & axis : m_Table.axes)
    {
      std::vector<ElementIndex> points;
      double                    radius = 0;
      double                    freeLength = 0;
      for (const ElementIndex branch : axis.branches)
      {
        const BranchRecord & record = m_Table.branches[branch];
        const End            base{ branch, m_Bases[branch] };
        for (std::size_t i = points.empty() ? 0 : 1; i < m_Graph.Branch(branch).size(); ++i)
        {
          points.push_back(PointFrom(base, i));
        }
        const double weight = record.freeLength > 0 ? record.freeLength : record.length;
        radius += weight * record.meanRadius;
        freeLength += weight;
      }
      axis.meanRadius = freeLength > 0 ? radius / freeLength : m_Table.branches[axis.branches[0]].meanRadius;
      // A lateral begins at its parent's surface: at the first point outside the ball it springs from.
      std::size_t first = 0;
      if (axis.parent != kNoBranch)
      {
        const Vector3 & base = m_Graph.positions[points[0]];
        while (first + 2 < points.size() &&
               Distance(base, m_Graph.positions[points[first]]) < m_Graph.radius[points[0]])
        {
          ++first;
        }
      }
      std::vector<double> way(points.size(), 0);
      for (std::size_t i = first + 1; i < points.size(); ++i)
      {
        way[i] = way[i - 1] + Distance(m_Graph.positions[points[i - 1]], m_Graph.positions[points[i]]);
      }
      axis.length = way.back();
      const Vector3 & base = m_Graph.positions[points[first]];
      const double    chord = Distance(base, m_Graph.positions[points.back()]);
      axis.tortuosity = chord > 0 ? axis.length / chord : std::numeric_limits<double>::infinity();
      axis.emergenceAngle = axis.midpointAngle = axis.tipAngle = kNan;
      const ElementIndex parent = m_Table.branches[axis.branches[0]].parent;
      if (parent != kNoBranch)
      {
        const Vector3 back = Direction({ parent, static_cast<std::uint8_t>(1 - m_Bases[parent]) });
        const Vector3 ahead{ -back[0], -back[1], -back[2] };
        const auto    middle =
          std::lower_bound(way.begin() + static_cast<std::ptrdiff_t>(first), way.end(), 0.5 * way.back());
        axis.emergenceAngle = m_Table.branches[axis.branches[0]].parentAngle;
        axis.midpointAngle =
          AngleDegrees(ahead, Minus(m_Graph.positions[points[static_cast<std::size_t>(middle - way.begin())]], base));
        axis.tipAngle = AngleDegrees(ahead, Minus(m_Graph.positions[points.back()], base));
      }
    }
  }

  const SkeletonGraph &                    m_Graph;
  const MeasureOptions &                   m_Options;
  BranchTable &                            m_Table;
  std::vector<ElementIndex>                m_Hubs;
  std::vector<ElementIndex>                m_Components; ///< per node
  std::vector<std::vector<ElementIndex>>   m_ComponentNodes;
  std::vector<std::vector<End>>            m_HubBranches;
  std::vector<std::uint8_t>                m_Visited;  ///< per branch
  std::vector<std::uint8_t>                m_Bases;    ///< per branch: which end is nearer to the root
  std::vector<std::array<std::int32_t, 2>> m_Strahler; ///< per branch: the two highest orders above it
  ElementIndex                             m_PointComponent = 0;
};

} // namespace

void
BuildHierarchy(const SkeletonGraph & graph, const MeasureOptions & options, BranchTable & table)
{
  Hierarchy(graph, options, table).Build();
}

} // namespace voxelcore
