// Refined cores of walls: twice their radius is the wall's thickness.

#include "RefinedCores.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace voxelcore::testing
{
namespace
{

struct Wall
{
  Vector3 normal{};
  double  thickness = 0; // mm
};

Vector3
AnyDirection(std::mt19937_64 & generator)
{
  std::normal_distribution<double> normal;
  const Vector3                    n{ normal(generator), normal(generator), normal(generator) };
  const double                     length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  return { n[0] / length, n[1] / length, n[2] / length };
}

/** Mean and standard deviation of twice the radius less the thickness, away from the wall's rim. */
std::array<double, 2>
ThicknessError(const Wall & wall, const Spacing3 & spacing, std::mt19937_64 & generator)
{
  constexpr double                       rim = 12; // mm
  const double                           reach = rim + 8;
  const double                           middle = reach + wall.thickness;
  std::uniform_real_distribution<double> part(0, 1);
  Vector3                                centre{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centre[axis] = middle + part(generator) * spacing[axis];
  }
  const auto side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * middle / spacing[axis]) + 2; };
  // Across the wall and along it.
  const auto place = [&](const Vector3 & p) {
    double across = 0;
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double from = p[axis] * spacing[axis] - centre[axis];
      across += from * wall.normal[axis];
      squared += from * from;
    }
    return std::array{ across, std::sqrt(std::max(0.0, squared - across * across)) };
  };
  const VoxelShape    shape = ShapeWhere({ side(0), side(1), side(2) }, [&](int x, int y, int z) {
    const auto [across, along] = place({ x + 0.5, y + 0.5, z + 0.5 });
    return std::abs(across) <= wall.thickness / 2 && along < reach;
  });
  const MedialComplex core = Refine(shape, spacing, 0.4 * wall.thickness).core;
  double              count = 0;
  double              sum = 0;
  double              squares = 0;
  for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
  {
    if (place(core.positions[vertex])[1] < reach - rim)
    {
      const double error = 2 * core.radius[vertex] - wall.thickness;
      count += 1;
      sum += error;
      squares += error * error;
    }
  }
  const double mean = sum / count;
  return { mean, std::sqrt(std::max(0.0, squares / count - mean * mean)) };
}

TEST(RefineCore, TellsTheThicknessOfObliqueWallsWithinAnEighthOfAVoxel)
{
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64     generator(seed);
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.2 } })
  {
    const double voxel = std::cbrt(spacing[0] * spacing[1] * spacing[2]);
    for (double thickness = 4; thickness < 14; thickness += 1.75)
    {
      Wall wall{ {}, thickness * voxel };
      // Labels do not tell the thickness of walls along planes of the grid, nor nearly of those near them.
      const auto isOblique = [](const Vector3 & n) {
        std::array<double, 3> parts{ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) };
        std::sort(parts.begin(), parts.end());
        return parts[0] > 0.15 && parts[1] - parts[0] > 0.1 && parts[2] - parts[1] > 0.1;
      };
      do
      {
        wall.normal = AnyDirection(generator);
      } while (!isOblique(wall.normal));
      const auto [mean, deviation] = ThicknessError(wall, spacing, generator);
      EXPECT_LT(std::abs(mean), 0.15 * voxel) << thickness << ", seed " << seed;
      EXPECT_LT(deviation, 0.15 * voxel) << thickness << ", seed " << seed;
    }
  }
}

} // namespace
} // namespace voxelcore::testing
