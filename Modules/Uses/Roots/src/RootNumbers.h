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
constexpr double kFusedReach = 3; ///< radii of a root beyond the stem, up to which two that part by 40 degrees are one
                                  ///< body: r / sin(20 deg); 2: levels of drawn crowns 95.5 %, not 96.1; 6: 95.8 and
                                  ///< those of phantoms 94.9, not 95.5
constexpr double kStemLikeness = 0.5;  ///< thinner over thicker of branches that follow each other in it (plants)
constexpr double kStraightReach = 2.5; ///< radii over which it turns or not; by branches of nodes: top missed (maize)
constexpr double kEndOfStem = 0.35;    ///< of its thickness; what is thinner may be one of the roots below. 0.5: maize
                                       ///< loses the lower 9 % of its column; 0: drawn crowns .3 % of their levels
constexpr double kAsThick = 0.6; ///< thickness of a root over that of what goes on: not a lateral but its like; 0.5:
                                 ///< taproots of phantoms are cut
constexpr int    kWhorl = 2;     ///< such roots beside it; with one, it is a lateral of a taproot
constexpr double kLeastOfStems = 0.6; ///< thickness of a further stem over the first's
constexpr double kUpperPart = 0.25;   ///< of the plant's height, in which further stems begin

// What it costs to run from branch to branch. To turn back costs 1. With these, 57 % of the published crown's length is
// on its level; with thinning 0.5, 55 %, and with length 0.03, 51 % (plants).
constexpr double kThinningCost = 0.25; ///< to become infinitely thin
constexpr double kSpringCost = 0.3;    ///< to spring from a side, beside the turn
constexpr double kLengthCost = 0.005;  ///< for a mean radius of length
constexpr double kOfLikeness = 2;      ///< of thickness, for 1 of cos(turn), by which the flow goes on (phantoms)

// What the choice of partners costs as a whole. A pair costs what it turns and thins, less kGoingOn. Measured on the
// published crown and on six phantoms with ten contacts, whose levels are right to 98.5 %.
constexpr double   kGoingOn = 0.6;      ///< what is more crooked does not go on; 0.5 or 0.8: as good
constexpr double   kOfLevel = 0.3;      ///< for the usual length between tips a level out from 1; 0.5: phantoms 96.3 %
constexpr double   kNoTipCost = 0.5;    ///< of a root that ends at others at both ends; 0.25 or 1: 1 % less (plants)
constexpr double   kShortRoot = 0.3;    ///< of the usual length; a shorter root costs less than that in proportion
constexpr double   kTwoTipsCost = 3;    ///< of one that ends free at both; 1.5: the same
constexpr double   kUnreachedCost = 30; ///< of one to which no way leads from a stem: beyond all others
constexpr double   kLeastGain = 1e-9;   ///< of another choice, beyond rounding
constexpr unsigned kMostArms = 6;       ///< at one place, of which all 76 choices are tried

} // namespace voxelcore
