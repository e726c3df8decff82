#pragma once
// Bodies in one layer of voxels, as in a single slice: what a skeleton takes them for.

#include "SkeletonSteps.h"
#include "voxelcore/Certified/Certified.h"

#include <cstddef>
#include <optional>

namespace voxelcore
{

/** The axis along which a body has one layer of voxels, where it has more along both others and half of the layer is no
 *  thicker than its voxels are wide. Along the rim of such a layer no boundary vertex lies within its thickness: its
 *  surface runs from voxel to voxel, as the staircase does, and each step would be a twig. In two layers of half voxels
 *  the steps stand out by what they are. Thicker layers have balls that are much wider than steps. */
std::optional<std::size_t>
SingleLayer(const VoxelShape & shape, const Vector3 & spacing);

/** Two layers of half voxels in the place of one, and what else is told in voxels. */
class HalvedLayer
{
public:
  HalvedLayer(std::size_t axis, const ImageGeometry & geometry);

  /** Voxels are half as long along the axis; places in mm stay. */
  const ImageGeometry &
  Geometry() const
  {
    return m_Halved;
  }

  VoxelShape
  Halve(const VoxelShape & shape) const;

  BeyondBorder
  Halve(BeyondBorder goesOn) const;

  /** Lengths in voxels stay what they are in mm. */
  CertifiedRequest
  Halve(CertifiedRequest request) const;

private:
  VoxelBox
  Halve(VoxelBox box) const;

  std::size_t   m_Axis;
  ImageGeometry m_Whole;
  ImageGeometry m_Halved;
};

} // namespace voxelcore
