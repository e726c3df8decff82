#pragma once
// Three grey levels for the topology of a shape that was cut out of a grey scan (TopologySimplification.h): the shape's
// own, a higher one for the kernel, a lower one for the neighbourhood; proposed from the values near the shape's
// boundary and from how pieces, loops and cavities persist over levels.

#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Grey values at the voxels of a band around a shape; elsewhere nothing is kept. 4 bytes a voxel of the band, and half
 *  a bit a voxel of its box. */
class BandValues
{
public:
  explicit BandValues(VoxelShape band);

  const VoxelShape &
  Band() const
  {
    return m_Band;
  }

  /** Takes what lies in the band of a row at y, z, whose values begin at Band().Box().lower[0]; indices of the scan. */
  void
  SetRow(std::int32_t y, std::int32_t z, std::span<const float> row);

  /** At a voxel of the band. */
  float
  At(std::int32_t x, std::int32_t y, std::int32_t z) const
  {
    return m_Values[Number(x, y, z)];
  }

  /** Of all voxels, in scan order. */
  std::span<const float>
  All() const
  {
    return m_Values;
  }

private:
  std::size_t
  Number(std::int32_t x, std::int32_t y, std::int32_t z) const;

  VoxelShape                 m_Band;
  std::vector<std::uint64_t> m_Before; ///< per row of the box the voxels of the band before it
  std::vector<std::uint32_t> m_InRow;  ///< per word those before it in its row
  std::vector<float>         m_Values;
};

/** The numbers of what is at or above a level. */
struct LevelNumbers
{
  double          level = 0;
  TopologyNumbers numbers;
};

/** A voxel of the shape below its level was filled on purpose and counts as brighter than any level; one outside that
 *  is above it was taken out and counts as darker. */
struct GreyLevels
{
  double                    background = 0; ///< median in the band outside the shape
  double                    bright = 0;     ///< median inside
  double                    shape = 0;
  double                    otsu = 0;          ///< of the band's values (Otsu 1979)
  double                    valley = 0;        ///< of their histogram, between background and bright
  double                    neighbourhood = 0; ///< the highest below the shape's at which the numbers are fewest in sum
  double                    kernel = 0;        ///< the lowest above at which there are the fewest loops
  std::vector<LevelNumbers> tried;             ///< rising, the shape's among them
};

/** Proposes levels for a shape cut out at `level`. The band holds the shape. */
GreyLevels
ProposeLevels(const VoxelShape & shape, const BandValues & values, double level);

/** What of the band is at or above a level, as in GreyLevels, in the band's box. */
VoxelShape
AtLeast(const VoxelShape & shape, const BandValues & values, double shapeLevel, double level);

} // namespace voxelcore
