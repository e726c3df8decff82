#pragma once
// By how much balls have to grow.

#include "voxelcore/ImageGeometry.h"

#include <array>
#include <cstddef>
#include <utility>

namespace voxelcore
{

/** Normal equations of d = m . u + g, of four unknowns. */
class GrowthEquations
{
public:
  void
  AddSquare(const Vector3 & way, double gap, double weight)
  {
    const std::array<double, 4> row{ way[0], way[1], way[2], 1 };
    std::size_t                 at = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      m_Right[i] += weight * gap * row[i];
      for (std::size_t j = 0; j <= i; ++j)
      {
        m_Left[at++] += weight * row[i] * row[j];
      }
    }
  }
  void
  Add(const GrowthEquations & other, double part)
  {
    for (std::size_t i = 0; i < m_Left.size(); ++i)
    {
      m_Left[i] += part * other.m_Left[i];
    }
    for (std::size_t i = 0; i < m_Right.size(); ++i)
    {
      m_Right[i] += part * other.m_Right[i];
    }
  }
  /** g, or 0 where the squares face each other's way. By elimination: with what a move costs, the matrix is positive
   *  where weights are. */
  double
  Growth() const
  {
    const double                         area = m_Left[9];
    std::array<std::array<double, 4>, 4> a{};
    std::array<double, 4>                b = m_Right;
    std::size_t                          at = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t j = 0; j <= i; ++j)
      {
        a[i][j] = m_Left[at];
        a[j][i] = m_Left[at++];
      }
      a[i][i] += i < 3 ? kStay * area : 0.0;
    }
    for (std::size_t i = 0; i < 4; ++i)
    {
      if (!(a[i][i] > 1e-6 * kStay * area))
      {
        return 0;
      }
      for (std::size_t j = i + 1; j < 4; ++j)
      {
        const double factor = a[j][i] / a[i][i];
        for (std::size_t k = i; k < 4; ++k)
        {
          a[j][k] -= factor * a[i][k];
        }
        b[j] -= factor * b[i];
      }
    }
    return b[3] / a[3][3];
  }

private:
  static constexpr double kStay = 1e-2; ///< what a move costs

  std::array<double, 10> m_Left{}; ///< row by row up to the diagonal
  std::array<double, 4>  m_Right{};
};

} // namespace voxelcore
