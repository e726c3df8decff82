#pragma once
// Roots that were run through from a contact back to where they spring.

#include "ContactPairing.h"

namespace voxelcore
{

/** A way from the stem may reach a contact, and go back from there along another root sooner than that root's own way
 *  comes to it. Then the root seems to spring at the contact and to end where it meets its parent, and another seems to
 *  spring at the contact that is its continuation. Turns such pieces, after which pairs are to be found anew; gives
 *  their number. */
std::size_t
TurnBackRoots(const RootBranches & branches, const RootRules & rules, const RootPairing & pairing, RootFlow & flow);

} // namespace voxelcore
