#include "voxelcore/Shape/BodyFrame.h"

#include "voxelcore/Base/ParallelTasks.h"

#include <cmath>
#include <cstddef>

namespace voxelcore
{

namespace
{

template <typename TMove>
void
MoveEach(std::vector<Vector3> & places, TMove && move)
{
  RunInParts(places.size() > 10000, places.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
    {
      places[i] = move(places[i]);
    }
  });
}

} // namespace

Vector3
OnPlaces(const Vector3 & lattice)
{
  Vector3 place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    place[axis] = std::nearbyint(lattice[axis] / kPlaceStep) * kPlaceStep;
  }
  return place;
}

VoxelShape
MovedTo(const std::array<std::int32_t, 3> & lower, const VoxelShape & shape)
{
  const auto & size = shape.Box().size;
  VoxelShape   moved({ lower, size });
  for (std::int32_t z = 0; z < size[2]; ++z)
  {
    for (std::int32_t y = 0; y < size[1]; ++y)
    {
      const ConstShapeRow from = shape.Row(y, z);
      const ShapeRow      to = moved.Row(y, z);
      for (std::size_t word = 0; word < to.size(); ++word)
      {
        if (const std::uint64_t bits = from[word]; bits != 0)
        {
          to[word] = bits;
        }
      }
    }
    if ((z & 7) == 7 || z + 1 == size[2])
    {
      moved.Compact(z & ~7, z + 1);
    }
  }
  return moved;
}

BodyFrame::BodyFrame(const ImageGeometry & scan, const VoxelBox & body)
  : m_Scan(scan)
  , m_Geometry(scan)
  , m_Lower(body.lower)
{
  m_Geometry.origin = { 0, 0, 0 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Geometry.size[axis] = body.size[axis];
  }
}

Vector3
BodyFrame::Enter(const Vector3 & inScan) const
{
  const Vector3 lattice = OnPlaces(PhysicalToLattice(m_Scan, inScan));
  return LatticeToPhysical(m_Geometry, { lattice[0] - m_Lower[0], lattice[1] - m_Lower[1], lattice[2] - m_Lower[2] });
}

void
BodyFrame::Enter(std::vector<Vector3> & places) const
{
  MoveEach(places, [this](const Vector3 & place) { return Enter(place); });
}

Vector3
BodyFrame::Leave(const Vector3 & inFrame) const
{
  return LatticeToPhysical(m_Scan, LeaveLattice(OnPlaces(PhysicalToLattice(m_Geometry, inFrame))));
}

void
BodyFrame::Leave(std::vector<Vector3> & places) const
{
  MoveEach(places, [this](const Vector3 & place) { return Leave(place); });
}

Vector3
BodyFrame::LeaveLattice(const Vector3 & inFrame) const
{
  return { inFrame[0] + m_Lower[0], inFrame[1] + m_Lower[1], inFrame[2] + m_Lower[2] };
}

VoxelBox
BodyFrame::Enter(VoxelBox inScan) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    inScan.lower[axis] -= m_Lower[axis];
  }
  return inScan;
}

VoxelBox
BodyFrame::Leave(VoxelBox inFrame) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    inFrame.lower[axis] += m_Lower[axis];
  }
  return inFrame;
}

} // namespace voxelcore
