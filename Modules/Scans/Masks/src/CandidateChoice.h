#pragma once
// Which cuts and fills to make.

#include "CandidateClusters.h"

#include "voxelcore/Masks/TopologySimplification.h"

namespace voxelcore
{

struct CandidateChoice
{
  std::vector<char> isIn;             ///< of each candidate
  TopologyShift     shift{ 0, 0, 0 }; ///< against the shape as it was
};

/** The choice whose numbers are nearest to those asked for (the sum of their differences), and of these the cheapest;
 *  `before` are the numbers of the shape as it is. \throws Cancelled */
CandidateChoice
ChooseCandidates(const CandidateGraph &   graph,
                 const TopologyShift &    before,
                 const TopologyRequest &  request,
                 const ProgressCallback & progress);

/** What the changes of each group of candidates make together, all else being as chosen; candidates that are in no
 *  group are `kNoCandidate`. */
std::vector<TopologyShift>
GroupDifferences(const CandidateGraph &             graph,
                 const CandidateChoice &            choice,
                 const std::vector<std::uint32_t> & group,
                 std::size_t                        groups);

} // namespace voxelcore
