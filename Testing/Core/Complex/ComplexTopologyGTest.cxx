#include "Core/Complex/ComplexFixtures.h"
#include "voxelcore/Complex/ComplexTopology.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ComplexTopology, KnownComplexesHaveTheirTextbookNumbers)
{
  for (const NamedComplex & known : KnownComplexes())
  {
    SCOPED_TRACE(known.name);
    EXPECT_EQ(ComputeComplexTopology(known.complex), known.expected);
    EXPECT_EQ(DenseTopology(known.complex), known.expected);
  }
}

TEST(ComplexTopology, AFaceWithdrawnFromASphereOpensIt)
{
  const CellComplex    cube = CubeSurface();
  std::vector<Corners> polygons;
  for (std::size_t f = 1; f < cube.FaceCount(); ++f)
  {
    polygons.emplace_back(cube.FaceVertices(f).begin(), cube.FaceVertices(f).end());
  }
  EXPECT_EQ(ComputeComplexTopology(MakeComplex(8, polygons)), (TopologyNumbers{ 1, { 1, 0, 0 } }));
}

TEST(ComplexTopology, RandomComplexesAgreeWithDenseRanks)
{
  std::int64_t cavities = 0;
  std::int64_t loops = 0;
  for (std::uint32_t seed = 1; seed <= 400; ++seed)
  {
    const unsigned        facePercent = 10 + seed * 7 % 90;
    const CellComplex     complex = seed % 2 == 0 ? RandomCubicalComplex(seed, 1 + seed % 3, facePercent, seed % 40)
                                                  : RandomSimplicialComplex(seed, 1 + seed % 2, facePercent, seed % 40);
    const TopologyNumbers expected = DenseTopology(complex);
    ASSERT_EQ(ComputeComplexTopology(complex), expected) << "seed " << seed;
    ASSERT_EQ(expected.euler, expected.betti[0] - expected.betti[1] + expected.betti[2]) << "seed " << seed;
    loops += expected.betti[1];
    cavities += expected.betti[2];
  }
  std::cout << "seeds 1 to 400: " << loops << " loops, " << cavities << " cavities in all\n";
  EXPECT_GT(loops, 100);
  EXPECT_GT(cavities, 100);
}
