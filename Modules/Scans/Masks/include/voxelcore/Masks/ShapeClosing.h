#pragma once
// Closing of a voxel shape by a ball (Serra 1982), and filling of lumens that a ball cannot get into.
//
// A voxel stands for its centre, and the ball of radius r = D / 2 about a lattice place holds the places within r of
// it. The closing adds every voxel that no such ball free of voxels holds. Distances are the exact integers of the
// lattice (SpacingWeights.h), so voxels need not be cubes. Outside the image is background: balls may reach there.
//
// - It adds, never removes; closing again changes nothing; what holds more stays more. All lies in the shape's own box.
// - D is the widest gap that closes. Parts farther apart than D, from voxel face to voxel face, are not joined, and
//   nothing is added that belongs to two of them. For then no place within r of one part is a face neighbour of a place
//   within r of the other, and the places of a ball hang together over faces.
// - Between flat walls along the grid, gaps of up to D close where D is an even number of voxels; an odd D acts as the
//   even number below it, as balls are centred on voxels. So one voxel needs D = 2 voxels. A hole through a wall
//   thinner than it is wide needs more, as balls bulge into it from both sides; FillHollows() does not.
// Time: proportional to the box that the balls have room in and to the number of voxels in the ball's largest disc, a
// word of 64 voxels at a time; of more than a thousand, which go by distances, no longer to that number.
// Memory: a bit a voxel more. The same on any number of threads.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Base/SpatialUnit.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace voxelcore
{

/** The width of a gap as a user writes it. */
struct GapWidth
{
  double      value = 0;
  SpatialUnit unit = SpatialUnit::Millimetres; ///< voxels: times the smallest spacing
  std::string text;                            ///< as written, without blanks
};

/** Reads "4vox", "2.5mm", "2.5" (mm): a positive number.
 *  \throws UsageError that quotes the text and names the units. */
GapWidth
ParseGapWidth(std::string_view text);

/** Lattice offsets (x, y, z) with sum of weight^2 * offset^2 <= squaredRadius. */
struct LatticeBall
{
  std::array<std::int64_t, 3> weight{ 1, 1, 1 };
  std::int64_t                squaredRadius = 0;
};

/** The largest ball whose diameter is no more than the gap's width, to 1e-9 of it.
 *  \throws InputError for a length in mm where the image's are in voxels, and for one over 2000 voxels. */
LatticeBall
BallOfDiameter(const GapWidth & width, const ImageGeometry & geometry);

/** The closing by a ball. Counts voxelsAdded and componentsJoined. \throws Cancelled */
EditedShape
CloseShape(VoxelShape shape, const LatticeBall & ball, const ProgressCallback & progress = {});

/** Fills lumens that a ball from outside cannot get into: a lumen is a place where the ball's centre fits (farther than
 *  r from every voxel) and from which it cannot move out, by steps to neighbours over faces, edges and corners. So each
 *  cavity is filled, and each lumen wider than D that opens only through holes up to D wide, however thin the wall. The
 *  background nearer than r to the shape goes to what it is nearer to along such steps, lumen or outside; as near to
 *  both it stays background. A hole in a wall so becomes a dent, and nothing is joined on the outside.
 *  With the scan's size (voxels from 0 on), a lumen that its border cuts is closed there: in a slice at the border,
 *  what the shape encloses, holes stopped by the ball, is no way out.
 *  Counts voxelsAdded, componentsJoined and, as cavitiesFilled, the lumens where the ball fits. \throws Cancelled */
EditedShape
FillHollows(VoxelShape                                         shape,
            const LatticeBall &                                ball,
            const ProgressCallback &                           progress = {},
            const std::optional<std::array<std::int64_t, 3>> & scan = {});

} // namespace voxelcore
