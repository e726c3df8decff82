#pragma once
// Which root goes on as which where roots touch, and which branch goes on at a junction.

#include "RootFlow.h"

namespace voxelcore
{

/** How branches follow each other. */
struct RootPairing
{
  std::vector<ElementIndex>              next;   ///< per branch the one that continues it; kNoRoot where it ends
  std::vector<ElementIndex>              parent; ///< per branch, if it is the first of a lateral: the branch it leaves
  std::vector<std::uint8_t>              inside; ///< per branch: part of a contact
  std::vector<std::vector<ElementIndex>> ways;   ///< per branch: the branches of the contact on the way to the next
  std::vector<std::uint8_t>              undecided;     ///< per branch: next was chosen in a contact that is marked
  std::vector<std::uint8_t>              endsAtMeeting; ///< per branch
  std::vector<ElementIndex>              contact;       ///< per hub: the same number for those of one contact
  std::vector<RootMeeting>               meetings;
};

/** Directions of the flow follow, and what comes before each branch. */
RootPairing
PairBranches(const RootBranches & branches, RootFlow & flow, const RootRules & rules);

} // namespace voxelcore
