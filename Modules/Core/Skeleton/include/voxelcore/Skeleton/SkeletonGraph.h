#pragma once
// A curve skeleton as nodes and branches: what is drawn, measured and written.

#include "voxelcore/Skeleton/CurveSkeleton.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace voxelcore
{

enum class NodeKind : std::uint8_t
{
  Tip,      ///< end of one branch
  Junction, ///< end of three branches or more (a branch that begins and ends here counts twice)
  Loop,     ///< where a closed curve without junctions is taken to begin
  Isolated, ///< a point by itself
  Surface,  ///< where curves meet faces that stay
  Contact   ///< of a network: where labels meet, and no more than two branches
};

/** Flat arrays; lengths in mm. A branch is a poly line of points from one node to another, or back to the same; only
 *  its ends may be shared with other branches. Branches begin at the node of the smaller point and stand in the order
 *  of these points; so do nodes. */
struct SkeletonGraph
{
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<double, 3>>
                      medial;           ///< where the points lay on the medial surface before fitting; may be empty
  std::vector<double> radius;           ///< of the largest ball in the shape around `medial`; MeasureBallsAnew()
  std::vector<double> sectionRadius;    ///< as CrossSectionRadii() gives it; may be empty
  std::vector<double> erosionThickness; ///< infinite on closed surfaces

  std::vector<std::int64_t> labels;  ///< of a network (LabelNetwork.h): value of each point's label; else empty
  std::vector<std::uint8_t> contact; ///< of a network: 1 where labels meet, at ends of branches alone; else empty

  std::vector<ElementIndex> nodePoints;
  std::vector<NodeKind>     nodeKinds;

  std::vector<std::uint64_t>               branchOffsets{ 0 }; ///< branches + 1 entries
  std::vector<ElementIndex>                branchPoints;
  std::vector<std::array<ElementIndex, 2>> branchNodes; ///< first and last node

  std::vector<std::uint64_t> faceOffsets{ 0 }; ///< faces that stay; faces + 1 entries
  std::vector<ElementIndex>  faceVertices;     ///< points
  std::vector<std::uint8_t>  closedFace;       ///< 1: of a closed surface, 0: of a plate

  std::size_t
  BranchCount() const
  {
    return branchNodes.size();
  }
  std::size_t
  FaceCount() const
  {
    return faceOffsets.size() - 1;
  }
  std::span<const ElementIndex>
  Branch(std::size_t branch) const
  {
    return { branchPoints.data() + branchOffsets[branch], branchPoints.data() + branchOffsets[branch + 1] };
  }
  double
  BranchLength(std::size_t branch) const;

  /** Of a network: the label of a branch, which is that of all its points but those where labels meet. */
  std::int64_t
  BranchLabel(std::size_t branch) const;
};

/** Per point 1 at tips of branches, else 0. */
std::vector<std::uint8_t>
TipFlags(const SkeletonGraph & graph);

/** What is measured as a radius: `sectionRadius`, or that of the balls where there is none. */
inline const std::vector<double> &
SectionRadii(const SkeletonGraph & graph)
{
  return graph.sectionRadius.empty() ? graph.radius : graph.sectionRadius;
}

/** A skeleton's nodes and branches. Edges of faces that stay are no branches. */
SkeletonGraph
BuildSkeletonGraph(const CurveSkeleton & skeleton);

/** Poly lines and faces over points, as they stand in a file, put in order: branches that meet in a point with no other
 *  stay apart, unless `join` is set; where labels meet they always do. Each poly line has two points or more.
 *  Points on no poly line and no face are isolated nodes. Fills nodes and branches of `graph` anew. */
void
SortBranches(SkeletonGraph & graph, const std::vector<std::vector<ElementIndex>> & lines, bool join);

/** How far a point may move: the ellipsoid that touches the faces of a voxel around it. Row k is a voxel's axis k (a
 *  unit vector) over half its spacing, 1/mm: a displacement d is allowed when the squares of its products with the rows
 *  sum up to 1 at most. */
using VoxelReach = std::array<std::array<double, 3>, 3>;

/** Smooths the branches: each point goes to the value, at its own arc length, of the polynomial that fits its
 *  branch best around it, but no further than `reach` from the branch as it lies on the medial surface. In branches
 *  of at least three windows, whose mean radius is at least a quarter of one, it is of the fourth degree and over
 *  2.5 times `window` mm before and behind the point; in others it is a parabola over `window`. Where the radius is
 *  more than the window, that grows by three times the difference, and the reach in proportion. Branches of three
 *  windows, thicker than two voxels, whose points are far off their fit, as rough walls make them, have windows up to
 *  3.5 times as wide where cross-validation speaks for that. Their points may move by 2.5 times the median of all moves
 *  where that is more than the reach. Nodes stay, and no curve turns back at one. A window of 0 puts the points back on
 *  the medial surface. Curved lines keep their length to second order, where averaging would shorten them. */
void
FitBranches(SkeletonGraph & graph, double window, const VoxelReach & reach);

/** A threshold for the length of a branch that ends in a tip. One that leads into a dome, a ball greater than that at
 *  its other end, is by the difference of their radii longer than its line, and held against kDomeOfRadius of the
 *  ball. */
struct BranchLimit
{
  double lengthMm = 0;    ///< shorter ones go
  double radiusRatio = 0; ///< and those shorter than so many times the radius at their other end
};

/** Takes off branches with a tip that fall short of a limit, the shortest first, until none is left; what then meets in
 *  twos is joined. A branch between two tips stays: no component vanishes. Gives their number.
 *  Points that are on no branch any more are removed. */
std::size_t
PruneBranches(SkeletonGraph & graph, const BranchLimit & limit);

/** A place where a cycle was cut. */
struct LoopCut
{
  std::array<double, 3> position{};
  double                radius = 0;
};

/** Cuts every cycle of branches at its thinnest branch, there at the thinnest point between the ends: that point
 *  becomes two tips. What is left is a forest of which the thick parts are whole. Cycles within faces that stay
 *  remain; so does, for each place of `real`, the thickest of the cycles through the branch there. */
std::vector<LoopCut>
CutLoops(SkeletonGraph & graph, std::span<const std::array<double, 3>> real = {});

/** A point of a branch, by its place in that. */
struct BranchPoint
{
  std::size_t branch = 0;
  std::size_t point = 0;
};

/** The branch at a place: of the points within whose radius (of the section, or of the ball where that is more, or
 *  `atLeast`) it lies the nearest, of equally near ones the first; none where there is none. */
std::optional<BranchPoint>
BranchAt(const SkeletonGraph & graph, const std::array<double, 3> & place, double atLeast = 0);

/** Takes off what hangs loose after cuts: branches whose tip is at a cut, and whose ball there stands out of the ball
 *  at their other end by less than `standOut` mm, the shortest first, until none is left. Gives their number. */
std::size_t
PruneCutEnds(SkeletonGraph & graph, const std::vector<LoopCut> & cuts, double standOut);

/** Takes off branches with a tip that stand out of the ball at their other end by less than `ratio` times what
 *  `roughness` says of the point there, the one that falls short of it most first, until none is left. A number per
 *  point, in mm. Gives their number. */
std::size_t
PruneBulges(SkeletonGraph & graph, const std::vector<double> & roughness, double ratio);

/** Takes off branches that are marked with a 1 and have a tip, until none is left; what then meets in twos is joined. A
 *  branch between two tips stays: no component vanishes. Gives their number. */
std::size_t
PruneMarked(SkeletonGraph & graph, const std::vector<std::uint8_t> & marked);

/** Gives each branch end points of its own: branches no longer hang together. */
void
SplitAtJunctions(SkeletonGraph & graph);

/** Per node the number of its hub: nodes on one surface that stays are one hub, any other is its own. */
std::vector<ElementIndex>
NodeHubs(const SkeletonGraph & graph);

} // namespace voxelcore
