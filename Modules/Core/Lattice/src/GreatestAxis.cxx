#include "voxelcore/Lattice/GreatestAxis.h"

#include <cmath>
#include <cstddef>

namespace voxelcore
{

Vector3
GreatestAxis(std::array<Vector3, 3> m, double & greatest)
{
  std::array<Vector3, 3> v{ Vector3{ 1, 0, 0 }, Vector3{ 0, 1, 0 }, Vector3{ 0, 0, 1 } };
  for (int sweep = 0; sweep < 30; ++sweep)
  {
    for (std::size_t p = 0; p < 2; ++p)
    {
      for (std::size_t q = p + 1; q < 3; ++q)
      {
        if (m[p][q] == 0)
        {
          continue;
        }
        const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
        const double t = (theta >= 0 ? 1.0 : -1.0) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const double c = 1 / std::sqrt(t * t + 1);
        const double s = t * c;
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double a = m[k][p];
          const double b = m[k][q];
          m[k][p] = c * a - s * b;
          m[k][q] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 3; ++k)
        {
          const double a = m[p][k];
          const double b = m[q][k];
          m[p][k] = c * a - s * b;
          m[q][k] = s * a + c * b;
          const double d = v[k][p];
          const double e = v[k][q];
          v[k][p] = c * d - s * e;
          v[k][q] = s * d + c * e;
        }
      }
    }
  }
  const std::size_t best = m[0][0] >= m[1][1] ? (m[0][0] >= m[2][2] ? 0 : 2) : (m[1][1] >= m[2][2] ? 1 : 2);
  greatest = m[best][best];
  Vector3           axis{ v[0][best], v[1][best], v[2][best] };
  const std::size_t main = std::abs(axis[0]) >= std::abs(axis[1]) ? (std::abs(axis[0]) >= std::abs(axis[2]) ? 0 : 2)
                                                                  : (std::abs(axis[1]) >= std::abs(axis[2]) ? 1 : 2);
  if (axis[main] < 0)
  {
    axis = { -axis[0], -axis[1], -axis[2] };
  }
  return axis;
}

} // namespace voxelcore
