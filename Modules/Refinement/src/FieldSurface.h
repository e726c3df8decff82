#pragma once
// The surface where a scalar field is 0.

#include "BandField.h"
#include "WallSwelling.h"

#include "voxelcore/Vectors.h"

#include "voxelcore/SurfaceEstimate.h"

#include <optional>

namespace voxelcore
{

/** Where a field is 0. */
class FieldSurface : public SurfaceEstimate
{
public:
  /** A field of coefficients. `spacing` in mm, `sides` those of the field. A slope (per unit of `sides`) less than
   *  `flattest` tells nothing: where labels allow no surface, the field is flat. The last step onto the surface is less
   *  than `close` voxels; what is left then goes as its square. */
  FieldSurface(BandField field, const Vector3 & spacing, const Vector3 & sides, double flattest, double close)
    : m_Field(std::move(field))
    , m_Spacing(spacing)
    , m_BySpacing(Over({ 1, 1, 1 }, Times(spacing, spacing)))
    , m_Unit(Over(spacing, sides))
    , m_BySides(Over({ 1, 1, 1 }, Times(sides, sides)))
    , m_Flattest(flattest)
    , m_Close(close)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override;

  double
  Ripples() const override
  {
    return 0.03;
  }

  /** In units of `sides`. */
  void
  SetSwelling(WallSwelling walls)
  {
    m_Walls = std::move(walls);
  }

  double
  Swelling(const Vector3 & half) const override;

  /** Another field after all: change(field). */
  template <typename TChange>
  void
  Change(TChange change)
  {
    change(m_Field);
  }

  const BandField &
  Field() const
  {
    return m_Field;
  }

private:
  BandField m_Field;
  Vector3   m_Spacing;
  Vector3   m_BySpacing; ///< 1 / spacing^2
  Vector3   m_Unit;      ///< of sides, mm; slices may be farther apart than sides say
  Vector3   m_BySides;   ///< 1 / sides^2
  double    m_Flattest;
  double    m_Close;

  std::optional<WallSwelling> m_Walls;
};

} // namespace voxelcore
