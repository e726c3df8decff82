#pragma once
// The least vertex cut of a small graph.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Nodes with weights, and two ends; edges are undirected. By maximal flow (Dinic 1970). */
class LeastCut
{
public:
  static constexpr std::uint64_t kStays = std::uint64_t{ 1 } << 48; ///< the weight of what is not cut

  struct Result
  {
    std::vector<std::size_t> nodes;   ///< ascending
    std::vector<char>        isFirst; ///< of each node, whether it stays on the first end's side
  };

  explicit LeastCut(std::size_t nodes)
    : m_Nodes(nodes)
    , m_First(2 * nodes + 2, kNone)
  {}

  void
  SetNode(std::size_t node, std::uint64_t weight)
  {
    Add(2 * node, 2 * node + 1, weight);
  }

  /** Once for both directions. */
  void
  Link(std::size_t a, std::size_t b)
  {
    Add(2 * a + 1, 2 * b, kStays);
    Add(2 * b + 1, 2 * a, kStays);
  }

  void
  SetEnd(std::size_t node, bool isFirst)
  {
    isFirst ? Add(2 * m_Nodes, 2 * node, kStays) : Add(2 * node + 1, 2 * m_Nodes + 1, kStays);
  }

  /** The least cut nearest to the first end and, if it is another, that nearest to the second; none where the ends hang
   *  together by what stays. */
  std::vector<Result>
  Run();

private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  struct Arc
  {
    std::size_t   to;
    std::size_t   next;
    std::uint64_t room;
  };

  void
  Add(std::size_t from, std::size_t to, std::uint64_t room)
  {
    m_Arcs.push_back({ to, m_First[from], room });
    m_First[from] = m_Arcs.size() - 1;
    m_Arcs.push_back({ from, m_First[to], 0 });
    m_First[to] = m_Arcs.size() - 1;
  }

  /** Steps along arcs with room from the first end, or against them from the second. */
  void
  FindLevels(bool isFromFirst);

  std::uint64_t
  PushOne();

  std::size_t              m_Nodes;
  std::vector<Arc>         m_Arcs;
  std::vector<std::size_t> m_First;
  std::vector<std::size_t> m_Now;
  std::vector<std::size_t> m_Level;
};

} // namespace voxelcore
