#include "FieldSurface.h"

#include "voxelcore/Vectors.h"


#include <algorithm>
#include <cmath>

namespace voxelcore
{

SurfacePoint
FieldSurface::Project(const Vector3 & place, double reach) const
{
  // Places are asked for one beside the other, some of two fields by turns.
  struct Remembered
  {
    std::uint64_t   of = 0;
    BandField::Spot spot;
  };
  static thread_local std::array<Remembered, 4> remembered;
  Remembered &                                  own = remembered[m_Number.Value() % remembered.size()];
  if (own.of != m_Number.Value())
  {
    own = { m_Number.Value(), {} };
  }
  constexpr int    steps = 6;
  constexpr double longest = 1.0; // voxels a step
  Vector3          at = Over(place, m_Spacing);
  SurfacePoint     point;
  for (int step = 0; step <= steps; ++step)
  {
    double  value = 0;
    Vector3 slope{};
    if (!m_Field.Evaluate(at, own.spot, value, slope) || Dot(Times(slope, slope), m_BySides) < m_Flattest * m_Flattest)
    {
      return point;
    }
    const Vector3 up = Times(slope, m_BySpacing);
    const double  squared = Dot(slope, up); // of the slope per mm
    const Vector3 move = AddScaled({ 0, 0, 0 }, -value / squared, up);
    const double  length = Dot(move, move);
    if (length < m_Close * m_Close || step == steps)
    {
      point.position = Times(AddScaled(at, 1, move), m_Spacing);
      point.normal = AddScaled({ 0, 0, 0 }, -1 / std::sqrt(squared), Times(up, m_Spacing));
      const Vector3 way = Minus(point.position, place);
      point.found = length < m_Close * m_Close && Dot(way, way) <= reach * reach;
      return point;
    }
    at = AddScaled(at, length > longest * longest ? longest / std::sqrt(length) : 1.0, move);
  }
  return point;
}

double
FieldSurface::Swelling(const Vector3 & half) const
{
  const double length = Length(half);
  if (!m_Walls || length == 0)
  {
    return 0;
  }
  const double unit = Length(Times(half, m_Unit)) / length; // across this wall
  return unit * m_Walls->At(length / unit);
}

} // namespace voxelcore
