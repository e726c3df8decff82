#pragma once
// When fire burns a medial surface (Yan, Sykes, Chambers, Letscher, Ju: "Erosion Thickness on Medial Axes of 3D
// Shapes", SIGGRAPH 2016, sections 3 and 5).

#include "voxelcore/Base/Progress.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** Burn times in mm. Fire starts on the free boundary of the surface, at each point at the time of its radius, and runs
 *  inwards along the surface with unit speed; a point has burned when fire has cut it off. Infinite on closed parts,
 *  which fire never enters. Points of curves are free boundary themselves: they burn at their radius. A burn time is at
 *  least the radius; the difference is the erosion thickness. */
struct BurnTimes
{
  std::vector<double> vertices;
  std::vector<double> edges; ///< mean over the edge's own sample points
  std::vector<double> faces; ///< mean over the corners, each as seen from the face: a corner on a seam burns sheet by
                             ///< sheet
};

/** Burn times over the ways between vertices and sample points on edges, of which each edge has at least one and which
 *  are about `sampling` apart; edges along which the radius grows by nearly their length have none. Within a polygon
 *  fire runs straight from any point on its sides to any other. A computed time is at least the true one; paths over
 *  sample points are a few percent longer than straight ones. On as many threads as OpenMP gives.
 *  Positions and radii in mm. Only + - * / and sqrt in a fixed order: the same bits everywhere.
 *  \throws InputError above 2^32 - 2 sample points, or where a number is no length; Cancelled when told so. */
BurnTimes
ComputeBurnTimes(const MedialComplex & complex, double sampling, const ProgressCallback & progress = {});

} // namespace voxelcore
