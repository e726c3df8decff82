#pragma once
// Cells in the order of their exact centres: the comparison, and a coarse order that takes no comparisons.

#include "voxelcore/Delaunay/CanonicalCells.h"

#include "voxelcore/Lattice/Predicates.h"

namespace voxelcore
{

/** The centres of cells that a list names, each coordinate rounded once. */
void
CentresOf(const DelaunayCells &             cells,
          std::span<const std::uint32_t>    list,
          const std::vector<LatticePoint> & points,
          const SpacingWeights &            weights,
          CentredCell *                     to);

/** Compares exact centres, x first. Rounding is monotone, so doubles decide unless they are equal. */
class CentreOrder
{
public:
  CentreOrder(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights)
    : m_Cells(cells)
    , m_Points(points)
    , m_Weights(weights)
  {}

  int
  Compare(const CentredCell & a, const CentredCell & b) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (a.centre[axis] != b.centre[axis])
      {
        return a.centre[axis] < b.centre[axis] ? -1 : 1;
      }
      if (const int sign = IsEqual(a, b, axis) ? 0 : CompareExactly(a, b, axis); sign != 0)
      {
        return sign;
      }
    }
    return 0;
  }

private:
  // Two fractions that round to the same v differ by at most v 2^-52, and by at least 1 / (q q') if at all.
  static bool
  IsEqual(const CentredCell & a, const CentredCell & b, std::size_t axis)
  {
    return static_cast<double>(a.denominator) * static_cast<double>(b.denominator) * std::abs(a.centre[axis]) < 0x1p51;
  }
  int
  CompareExactly(const CentredCell & a, const CentredCell & b, std::size_t axis) const;

  const DelaunayCells &             m_Cells;
  const std::vector<LatticePoint> & m_Points;
  const SpacingWeights &            m_Weights;
};

/** Buckets that follow each other in the order of centres. Centres at whole and half x, which most are, go by y
 *  within it, all others by x. */
class CentreBuckets
{
public:
  /** For about so many cells, whose centres lie in the box of the points. */
  CentreBuckets(const DelaunayCells &             cells,
                const std::vector<LatticePoint> & points,
                const SpacingWeights &            weights,
                std::size_t                       count);

  std::size_t
  Count() const
  {
    return m_Slabs * m_PerSlab;
  }

  std::uint32_t
  Of(const CentredCell & entry) const;

private:
  int
  SideOf(const CentredCell & entry, double x) const;

  const DelaunayCells &             m_Cells;
  const std::vector<LatticePoint> & m_Points;
  const SpacingWeights &            m_Weights;
  double                            m_LowX = 0.0;
  double                            m_LowY = 0.0;
  double                            m_ScaleY = 0.0;
  std::size_t                       m_Slabs = 0;   // one lattice step of x each
  std::size_t                       m_Rows = 0;    // buckets of a whole or half x
  std::size_t                       m_Parts = 0;   // buckets between a whole and a half
  std::size_t                       m_PerSlab = 0; // whole x, between, half x, between
};

} // namespace voxelcore
