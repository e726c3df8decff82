#pragma once
// Which root springs from which: the axes of a root system in a curve skeleton, also where roots touch and the skeleton
// has loops there.
//
// The rules, in the order they apply:
// 1. Up. Given, or the coordinate axis along which the base of the stem lies farthest from the skeleton's centre.
// 2. Stems. The thickest long way through the skeleton: of all ways in the forest of its widest branches, the one with
//    the greatest sum of length times radius to the third power, the less the more it turns beyond the balls of nodes.
//    It goes on as long as neither branch is half as thick as the other. Its base is the end that is thicker and
//    farther from the skeleton's middle, or higher where up is given. `stem` says where it begins and what it passes.
//    More are taken as asked; to find how many there are, those with 0.6 of its thickness that begin in the upper
//    quarter count.
// 3. Flow. Every branch is run through in the direction in which the way from a stem is cheapest: to turn and to thin
//    costs, so does to spring from a side, and a little does length; next to a stem only length does. Where a branch
//    arrives at a junction that another reached before, there is a loop: two roots touch.
// 4. Contacts. A bridge between the two, or a stretch they share, if it is short against their radii, is part of the
//    contact.
// 5. Choice. Which branch goes on as which, at contacts and junctions alike, is chosen over the whole plant: so that
//    least is turned and thinned, least length is on far levels, and roots have one tip. Directions are measured
//    outside the contact. The search begins where the branch goes on beyond which most junctions lie, of several such
//    the longest; in contacts, with the straightest. A branch that does not go on as another springs from what passes
//    where it begins, of several such from the one of the least level, a level further out; within 1.7 radii of a
//    stem, where roots of a whorl run fused, from the stem. The stem has level 0. What ends at another root, without
//    laterals, and is no longer than bridgeLength times twice the thinner of the two is a bridge. Where the next best
//    choice is worse by less than `undecided`, a contact is marked.
// 6. Whorls. Laterals of a stem whose places along it follow each other by less than `whorlGap` stem radii form one if
//    there are `whorlSize` of them or more.
// Pieces that hang together with no stem have one of their own, marked as loose. `leftOut` says what is on no root.

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct RootRules
{
  std::optional<Vector3> up;                 ///< unit vector in the space of the positions; none: found
  int                    stems = 1;          ///< 0: found
  std::vector<Vector3>   stem;               ///< places along the only stem, from its base on; none: found
  double                 bridgeLength = 1.6; ///< longest bridge between roots that touch, in sums of their radii
  double                 sharedLength = 4;   ///< longest stretch that two roots share, in sums of their radii
  double                 tornGap = 2;        ///< longest gap in a torn root, in sums of the radii at its ends; 0: none
  double                 tornSlack = 0;      ///< mm: so much longer where slices are so thick
  double                 bulge = 4;          ///< what stands out by less than so many times the roughness is none
  double                 undecided = 0.15;   ///< margin in costs of RootNumbers.h below which a contact is marked
  double                 whorlGap = 1;       ///< in radii of the stem
  int                    whorlSize = 3;
};

constexpr ElementIndex kNoRoot = 0xFFFFFFFFU;

/** One root from its base, on the axis it springs from, to its tip. */
struct RootAxis
{
  std::int32_t              level = 0; ///< 0 a stem
  ElementIndex              stem = 0;  ///< the stem it belongs to, as an axis
  ElementIndex              parent = kNoRoot;
  std::size_t               parentPoint = 0;       ///< in the parent's points, the nearest to its own first
  std::vector<ElementIndex> points;                ///< of the graph; where roots touch one may be on two axes
  bool                      endsAtContact = false; ///< rather than at a tip
  bool                      undecided = false;     ///< goes through a contact that is marked
  bool                      loose = false;         ///< of a piece without a stem
  std::int32_t              children = 0;
  std::string               name{}; ///< given by a person (RootEdits.h)
};

/** Where roots touch. */
struct RootMeeting
{
  Vector3                                  position{};
  double                                   radius = 0; ///< of the largest ball there
  double                                   reach = 0;  ///< mm from the position: the arms are outside the contact there
  std::vector<ElementIndex>                arms;       ///< branches that arrive or leave
  std::vector<std::array<ElementIndex, 2>> pairs;      ///< branches that go on as one root: arriving, leaving
  double                                   margin = 0; ///< to the next best pairing
  bool                                     undecided = false;
};

/** Laterals that spring from a stem at nearly one place. */
struct RootWhorl
{
  ElementIndex              stem = 0;
  double                    along = 0; ///< mm along the stem from its base, mean of the laterals'
  Vector3                   position{};
  std::vector<ElementIndex> roots; ///< axes
};

/** Why a branch is on no root. */
enum class LeftOut : std::uint8_t
{
  No,
  Bridge, ///< between roots that touch
  Removed ///< with a root that a person removed
};

/** What stands out of a root no more than that is rough (RootRoughness.h): taken from the skeleton, on no root. */
struct RootBulges
{
  std::size_t count = 0;
  double      length = 0; ///< mm, of their branches
};

struct RootHierarchy
{
  Vector3                   up{ 0, 0, 1 };
  bool                      upFound = false; ///< rather than given
  std::vector<RootAxis>     axes;            ///< stems, then level by level; a parent before its children
  std::vector<RootMeeting>  meetings;
  std::vector<RootWhorl>    whorls; ///< from the base of each stem on
  std::vector<ElementIndex> rootOf; ///< per branch of the graph its axis; kNoRoot for a bridge between roots that touch
  std::vector<LeftOut>      leftOut; ///< per branch
  RootBulges                bulges;
};

/** Joins what is torn: two tips that face each other, of which the thinner has at least half of the other's radius,
 *  get a straight line between them where the gap is short enough (RootRules::tornGap) and neither way turns by more
 *  than 60 degrees into it, nor by more than 45 from one into the other; always the nearest first. A gap shorter than a
 *  radius has no direction of its own. With `tornSlack` a tip that is left and runs into the side of a branch not
 *  joined to its own, less than that from body to body, ends there: beyond it the root may share the other's voxels. A
 *  thin root may be lost for a voxel or two where slices are thick or noise is strong. Gives the gaps, in mm. */
std::vector<double>
JoinTornRoots(SkeletonGraph & graph, const RootRules & rules = {});

/** The axes of a skeleton. The graph need not be a tree. */
RootHierarchy
FindRoots(const SkeletonGraph & graph, const RootRules & rules = {});

} // namespace voxelcore
