#include "RefinedCores.h"

#include "voxelcore/Refinement/RadiusMargin.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <random>

namespace voxelcore::testing
{
namespace
{

struct Off
{
  double radius; ///< less half the wall's thickness
  double margin;
};

/** Of a round plate drawn somewhere across a direction, away from its rim; mm. */
std::vector<Off>
OffOfPlate(Vector3 normal, double thickness, const Spacing3 & spacing, std::mt19937_64 & generator)
{
  constexpr double rim = 12;
  const double     reach = rim + 6;
  const double     middle = reach + thickness;
  const double     length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  std::uniform_real_distribution<double> part(0, 1);
  Vector3                                centre{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    centre[axis] = middle + part(generator) * spacing[axis];
    normal[axis] /= length;
  }
  const auto side = [&](std::size_t axis) { return static_cast<std::int32_t>(2 * middle / spacing[axis]) + 2; };
  const auto place = [&](const Vector3 & p) {
    double across = 0;
    double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double from = p[axis] * spacing[axis] - centre[axis];
      across += from * normal[axis];
      squared += from * from;
    }
    return std::array{ across, std::sqrt(std::max(0.0, squared - across * across)) };
  };
  const VoxelShape          shape = ShapeWhere({ side(0), side(1), side(2) }, [&](int x, int y, int z) {
    const auto [across, along] = place({ x + 0.5, y + 0.5, z + 0.5 });
    return std::abs(across) <= thickness / 2 && along < reach;
  });
  const MedialComplex       core = Refine(shape, spacing, 0.4 * thickness).core;
  const std::vector<double> margins = RadiusMargins(core, shape, spacing);
  EXPECT_EQ(margins.size(), core.positions.size());
  std::vector<Off> all;
  for (std::size_t vertex = 0; vertex < core.positions.size(); ++vertex)
  {
    if (place(core.positions[vertex])[1] < reach - rim)
    {
      all.push_back({ core.radius[vertex] - thickness / 2, margins[vertex] });
    }
  }
  EXPECT_FALSE(all.empty());
  return all;
}

TEST(RadiusMargins, HoldTheThicknessOfPlatesAlongPlanesOfTheLattice)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64                        generator(seed);
  std::uniform_real_distribution<double> thicknesses(4, 9);
  for (const Spacing3 & spacing : { Spacing3{ 1, 1, 1 }, Spacing3{ 0.8, 0.8, 1.2 } })
  {
    for (const Vector3 & steps : { Vector3{ 1, 0, 0 }, { 0, 0, 1 }, { 1, 1, 0 }, { 0, 1, -1 }, { 1, 1, 1 } })
    {
      // A plane of the lattice, and how far such planes are apart.
      const Vector3 normal{ steps[0] / spacing[0], steps[1] / spacing[1], steps[2] / spacing[2] };
      const double  apart = 1 / std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      for (int k = 0; k < 3; ++k)
      {
        double most = 0;
        for (const Off & off : OffOfPlate(normal, thicknesses(generator), spacing, generator))
        {
          EXPECT_LE(std::abs(off.radius), off.margin + 0.03) << seed; // places are found as closely
          most = std::max(most, off.margin);
        }
        // Labels leave each side the way from one plane to the next.
        EXPECT_LE(most, apart + 0.03) << seed;
        EXPECT_GE(most, 0.4 * apart) << seed;
      }
    }
  }
}

TEST(RadiusMargins, AreSmallOnObliquePlates)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64                        generator(seed);
  std::uniform_real_distribution<double> part(0, 1);
  for (int k = 0; k < 4; ++k)
  {
    const Vector3 normal{ 0.25 + 0.05 * part(generator), 0.55 + 0.05 * part(generator), 0.8 };
    double        sum = 0;
    const auto    all = OffOfPlate(normal, 4 + 5 * part(generator), { 1, 1, 1 }, generator);
    for (const Off & off : all)
    {
      sum += off.margin;
    }
    EXPECT_LT(sum / static_cast<double>(all.size()), 0.2) << seed; // of a hundred plates at most 0.14
  }
}

TEST(RadiusMargins, OfCurvesAndOfNothingAreZero)
{
  const VoxelShape rod =
    ShapeWhere({ 24, 5, 5 }, [](int x, int y, int z) { return x > 1 && x < 22 && y > 0 && y < 4 && z > 0 && z < 4; });
  const MedialComplex core = Refine(rod, { 1, 1, 1 }, 1.8).core;
  ASSERT_GT(core.cells.vertexCount, 0U);
  ASSERT_EQ(core.cells.FaceCount(), 0U);
  EXPECT_EQ(RadiusMargins(core, rod, { 1, 1, 1 }), std::vector<double>(core.cells.vertexCount, 0));
  EXPECT_TRUE(RadiusMargins({}, rod, { 1, 1, 1 }).empty());
}

} // namespace
} // namespace voxelcore::testing
