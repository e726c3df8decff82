#pragma once
// The numbers in the rules by which roots are told apart (RootHierarchy.h), each with what it means. `Phantoms` says
// that it was measured on grey phantoms, `plants` on the published crown (both in Testing/Performance/Roots.md) and on
// a crown of maize.

namespace voxelcore
{

// Where a branch is itself, and not the root it springs from.
constexpr double kOutsideBall = 1.2;  ///< balls of a junction: from there on (phantoms)
constexpr double kDirectionReach = 5; ///< radii over which its direction is taken (phantoms)
constexpr double kLeastDirection = 2; ///< radii; a shorter stretch has no direction of its own (phantoms)

// The stem.
constexpr double kStemReach =
  1.7; ///< its radii within which roots of a whorl may run fused and still spring from it; 1.2: 3 % less (plants)
constexpr double kStemLikeness = 0.5; ///< thinner over thicker of branches that follow each other in it (plants)
constexpr double kLeastOfStems = 0.6; ///< thickness of a further stem over the first's
constexpr double kUpperPart = 0.25;   ///< of the plant's height, in which further stems begin

// What it costs to run from branch to branch. To turn back, or to become infinitely thin beside a turn to the side,
// costs 1. With these, 47 % of the published crown's length is on its level; where springing cost 1 and length nothing,
// some 8 % less was (plants).
constexpr double kThinningCost = 0.5; ///< of a turn to the side, when it becomes infinitely thin (phantoms)
constexpr double kSpringCost = 0.3;   ///< to spring from a side, beside the turn
constexpr double kLengthCost = 0.01;  ///< for a mean radius of length

// What goes on as what at a junction.
constexpr double kOfLikeness = 2;  ///< of thickness, for 1 of cos(turn) (phantoms)
constexpr double kOfLength = 0.25; ///< for the longest way beyond, where they are alike in thickness (phantoms)
constexpr double kOfJunctions =
  0.2; ///< for each junction on the way beyond that has most; 0: some 12 % of the length less on its level (plants)

// What goes on as what in a contact.
constexpr double kThinBeside = 0.6; ///< thinner than so much of a root that passes: rather springs from it (phantoms)
constexpr double kOfPassing = 0.6;  ///< what a pair of such is worth less (phantoms)

constexpr double kOfStem = 10; ///< value of a pair that is the stem's, beyond all others
constexpr double kNoPair = -1; ///< of one that is not made

} // namespace voxelcore
