#pragma once
// The balls of a refined core made to hold as much as the voxels do.
//
// Smoothing draws in what is thin and bent, and coarse slices swell: balls of a rod or a blob come out too small,
// those of a wall in thick slices too large. What voxels hold is right in the mean, as each stands for its centre. So
// of each square of the labels' boundary, of area A, take the ball of the core, about a vertex or a place between,
// whose surface is nearest; let m be the direction from the ball's centre to the middle of the square, d how far that
// lies beyond the ball, and w = A n . m, with n the square's outward normal. By Gauss' theorem sums of w f(m) d over
// the squares are what f would come to on the surface that was made voxels: on a staircase of any slope they are
// right in the mean, though single squares are not (of an ideal plane the sum of w d is 0, of a ball w |d + r| is
// three times its volume). Where the balls about a place would have to move by u and to grow by g, d = m . u + g,
// fitted by least squares with weights w. Only radii change: a wall bent by smoothing towards one side has too much
// there and too little on the other, and is no thicker for that, though its outer side is the longer one.
//
// That is for sheets. About lines and single vertices squares are large beside the balls, and d is no longer small. So
// their radii are told by how much the voxels hold, and not by the balls (RoundParts.h), over pieces of squares.
//
// The core of a wall of one to three voxels goes up and down with its voxels, and the balls of such a core would fill
// more than the wall has. So centres are averaged with those of their neighbours for this, four times.
//
// A plate thinner than a slice is left as strips, and its core as lines. It is told from rods (ThinPlates.h): balls at
// ends of lines, along lines and at rims get its thickness, which is its volume by its area.
//
// What balls never hold must not count: at the free border of a sheet and at the end of a line they are round where
// the body may have edges. Squares there have a thousandth of their weight, so that they count where there are no
// others. So have those about lines for sheets: a line that hangs on a sheet lies along its rim. Nor is such a line
// a tube as long as it lies within the balls of the sheet: there it has their radius, and grows with them.

#include "voxelcore/CoreThickness.h"

namespace voxelcore
{

/** Adds the growth g to the radii of a core's balls and to what they paint. Of sheets it is fitted over the squares
 *  whose balls lie about a cube, the side of which is a voxel's longest and shortest side together, with weights that
 *  fall to nothing at a distance of three cubes; u costs a little, so that one-sided squares grow balls. Lines are
 *  fitted as far along themselves. No radius shrinks by more than half, or grows by more than the longest side. Centres
 *  stay. The core's faces are triangles, its balls centred in lattice coordinates. The same for every number of
 *  threads. \throws Cancelled */
void
FitBalls(const VoxelShape &       shape,
         const SpacingWeights &   weights,
         const CellComplex &      cells,
         PaintingBalls &          balls,
         const ProgressCallback & progress = {});

} // namespace voxelcore
