#pragma once
// The surface where a scalar field is 0.

#include "BandField.h"
#include "WallSwelling.h"

#include "voxelcore/Lattice/Vectors.h"

#include "voxelcore/Refinement/SurfaceEstimate.h"

#include <atomic>
#include <cstdint>
#include <optional>

namespace voxelcore
{

/** A number that no other one has, nor has had: what is remembered by it is of what has it and has not changed. */
class OwnNumber
{
public:
  OwnNumber()
    : m_Value(Next())
  {}
  OwnNumber(const OwnNumber &)
    : OwnNumber()
  {}
  OwnNumber &
  operator=(const OwnNumber &)
  {
    Renew();
    return *this;
  }
  void
  Renew()
  {
    m_Value = Next();
  }
  std::uint64_t
  Value() const
  {
    return m_Value;
  }

private:
  static std::uint64_t
  Next()
  {
    static std::atomic<std::uint64_t> last = 0;
    return ++last;
  }

  std::uint64_t m_Value;
};

/** Where a field is 0. */
class FieldSurface : public SurfaceEstimate
{
public:
  /** How its slopes are measured. */
  struct Scale
  {
    Vector3 spacing;
    Vector3 bySpacing; ///< 1 / spacing^2
    Vector3 bySides;   ///< 1 / sides^2
    double  flattest;
    double  close;
  };

  /** A field of coefficients. `spacing` in mm, `sides` those of the field. A slope (per unit of `sides`) less than
   *  `flattest` tells nothing: where labels allow no surface, the field is flat. The last step onto the surface is less
   *  than `close` voxels; what is left then goes as its square. */
  FieldSurface(BandField field, const Vector3 & spacing, const Vector3 & sides, double flattest, double close)
    : m_Field(std::move(field))
    , m_Scale{ spacing,
               Over({ 1, 1, 1 }, Times(spacing, spacing)),
               Over({ 1, 1, 1 }, Times(sides, sides)),
               flattest,
               close }
    , m_Unit(Over(spacing, sides))
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override;

  double
  Ripples() const override
  {
    return 0.03;
  }

  bool
  IsOfLabels() const override
  {
    return m_IsOfLabels;
  }

  /** Of a field made of labels: in units of `sides`. */
  void
  SetSwelling(WallSwelling walls)
  {
    m_Walls = std::move(walls);
    m_IsOfLabels = true;
  }

  double
  Swelling(const Vector3 & half) const override;

  /** Another field after all: change(field). */
  template <typename TChange>
  void
  Change(TChange change)
  {
    change(m_Field);
    m_Number.Renew();
  }

  const BandField &
  Field() const
  {
    return m_Field;
  }

private:
  BandField m_Field;
  Scale     m_Scale;
  Vector3   m_Unit; ///< of sides, mm; slices may be farther apart than sides say

  std::optional<WallSwelling> m_Walls;
  bool                        m_IsOfLabels = false;
  OwnNumber                   m_Number; ///< of the field as it is where it is
};

} // namespace voxelcore
