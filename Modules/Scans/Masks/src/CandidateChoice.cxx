#include "CandidateChoice.h"

#include "ClusterChoices.h"
#include "CombinedOptions.h"

#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::size_t kAllChoices = 12; // candidates of a cluster for which all choices are looked at

} // namespace

CandidateChoice
ChooseCandidates(const CandidateGraph &   graph,
                 const TopologyShift &    before,
                 const TopologyRequest &  request,
                 const ProgressCallback & progress)
{
  const std::vector<CandidateCluster> clusters = FindClusters(graph);
  const TopologyShift                 wanted{ request.pieces.value_or(before[0]) - before[0],
                              request.loops.value_or(before[1]) - before[1],
                              request.cavities.value_or(before[2]) - before[2] };
  std::vector<ClusterOptions>         all;
  for (const CandidateCluster & cluster : clusters)
  {
    ReportProgress(progress, "simplifying", 0.5);
    ClusterChoices choices(graph, cluster);
    if (cluster.candidates.size() <= kAllChoices)
    {
      choices.All();
    }
    else
    {
      choices.Windows([](const TopologyShift & s, std::uint64_t cost) { return Badness(s[0] + s[1] + s[2], cost); },
                      progress);
      if (request.IsGiven())
      {
        choices.Windows([&](const TopologyShift & s, std::uint64_t cost) { return Badness(Distance(s, wanted), cost); },
                        progress);
      }
    }
    all.push_back(choices.Release());
  }
  const auto      chosen = request.IsGiven() ? CombineTowards(all, wanted) : CombineFewest(all);
  CandidateChoice result{ std::vector<char>(graph.candidates.size()), {} };
  for (std::size_t i = 0; i < clusters.size(); ++i)
  {
    const CandidateCluster & cluster = clusters[i];
    ClusterNumbers           numbers(cluster);
    std::vector<char>        isIn(cluster.candidates.size());
    for (std::size_t k = 0; k < isIn.size(); ++k)
    {
      isIn[k] = !graph.candidates[cluster.candidates[k]].isFill;
      result.isIn[cluster.candidates[k]] = chosen[i]->isIn[k];
    }
    result.shift = Sum(result.shift, Less(numbers(chosen[i]->isIn), numbers(isIn)));
  }
  return result;
}

std::vector<TopologyShift>
GroupDifferences(const CandidateGraph &             graph,
                 const CandidateChoice &            choice,
                 const std::vector<std::uint32_t> & group,
                 std::size_t                        groups)
{
  std::vector<TopologyShift> result(groups, TopologyShift{ 0, 0, 0 });
  for (const CandidateCluster & cluster : FindClusters(graph))
  {
    ClusterNumbers                                    numbers(cluster);
    std::vector<char>                                 isIn;
    std::map<std::uint32_t, std::vector<std::size_t>> members;
    for (std::size_t k = 0; k < cluster.candidates.size(); ++k)
    {
      isIn.push_back(choice.isIn[cluster.candidates[k]]);
      if (group[cluster.candidates[k]] != kNoCandidate)
      {
        members[group[cluster.candidates[k]]].push_back(k);
      }
    }
    const TopologyShift now = numbers(isIn);
    for (const auto & [which, who] : members)
    {
      auto without = isIn;
      for (const std::size_t k : who)
      {
        without[k] = static_cast<char>(1 - without[k]);
      }
      result[which] = Sum(result[which], Less(now, numbers(without)));
    }
  }
  return result;
}

} // namespace voxelcore
