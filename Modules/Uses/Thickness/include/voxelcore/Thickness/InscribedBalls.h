#pragma once
// The balls local thickness is painted with: those around the vertices of a whole voxel core, and around places on its
// edges, so that nothing thin is lost.
//
// A ball is inscribed when it lies in the closure of the shape S. Let r(c) be the distance of c in S to the nearest
// boundary square, R(c) that to the nearest boundary vertex: r <= R, the ball of radius r is inscribed and no greater
// one about c is. Balls of radius r give lower bounds of the local thickness (Hildebrand, Rueegsegger 1997).
//
// Upper bounds. Let a ball of radius r(c) hold p, and b be a boundary vertex nearest to c. Distances are those of the
// lattice, w the sides of a voxel.
//  1. In the Voronoi cell V(b), S is the union of the octants at b whose voxels are in: a place of V(b) on the boundary
//     lies in a boundary square, whose corner b is (paper, Theorem 3.1).
//  2. Let A be a set of axes such that of every octant in S one that is out differs in axes of A alone. Both voxels
//     have the lattice edges from b along the other axes as sides, whose ends are boundary vertices, so that in V(b) no
//     place is farther than w/2 from b along these axes. So r(c) <= G(c), the length of c - b in the axes of A.
//     G is convex, G <= R.
//  3. p is in the ball about c' through b if and only if c' is in a half-space H: nearer to p than to b. c lies in K,
//     the part of V(b), of H and of the closure of S in common. Among the places of K where G is greatest take c*,
//     the farthest from b: G(c*) >= r(c). G is convex and the distance strictly so; c* therefore is no inner place of a
//     segment in K.
//  4. If c* lies in S, then by 1 it is a vertex of V(b), or the place where an edge of V(b) leaves H. Of V(b)'s
//     vertices those in S are core vertices. On an edge, p is in the balls about a connected part of it only, one end
//     of which is an end of the edge (the power of p is linear along it). Cut an edge into pieces: p is in the ball of
//     one of the ends of the piece on which c* lies, and G(c*) is at most the greater of G at these ends.
//  5. An edge with only one end v in S passes the boundary in the middle q of a square with corner b. If p is above the
//     square, it is in the ball of v too, and G(c*) <= G(v). If it is below, it is in the ball about q through b, and
//     as it is not the centre of the voxel right below, which is out, c* is not higher above q than follows from that.
//     The edge from q to there is cut as in 4; p is in the ball of the lower end of a piece.
//  6. If c* lies on the boundary, it is in the quarter of a square with corner b. By the power of p again, p is in the
//     ball of one of the other corners of this quarter, the middle of the square and those of two of its sides, and
//     G is nowhere on it greater than in the middle.
// So with each core vertex painted with the greatest G of the boundary vertices nearest to it and of the other ends of
// its pieces, each cut with that of its pieces, and the middles of squares and of their sides with those of 5 and 6,
// every voxel centre gets at least its local thickness.

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Lattice/ImageGeometry.h"

#include <cstddef>
#include <span>
#include <vector>

namespace voxelcore
{

/** Closed balls in lattice coordinates (voxel index + 1/2), each with half the thickness it gives to what it holds. */
struct PaintingBalls
{
  std::vector<Vector3> centres;
  std::vector<double>  radius; ///< mm
  std::vector<double>  value;  ///< mm

  void
  Add(const Vector3 & centre, double ball, double painted)
  {
    centres.push_back(centre);
    radius.push_back(ball);
    value.push_back(painted);
  }
  std::size_t
  Count() const
  {
    return centres.size();
  }
};

struct ThicknessBalls
{
  PaintingBalls inscribed; ///< value = radius: the exact distance to the nearest boundary square
  PaintingBalls bounding;  ///< as said above; empty where they were not asked for
};

/** The balls of a shape, whose boundary vertices, as BoundaryVertices() gives them, are `points` and whose cells are
 *  `cells`. Lengths are those of the weights' lattice, in mm. Edges of the core are cut into pieces along which no ball
 *  grows by more than an eighth of a voxel's shortest side; for bounds, by `boundingStep` of it, where 0 asks for no
 *  bounds. Inscribed balls that stick out of a neighbour's by nothing are left out, and those of a 64th at most where
 *  that grows by less than half a side; so are those that hold no voxel's centre.
 *  The same for every number of threads, and for every order of a cell's points. \throws Cancelled */
ThicknessBalls
FindThicknessBalls(const VoxelShape &            shape,
                   std::span<const LatticePoint> points,
                   const DelaunayCells &         cells,
                   const SpacingWeights &        weights,
                   double                        boundingStep,
                   const ProgressCallback &      progress = {});

} // namespace voxelcore
