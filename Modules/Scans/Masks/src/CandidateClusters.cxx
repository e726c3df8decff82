#include "CandidateClusters.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <numeric>

namespace voxelcore
{

namespace
{

/** Unites the candidates of each block (Hopcroft and Tarjan 1973, without recursion). */
void
UniteBlocks(std::size_t candidates, const std::vector<CandidateGraph::Edge> & edges, UnionFind & sets)
{
  std::size_t nodes = candidates;
  for (const auto & [a, b] : edges)
  {
    nodes = std::max<std::size_t>(nodes, b + std::size_t{ 1 });
  }
  std::vector<std::size_t> start(nodes + 1, 0);
  for (const auto & [a, b] : edges)
  {
    ++start[a];
    ++start[b];
  }
  std::exclusive_scan(start.begin(), start.end(), start.begin(), std::size_t{ 0 });
  std::vector<std::uint32_t> next(2 * edges.size());
  auto                       fill = start;
  for (const auto & [a, b] : edges)
  {
    next[fill[a]++] = b;
    next[fill[b]++] = a;
  }
  std::vector<std::uint32_t> order(nodes, kNoCandidate);
  std::vector<std::uint32_t> low(nodes);
  std::vector<std::uint32_t> parent(nodes, kNoCandidate);
  std::vector<std::size_t>   at(start.begin(), start.end() - 1);
  std::vector<std::uint32_t> path;
  std::vector<std::uint32_t> open;
  std::uint32_t              count = 0;
  const auto                 enter = [&](std::uint32_t node) {
    order[node] = low[node] = count++;
    path.push_back(node);
    open.push_back(node);
  };
  for (std::uint32_t root = 0; root < candidates; ++root)
  {
    if (order[root] != kNoCandidate)
    {
      continue;
    }
    enter(root);
    while (!path.empty())
    {
      const std::uint32_t node = path.back();
      if (at[node] < start[node + 1])
      {
        const std::uint32_t other = next[at[node]++];
        if (order[other] == kNoCandidate)
        {
          parent[other] = node;
          enter(other);
        }
        else
        {
          low[node] = std::min(low[node], order[other]);
        }
        continue;
      }
      path.pop_back();
      const std::uint32_t above = parent[node];
      if (above == kNoCandidate)
      {
        open.clear();
        continue;
      }
      low[above] = std::min(low[above], low[node]);
      if (low[node] >= order[above])
      {
        std::uint32_t first = above < candidates ? above : kNoCandidate;
        for (std::uint32_t last = kNoCandidate; last != node;)
        {
          last = open.back();
          open.pop_back();
          if (last < candidates)
          {
            sets.Unite(first == kNoCandidate ? last : first, last);
            first = first == kNoCandidate ? last : first;
          }
        }
      }
    }
  }
}

/** Gives the parts that edges of each cluster name numbers behind its candidates; returns how many there are. */
std::size_t
NumberParts(std::size_t candidates, std::size_t own, std::vector<CandidateGraph::Edge> & edges)
{
  std::vector<std::uint32_t> parts;
  for (const auto & edge : edges)
  {
    if (edge.second >= candidates)
    {
      parts.push_back(edge.second);
    }
  }
  ranges::sort(parts);
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
  for (auto & edge : edges)
  {
    if (edge.second >= candidates)
    {
      edge.second = static_cast<std::uint32_t>(
        own + static_cast<std::size_t>(ranges::lower_bound(parts, edge.second) - parts.begin()));
    }
  }
  return parts.size();
}

} // namespace

std::vector<CandidateCluster>
FindClusters(const CandidateGraph & graph)
{
  const std::size_t count = graph.candidates.size();
  UnionFind         sets(count);
  UniteBlocks(count, graph.objectEdges, sets);
  UniteBlocks(count, graph.backgroundEdges, sets);
  for (const CandidateGraph::Term & term : graph.terms)
  {
    for (std::size_t i = 1; i < term.Size(); ++i)
    {
      sets.Unite(term.who[0], term.who[i]);
    }
  }
  std::vector<CandidateCluster> clusters;
  std::vector<std::uint32_t>    clusterOf(count, kNoCandidate);
  std::vector<std::uint32_t>    place(count);
  for (std::uint32_t i = 0; i < count; ++i)
  {
    const std::uint32_t first = sets.Find(i);
    if (first == i)
    {
      clusterOf[i] = static_cast<std::uint32_t>(clusters.size());
      clusters.emplace_back();
    }
    clusterOf[i] = clusterOf[first];
    place[i] = static_cast<std::uint32_t>(clusters[clusterOf[i]].candidates.size());
    clusters[clusterOf[i]].candidates.push_back(i);
  }
  const auto share = [&](const std::vector<CandidateGraph::Edge> & edges, auto member, auto parts) {
    // Parts keep their numbers until all edges of a cluster are there.
    for (const auto & [a, b] : edges)
    {
      (clusters[clusterOf[a]].*member)
        .emplace_back(place[a], b < count ? place[b] : b + static_cast<std::uint32_t>(count));
    }
    for (CandidateCluster & cluster : clusters)
    {
      cluster.*parts = NumberParts(2 * count, cluster.candidates.size(), cluster.*member);
    }
  };
  share(graph.objectEdges, &CandidateCluster::objectEdges, &CandidateCluster::objects);
  share(graph.backgroundEdges, &CandidateCluster::backgroundEdges, &CandidateCluster::backgrounds);
  for (CandidateGraph::Term term : graph.terms)
  {
    CandidateCluster & cluster = clusters[clusterOf[term.who[0]]];
    for (std::size_t i = 0, size = term.Size(); i < size; ++i)
    {
      term.who[i] = place[term.who[i]];
    }
    cluster.terms.push_back(term);
  }
  return clusters;
}

ClusterNumbers::ClusterNumbers(const CandidateCluster & cluster)
  : m_Cluster(cluster)
  , m_Parent(cluster.candidates.size() + std::max(cluster.objects, cluster.backgrounds))
{}

std::int64_t
ClusterNumbers::Rank(const std::vector<CandidateGraph::Edge> & edges, const std::vector<char> & isIn, char which)
{
  std::iota(m_Parent.begin(), m_Parent.end(), std::uint32_t{ 0 });
  const auto find = [&](std::uint32_t node) {
    while (m_Parent[node] != node)
    {
      m_Parent[node] = m_Parent[m_Parent[node]];
      node = m_Parent[node];
    }
    return node;
  };
  std::int64_t rank = 0;
  for (const auto & [a, b] : edges)
  {
    if (isIn[a] != which || (b < isIn.size() && isIn[b] != which))
    {
      continue;
    }
    const std::uint32_t rootA = find(a);
    const std::uint32_t rootB = find(b);
    if (rootA != rootB)
    {
      m_Parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
      ++rank;
    }
  }
  return rank;
}

TopologyShift
ClusterNumbers::operator()(const std::vector<char> & isIn)
{
  const auto   in = static_cast<std::int64_t>(ranges::count(isIn, char{ 1 }));
  const auto   out = static_cast<std::int64_t>(isIn.size()) - in;
  std::int64_t euler = 0;
  for (const CandidateGraph::Term & term : m_Cluster.terms)
  {
    bool all = true;
    for (std::size_t i = 0; i < term.who.size() && term.who[i] != kNoCandidate; ++i)
    {
      all = all && isIn[term.who[i]] != 0;
    }
    euler += all ? term.euler : 0;
  }
  const std::int64_t pieces = in - Rank(m_Cluster.objectEdges, isIn, 1);
  const std::int64_t cavities = out - Rank(m_Cluster.backgroundEdges, isIn, 0);
  return { pieces, pieces + cavities - euler, cavities };
}

} // namespace voxelcore
