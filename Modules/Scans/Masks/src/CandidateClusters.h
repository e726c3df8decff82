#pragma once
// Candidates that can affect each other, and the topology numbers of every choice among them.

#include "CandidateGraph.h"

namespace voxelcore
{

/** What a choice adds to pieces, loops and cavities. */
using TopologyShift = std::array<std::int64_t, 3>;

/** Some candidates with all that their choice decides, numbered from 0. Topology numbers are sums over clusters. */
struct CandidateCluster
{
  std::vector<std::uint32_t>        candidates; ///< ascending, of the graph
  std::vector<CandidateGraph::Edge> objectEdges;
  std::vector<CandidateGraph::Edge> backgroundEdges;
  std::size_t                       objects = 0; ///< parts, numbered behind the candidates
  std::size_t                       backgrounds = 0;
  std::vector<CandidateGraph::Term> terms;
};

/** Apart are candidates that share no inner element, and no block of the object's or the background's graph: the rank
 *  of a graph is the sum of those of its blocks (maximal parts that no single node cuts), and parts are always
 *  there. */
std::vector<CandidateCluster>
FindClusters(const CandidateGraph & graph);

/** Counts of one cluster; holds the memory for it. */
class ClusterNumbers
{
public:
  explicit ClusterNumbers(const CandidateCluster & cluster);

  /** For which candidates are in: components of object and background and Euler number, each but for a constant. */
  TopologyShift
  operator()(const std::vector<char> & isIn);

private:
  std::int64_t
  Rank(const std::vector<CandidateGraph::Edge> & edges, const std::vector<char> & isIn, char which);

  const CandidateCluster &   m_Cluster;
  std::vector<std::uint32_t> m_Parent;
};

} // namespace voxelcore
