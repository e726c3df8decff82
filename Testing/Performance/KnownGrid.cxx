#include "KnownGrid.h"

#include <algorithm>
#include <cmath>

namespace voxelcore::evaluation
{

Vector3
KnownGrid::ToBody(const Vector3 & place) const
{
  Vector3 p{ 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double mm = place[i] - 0.5 * size[i] * spacing[i] + shift[i];
    for (std::size_t j = 0; j < 3; ++j)
    {
      p[j] += mm * axes[i][j];
    }
  }
  return p;
}

Vector3
KnownGrid::ToGrid(const Vector3 & place) const
{
  Vector3 p{ 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    p[i] =
      place[0] * axes[i][0] + place[1] * axes[i][1] + place[2] * axes[i][2] + 0.5 * size[i] * spacing[i] - shift[i];
  }
  return p;
}

KnownGrid
PlaceGrid(const KnownBody & body, const Vector3 & spacing, int rotation)
{
  // Quaternions off the axes and off each other.
  const double t = 0.61 + 1.7 * rotation;
  double       q[4] = { std::cos(0.37 * t), 0.41 + 0.1 * std::sin(t), 0.23 - 0.2 * std::cos(2 * t), 0.31 };
  double       length = 0;
  for (const double v : q)
  {
    length += v * v;
  }
  for (double & v : q)
  {
    v /= std::sqrt(length);
  }
  const double w = q[0];
  const double x = q[1];
  const double y = q[2];
  const double z = q[3];
  KnownGrid    grid;
  grid.axes = { { { 1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w) },
                  { 2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w) },
                  { 2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y) } } };
  grid.spacing = spacing;
  for (std::size_t i = 0; i < 3; ++i)
  {
    grid.shift[i] = spacing[i] * (0.13 + 0.29 * static_cast<double>(i));
    grid.size[i] = static_cast<std::int32_t>(std::ceil(2 * body.reach / spacing[i])) + 6;
  }
  return grid;
}

VoxelShape
Digitize(const KnownBody & body, const KnownGrid & grid)
{
  VoxelShape   shape(VoxelBox{ { 0, 0, 0 }, grid.size });
  const double step = 1 / grid.spacing[0];
#pragma omp parallel for schedule(dynamic)
  for (std::int32_t z = 0; z < grid.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < grid.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < grid.size[0];)
      {
        const double value = body.value(
          grid.ToBody({ (x + 0.5) * grid.spacing[0], (y + 0.5) * grid.spacing[1], (z + 0.5) * grid.spacing[2] }));
        // As far as the surface is away all voxels are alike.
        const auto run = static_cast<std::int32_t>(std::max(1.0, std::ceil(std::abs(value) * step * (1 - 1e-9))));
        const auto end = std::min(grid.size[0], x + run);
        for (; x < end; ++x)
        {
          if (value <= 0)
          {
            shape.Insert(x, y, z);
          }
        }
      }
    }
  }
  return CropToVoxels(shape);
}

double
PartInside(const KnownBody & body, const KnownGrid & grid, const std::array<std::int32_t, 3> & voxel)
{
  constexpr int parts = 6;
  const auto    at = [&](double i, double j, double k) {
    return body.value(grid.ToBody(
      { (voxel[0] + i) * grid.spacing[0], (voxel[1] + j) * grid.spacing[1], (voxel[2] + k) * grid.spacing[2] }));
  };
  const double value = at(0.5, 0.5, 0.5);
  if (std::abs(value) > 0.5 * std::hypot(grid.spacing[0], grid.spacing[1], grid.spacing[2]))
  {
    return value < 0 ? 1 : 0;
  }
  int in = 0;
  for (int i = 0; i < parts; ++i)
  {
    for (int j = 0; j < parts; ++j)
    {
      for (int k = 0; k < parts; ++k)
      {
        in += at((i + 0.5) / parts, (j + 0.5) / parts, (k + 0.5) / parts) <= 0 ? 1 : 0;
      }
    }
  }
  return static_cast<double>(in) / (parts * parts * parts);
}

} // namespace voxelcore::evaluation
