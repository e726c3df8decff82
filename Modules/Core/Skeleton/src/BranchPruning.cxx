// Branches that go because they are short, or because they hang loose after a cut.

#include "GraphLines.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/DomeBranches.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

namespace voxelcore
{

namespace
{

/** By how much the ball at a branch's tip stands out of the one at its base, mm along the branch. */
double
StandsOut(const SkeletonGraph & graph, double length, ElementIndex tip, ElementIndex base)
{
  return length + graph.radius[tip] - graph.radius[base];
}

/** Takes off branches that end in a tip one by one, the one with the smallest key first, and joins what then meets in
 *  twos. The order does not depend on where it stops: a higher limit takes the same branches and more. */
template <typename Key>
class TipPruning
{
public:
  TipPruning(SkeletonGraph & graph, const Key & key)
    : m_Graph(graph)
    , m_Key(key)
    , m_Lines(graph.BranchCount())
    , m_LinesAt(graph.nodePoints.size())
    , m_Parts(graph.BranchCount())
  {}

  /** Until no key is below the limit; gives the number of branches that went. */
  std::size_t
  Run(double limit)
  {
    for (ElementIndex branch = 0; branch < m_Lines.size(); ++branch)
    {
      m_Lines[branch] = { m_Graph.branchNodes[branch], m_Graph.BranchLength(branch), true };
      m_Parts[branch].push_back(branch);
      for (const ElementIndex node : m_Lines[branch].nodes)
      {
        m_LinesAt[node].push_back(branch);
      }
    }
    for (ElementIndex node = 0; node < m_LinesAt.size(); ++node)
    {
      JoinAt(node);
    }
    for (ElementIndex line = 0; line < m_Lines.size(); ++line)
    {
      Enqueue(line);
    }
    std::size_t count = 0;
    while (!m_Queue.empty() && m_Queue.begin()->key < limit)
    {
      const Candidate candidate = *m_Queue.begin();
      m_Queue.erase(m_Queue.begin());
      m_Lines[candidate.line].isThere = false;
      auto & lines = m_LinesAt[candidate.base];
      lines.erase(std::find(lines.begin(), lines.end(), candidate.line));
      JoinAt(candidate.base);
      ++count;
    }
    if (count > 0)
    {
      Apply();
    }
    return count;
  }

private:
  struct Line
  {
    std::array<ElementIndex, 2> nodes{};
    double                      length = 0;
    bool                        isThere = false;
  };

  struct Candidate
  {
    double       key;
    double       length;
    ElementIndex line;
    ElementIndex base;

    bool
    operator<(const Candidate & other) const
    {
      return std::tie(key, length, line) < std::tie(other.key, other.length, other.line);
    }
  };

  bool
  IsTip(ElementIndex node) const
  {
    return m_Graph.nodeKinds[node] == NodeKind::Tip;
  }

  bool
  IsContact(ElementIndex node) const
  {
    return !m_Graph.contact.empty() && m_Graph.contact[m_Graph.nodePoints[node]] != 0;
  }

  std::optional<Candidate>
  CandidateOf(ElementIndex number) const
  {
    const Line & line = m_Lines[number];
    if (!line.isThere || IsTip(line.nodes[0]) == IsTip(line.nodes[1]))
    {
      return std::nullopt;
    }
    const std::size_t  tip = IsTip(line.nodes[0]) ? 0 : 1;
    const ElementIndex base = line.nodes[1 - tip];
    const double       key = m_Key(line.length, m_Graph.nodePoints[line.nodes[tip]], m_Graph.nodePoints[base]);
    return Candidate{ key, line.length, number, base };
  }

  void
  Enqueue(ElementIndex line)
  {
    if (const auto candidate = CandidateOf(line))
    {
      m_Queue.insert(*candidate);
    }
  }

  void
  Dequeue(ElementIndex line)
  {
    if (const auto candidate = CandidateOf(line))
    {
      m_Queue.erase(*candidate);
    }
  }

  /** Two lines that meet with no other become the first of them. */
  void
  JoinAt(ElementIndex node)
  {
    auto & lines = m_LinesAt[node];
    if (m_Graph.nodeKinds[node] == NodeKind::Surface || IsContact(node) || lines.size() != 2 || lines[0] == lines[1])
    {
      return;
    }
    const ElementIndex first = lines[0];
    const ElementIndex second = lines[1];
    lines.clear();
    Dequeue(first);
    Dequeue(second);
    const auto &       ends = m_Lines[second].nodes;
    const ElementIndex far = ends[ends[0] == node ? 1 : 0];
    m_Lines[second].isThere = false;
    m_Lines[first].length += m_Lines[second].length;
    auto & nodes = m_Lines[first].nodes;
    nodes[nodes[0] == node ? 0 : 1] = far;
    m_Parts[first].insert(m_Parts[first].end(), m_Parts[second].begin(), m_Parts[second].end());
    std::replace(m_LinesAt[far].begin(), m_LinesAt[far].end(), second, first);
    Enqueue(first);
  }

  void
  Apply()
  {
    std::vector<std::uint8_t> stays(m_Graph.BranchCount(), 0);
    for (ElementIndex line = 0; line < m_Lines.size(); ++line)
    {
      for (const ElementIndex branch : m_Parts[line])
      {
        stays[branch] = m_Lines[line].isThere ? 1 : stays[branch];
      }
    }
    KeepBranches(m_Graph, stays);
  }

  SkeletonGraph &                        m_Graph;
  const Key &                            m_Key;
  std::vector<Line>                      m_Lines;
  std::vector<std::vector<ElementIndex>> m_LinesAt; ///< per node; one that ends there twice stands there twice
  std::vector<std::vector<ElementIndex>> m_Parts;   ///< per line the branches of the graph it is made of
  std::set<Candidate>                    m_Queue;
};

} // namespace

std::size_t
PruneBranches(SkeletonGraph & graph, const BranchLimit & limit)
{
  const auto key = [&](double length, ElementIndex tip, ElementIndex base) {
    const double dome = std::max(0.0, graph.radius[tip] - graph.radius[base]);
    const double radius = dome > 0 ? kDomeOfRadius * graph.radius[tip] : graph.radius[base];
    const double least = std::max(limit.lengthMm, limit.radiusRatio * radius);
    return least > 0 ? (length + dome) / least : std::numeric_limits<double>::infinity();
  };
  return TipPruning(graph, key).Run(1);
}

std::size_t
PruneBulges(SkeletonGraph & graph, const std::vector<double> & roughness, double ratio)
{
  const auto key = [&](double length, ElementIndex tip, ElementIndex base) {
    return roughness[base] > 0 ? StandsOut(graph, length, tip, base) / roughness[base]
                               : std::numeric_limits<double>::infinity();
  };
  return TipPruning(graph, key).Run(ratio);
}

std::size_t
PruneCutEnds(SkeletonGraph & graph, const std::vector<LoopCut> & cuts, double standOut)
{
  std::set<Vector3> places;
  for (const LoopCut & cut : cuts)
  {
    places.insert(cut.position);
  }
  const auto key = [&](double length, ElementIndex tip, ElementIndex base) {
    return places.count(graph.positions[tip]) > 0 ? StandsOut(graph, length, tip, base)
                                                  : std::numeric_limits<double>::infinity();
  };
  return TipPruning(graph, key).Run(standOut);
}

} // namespace voxelcore
