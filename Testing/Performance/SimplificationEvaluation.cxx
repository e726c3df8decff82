// How good cuts and fills are: on random grey volumes against all single and paired cuts and fills, on phantoms against
// the least change, which another method finds (a minimal vertex cut by maximal flow, a cheapest way by Dijkstra).
// usage: VoxelCoreSimplificationEvaluation [VOLUMES [PHANTOMS [SEED]]]

#include "CandidateChoice.h"

#include "../Scans/Masks/LeastChange.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>

namespace voxelcore::testing
{

namespace
{

std::int64_t
SumOf(const TopologyNumbers & numbers)
{
  return numbers.betti[0] + numbers.betti[1] + numbers.betti[2];
}

/** The graph of cuts and fills of a volume, all of it as one cluster. */
class WholeGraph
{
public:
  explicit WholeGraph(const GreyCase & grey)
    : m_Grey(grey)
    , m_Box(grey.Level(0).Box())
  {
    const ChangeCost cost = [&](int x, int y, int z) { return grey.Cost(x, y, z); };
    const PaddedCost costAt(cost, m_Box);
    const VoxelShape shape = InBox(1);
    PaddedShape      grown(InBox(2));
    PaddedShape      cuts(Difference(1, 2));
    FlipSimpleVoxels(grown, cuts, costAt, {});
    PaddedShape shrunk(InBox(0));
    PaddedShape fills(Difference(0, 1));
    FlipSimpleVoxels(shrunk, fills, costAt, {});
    graph = MakeCandidateGraph(grown, cuts, shrunk, fills, costAt);
    base = std::move(grown).Release();
    m_All.candidates.resize(graph.candidates.size());
    for (std::size_t i = 0; i < m_All.candidates.size(); ++i)
    {
      m_All.candidates[i] = static_cast<std::uint32_t>(i);
    }
    m_All.objectEdges = graph.objectEdges;
    m_All.backgroundEdges = graph.backgroundEdges;
    m_All.objects = graph.objects;
    m_All.backgrounds = graph.backgrounds;
    m_All.terms = graph.terms;
  }

  const CandidateCluster &
  All() const
  {
    return m_All;
  }

  CandidateGraph graph;
  VoxelShape     base; ///< without any candidate

  /** Counted from its voxels. */
  TopologyNumbers
  Count(const std::vector<char> & isIn) const
  {
    VoxelShape shape = base;
    for (std::size_t i = 0; i < graph.voxels.size(); ++i)
    {
      const Voxel & at = graph.voxels[i];
      if (isIn[graph.owner[i]] != 0)
      {
        constexpr auto room = PaddedShape::kRoom;
        shape.Insert(at[0] - room + m_Box.lower[0], at[1] - room + m_Box.lower[1], at[2] - room + m_Box.lower[2]);
      }
    }
    return ComputeShapeTopology(shape);
  }

private:
  VoxelShape
  InBox(int level) const
  {
    return Where([&](std::uint32_t value) { return value >= m_Grey.levels[level]; });
  }

  VoxelShape
  Difference(int outer, int inner) const
  {
    return Where([&](std::uint32_t value) { return value >= m_Grey.levels[outer] && value < m_Grey.levels[inner]; });
  }

  template <typename TTest>
  VoxelShape
  Where(const TTest & isIn) const
  {
    VoxelShape shape(m_Box);
    for (std::int32_t z = m_Box.lower[2]; z < m_Box.lower[2] + m_Box.size[2]; ++z)
    {
      for (std::int32_t y = m_Box.lower[1]; y < m_Box.lower[1] + m_Box.size[1]; ++y)
      {
        for (std::int32_t x = m_Box.lower[0]; x < m_Box.lower[0] + m_Box.size[0]; ++x)
        {
          if (isIn(m_Grey.At(x, y, z)))
          {
            shape.Insert(x, y, z);
          }
        }
      }
    }
    return shape;
  }

  const GreyCase & m_Grey;
  VoxelBox         m_Box;
  CandidateCluster m_All;
};

struct VolumeSums
{
  int         volumes = 0;
  int         invalid = 0;
  std::size_t candidates = 0;
  std::size_t tried = 0;
  int         fewerThanPairs = 0; ///< numbers lower than by any single or paired change of the shape
  int         nearPairs = 0;      ///< as low, and at most a tenth costlier
  int         worseThanPairs = 0;
  int         improvedNumbers = 0; ///< a single or paired change of the result has lower numbers
  int         improvedCost = 0;    ///< or equal ones, and costs less by more than a tenth
};

/** What the choice leads to, without the clean-up that comes after. */
struct Value
{
  std::int64_t  numbers = 0;
  std::uint64_t cost = 0;
};

/** All that one or two candidates more or less lead to, from a choice on. */
void
TryPairs(const WholeGraph & whole, std::vector<char> isIn, const std::function<void(const Value &)> & visit)
{
  ClusterNumbers    numbers(whole.All());
  const std::size_t count = isIn.size();
  const auto        look = [&] {
    const TopologyShift shift = numbers(isIn);
    Value               value{ shift[0] + shift[1] + shift[2], 0 };
    for (std::size_t i = 0; i < count; ++i)
    {
      value.cost += (isIn[i] != 0) == whole.graph.candidates[i].isFill ? whole.graph.candidates[i].cost : 0;
    }
    visit(value);
  };
  for (std::size_t a = 0; a < count; ++a)
  {
    isIn[a] ^= 1;
    look();
    for (std::size_t b = 0; b < a; ++b)
    {
      isIn[b] ^= 1;
      look();
      isIn[b] ^= 1;
    }
    isIn[a] ^= 1;
  }
}

void
RunVolume(std::uint64_t seed, std::int64_t most, VolumeSums & sums)
{
  const GreyCase        grey = RandomGrey(seed, most);
  const VoxelShape      shape = grey.Level(1);
  const SimplifiedShape result = grey.Run();
  ++sums.volumes;
  const WholeGraph      whole(grey);
  const CandidateChoice choice = ChooseCandidates(whole.graph, result.before.betti, {}, {});
  // Valid: counted from voxels, nothing in the kernel, nothing beyond the neighbourhood.
  bool isValid = ComputeShapeTopology(result.shape) == result.after && whole.Count(choice.isIn) == result.after;
  for (std::int32_t z = 0; z < grey.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grey.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grey.size[0]; ++x)
      {
        const bool isIn = result.shape.Contains(x, y, z);
        isValid = isValid && (isIn ? grey.At(x, y, z) >= grey.levels[0] : grey.At(x, y, z) < grey.levels[2]);
      }
    }
  }
  std::vector<char> asItIs;
  for (const auto & candidate : whole.graph.candidates)
  {
    asItIs.push_back(candidate.isFill ? 0 : 1);
  }
  ClusterNumbers      numbers(whole.All());
  const TopologyShift before = numbers(asItIs);
  const TopologyShift after = numbers(choice.isIn);
  isValid = isValid && whole.Count(asItIs) == result.before;
  // The graph's numbers are those of the voxels for other choices, too.
  Random random(seed);
  for (int k = 0; k < 5; ++k)
  {
    std::vector<char> any = asItIs;
    for (char & one : any)
    {
      one = static_cast<char>(random.Between(0, 1));
    }
    const TopologyShift shift = numbers(any);
    const auto          counted = whole.Count(any);
    for (std::size_t i = 0; i < 3; ++i)
    {
      isValid = isValid && shift[i] - before[i] == counted.betti[i] - result.before.betti[i];
    }
  }
  sums.invalid += isValid ? 0 : 1;
  sums.candidates += asItIs.size();
  Value own{ after[0] + after[1] + after[2], 0 };
  for (std::size_t i = 0; i < asItIs.size(); ++i)
  {
    own.cost += choice.isIn[i] != asItIs[i] ? whole.graph.candidates[i].cost : 0;
  }
  Value best{ before[0] + before[1] + before[2], 0 };
  TryPairs(whole, asItIs, [&](const Value & value) {
    ++sums.tried;
    if (value.numbers < best.numbers || (value.numbers == best.numbers && value.cost < best.cost))
    {
      best = value;
    }
  });
  sums.fewerThanPairs += own.numbers < best.numbers ? 1 : 0;
  sums.nearPairs += own.numbers == best.numbers && 10 * own.cost <= 11 * best.cost ? 1 : 0;
  sums.worseThanPairs +=
    own.numbers > best.numbers || (own.numbers == best.numbers && 10 * own.cost > 11 * best.cost) ? 1 : 0;
  bool hasFewer = false;
  bool hasCheaper = false;
  TryPairs(whole, choice.isIn, [&](const Value & value) {
    ++sums.tried;
    hasFewer = hasFewer || value.numbers < own.numbers;
    hasCheaper = hasCheaper || (value.numbers == own.numbers && 11 * value.cost < 10 * own.cost);
  });
  sums.improvedNumbers += hasFewer ? 1 : 0;
  sums.improvedCost += !hasFewer && hasCheaper ? 1 : 0;
}

void
EvaluateVolumes(int count, std::uint64_t seed)
{
  std::printf(
    "random volumes: side at most, volumes, invalid, candidates, choices tried; against all single and\n"
    "paired changes of the shape: fewer numbers, equal and within a tenth, worse; a single or paired change "
    "of\nthe result: lowers numbers, costs a tenth less\n");
  for (const std::int64_t most : { 8, 12, 16, 20, 24 })
  {
    VolumeSums sums;
    for (int k = 0; k < count; ++k)
    {
      RunVolume(seed + static_cast<std::uint64_t>(1000 * most + k), most, sums);
    }
    std::printf("%4d %6d %4d %8.1f %10zu   %4d %4d %4d   %4d %4d\n",
                static_cast<int>(most),
                sums.volumes,
                sums.invalid,
                static_cast<double>(sums.candidates) / sums.volumes,
                sums.tried,
                sums.fewerThanPairs,
                sums.nearPairs,
                sums.worseThanPairs,
                sums.improvedNumbers,
                sums.improvedCost);
    std::fflush(stdout);
  }
}

void
EvaluatePhantoms(int count, std::uint64_t seed)
{
  std::printf(
    "phantoms: kind, number, as asked, in the kernel or beyond the neighbourhood; cost over the least: mean, "
    "worst, within 1.1\n");
  for (const auto & [name, make] : LeastChangeKinds())
  {
    int    reached = 0;
    int    outside = 0;
    int    near = 0;
    double sum = 0;
    double worst = 0;
    for (int k = 0; k < count; ++k)
    {
      const LeastChangeCase one = make(seed + static_cast<std::uint64_t>(k));
      const SimplifiedShape result = one.grey.Run(one.request);
      reached += SumOf(result.after) == one.numbers ? 1 : 0;
      outside += StaysBetween(one.grey, result.shape) ? 0 : 1;
      const double ratio = one.least == 0 ? 1 : static_cast<double>(result.cost) / static_cast<double>(one.least);
      sum += ratio;
      worst = std::max(worst, ratio);
      near += ratio <= 1.1 ? 1 : 0;
    }
    std::printf("%-34s %4d %4d %4d   %6.3f %6.3f %4d\n", name, count, reached, outside, sum / count, worst, near);
    std::fflush(stdout);
  }
}

} // namespace

} // namespace voxelcore::testing

int
main(int argc, char ** argv)
{
  try
  {
    const auto number = [&](int at, int otherwise) { return argc > at ? std::atoi(argv[at]) : otherwise; };
    const auto seed = static_cast<std::uint64_t>(number(3, 1));
    voxelcore::testing::EvaluatePhantoms(number(2, 100), seed);
    voxelcore::testing::EvaluateVolumes(number(1, 20), seed);
    return 0;
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
