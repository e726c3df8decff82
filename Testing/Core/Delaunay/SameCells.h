#pragma once
// The merged cells are unique: whatever computes them, and with however many threads, must agree to the last bit.

#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/Threads.h"

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

namespace voxelcore::testing
{

/** Compared as wholes: millions of numbers in a failure help nobody. */
inline void
ExpectSameCells(const DelaunayCells & a, const DelaunayCells & b)
{
  ASSERT_EQ(a.CellCount(), b.CellCount());
  ASSERT_EQ(a.FacetCount(), b.FacetCount());
  ASSERT_TRUE(a.centres == b.centres);
  ASSERT_TRUE(a.facetCells == b.facetCells);
  ASSERT_TRUE(a.facetOffsets == b.facetOffsets);
  ASSERT_TRUE(a.facetPoints == b.facetPoints);
}

/** By the lattice engine with 1, 2, 3 and 7 threads, and by TetGen where the build has it. Returns the cells. */
inline DelaunayCells
ExpectAgreement(const VoxelShape & shape, const SpacingWeights & weights)
{
  const auto points = BoundaryVertices(shape);
  const auto byLattice = [&](int threads) {
    const Threads now(threads);
    return ComputeDelaunayCells(shape, points, weights, Engine::Lattice);
  };
  DelaunayCells alone = byLattice(1);
  for (const int threads : { 2, 3, 7 })
  {
    SCOPED_TRACE(threads);
    ExpectSameCells(byLattice(threads), alone);
  }
  if (HasEngine(Engine::TetGen))
  {
    SCOPED_TRACE("TetGen");
    ExpectSameCells(ComputeDelaunayCells(shape, points, weights, Engine::TetGen), alone);
  }
  return alone;
}

inline void
ExpectAgreement(const RandomVolume & volume)
{
  SCOPED_TRACE(volume.Describe());
  ExpectAgreement(volume.shape, ComputeSpacingWeights(volume.spacing));
}

} // namespace voxelcore::testing
