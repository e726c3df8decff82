#include "Uses/Roots/RootScore.h"

#include "TurnedSurface.h"

namespace voxelcore::testing
{
namespace
{

TurnedSurface
TurnedOf(const VoxelShape & shape)
{
  return TurnSurface(SurfaceOf(shape), {});
}

TEST(TurnedSurface, IsTheSameInAllRotationsOfTheGrid)
{
  for (const char * kind : { "root", "porous", "gyroid", "ellipsoid", "tanglecube" })
  {
    SCOPED_TRACE(kind);
    constexpr std::int32_t n = 24;
    const VoxelShape       shape = PhantomShape(kind, n, 5);
    const MedialComplex    expected = TurnedOf(shape).surface;
    ASSERT_GT(expected.cells.FaceCount(), 0U);
    ForRotations(shape, n, [&](const VoxelShape & rotated) {
      const MedialComplex surface = TurnedOf(rotated).surface;
      ASSERT_TRUE(surface.positions == expected.positions);
      ASSERT_TRUE(surface.radius == expected.radius);
      ASSERT_TRUE(surface.cells.edges == expected.cells.edges);
      ASSERT_TRUE(surface.cells.faceOffsets == expected.cells.faceOffsets);
      ASSERT_TRUE(surface.cells.faceVertices == expected.cells.faceVertices);
      ASSERT_TRUE(surface.cells.faceEdges == expected.cells.faceEdges);
    });
  }
}

TEST(TurnedSurface, IsTheSurfaceUnderOtherNumbers)
{
  // Slices of 2 mm in a turned and shifted scan.
  ImageGeometry geometry;
  geometry.spacing = { 1, 1, 2 };
  geometry.origin = { -40, 7, 12.5 };
  geometry.direction = { 0, 0, 1, 0.6, -0.8, 0, 0.8, 0.6, 0 };
  MedialComplex surface = CoreOf(PhantomShape("porous", 24, 3), geometry.spacing);
  for (auto & position : surface.positions)
  {
    position = LatticeToPhysical(geometry, position);
  }
  const TurnedSurface turned = TurnSurface(surface, geometry);
  const CellComplex & cells = turned.surface.cells;
  ASSERT_EQ(cells.vertexCount, surface.cells.vertexCount);
  ASSERT_EQ(cells.edges.size(), surface.cells.edges.size());
  ASSERT_EQ(cells.FaceCount(), surface.cells.FaceCount());
  for (std::size_t edge = 0; edge < cells.edges.size(); ++edge)
  {
    std::array<ElementIndex, 2> ends{ turned.vertices[cells.edges[edge][0]], turned.vertices[cells.edges[edge][1]] };
    std::sort(ends.begin(), ends.end());
    ASSERT_EQ(ends, surface.cells.edges[turned.edges[edge]]);
    EXPECT_NEAR(
      Distance(turned.surface.positions[cells.edges[edge][0]], turned.surface.positions[cells.edges[edge][1]]),
      Distance(surface.positions[ends[0]], surface.positions[ends[1]]),
      1e-6);
  }
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    const auto                corners = cells.FaceVertices(face);
    const auto                sides = cells.FaceEdges(face);
    std::vector<ElementIndex> names;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      const ElementIndex next = corners[(i + 1) % corners.size()];
      ASSERT_EQ(cells.edges[sides[i]], (std::array{ std::min(corners[i], next), std::max(corners[i], next) }));
      names.push_back(turned.vertices[corners[i]]);
    }
    const auto                before = surface.cells.FaceVertices(turned.faces[face]);
    std::vector<ElementIndex> expected(before.begin(), before.end());
    std::sort(names.begin(), names.end());
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(names, expected);
  }
}

} // namespace
} // namespace voxelcore::testing
