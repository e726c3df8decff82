#include "voxelcore/Lattice/ImageGeometry.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace voxelcore
{

namespace
{
double
Determinant(const std::array<double, 9> & m)
{
  return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}
} // namespace

Vector3
LatticeToPhysical(const ImageGeometry & geometry, const Vector3 & lattice)
{
  Vector3 physical{};
  for (std::size_t row = 0; row < 3; ++row)
  {
    double sum = geometry.origin[row];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum += geometry.direction[3 * row + axis] * (geometry.spacing[axis] * (lattice[axis] - 0.5));
    }
    physical[row] = sum;
  }
  return physical;
}

Vector3
PhysicalToLattice(const ImageGeometry & geometry, const Vector3 & physical)
{
  const auto &  m = geometry.direction;
  const double  det = Determinant(m);
  const Vector3 v{ physical[0] - geometry.origin[0],
                   physical[1] - geometry.origin[1],
                   physical[2] - geometry.origin[2] };
  const Vector3 local{
    ((m[4] * m[8] - m[5] * m[7]) * v[0] + (m[2] * m[7] - m[1] * m[8]) * v[1] + (m[1] * m[5] - m[2] * m[4]) * v[2]) /
      det,
    ((m[5] * m[6] - m[3] * m[8]) * v[0] + (m[0] * m[8] - m[2] * m[6]) * v[1] + (m[2] * m[3] - m[0] * m[5]) * v[2]) /
      det,
    ((m[3] * m[7] - m[4] * m[6]) * v[0] + (m[1] * m[6] - m[0] * m[7]) * v[1] + (m[0] * m[4] - m[1] * m[3]) * v[2]) / det
  };
  return { local[0] / geometry.spacing[0] + 0.5,
           local[1] / geometry.spacing[1] + 0.5,
           local[2] / geometry.spacing[2] + 0.5 };
}

bool
IsLeftHanded(const ImageGeometry & geometry)
{
  return Determinant(geometry.direction) < 0.0;
}

double
OrthonormalityDeviationDegrees(const ImageGeometry & geometry)
{
  const auto & m = geometry.direction;
  double       worst = 0.0;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t b = a; b < 3; ++b)
    {
      const double dot = m[a] * m[b] + m[3 + a] * m[3 + b] + m[6 + a] * m[6 + b];
      const double excess = a == b ? std::sqrt(std::max(dot, 0.0)) - 1.0 : dot;
      if (!std::isfinite(excess))
      {
        return 90.0;
      }
      worst = std::max(worst, std::min(1.0, std::abs(excess)));
    }
  }
  return std::asin(worst) * 180.0 / std::numbers::pi;
}

double
LargestCoordinate(const ImageGeometry & geometry)
{
  double largest = 0;
  for (const double coordinate : geometry.origin)
  {
    largest = std::max(largest, std::abs(coordinate));
  }
  for (std::size_t a = 0; a < 3; ++a)
  {
    largest += geometry.spacing[a] * static_cast<double>(geometry.size[a] + 1);
  }
  return largest;
}

void
RequireDistinctPositions(const ImageGeometry & geometry)
{
  const auto isFinite = [](double value) { return std::isfinite(value); };
  if (!std::all_of(geometry.origin.begin(), geometry.origin.end(), isFinite) ||
      !std::all_of(geometry.direction.begin(), geometry.direction.end(), isFinite))
  {
    throw InputError("the origin or the direction of the image is not finite; correct it");
  }
  const double finest = *std::min_element(geometry.spacing.begin(), geometry.spacing.end());
  if (!(LargestCoordinate(geometry) <= std::ldexp(finest, 36)))
  {
    std::ostringstream text;
    text << "the image lies so far off (origin " << geometry.origin[0] << ", " << geometry.origin[1] << ", "
         << geometry.origin[2] << " mm, finest spacing " << finest
         << " mm) that doubles cannot tell places within a voxel apart; correct its origin";
    throw InputError(InUnit(text.str(), geometry.unit));
  }
}

} // namespace voxelcore
