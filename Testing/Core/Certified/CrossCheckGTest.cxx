#include "CrossCheck.h"

#include "voxelcore/Certified/Certified.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <functional>
#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

/** Three voxels in an L: cells, inner facets and facets on the boundary. */
VoxelShape
Ell()
{
  VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 2, 2, 1 } });
  shape.Insert(0, 0, 0);
  shape.Insert(1, 0, 0);
  shape.Insert(0, 1, 0);
  return shape;
}

DelaunayCells
CellsOfEll()
{
  const VoxelShape shape = Ell();
  return ComputeDelaunayCells(shape, BoundaryVertices(shape), ComputeSpacingWeights({ 1, 1, 1 }), Engine::Lattice);
}

TEST(FirstDifference, EqualAnswersHaveNone)
{
  EXPECT_EQ(FirstDifference(CellsOfEll(), CellsOfEll()), "");
  DelaunayCells other = CellsOfEll();
  std::swap(other.tetrahedra[0][0], other.tetrahedra[0][1]);
  EXPECT_EQ(FirstDifference(CellsOfEll(), other), "") << "which four points fix a sphere is the engine's choice";
}

TEST(FirstDifference, NamesEveryKindOfDamage)
{
  const auto damaged = [](const std::function<void(DelaunayCells &)> & damage) {
    DelaunayCells other = CellsOfEll();
    damage(other);
    EXPECT_NE(FirstDifference(other, CellsOfEll()), "");
    return FirstDifference(CellsOfEll(), other);
  };
  EXPECT_EQ(damaged([](DelaunayCells & cells) { cells.centres[1][2] = 0.75; }).find("centre of cell 1: lattice ("), 0U);
  EXPECT_EQ(damaged([](DelaunayCells & cells) {
              cells.facetCells[0][1] = kOutside;
            }).find("cells of facet 0: lattice (0, 1), tetgen (0, outside)"),
            0U);
  EXPECT_EQ(damaged([](DelaunayCells & cells) {
              std::swap(cells.facetPoints[0], cells.facetPoints[1]);
            }).find("points of facet 0: lattice ("),
            0U);
  EXPECT_EQ(damaged([](DelaunayCells & cells) {
              cells.facetCells.pop_back();
              cells.facetOffsets.pop_back();
            }).find("number of facets: lattice "),
            0U);
  EXPECT_EQ(damaged([](DelaunayCells & cells) {
              cells.tetrahedra.pop_back();
              cells.centres.pop_back();
            }),
            "number of cells: lattice 3, tetgen 2");
  DelaunayCells zero = CellsOfEll();
  DelaunayCells minus = CellsOfEll();
  zero.centres[0][0] = 0.0;
  minus.centres[0][0] = -0.0;
  EXPECT_NE(FirstDifference(zero, minus), "") << "equal values, other bits";
}

TEST(CrossCheck, GivesTheSameResultByEitherEngine)
{
  if (!HasEngine(Engine::TetGen))
  {
    GTEST_SKIP() << "a build without TetGen";
  }
  ImageGeometry geometry;
  geometry.size = { 2, 2, 1 };
  const auto compute = [&](Engine engine, bool crossCheck) {
    CertifiedRequest request;
    request.lambdas = { ParseLambda("0") };
    request.engine = engine;
    request.crossCheck = crossCheck;
    return ComputeCertified(Ell(), geometry, request).cores[0].core.core;
  };
  const MedialComplex plain = compute(Engine::Lattice, false);
  for (const Engine engine : { Engine::Auto, Engine::Lattice, Engine::TetGen })
  {
    const MedialComplex checked = compute(engine, true);
    EXPECT_EQ(checked.positions, plain.positions);
    EXPECT_EQ(checked.vertexLambda, plain.vertexLambda);
  }
}

} // namespace
} // namespace voxelcore
