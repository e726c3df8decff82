#pragma once
// Where, within half a voxel's diagonal, the smooth surface passes each square of a voxel shape's boundary.
//
// From labels alone. A square's middle lies half way between a voxel that is in and one that is out. Single middles are
// up to half a voxel off the surface, but in sums over a staircase, each weighted with its square's area as seen along
// the surface's normal, what is too far out and too far in is equal, whatever the slope. So the surface near a square
// is the quadric, over the plane across the normal, that fits the middles around it best by least squares with these
// weights; squares that face the other way, those of a thin wall's other side too, do not count. The square's place is
// where that quadric passes it. Nothing about it knows how thick the body is on its other side, and a body moved as a
// whole has the same places.

#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Refinement/SurfaceEstimate.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A square between a voxel that is in and one that is out. */
struct FacingSquare
{
  std::array<std::int32_t, 3> voxel{}; ///< the one that is in, in indices of the scan
  std::uint8_t                axis = 0;
  std::int8_t                 way = 1; ///< -1: the voxel that is out comes before
};

/** Lengths in mm along the lattice's axes. */
struct SurfacePlace
{
  Vector3 at{};
  Vector3 normal{}; ///< outwards, unit length
  double  area = 0; ///< of the square as seen along it
};
using SurfacePlaces = std::vector<SurfacePlace>;

/** All squares of a shape, in scan order of what lies behind them. */
std::vector<FacingSquare>
FacingSquares(const VoxelShape & shape);

/** Of a voxel, mm. */
Vector3
SidesOf(const SpacingWeights & weights);

/** The middle of a square. */
Vector3
MiddleOf(const FacingSquare & square, const Vector3 & sides);

class LabelPlaces
{
public:
  /** Borrows the squares. */
  LabelPlaces(const std::vector<FacingSquare> & squares, const Vector3 & sides);
  ~LabelPlaces();

  /** At each square, fits over all squares within its reach (mm). The same for every number of threads.
   *  \throws Cancelled */
  SurfacePlaces
  Find(const std::vector<double> & reaches, const ProgressCallback & progress) const;

private:
  struct Middles;
  class Fitter;
  std::unique_ptr<const Middles> m_Middles;
};

/** One for each square, of a surface that something else tells. Where it is not found, the middle itself.
 *  \throws Cancelled */
SurfacePlaces
PlacesOn(const SurfaceEstimate &           surface,
         const std::vector<FacingSquare> & squares,
         const Vector3 &                   sides,
         const ProgressCallback &          progress);

} // namespace voxelcore
