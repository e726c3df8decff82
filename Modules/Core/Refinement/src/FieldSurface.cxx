#include "FieldSurface.h"

#include "BandFieldEvaluate.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

// Along the slopes of the field to where it is 0.
VOXELCORE_EIGHT_LANES void
FindSurface(const BandField &           field,
            const FieldSurface::Scale & scale,
            BandField::Spot &           spot,
            const Vector3 &             place,
            double                      reach,
            SurfacePoint &              point)
{
  constexpr int    steps = 6;
  constexpr double longest = 1.0; // voxels a step
  const double     close = scale.close * scale.close;
  Vector3          at = Over(place, scale.spacing);
  for (int step = 0; step <= steps; ++step)
  {
    double  value = 0;
    Vector3 slope{};
    if (!field.Evaluate(at, spot, value, slope) ||
        Dot(Times(slope, slope), scale.bySides) < scale.flattest * scale.flattest)
    {
      return;
    }
    const Vector3 up = Times(slope, scale.bySpacing);
    const double  squared = Dot(slope, up); // of the slope per mm
    const Vector3 move = AddScaled({ 0, 0, 0 }, -value / squared, up);
    const double  length = Dot(move, move);
    if (length < close || step == steps)
    {
      point.position = Times(AddScaled(at, 1, move), scale.spacing);
      point.normal = AddScaled({ 0, 0, 0 }, -1 / std::sqrt(squared), Times(up, scale.spacing));
      const Vector3 way = Minus(point.position, place);
      point.found = length < close && Dot(way, way) <= reach * reach;
      return;
    }
    at = AddScaled(at, length > longest * longest ? longest / std::sqrt(length) : 1.0, move);
  }
}

} // namespace

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
  SurfacePoint point;
  FindSurface(m_Field, m_Scale, own.spot, place, reach, point);
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
