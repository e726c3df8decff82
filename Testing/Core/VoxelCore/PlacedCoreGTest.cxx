#include "voxelcore/VoxelCore/PlacedCore.h"

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{
namespace
{

/** Axes turned by 30 degrees in their first plane; mirrored if asked. */
ImageGeometry
Turned(bool mirrored)
{
  ImageGeometry geometry;
  geometry.size = { 12, 12, 12 };
  geometry.spacing = { 0.5, 0.5, 2 };
  geometry.origin = { -40, 17, 3 };
  const double c = std::sqrt(3.0) / 2;
  geometry.direction = { c, -0.5, 0, 0.5, c, 0, 0, 0, mirrored ? -1.0 : 1.0 };
  return geometry;
}

TEST(PlacedCore, LiesWhereTheScansGeometrySaysAndKeepsAllElse)
{
  const MedialComplex core = CoreOf(Box({ 4, 5, 6 }), { 0.5, 0.5, 2 });
  const ImageGeometry geometry = Turned(false);
  const PlacedCore    placed = ToPhysical(core, geometry, 7);
  EXPECT_EQ(placed.label, 7);
  EXPECT_EQ(placed.component, 0);
  EXPECT_TRUE(placed.displacement.empty());
  ExpectSameCore(placed.core, core, false);
  for (std::size_t vertex = 0; vertex < core.cells.vertexCount; ++vertex)
  {
    EXPECT_EQ(placed.core.positions[vertex], LatticeToPhysical(geometry, core.positions[vertex]));
  }
}

/** A polygon's normal in the axes its positions have. */
std::array<double, 3>
NormalOf(const MedialComplex & core, std::size_t face)
{
  const auto            corners = core.cells.FaceVertices(face);
  const auto &          first = core.positions[corners[0]];
  std::array<double, 3> normal{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
  {
    const auto & a = core.positions[corners[i]];
    const auto & b = core.positions[corners[i + 1]];
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t l = (k + 1) % 3;
      const std::size_t m = (k + 2) % 3;
      normal[k] += (a[l] - first[l]) * (b[m] - first[m]) - (a[m] - first[m]) * (b[l] - first[l]);
    }
  }
  return normal;
}

TEST(PlacedCore, PolygonsKeepTheirCornersAndTheirNormalsWhereAxesAreMirrored)
{
  const MedialComplex core = CoreOf(Box({ 4, 5, 6 }), { 0.5, 0.5, 2 });
  for (const bool mirrored : { false, true })
  {
    const ImageGeometry geometry = Turned(mirrored);
    const MedialComplex placed = ToPhysical(core, geometry, 1).core;
    ASSERT_GT(placed.cells.FaceCount(), 10U);
    for (std::size_t face = 0; face < placed.cells.FaceCount(); ++face)
    {
      const auto corners = placed.cells.FaceVertices(face);
      const auto sides = placed.cells.FaceEdges(face);
      ASSERT_EQ(corners[0], core.cells.FaceVertices(face)[0]);
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const auto ends = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
        ASSERT_EQ(placed.cells.edges[sides[i]], (std::array<ElementIndex, 2>{ ends.first, ends.second }));
      }
      // The normal before, carried over as a direction from one boundary vertex to the other is: by axes and spacing.
      auto before = NormalOf(core, face);
      for (std::size_t k = 0; k < 3; ++k)
      {
        before[k] /=
          geometry.spacing[k]; // a normal in lattice coordinates is along the difference over squared weights
      }
      const auto after = NormalOf(placed, face);
      double     along = 0;
      for (std::size_t row = 0; row < 3; ++row)
      {
        for (std::size_t k = 0; k < 3; ++k)
        {
          along += after[row] * geometry.direction[3 * row + k] * before[k];
        }
      }
      EXPECT_GT(along, 0) << "face " << face << (mirrored ? ", mirrored" : "");
    }
  }
}

TEST(PlacedCore, ARemoteOriginIsRefused)
{
  ImageGeometry geometry = Turned(false);
  geometry.origin[0] = 1e15;
  EXPECT_THROW(ToPhysical(CoreOf(Box({ 2, 2, 2 })), geometry, 1), InputError);
}

} // namespace
} // namespace voxelcore::testing
