#include "SingleLayer.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace voxelcore
{

std::optional<std::size_t>
SingleLayer(const VoxelShape & shape, const Vector3 & spacing)
{
  const auto & size = shape.Box().size;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t next = (axis + 1) % 3;
    const std::size_t last = (axis + 2) % 3;
    if (size[axis] == 1 && size[next] > 1 && size[last] > 1 &&
        0.5 * spacing[axis] <= std::min(spacing[next], spacing[last]))
    {
      return axis;
    }
  }
  return std::nullopt;
}

HalvedLayer::HalvedLayer(std::size_t axis, const ImageGeometry & geometry)
  : m_Axis(axis)
  , m_Whole(geometry)
  , m_Halved(geometry)
{
  m_Halved.spacing[axis] *= 0.5;
  m_Halved.size[axis] *= 2;
  for (std::size_t k = 0; k < 3; ++k)
  {
    m_Halved.origin[k] -= 0.5 * m_Halved.spacing[axis] * geometry.direction[3 * k + axis];
  }
}

VoxelBox
HalvedLayer::Halve(VoxelBox box) const
{
  box.lower[m_Axis] *= 2;
  box.size[m_Axis] *= 2;
  return box;
}

VoxelShape
HalvedLayer::Halve(const VoxelShape & shape) const
{
  VoxelShape       halves(Halve(shape.Box()));
  const VoxelBox & box = halves.Box();
  for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
  {
    for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
    {
      for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
      {
        std::array<std::int32_t, 3> whole{ x, y, z };
        whole[m_Axis] = shape.Box().lower[m_Axis];
        if (shape.Contains(whole[0], whole[1], whole[2]))
        {
          halves.Insert(x, y, z);
        }
      }
    }
  }
  return halves;
}

BeyondBorder
HalvedLayer::Halve(BeyondBorder goesOn) const
{
  goesOn.scan = Halve(goesOn.scan);
  goesOn.box = Halve(goesOn.box);
  for (BorderSection & section : goesOn.sections)
  {
    section.centre[m_Axis] *= 2;
  }
  return goesOn;
}

CertifiedRequest
HalvedLayer::Halve(CertifiedRequest request) const
{
  const Vector3 & whole = m_Whole.spacing;
  const Vector3 & half = m_Halved.spacing;
  const double    smallest = *ranges::min_element(whole) / *ranges::min_element(half);
  const double    diagonal = Length(whole) / Length(half);
  const auto      keep = [](Lambda & length, double ratio) {
    length.value *= length.unit == Lambda::Unit::Voxel ? ratio : 1;
  };
  const auto keepHeight = [&](Tolerance & height) {
    height.value *= height.unit == Tolerance::Unit::Voxel      ? smallest
                    : height.unit == Tolerance::Unit::Diagonal ? diagonal
                                                               : 1;
  };
  for (Lambda & lambda : request.lambdas)
  {
    keep(lambda, smallest);
  }
  ranges::for_each(request.tolerances, keepHeight);
  SkeletonRequest & skeleton = *request.skeleton;
  keep(skeleton.lambda, smallest);
  keep(skeleton.standOut, diagonal);
  keep(skeleton.smooth, diagonal);
  if (skeleton.tolerance)
  {
    keepHeight(*skeleton.tolerance);
  }
  if (skeleton.plates)
  {
    keep(*skeleton.plates, smallest);
  }
  if (skeleton.branches.pruneLength)
  {
    keep(*skeleton.branches.pruneLength, smallest);
  }
  if (request.scan)
  {
    request.scan = Halve(*request.scan);
  }
  return request;
}

} // namespace voxelcore
