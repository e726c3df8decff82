#include "ChangeProposals.h"

#include "LeastCut.h"
#include "voxelcore/Base/Library.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kMostLinks = 1000000; // of a graph that is cut
constexpr char        kBeyond = 2;          // what is too far away to be looked at

class Proposer
{
public:
  Proposer(const ChangeInWindow & change, std::vector<char> now)
    : m_Change(change)
    , m_Window(change.window)
    , m_From(change.isFill ? 0 : 1)
    , m_Steps(change.window.StepsFrom(change.voxels, change.reach))
    , m_Now(std::move(now))
  {
    for (std::size_t number = 0; number < m_Now.size(); ++number)
    {
      m_Now[number] = m_Steps[number] > change.reach ? kBeyond : m_Now[number];
    }
    m_Before = m_Now;
    for (const std::size_t number : change.voxels)
    {
      m_Before[number] = m_From;
    }
  }

  std::vector<ChangeProposal>
  Release()
  {
    return std::move(m_Proposals);
  }

  /** Two sides that the change parts are parted elsewhere. */
  void
  Part()
  {
    // What the change takes from hangs together over faces if it is the object, over corners if it is the background.
    const bool           corners = m_Change.isFill;
    ChangeWindow::Labels labels;
    m_Window.Flood(m_Now, m_From, corners, labels);
    const VoxelNumbers sides = Beside(labels, corners);
    if (sides.size() != 2)
    {
      return;
    }
    ChangeWindow::Labels node(m_Window.Count(), ChangeWindow::kNone);
    VoxelNumbers         numbers;
    const auto           costs = Costs(m_From, m_Change.isFill);
    for (std::size_t number = 0; number < node.size(); ++number)
    {
      const bool isSide = labels[number] == sides[0] || labels[number] == sides[1];
      if (costs[number] > 0 && (isSide || m_Now[number] != m_From))
      {
        node[number] = static_cast<std::uint32_t>(numbers.size());
        numbers.push_back(number);
      }
    }
    if (numbers.size() * (corners ? 26 : 6) > kMostLinks)
    {
      return;
    }
    LeastCut            cut(numbers.size());
    std::array<bool, 2> hasEnd{ false, false };
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      cut.SetNode(i, costs[numbers[i]]);
      std::array<bool, 2> isAtEnd{ false, false };
      m_Window.VisitAround(numbers[i], corners, [&](std::size_t next) {
        if (node[next] != ChangeWindow::kNone)
        {
          if (node[next] > i)
          {
            cut.Link(i, node[next]);
          }
        }
        else if (labels[next] == sides[0] || labels[next] == sides[1])
        {
          isAtEnd[labels[next] == sides[0] ? 0 : 1] = true;
        }
      });
      for (const std::size_t end : { std::size_t{ 0 }, std::size_t{ 1 } })
      {
        if (isAtEnd[end])
        {
          cut.SetEnd(i, end == 0);
          hasEnd[end] = true;
        }
      }
    }
    if (!hasEnd[0] || !hasEnd[1])
    {
      return;
    }
    for (const LeastCut::Result & one : cut.Run(m_Change.total)) // what costs as much is no proposal
    {
      ChangeProposal proposal{ m_Change.isFill, 0, {}, {} };
      for (const std::size_t i : one.nodes)
      {
        proposal.voxels.push_back(numbers[i]);
      }
      for (std::size_t i = 0; i < numbers.size(); ++i)
      {
        const std::uint32_t label = labels[numbers[i]];
        if (label != ChangeWindow::kNone && (one.isFirst[i] != 0) != (label == sides[0]) &&
            !ranges::binary_search(proposal.voxels, numbers[i]))
        {
          proposal.between.push_back(numbers[i]);
        }
      }
      Add(std::move(proposal), costs);
    }
  }

  /** Two parts that the change joins are joined elsewhere, or one of them goes as a whole. */
  void
  Join()
  {
    const bool           corners = !m_Change.isFill;
    const char           to = static_cast<char>(1 - m_From);
    ChangeWindow::Labels labels;
    m_Window.Flood(m_Before, to, corners, labels);
    const VoxelNumbers sides = Beside(labels, corners);
    if (sides.size() != 2)
    {
      return;
    }
    const auto costs = Costs(m_From, m_Change.isFill);
    Add(Way(labels, sides[0], costs, corners, m_Change.isFill), costs);
    if (m_Change.mayTurn)
    {
      const auto others = Costs(to, !m_Change.isFill);
      for (const std::size_t side : sides)
      {
        ChangeProposal whole{ !m_Change.isFill, 0, {}, {} };
        bool           isOpen = true;
        for (std::size_t number = 0; number < labels.size(); ++number)
        {
          if (labels[number] == side)
          {
            isOpen = isOpen && others[number] > 0;
            whole.voxels.push_back(number);
          }
        }
        if (isOpen)
        {
          Add(std::move(whole), others);
        }
      }
    }
  }

  /** A part that goes as a whole is joined to another of its kind instead. */
  void
  Keep()
  {
    const bool           corners = m_Change.isFill;
    ChangeWindow::Labels labels;
    m_Window.Flood(m_Before, m_From, corners, labels);
    const std::uint32_t part = labels[m_Change.voxels.front()];
    const auto          voxels = static_cast<std::size_t>(ranges::count(labels, part));
    for (const std::size_t number : m_Change.voxels)
    {
      if (labels[number] != part || voxels != m_Change.voxels.size())
      {
        return;
      }
    }
    const auto costs = Costs(static_cast<char>(1 - m_From), !m_Change.isFill);
    Add(Way(labels, part, costs, corners, !m_Change.isFill), costs);
  }

private:
  /** Of voxels that are `value` before the change. */
  std::vector<std::uint64_t>
  Costs(char value, bool isFill) const
  {
    std::vector<std::uint64_t> costs(m_Window.Count(), 0);
    for (std::size_t number = 0; number < costs.size(); ++number)
    {
      if (m_Before[number] == value && m_Steps[number] < m_Change.reach)
      {
        costs[number] = m_Change.cost(number, isFill);
      }
    }
    return costs;
  }

  /** The components beside the change. */
  VoxelNumbers
  Beside(const ChangeWindow::Labels & labels, bool corners) const
  {
    VoxelNumbers sides;
    for (const std::size_t number : m_Change.voxels)
    {
      m_Window.VisitAround(number, corners, [&](std::size_t next) {
        if (labels[next] != ChangeWindow::kNone && ranges::find(sides, labels[next]) == sides.end())
        {
          sides.push_back(labels[next]);
        }
      });
    }
    ranges::sort(sides);
    return sides;
  }

  /** The cheapest way from one component to any other, through what has a cost. */
  ChangeProposal
  Way(const ChangeWindow::Labels &       labels,
      std::size_t                        start,
      const std::vector<std::uint64_t> & costs,
      bool                               corners,
      bool                               isFill) const
  {
    using Waiting = std::pair<std::uint64_t, std::size_t>;
    ChangeProposal             result{ isFill, 0, {}, {} };
    std::vector<std::uint64_t> way(m_Window.Count(), std::numeric_limits<std::uint64_t>::max());
    VoxelNumbers               last(m_Window.Count(), 0);
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
    for (std::size_t number = 0; number < labels.size(); ++number)
    {
      if (labels[number] == start)
      {
        way[number] = 0;
        waiting.emplace(0, number);
      }
    }
    while (!waiting.empty())
    {
      const auto cost = waiting.top().first; // clang 14 lets no lambda see a structured binding
      const auto number = waiting.top().second;
      waiting.pop();
      if (labels[number] != ChangeWindow::kNone && labels[number] != start)
      {
        for (std::size_t at = last[number]; labels[at] != start; at = last[at])
        {
          result.voxels.push_back(at);
        }
        ranges::sort(result.voxels);
        break;
      }
      if (cost != way[number])
      {
        continue;
      }
      m_Window.VisitAround(number, corners, [&](std::size_t next) {
        const bool isThere = labels[next] != ChangeWindow::kNone && labels[next] != start;
        if ((isThere || costs[next] > 0) && cost + (isThere ? 0 : costs[next]) < way[next])
        {
          way[next] = cost + (isThere ? 0 : costs[next]);
          last[next] = number;
          waiting.emplace(way[next], next);
        }
      });
    }
    return result;
  }

  void
  Add(ChangeProposal proposal, const std::vector<std::uint64_t> & costs)
  {
    for (const std::size_t number : proposal.voxels)
    {
      proposal.cost += costs[number];
    }
    if (!proposal.voxels.empty())
    {
      m_Proposals.push_back(std::move(proposal));
    }
  }

  const ChangeInWindow &      m_Change;
  const ChangeWindow &        m_Window;
  char                        m_From; ///< what the change makes the other
  std::vector<std::int32_t>   m_Steps;
  std::vector<char>           m_Now;
  std::vector<char>           m_Before;
  std::vector<ChangeProposal> m_Proposals;
};

} // namespace

std::vector<ChangeProposal>
ProposeChanges(const ChangeInWindow & change, std::vector<char> now)
{
  Proposer proposer(change, std::move(now));
  proposer.Part();
  proposer.Join();
  if (change.mayTurn)
  {
    proposer.Keep();
  }
  auto proposals = proposer.Release();
  std::erase_if(proposals, [&](const ChangeProposal & one) { return one.cost >= change.total; });
  ranges::stable_sort(proposals, {}, &ChangeProposal::cost);
  return proposals;
}

} // namespace voxelcore
