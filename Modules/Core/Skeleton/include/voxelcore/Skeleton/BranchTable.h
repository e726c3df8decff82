#pragma once
// What a lab wants to know of a skeleton: numbers of its branches, of the axes they form, and of the levels of these.

#include "voxelcore/Skeleton/SkeletonGraph.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

/** Where the hierarchy of a component begins. */
struct RootChoice
{
  enum class Kind
  {
    Thickest, ///< the tip whose branch is thickest (mean radius)
    Top,      ///< the tip that lies highest (greatest third coordinate: superior in LPS)
    Bottom,   ///< the tip that lies lowest
    Point     ///< the tip nearest to `point`, in the component nearest to it; others by Thickest
  };
  Kind                  kind = Kind::Thickest;
  std::array<double, 3> point{}; ///< mm
};

struct MeasureOptions
{
  RootChoice root;
};

/** skan's numbers for how a branch ends. */
enum class BranchType : std::uint8_t
{
  TipToTip = 0,
  TipToJunction = 1,
  JunctionToJunction = 2,
  Cycle = 3 ///< a closed curve by itself, or a branch that ends where it began
};

constexpr ElementIndex kNoBranch = 0xFFFFFFFFU;

/** Lengths in mm, angles in degrees. Radii are the graph's `sectionRadius`, where it is empty those of the balls; they
 *  are taken along the branch without the parts within the ball at a junction (there the thicker neighbour is measured)
 *  unless nothing else is left. Volume and surface are those of the round cones between points along the same parts. */
struct BranchRecord
{
  ElementIndex component = 0; ///< from 1, in the order of nodes
  BranchType   type = BranchType::TipToTip;
  double       length = 0;
  double       chord = 0;      ///< between the ends
  double       tortuosity = 0; ///< length / chord; infinite for a closed branch
  double       freeLength = 0; ///< length outside the balls at its junctions
  double       meanRadius = 0;
  double       minRadius = 0;
  double       maxRadius = 0;
  double       sdRadius = 0;
  double       meanBallRadius = 0; ///< of the largest balls, along the same parts
  double       minBallRadius = 0;
  double       maxBallRadius = 0;
  double       volume = 0;
  double       surface = 0;
  ElementIndex parent = kNoBranch; ///< the branch nearer to the root it hangs on
  double       parentAngle = 0;    ///< to the direction the parent arrives in; NaN without a parent
  bool         baseIsLast = false; ///< whether its last point is the one nearer to the root
  std::int32_t centrifugal = 1;    ///< junctions to the root, plus 1
  std::int32_t strahler = 1;
  std::int32_t level = 0;          ///< 0 the axis from the root, 1 its laterals, 2 theirs
  ElementIndex axis = 0;           ///< number of the axis it is part of
  bool         closesLoop = false; ///< off the tree of thickest branches: with it begins a cycle
};

/** Branches that continue each other: a stem, a root, a vessel. */
struct AxisRecord
{
  std::int32_t              level = 0;
  ElementIndex              parent = kNoBranch; ///< an axis
  ElementIndex              component = 0;
  std::vector<ElementIndex> branches;   ///< from the base on
  double                    length = 0; ///< from the surface of its parent on
  double                    meanRadius = 0;
  double                    tortuosity = 0;
  double       emergenceAngle = 0; ///< between the parent's direction and its own at the base; NaN without parent
  double       midpointAngle = 0;  ///< the same, to its middle
  double       tipAngle = 0;       ///< the same, to its end
  std::int32_t children = 0;       ///< axes that spring from it
};

/** Sums over the axes of a level. */
struct LevelRecord
{
  std::int32_t level = 0;
  std::int32_t count = 0;
  double       totalLength = 0;
  double       meanLength = 0;
  double       meanRadius = 0; ///< weighted by length
  double       meanTortuosity = 0;
  double       meanTipAngle = 0;
  double       meanEmergenceAngle = 0;
  double       meanMidpointAngle = 0;
  double       meanChildren = 0;
};

struct SkeletonNumbers
{
  std::int64_t components = 0;
  std::int64_t branches = 0;
  std::int64_t tips = 0;
  std::int64_t junctions = 0;
  std::int64_t triplePoints = 0;
  std::int64_t quadruplePoints = 0;
  std::int64_t cycles = 0;        ///< independent ones, of branches; surfaces count as points
  std::int64_t isolatedLoops = 0; ///< closed curves without junctions
  std::int64_t isolatedPoints = 0;
  std::int64_t closedFaces = 0;
  std::int64_t plateFaces = 0;
  double       totalLength = 0;
  double       closingLength = 0; ///< part of it: of branches that close loops
  double       meanLength = 0;
  double       maxLength = 0;
  double       meanRadius = 0; ///< weighted by free length; by length where no branch has any
  double       volume = 0;
  double       surface = 0;
};

struct BranchTable
{
  std::vector<BranchRecord> branches; ///< as in the graph
  std::vector<AxisRecord>   axes;     ///< by component, then from the root outwards
  std::vector<LevelRecord>  levels;
  SkeletonNumbers           numbers;
};

/** Measures a graph. The hierarchy is that of a tree: where there are cycles, branches count for it that are not their
 *  thinnest (as CutLoops has it); the others are laterals that end where they meet the tree again. At a junction that
 *  branch continues its parent which is best by direction and radius; the others begin axes of the next level. */
BranchTable
MeasureBranches(const SkeletonGraph & graph, const MeasureOptions & options = {});

} // namespace voxelcore
