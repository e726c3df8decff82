#pragma once
// A medial surface cut into sheets: where it branches lie seams, and where seams meet, junctions.
//
// Sheets are the pieces of faces that hang together through edges with two faces. A seam is a chain of edges with three
// faces or more, a rod one of edges without any; a point that stands alone is a rod without length.
//
// Slivers. How far a piece stands out from its seams is the greatest of what the ball of one of its vertices reaches
// beyond the balls of its seams: way along edges to a seam's vertex, plus radius, minus that vertex' radius. What
// stands out by less than a length `sliver` is a sliver, in two kinds:
//  - A fin, at least a quarter of whose border is free, is passed over: where two faces are left, what it parted is one
//    sheet. Fins go in four steps of rising height, so that a rib that fins have cut up is whole before it is judged.
//    A fin may stand out by a third of what the balls at its seams are wide, too: bevels of a square rim do by a fifth.
//    A piece that parts two pairs of larger pieces, each along a quarter of its seams, is no fin: it lies between
//    these. Nor is a piece whose border with others is, for more than half, lines drawn on as below.
//  - Else it lies between seams, and is joined to the neighbour it continues: the one with the greatest sum, over the
//    common edges, of length times the cosine of the bend; the smallest piece first. Such a piece is a sliver, too,
//    where it stands out by less than the mean radius of the balls at its seams.
// A seam that ends on the way is drawn on to the border of the sheets that go round its end, or to another seam, where
// that is nearer than the radius there plus `sliver`, or than twice that radius. Ways along the feet of fins do not
// count: there the surface itself says how the seam went on. A seam that turns back round the tip of a sliver, at
// which those sheets have creases, is drawn on likewise. All these are judged before any line is drawn. Where four
// sheets end, so that two go round on either side, both pairs are parted. What hangs together only within the balls of
// its seams, along a line of edges that lies in them, is parted, if both parts stand out of these by `sliver` and by
// the radius there, and border seams by as much as the balls are wide. Fins that come off so are passed over, too.
// What lies between seams and is a sliver belongs to them: those along it are one, in which all sheets about it meet.
// Seams of the same sheets that touch are one.
// What lies between seams, is a sliver, and has one sheet about it, is a pocket in that sheet and makes no seam.
// A piece that shares no edge with another but those of fins, and hangs on one by these, by rods or a point, is part of
// it where it stands out by less than `sliver`, or than it or the rods it hangs by are thick; the largest of all that
// hangs together stays.
// A rod is longer than it is thick: rods that hang together and on sheets, and nowhere stand out of these by `sliver`,
// nor by their own thickness, are part of them; so is a rod that hangs on rods, ends freely and stands out by less.
// What leads from one sheet to another stands out by its whole length.
// A sheet that touches no other and stands out by less than `sliver`, or than it is thick, of rods that end at it and
// are no part of it, is part of these: their junction, if they are more than two.
// Within the balls nothing can be told: a seam that is shorter than `sliver`, or than its balls are wide, is drawn
// together into one junction, and so is a rod between two, unless both lie on sheets. Where the border of what lies
// between seams is all of a seam and three others end at it, it is measured round, against the girth of the balls.

#include "voxelcore/Thickness/CoreThickness.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

inline constexpr std::uint32_t kNoPiece = 0xFFFFFFFFU;

/** Lengths in the unit of the core's positions. */
struct SheetRecord
{
  double                     area = 0;
  double                     thickness = 0; ///< mean of twice the radius, by area
  double                     thicknessDeviation = 0;
  Vector3                    normal{ 0, 0, 1 }; ///< of the plane it is nearest to; the greatest coordinate is positive
  double                     flatness = 0;      ///< 1 in a plane, 1/3 where normals go everywhere
  double                     freeBorder = 0;    ///< length of its border that is no seam
  double                     seamBorder = 0;    ///< length of its seams
  std::vector<std::uint32_t> neighbours;        ///< sheets that it shares a seam with, ascending
};

struct CurveRecord
{
  bool                         isRod = false;
  bool                         isClosed = false;
  double                       length = 0;
  double                       thickness = 0; ///< mean of twice the radius, by length
  std::vector<std::uint32_t>   sheets;        ///< that meet in a seam, ascending
  std::vector<ElementIndex>    vertices;      ///< of its longest stretch; of a closed one the first is not repeated
  std::array<std::uint32_t, 2> junctions{ kNoPiece, kNoPiece }; ///< where it meets others, two at most
};

struct MedialSheets
{
  std::vector<std::uint32_t> sheetOfFace; ///< or, behind the sheets, the rod whose junction or end a face is part of
  std::vector<std::uint32_t> curveOfEdge; ///< kNoPiece for the others
  std::vector<SheetRecord>   sheets;      ///< the largest first
  std::vector<CurveRecord>   curves;      ///< seams, then rods, the longest first
  std::vector<ElementIndex>  junctions;   ///< a vertex of each, ascending

  /** Per vertex the sheet with most of its faces or, behind the sheets, the curve: sheets.size() + curve. */
  std::vector<std::uint32_t> pieceOfVertex;
};

/** Cuts a core, pruned and best refined. The result does not depend on threads. */
MedialSheets
CutIntoSheets(const MedialComplex & core, double sliver);

/** Per voxel 1 + the piece (as pieceOfVertex) whose ball gives it its thickness; voxels without any ball have 0. The
 *  owners are those among the balls of the same core. */
VoxelOwners
PiecesOfVoxels(const MedialSheets & sheets, const VoxelOwners & owners);

} // namespace voxelcore
