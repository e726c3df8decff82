#pragma once
// The surface where a scalar field is 0.

#include "BandField.h"

#include "voxelcore/SurfaceEstimate.h"

#include <vector>

namespace voxelcore
{

/** Where a field is 0; where it has no good answer the next one is asked. */
class FieldSurface : public SurfaceEstimate
{
public:
  /** Fields of coefficients. `spacing` in mm, `sides` those of the fields. A slope (per unit of `sides`) less than `flattest`
   *  tells nothing: where labels allow no surface, the field is flat. */
  FieldSurface(std::vector<BandField> fields, const Vector3 & spacing, const Vector3 & sides, double flattest)
    : m_Fields(std::move(fields))
    , m_Spacing(spacing)
    , m_Sides(sides)
    , m_Flattest(flattest)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override;

private:
  SurfacePoint
  Project(const BandField & field, const Vector3 & place, double reach) const;

  std::vector<BandField> m_Fields;
  Vector3                m_Spacing;
  Vector3                m_Sides;
  double                 m_Flattest;
};

} // namespace voxelcore
