#include "LeastCut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using voxelcore::LeastCut;

namespace
{

constexpr std::size_t kNodes = 9;

struct RandomGraph
{
  std::vector<std::uint64_t>         weights;
  std::vector<std::array<size_t, 2>> links;
  std::vector<char>                  first; // beside the first end
  std::vector<char>                  second;

  explicit RandomGraph(std::mt19937 & random)
    : weights(kNodes)
    , first(kNodes, 0)
    , second(kNodes, 0)
  {
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      weights[node] = random() % 8 == 0 ? LeastCut::kStays : 1 + random() % 4;
      first[node] = random() % 4 == 0 ? 1 : 0;
      second[node] = random() % 4 == 0 ? 1 : 0;
      for (std::size_t other = node + 1; other < kNodes; ++other)
      {
        if (random() % 3 == 0)
        {
          links.push_back({ node, other });
        }
      }
    }
  }

  LeastCut
  Cut() const
  {
    LeastCut cut(kNodes);
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      cut.SetNode(node, weights[node]);
      for (const bool isFirst : { true, false })
      {
        if ((isFirst ? first : second)[node])
        {
          cut.SetEnd(node, isFirst);
        }
      }
    }
    for (const auto & [a, b] : links)
    {
      cut.Link(a, b);
    }
    return cut;
  }

  /** What hangs together with the first end without some nodes, or with the second. */
  unsigned
  Side(unsigned without, bool isFirst) const
  {
    unsigned side = 0;
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      side |= (isFirst ? first : second)[node] ? 1U << node : 0;
    }
    side &= ~without;
    for (unsigned before = 0; before != side;)
    {
      before = side;
      for (const auto & [a, b] : links)
      {
        side |= (side >> a & 1U) << b | (side >> b & 1U) << a;
        side &= ~without;
      }
    }
    return side;
  }

  std::uint64_t
  Weight(unsigned nodes) const
  {
    std::uint64_t sum = 0;
    for (std::size_t node = 0; node < kNodes; ++node)
    {
      sum += nodes >> node & 1U ? weights[node] : 0;
    }
    return sum;
  }
};

unsigned
BitsOf(const std::vector<std::size_t> & nodes)
{
  unsigned bits = 0;
  for (const std::size_t node : nodes)
  {
    bits |= 1U << node;
  }
  return bits;
}

} // namespace

TEST(LeastCut, WeighsLeastOfAllAndLiesNearestToEitherEnd)
{
  std::mt19937 random(20261129);
  int          several = 0;
  for (int i = 0; i < 300; ++i)
  {
    const RandomGraph graph(random);
    SCOPED_TRACE(i);
    std::uint64_t least = LeastCut::kStays;
    for (unsigned nodes = 0; nodes < 1U << kNodes; ++nodes)
    {
      if ((graph.Side(nodes, true) & graph.Side(nodes, false)) == 0)
      {
        least = std::min(least, graph.Weight(nodes));
      }
    }
    const auto found = graph.Cut().Run();
    EXPECT_TRUE(graph.Cut().Run(least).empty());
    ASSERT_EQ(found.empty(), least >= LeastCut::kStays);
    if (found.empty())
    {
      continue;
    }
    EXPECT_EQ(graph.Cut().Run(least + 1).size(), found.size());
    several += found.size() > 1 ? 1 : 0;
    for (const bool isFirst : { true, false })
    {
      const auto &   one = isFirst ? found.front() : found.back();
      const unsigned cut = BitsOf(one.nodes);
      EXPECT_EQ(graph.Weight(cut), least);
      EXPECT_EQ(graph.Side(cut, true) & graph.Side(cut, false), 0U);
      for (std::size_t node = 0; node < kNodes; ++node)
      {
        if (graph.Side(cut, true) >> node & 1U)
        {
          EXPECT_TRUE(one.isFirst[node]) << node;
        }
        if (graph.Side(cut, false) >> node & 1U)
        {
          EXPECT_FALSE(one.isFirst[node]) << node;
        }
      }
      for (unsigned nodes = 0; nodes < 1U << kNodes; ++nodes)
      {
        if (graph.Weight(nodes) == least && (graph.Side(nodes, true) & graph.Side(nodes, false)) == 0)
        {
          EXPECT_EQ(graph.Side(cut, isFirst) & ~graph.Side(nodes, isFirst), 0U); // no other is nearer
        }
      }
    }
  }
  EXPECT_GT(several, 20);
}
