#include "voxelcore/Verification/BettiReduction.h"

#include "Core/Complex/ComplexFixtures.h"
#include "voxelcore/Complex/ComplexTopology.h"

#include <gtest/gtest.h>

#include <iostream>

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(BettiReduction, KnownComplexesHaveTheirTextbookNumbers)
{
  for (const NamedComplex & known : KnownComplexes())
  {
    SCOPED_TRACE(known.name);
    EXPECT_EQ(ReduceToTopologyNumbers(known.complex), known.expected);
  }
}

TEST(BettiReduction, SmallComplexesAgreeWithDenseRanks)
{
  std::cout << "seeds 1001 to 1400\n";
  for (std::uint32_t seed = 1001; seed <= 1400; ++seed)
  {
    const unsigned    facePercent = 10 + seed * 7 % 90;
    const CellComplex complex = seed % 2 == 0 ? RandomCubicalComplex(seed, 1 + seed % 3, facePercent, seed % 40)
                                              : RandomSimplicialComplex(seed, 1 + seed % 2, facePercent, seed % 40);
    ASSERT_EQ(ReduceToTopologyNumbers(complex), DenseTopology(complex)) << "seed " << seed;
  }
}

TEST(BettiReduction, LargerComplexesAgreeWithCollapsingAndUniting)
{
  std::cout << "seeds 1 to 60\n";
  for (std::uint32_t seed = 1; seed <= 60; ++seed)
  {
    const unsigned    facePercent = 15 + seed * 11 % 85;
    const CellComplex complex = seed % 2 == 0 ? RandomCubicalComplex(seed, 12, facePercent, seed % 30)
                                              : RandomSimplicialComplex(seed, 7, facePercent, seed % 30);
    ASSERT_EQ(ReduceToTopologyNumbers(complex), ComputeComplexTopology(complex)) << "seed " << seed;
  }
}

// A closed surface numbered at random is the worst order for a reduction by columns; it must still end soon.
TEST(BettiReduction, AGridOfAllSquaresHasACavityPerCube)
{
  const CellComplex complex = RandomCubicalComplex(1, 16, 100, 0);
  EXPECT_EQ(ReduceToTopologyNumbers(complex).betti, (std::array<std::int64_t, 3>{ 1, 0, 16 * 16 * 16 }));
}
