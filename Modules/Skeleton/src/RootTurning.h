#pragma once
// Roots that were run through from a contact back to where they spring.

#include "ContactPairing.h"

namespace voxelcore
{

/** The cheapest way from a stem may reach a contact and run back along the other root before that root's own way gets
 *  there. The other root then seems to spring at the contact and to end at its parent, and its continuation beyond the
 *  contact seems to be a root of its own. Turns such pieces and gives their number; pairs must be found anew then. */
std::size_t
TurnBackRoots(const RootBranches & branches, const RootRules & rules, const RootPairing & pairing, RootFlow & flow);

} // namespace voxelcore
