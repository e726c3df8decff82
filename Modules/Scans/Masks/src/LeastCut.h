#pragma once
// The least vertex cut of a small graph.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace voxelcore
{

/** Nodes with weights, and two ends; edges are undirected. By maximal flow (Dinic 1970). Every node is two: flow comes
 *  in at 2 n, goes on to 2 n + 1 as far as the weight has room, and from there to any neighbour. */
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
    : m_Room(nodes, 0)
    , m_Through(nodes, 0)
    , m_AtEnd(nodes, { 0, 0 })
  {}

  void
  SetNode(std::size_t node, std::uint64_t weight)
  {
    m_Room[node] = weight;
  }

  /** Once for both directions. */
  void
  Link(std::size_t a, std::size_t b)
  {
    m_Links.push_back({ static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b) });
  }

  void
  SetEnd(std::size_t node, bool isFirst)
  {
    m_AtEnd[node][isFirst ? 0 : 1] = 1;
  }

  /** The least cut nearest to the first end and, if it is another, that nearest to the second; none where they weigh as
   *  much as `limit` or more. */
  std::vector<Result>
  Run(std::uint64_t limit = kStays);

private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /** A step from one half of a node: number 0 to its other half, from 1 on to its neighbours. */
  struct Step
  {
    std::uint32_t half;
    std::uint32_t number;
  };

  void
  MakeNeighbours();

  std::uint32_t
  Degree(std::uint32_t node) const
  {
    return m_FirstOf[node + 1] - m_FirstOf[node];
  }

  std::uint32_t
  TargetOf(const Step & step) const;

  /** How much more can flow along a step. */
  std::uint64_t
  RoomOf(const Step & step) const;

  void
  Flow(const Step & step, std::uint64_t by);

  /** Steps that halves are from the second end, of the flow that is left; up to the first end, if that is all that is
   *  asked. Gives the number of the first end, kNone where nothing leads to it. */
  std::uint32_t
  LevelsToSecond(bool onlyToFirst);

  /** The same from the first end; all of them. */
  void
  LevelsFromFirst();

  /** As much as goes by shortest ways from a half that is beside the first end, but not beyond a limit. */
  std::uint64_t
  Push(std::uint32_t from, std::uint64_t limit);

  std::vector<std::array<std::uint32_t, 2>> m_Links;
  std::vector<std::uint64_t>                m_Room;    ///< per node, from half to half
  std::vector<std::uint64_t>                m_Through; ///< per node
  std::vector<std::array<char, 2>>          m_AtEnd;   ///< per node
  std::vector<std::uint32_t>                m_FirstOf; ///< per node in the following
  std::vector<std::uint32_t>                m_Neighbour;
  std::vector<std::uint32_t>                m_Twin; ///< where the neighbour has this node
  std::vector<std::uint64_t>                m_Flow; ///< to the neighbour
  std::vector<std::uint32_t>                m_Now;  ///< per half the step to be tried next
  std::vector<std::uint32_t>                m_Level;
  std::vector<std::uint32_t>                m_Waiting;
};

} // namespace voxelcore
