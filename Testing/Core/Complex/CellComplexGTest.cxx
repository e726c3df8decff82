#include "ComplexFixtures.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore::testing
{
namespace
{

TEST(CellComplex, CornersAreToldByTheEdges)
{
  std::size_t faces = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
  {
    CellComplex complex = RandomCubicalComplex(seed, 3, 30, 40);
    const bool  hasFaces = complex.FaceCount() > 0;
    ASSERT_TRUE(complex.HasCorners());
    for (std::size_t face = 0; face < complex.FaceCount(); ++face)
    {
      const auto                expected = complex.FaceVertices(face);
      std::vector<ElementIndex> corners(expected.size());
      FindCorners(complex, face, corners.data());
      ASSERT_TRUE(std::ranges::equal(corners, expected)) << "seed " << seed << ", face " << face;
      ++faces;
    }
    complex.faceVertices.clear();
    ASSERT_EQ(complex.HasCorners(), !hasFaces);
  }
  ASSERT_GT(faces, 100U);
}

TEST(CellComplex, CofacesAreCountedAndOneAloneIsNamed)
{
  std::size_t alone = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed)
  {
    const CellComplex complex = RandomCubicalComplex(seed, 3, 30, 40);
    const auto        ofVertices = CountVertexCofaces(complex);
    const auto        ofEdges = CountEdgeCofaces(complex);
    ASSERT_EQ(ofVertices.size(), complex.vertexCount);
    ASSERT_EQ(ofEdges.size(), complex.edges.size());
    for (ElementIndex vertex = 0; vertex < complex.vertexCount; ++vertex)
    {
      ElementIndex count = 0;
      ElementIndex last = 0;
      for (ElementIndex edge = 0; edge < complex.edges.size(); ++edge)
      {
        const bool holds = complex.edges[edge][0] == vertex || complex.edges[edge][1] == vertex;
        count += holds ? 1 : 0;
        last = holds ? edge : last;
      }
      ASSERT_EQ(ofVertices[vertex].count, count) << "seed " << seed;
      ASSERT_TRUE(count != 1 || ofVertices[vertex].exclusiveOr == last) << "seed " << seed;
    }
    for (ElementIndex edge = 0; edge < complex.edges.size(); ++edge)
    {
      ElementIndex count = 0;
      ElementIndex last = 0;
      for (ElementIndex face = 0; face < complex.FaceCount(); ++face)
      {
        const auto sides = complex.FaceEdges(face);
        const bool holds = std::find(sides.begin(), sides.end(), edge) != sides.end();
        count += holds ? 1 : 0;
        last = holds ? face : last;
      }
      ASSERT_EQ(ofEdges[edge].count, count) << "seed " << seed;
      ASSERT_TRUE(count != 1 || ofEdges[edge].exclusiveOr == last) << "seed " << seed;
      alone += count == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(alone, 100U);
}

TEST(CellComplex, OfTwoCofacesTheOneThatIsLeftIsNamed)
{
  const CellComplex complex = MakeComplex(4, { { 0, 1, 2 }, { 0, 2, 3 } });
  for (std::size_t edge = 0; edge < complex.edges.size(); ++edge)
  {
    Cofaces cofaces = CountEdgeCofaces(complex)[edge];
    if (cofaces.count == 2)
    {
      EXPECT_EQ(complex.edges[edge], (std::array<ElementIndex, 2>{ 0, 2 }));
      cofaces.Remove(0);
      EXPECT_EQ(cofaces.exclusiveOr, 1U);
      EXPECT_EQ(cofaces.count, 1U);
    }
  }
}

TEST(CellComplex, AFacesEdgesJoinItsCornersInTurn)
{
  for (const NamedComplex & known : KnownComplexes())
  {
    for (std::size_t face = 0; face < known.complex.FaceCount(); ++face)
    {
      const auto corners = known.complex.FaceVertices(face);
      const auto sides = known.complex.FaceEdges(face);
      ASSERT_EQ(corners.size(), sides.size()) << known.name;
      for (std::size_t i = 0; i < corners.size(); ++i)
      {
        const auto ends = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
        EXPECT_EQ(known.complex.edges[sides[i]], (std::array<ElementIndex, 2>{ ends.first, ends.second }))
          << known.name;
      }
    }
  }
}

} // namespace
} // namespace voxelcore::testing
