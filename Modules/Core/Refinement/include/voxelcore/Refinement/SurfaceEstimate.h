#pragma once
// Where, within a voxel, the smooth surface lies that the voxels of a shape stand for: from the labels themselves, from
// the grey values they were made of, or from a triangle mesh.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

namespace voxelcore
{

/** A point of an estimated surface. Places are in millimetres along the lattice axes (lattice coordinate times
 *  spacing). */
struct SurfacePoint
{
  Vector3 position{};
  Vector3 normal{};      ///< unit length, either way
  bool    found = false; ///< false: the surface is not known here
};

/** An estimate of the surface. Thread-safe, and the same bits on every machine. */
class SurfaceEstimate
{
public:
  virtual ~SurfaceEstimate() = default;

  /** The point of the surface that lies near `place`, found along the surface's normals: not farther than `reach`
   *  mm. */
  virtual SurfacePoint
  Project(const Vector3 & place, double reach) const = 0;

  /** How high ripples are that the true surface does not have, in voxels: nothing is sought more closely on it. */
  virtual double
  Ripples() const
  {
    return 0;
  }

  /** Whether nothing but labels tells where it is. */
  virtual bool
  IsOfLabels() const
  {
    return false;
  }

  /** By how much each side of a wall lies too far out, mm; `half` leads from its middle to a side, mm. */
  virtual double
  Swelling(const Vector3 & /*half*/) const
  {
    return 0;
  }
};

/** Grey values along x: those of the voxels (x, y, z) to (x + values.size() - 1, y, z) in indices of the scan, all
 *  within it, made such that the shape is where they are positive. Thread-safe. */
using GreyRows = std::function<void(std::int32_t x, std::int32_t y, std::int32_t z, std::span<float> values)>;

/** Takes values as GreyRows has them, of a row of a box. */
using GreyRowTaker = std::function<void(std::int32_t y, std::int32_t z, std::span<const float> values)>;

/** The same of a box, where they come from a file. */
struct GreyBoxRows
{
  VoxelBox                                       box;   ///< within the scan
  std::function<void(const GreyRowTaker & take)> visit; ///< gives each of its rows once; nothing of it is kept
};

/** As far around a shape's box, within the scan, as SurfaceFromGrey() asks for values: two bricks of 8 voxels around
 *  those within 7 voxels of the boundary. */
VoxelBox
GreyBoxAround(const VoxelBox & shape, const VoxelBox & scan);

/** From the labels alone: of all surfaces that part the centres of the voxels that are in from those that are out, one
 *  that bends little. `spacing` in mm. Memory follows the boundary. The shape must outlive the call, not the result.
 *  \throws Cancelled when the callback says so. */
std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress = {});

/** The same for many labels of one scan: what the spacing alone decides is found once. Thread-safe. */
std::function<std::unique_ptr<SurfaceEstimate>(const VoxelShape & shape, const ProgressCallback & progress)>
SurfacesFromLabels(const Vector3 & spacing);

/** From grey values: where they are 0 after smoothing that keeps curvature, little where more would move a wall of a
 *  thin part or round an edge. `scan` is the box that has values; beyond it
 *  they are mirrored with their sign turned, as the scan's border is the shape's. `grey` holds GreyBoxAround().
 *  \throws Cancelled when the callback says so. */
std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyBoxRows &      grey,
                const ProgressCallback & progress = {});

std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyRows &         rows,
                const ProgressCallback & progress = {});

/** A triangle mesh: `vertices` in millimetres along the lattice axes, `triangles` by their vertices. It need not be
 *  closed nor oriented. Both are copied. */
std::unique_ptr<SurfaceEstimate>
SurfaceFromTriangles(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);

} // namespace voxelcore
