#pragma once
// Local thickness block by block, for shapes whose cells would not be in memory all at once.
//
// A block is a box of voxels that get their values. It is computed in a window, the block and a margin, as if the
// window's voxels were all there is.
//
// Why the voxels as they are get the same bits (without refinement). Lengths are those of the lattice. Let D be the
// margin wherever the window ends within the shape, and rho the greatest R of the window's cells, R being the distance
// of a core vertex to its nearest boundary vertices.
//  1. Boundary vertices of the shape and of the window's voxels are the same but at the sides that cut, and beyond.
//  2. Let a place p be at most a away from the block, with D > a + 2 rho + 1, and p in a ball about c through the
//     boundary vertices nearest to c, in the whole shape. Then its radius is at most rho: else take q from p towards c,
//     so that |p - q| = t is above rho, but by less than 1/2. The ball about q through p lies in that about c: the
//     nearest boundary vertex of the shape is at least t from q, and so is that of the window, whose sides are at least
//     D - a - t away. q lies in the shape, as no place between c and it is so near to a square (half the diagonal of
//     one is at most rho), so in a cell of the window, and no place in a cell is farther from its corners than its R.
//  3. So the balls that reach the block have their centres within rho of it. Where such a centre lies on an edge of the
//     core, the boundary vertices about the edge are within 2 rho, and those of the balls at its ends are among them:
//     these ends are within 3 rho (2 with a = 2 rho).
//  4. Cells with centres within 3 rho of the block, in the shape or in the window, have no boundary vertex in their
//     balls, which end within 4 rho. With D > 4 rho + 1 both have the same ones there, so the same cells, edges and
//     squares. What the window has elsewhere does not reach the block, as rho bounds its balls, too.
// D is chosen, rho found, and where D is not enough the block is computed again with a greater one.
//
// Of the smooth surface that labels stand for the bits are the same, too: what gives a voxel its thickness lies within
// the margin that SmoothBalls() says, 4 rho + kSmoothReach. Where grey values or a mesh tell the surface, it is
// estimated in each window by itself.

#include "voxelcore/Certified/Certified.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace voxelcore
{

/** Per ball, whether it meets the border of what is measured. */
using BallTest = std::function<std::vector<char>(const PaintingBalls &)>;

struct BlockedThickness
{
  VoxelValues       map;          ///< of the whole shape, mm
  std::vector<char> atBorder;     ///< per value, whether its ball meets the border
  double            reach = 0;    ///< the radius of the greatest ball, mm
  std::size_t       computed = 0; ///< windows, those that were computed again included
};

/** Voxels around a block that its window needs where no ball is greater than `reach` mm. */
std::array<std::int32_t, 3>
MarginOfBlocks(const CertifiedRequest & request, const ImageGeometry & geometry, double reach);

/** A block and its margin, within the box of the shape. */
VoxelBox
WindowOf(const VoxelBox & block, const std::array<std::int32_t, 3> & margin, const VoxelBox & shape);

/** A first guess of the radius of a shape's greatest ball, mm: how often its outermost voxels can be taken off. */
double
GuessReach(const VoxelShape & shape, const ImageGeometry & geometry);

/** The map of a request for thickness without bounds. `blocks` part the shape's box; some may be empty. The same bits
 *  for every number of threads and, without grey values or a mesh, for all blocks.
 *  \throws as ComputeCertified() */
BlockedThickness
ThicknessInBlocks(const VoxelShape &        shape,
                  const ImageGeometry &     geometry,
                  const CertifiedRequest &  request,
                  std::span<const VoxelBox> blocks,
                  const BallTest &          isAtBorder,
                  const ProgressCallback &  progress = {});

} // namespace voxelcore
