#pragma once
// Radii about a core's lines, and about vertices without edges, from how much the voxels hold.
//
// Let p lead from the core to a square of the boundary, of area A and normal n. About a line, sums of A n . p are twice
// the volume, those of A n . p / p^2 the angle around it times its length: of a round tube the first are radius^2
// times the second. About a point it is the third power, and p^3. Neither asks how large the core's balls are, and
// none needs to lie in the middle.

#include "voxelcore/CellComplex.h"
#include "voxelcore/ImageGeometry.h"

#include <cstdint>
#include <map>
#include <vector>

namespace voxelcore
{

/** In how many directions balls about a vertex and the places beside it bend: 0 on faces, 1 on lines, 2 else. */
std::vector<std::uint8_t>
FindBends(const CellComplex & cells);

/** Over squares about a vertex, mm. */
struct RoundSums
{
  double holds = 0;
  double angle = 0;

  /** Of a square, or a piece of it; `across` is its area as seen from the core. */
  void
  AddSquare(double across, double distance, int bends)
  {
    holds += across * distance;
    angle += across / (bends == 1 ? distance : distance * distance);
  }
  void
  Add(const RoundSums & other, double part)
  {
    holds += part * other.holds;
    angle += part * other.angle;
  }
};

/** By vertex. */
using RoundParts = std::map<ElementIndex, RoundSums>;

/** mm */
struct RoundLimits
{
  double reach = 0;   ///< along lines, that sums are taken
  double noise = 0;   ///< radii that differ by more are of different bodies
  double longest = 0; ///< up to this a radius is told by voxels alone, from twice as much on its changes by balls
};

/** mm */
struct RoundRadius
{
  double before = 0; ///< the balls', on lines that lie within a sheet's balls the sheet's
  double after = 0;  ///< what the voxels tell
  double part = 0; ///< how much that is worth, 0 to 1: nothing on sheets, and on lines as near to one as they are thick
};

/** Per vertex; places and radii are the balls', mm. */
std::vector<RoundRadius>
RoundRadii(const CellComplex &               cells,
           const std::vector<std::uint8_t> & bends,
           const std::vector<Vector3> &      places,
           const std::vector<double> &       radii,
           const RoundParts &                sums,
           const RoundLimits &               limits);

} // namespace voxelcore
