#pragma once
// What a lab wants to know of a root system: numbers of each root, of each level, of the plant as a whole. Those of
// TopoRoot (Zeng et al., Plant Methods 2021) and TopoRoot+ (2024), and what plant scientists take besides.
//
// Lengths are in the unit of the positions (mm), angles in degrees. A root is measured from the surface of its parent
// on, that is from its first point outside the parent's section there; a stem from its first point. Its direction at
// the base is that of its next piece, four of its mean radii long. `down` is the opposite of RootHierarchy::up.

#include "voxelcore/Roots/RootHierarchy.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

struct RootRecord
{
  double length = 0;
  double chord = 0;        ///< from its base to its tip
  double tortuosity = 0;   ///< length / chord; NaN without a chord
  double meanDiameter = 0; ///< weighted by length
  double minDiameter = 0;
  double maxDiameter = 0;
  double volume = 0;  ///< of the round cones between its points
  double surface = 0; ///< of their sides
  /** Of its direction from half to three diameters behind its base with its parent's, over two diameters to each side;
   *  NaN for a stem. */
  double       emergenceAngle = 0;
  double       midpointAngle = 0;     ///< between the parent's direction and the way from its base to its middle
  double       tipAngle = 0;          ///< the same to its tip
  double       emergenceFromDown = 0; ///< between down and its direction at the base
  double       midpointFromDown = 0;  ///< between down and the way from its base to its middle
  double       tipFromDown = 0;       ///< the same to its tip
  double       alongParent = 0;       ///< along the parent, from the parent's base to where it springs
  double       baseDepth = 0;         ///< below the base of the first stem, along down
  double       tipDepth = 0;
  std::int32_t children = 0;
  Vector3      base{};
  Vector3      tip{};
};

/** Over the roots of a level, over all laterals (every level but 0), or over all. Means over roots, each counting the
 *  same, but the diameter's, which is weighted by length; NaN where there is none. */
struct RootLevelRecord
{
  enum class Kind : std::uint8_t
  {
    Level,
    Laterals,
    All
  };
  Kind         kind = Kind::Level;
  std::int32_t level = 0;
  std::int64_t count = 0;
  double       totalLength = 0;
  double       meanLength = 0;
  double       meanDiameter = 0;
  double       meanTortuosity = 0;
  double       meanEmergenceAngle = 0;
  double       meanMidpointAngle = 0;
  double       meanTipAngle = 0;
  double       meanEmergenceFromDown = 0;
  double       meanMidpointFromDown = 0;
  double       meanTipFromDown = 0;
  double       meanChildren = 0;
  double       volume = 0;
  double       surface = 0;
};

/** A slice of the root system across down. */
struct RootDepthRecord
{
  double depth = 0;  ///< of its middle
  double length = 0; ///< of the roots in it
  double width = 0;  ///< greatest distance between two roots' centre lines in it, across down
};

/** Length of roots by diameter. */
struct RootDiameterRecord
{
  double from = 0;
  double to = 0;
  double length = 0;
};

/** Where the length of a skeleton is, mm. */
struct RootBalance
{
  double skeleton = 0; ///< of all branches
  double roots = 0;    ///< of all roots, as they are measured
  double within = 0;   ///< of their first pieces, within their parents
  double shared = 0;   ///< counted more than once in these two, where several roots share a stretch
  double bridged = 0;  ///< in these two, but on no branch: an edit's line over a gap
  double bridges = 0;  ///< on no root: between roots that touch
  double removed = 0;  ///< on no root: taken off by an edit
  double bulges = 0;   ///< on no root: bulges of roots that are rough

  double
  LeftOut() const
  {
    return bridges + removed + bulges;
  }
  /** Length that is on no root for no reason: 0, or a rule has failed. */
  double
  Missing() const
  {
    return skeleton - (roots + within - shared - bridged) - LeftOut();
  }
};

struct RootTraits
{
  std::vector<RootRecord>         roots;     ///< as in RootHierarchy::axes
  std::vector<RootLevelRecord>    levels;    ///< from 0 on, then all laterals, then all
  std::vector<RootDepthRecord>    depths;    ///< 20 slices from the highest point to the deepest
  std::vector<RootDiameterRecord> diameters; ///< 20 classes from 0 to the greatest diameter
  RootBalance                     balance;
  std::int64_t                    stems = 0;
  double                          stemLength = 0; ///< of all stems
  double                          stemDiameter = 0;
  std::int64_t                    whorls = 0;
  double                          meanWhorlDistance = 0; ///< along the stem; NaN with fewer than two
  double                          depth = 0;             ///< from the highest point to the deepest
  double                          width = 0;             ///< greatest distance across down
  double                          hullVolume = 0;        ///< of the convex hull of the centre lines
  double                          hullSurface = 0;
  std::int64_t                    contacts = 0;
  std::int64_t                    undecidedContacts = 0;
  /** With a soil plane: stems do not count as roots. */
  std::optional<double> soilDepth;          ///< below the base of the first stem
  std::int64_t          rootsAboveSoil = 0; ///< that spring above it
  std::int64_t          rootsBelowSoil = 0;
  std::int64_t          whorlsAboveSoil = 0;
  std::int64_t          whorlsBelowSoil = 0;
};

/** Raises `sectionRadius` where the ball does not fit into it. Of a stem between laterals cross-sections may be shared
 *  out wrongly, but the ball lies within it, greater than it by as much as balls are elsewhere (the median): they reach
 *  to the nearest corners of voxels. Nothing where the graph has no cross-sections. */
void
WidenToBalls(SkeletonGraph & graph);

/** `soilDepth`: how far below the base of the first stem the soil begins, where that is known. */
RootTraits
MeasureRoots(const SkeletonGraph & graph, const RootHierarchy & roots, std::optional<double> soilDepth = {});

} // namespace voxelcore
