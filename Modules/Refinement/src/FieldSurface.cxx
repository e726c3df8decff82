#include "FieldSurface.h"

#include "voxelcore/Vectors.h"


#include <algorithm>
#include <cmath>

namespace voxelcore
{

SurfacePoint
FieldSurface::Project(const Vector3 & place, double reach) const
{
  constexpr int    steps = 6;
  constexpr double longest = 1.0; // voxels a step
  constexpr double close = 3e-2;  // voxels: what is left after such a step goes as its square
  Vector3          at = Over(place, m_Spacing);
  SurfacePoint     point;
  for (int step = 0; step <= steps; ++step)
  {
    double  value = 0;
    Vector3 slope{};
    if (!m_Field.Evaluate(at, value, slope) || Length(Over(slope, m_Sides)) < m_Flattest)
    {
      return point;
    }
    const Vector3 normal = Over(slope, m_Spacing); // per mm
    const double  squared = Dot(normal, normal);
    Vector3       move = Over(AddScaled({ 0, 0, 0 }, -value / squared, normal), m_Spacing);
    const double  length = Length(move);
    if (length < close || step == steps)
    {
      point.position = Times(AddScaled(at, 1, move), m_Spacing);
      point.normal = AddScaled({ 0, 0, 0 }, -1 / std::sqrt(squared), normal);
      point.found = length < close && Distance(point.position, place) <= reach;
      return point;
    }
    at = AddScaled(at, std::min(1.0, longest / length), move);
  }
  return point;
}

} // namespace voxelcore
