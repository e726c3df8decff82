#pragma once
// Lengths for people: in nm, um or mm, whichever suits their size; of scans without a voxel size in voxels. Files keep
// mm, or voxels.

#include "voxelcore/Base/SpatialUnit.h"

#include <string>

namespace voxelcore
{

/** The unit in which lengths of one size are shown. */
class LengthUnit
{
public:
  /** The unit for lengths of about `typicalMm`: mm from 0.1 mm on, um from 0.1 um on, else nm; mm where it is 0 or no
   *  number. Of a table or a picture, take the largest length shown, and use one unit throughout. Lengths in voxels
   *  stay voxels. */
  static LengthUnit
  For(double typicalMm, SpatialUnit unit = SpatialUnit::Millimetres);

  /** `mm` (with `power` 2 or 3: square or cubic mm) in this unit. */
  double
  Of(double mm, int power = 1) const;

  /** "um", "um2", "um3". */
  std::string
  Name(int power = 1) const;

  /** For pictures and pages: "µm", "µm²", "µm³". */
  std::string
  Symbol(int power = 1) const;

  /** FixedText of Of(mm, power). */
  std::string
  Text(double mm, int power = 1, int decimals = 2) const;

private:
  explicit LengthUnit(int thousandths, SpatialUnit unit = SpatialUnit::Millimetres)
    : m_Thousandths(thousandths)
    , m_Unit(unit)
  {}

  int         m_Thousandths; ///< 0 for mm and voxels, 1 for um, 2 for nm
  SpatialUnit m_Unit;
};

} // namespace voxelcore
