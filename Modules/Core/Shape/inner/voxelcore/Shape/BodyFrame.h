#pragma once
// A body apart from the scan it lies in: what is computed must not depend on where in the grid that is.
//
// Everything is computed of a body whose tight box begins at voxel (0,0,0), and in places told from there. Only then it
// is put where it lies, by whole voxels. So a body that is moved by whole voxels, cropped closer or padded has the same
// places in lattice coordinates, less those of its box' corner, bit for bit: LatticeToPhysical() makes of them what
// stands in files. For that to hold of what is read back, too, places are multiples of kPlaceStep of a voxel. The whole
// number of voxels is then added without rounding, and Enter() finds the same bits again in mm that were rounded, as
// long as no coordinate exceeds 2^18 voxels.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Lattice/PlaceStep.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A place in lattice coordinates as the nearest one that is told from others; of two, the even multiple. */
Vector3
OnPlaces(const Vector3 & lattice);

/** The same voxels elsewhere: the first of the box becomes `lower`. */
VoxelShape
MovedTo(const std::array<std::int32_t, 3> & lower, const VoxelShape & shape);

class BodyFrame
{
public:
  /** Of a body whose tight box is `body`, in voxels of the scan. */
  BodyFrame(const ImageGeometry & scan, const VoxelBox & body);

  /** In which the body is computed: the scan's axes and unit, no more voxels than its box has, and the first of them at
   *  the origin. */
  const ImageGeometry &
  Geometry() const
  {
    return m_Geometry;
  }

  /** Where the frame's voxel (0,0,0) lies in the scan. */
  const std::array<std::int32_t, 3> &
  Lower() const
  {
    return m_Lower;
  }

  /** From LPS mm of the scan to those of the frame. */
  Vector3
  Enter(const Vector3 & inScan) const;
  void
  Enter(std::vector<Vector3> & places) const;

  /** The inverse of Enter(). */
  Vector3
  Leave(const Vector3 & inFrame) const;
  void
  Leave(std::vector<Vector3> & places) const;

  /** From lattice coordinates in the frame to those in the scan. */
  Vector3
  LeaveLattice(const Vector3 & inFrame) const;

  VoxelBox
  Enter(VoxelBox inScan) const;
  VoxelBox
  Leave(VoxelBox inFrame) const;

private:
  ImageGeometry               m_Scan;
  ImageGeometry               m_Geometry;
  std::array<std::int32_t, 3> m_Lower{};
};

} // namespace voxelcore
