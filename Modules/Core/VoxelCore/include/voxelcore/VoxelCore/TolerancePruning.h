#pragma once
// Pruning by tolerance: one length that serves thick and thin parts at once.
//
// Lambda cannot: a bump of height b on a part of radius R has a radius measure of about sqrt(2 b R), so the staircase
// of the voxels grows with the thickness, while a rod of radius r has measures up to r only. The height of a bump is
// the same on both: D(x, y) = |x - y| + R(x) - R(y) says by how much the ball of core vertex x sticks out of the ball
// of y.
//
// The promise. At tolerance h every boundary vertex p lies within h of the ball of a vertex x that is still there:
// gap(p, x) = |p - x| - R(x) < h. So bumps lower than h are ignored, and what is left rebuilds the boundary to within
// h. At tolerance 0 all is left. Where voxels are no cubes the gap times the weight of p is less than h, which allows
// less than h where the boundary runs across thinner sides of the voxels (ToleranceWeights.h).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <string>
#include <string_view>

namespace voxelcore
{

/** A tolerance as a user writes it. */
struct Tolerance
{
  enum class Unit
  {
    Millimetre, ///< "1.5mm", "1.5"
    Voxel,      ///< "1.5vox": times the smallest spacing
    Diagonal    ///< "1diag": times the diagonal of a voxel
  };
  double      value = 0;
  Unit        unit = Unit::Millimetre;
  std::string text = "0"; ///< as written, without blanks
};

/** What is taken where nothing is asked for: of all prunings the best by score, on bodies whose medial axes are known
 *  and on scans (Testing/Performance/Pruning.md). */
inline constexpr std::string_view kUsualTolerance = "1.2diag";

/** Reads "1.5mm", "2.5vox", "1diag", "1.5" (mm). Decimal numbers, not negative, finite.
 *  \throws UsageError that quotes the text and names the units. */
Tolerance
ParseTolerance(std::string_view text);

/** \throws InputError for a length in mm, unless it is 0, where lengths are in voxels. */
void
RequireLengthIn(SpatialUnit unit, const Tolerance & height);

double
ToleranceInMillimetres(const Tolerance & height, const std::array<double, 3> & spacing);

/** What the heights need of the Delaunay cells, whose order is that of the core's vertices. */
struct TouchingBalls
{
  /** Per boundary vertex the cell whose ball is the largest of those it touches; of equals the one of smallest
   *  index. */
  std::vector<ElementIndex> largest;
  /** Per cell its centre in lattice steps from the first boundary vertex, each coordinate the exact rational rounded
   *  once: unlike the core's positions the same wherever the volume begins. */
  std::vector<std::array<double, 3>> places;

  // Where voxels are no cubes
  std::vector<double>        weights{}; ///< ToleranceWeights() of the boundary vertices
  std::vector<std::uint32_t> offsets{}; ///< cells + 1
  std::vector<std::uint32_t> touched{}; ///< boundary vertices that each cell's ball touches, ascending
};

/** To be asked before the cells are moved into BuildVoxelCore(). All facets are needed, those of the hull too. */
TouchingBalls
LargestTouchingBalls(const VoxelShape &                shape,
                     const DelaunayCells &             cells,
                     const std::vector<LatticePoint> & points,
                     const SpacingWeights &            weights);

/** The heights of all elements of a whole core. `points` are the boundary vertices, `touching` as above (move it in:
 *  its memory is given back on the way). Infinity for what never goes, as the topology needs it.
 *
 *  Only simple pairs go, the cheapest first, level by level: levels are 1/80 of a voxel's diagonal apart up to four
 *  diagonals, then by the same proportion, and lie between the round multiples of the diagonal. What goes at a level
 *  costs no more than it and has it as its height. So all results have the topology of the core, are nested, and one
 *  run serves every h.
 *
 *  - An edge and its face burn. Fire enters sheets at their rims and is carried by the ball that burnt first there, the
 *    witness; it reaches a vertex when this ball sticks out by h. Where voxels are no cubes balls stick out far between
 *    the boundary vertices of two slices: there it reaches a vertex when a boundary vertex that the ball touches lies h
 *    (weighed) from the vertex' own ball. The face goes when fire has crossed it, or when fires from two sides have met
 *    on it, and with it that of its free edges which lies nearest to where fire set out. So a sheet shrinks evenly from
 *    its rims and does not tear, and the line that is left of a narrow one runs along its middle.
 *  - A vertex at the loose end of an edge goes when each of the boundary vertices it keeps, at first those of which its
 *    ball is the largest, lies within h of another ball that is still there; that one keeps it from then on. Beyond
 *    four voxel diagonals h is an upper bound of that, along the path the end has gone.
 *  - Up to four voxel diagonals a sheet that stays keeps its rims: what fire took from them has the height of the
 *    sheet's last face. Beyond, sheets draw back as fire goes.
 *
 *  With `floor` (mm) > 0 what PruneByLambda(core, {floor}) takes goes first, whatever bump it stands for: its value is
 *  -1, and nothing is promised of the boundary vertices of its balls. Only this asks for measures but those of faces.
 *
 *  Costs are made of +, -, *, / and sqrt of canonical doubles in a fixed order. Within a level fire comes in waves,
 *  each in the order in which the one before freed its edges; loose ends follow the burnt edges. Fire does not ask for
 *  them, so that they may follow in a second thread: the same bits on every machine, for every engine and thread
 *  count, and for a volume that is cropped or padded.
 *  \throws Cancelled when the callback says so */
ToleranceValues
ComputeTolerances(const MedialComplex &             core,
                  const SpacingWeights &            weights,
                  const std::vector<LatticePoint> & points,
                  TouchingBalls                     touching,
                  double                            floor = 0,
                  const ProgressCallback &          progress = {});

/** What its elements that never go have; 0 for an empty core. Of an element and those that bound it the vertices have
 *  the greatest, and something of each piece always stays. */
double
GreatestTolerance(const MedialComplex & core);

/** Gives those below `height` this one. */
void
RaiseTolerances(ToleranceValues & values, double height);

/** What is left at a height in mm of a core that has its heights (MedialComplex::tolerances): what has at least this
 *  one, or the greatest. Pruning raises what is left to the height. */
LiveElements
LeftByTolerance(const MedialComplex & core, double height);
MedialComplex
PruneByTolerance(const MedialComplex & core, double height);
/** The same; `vertices` receives of each vertex of the result the index in `core`. */
MedialComplex
PruneByTolerance(const MedialComplex & core, double height, std::vector<ElementIndex> & vertices);

} // namespace voxelcore
