#include "voxelcore/Delaunay/DelaunayCells.h"

#include "EngineFixture.h"

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Lattice/Predicates.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

namespace voxelcore
{
namespace
{

using testing::Box;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;

// A shape's cells with everything needed to judge them.
struct Case
{
  VoxelShape                              shape;
  SpacingWeights                          weights;
  std::vector<LatticePoint>               points;
  DelaunayCells                           cells;
  std::vector<CircumSphere>               spheres;
  std::vector<std::vector<std::uint32_t>> cellPoints; // sorted

  Case(Engine engine, const VoxelShape & itsShape, const testing::Spacing3 & spacing)
    : shape(itsShape)
    , weights(ComputeSpacingWeights(spacing))
    , points(BoundaryVertices(itsShape))
    , cells(ComputeDelaunayCells(itsShape, points, weights, engine))
    , cellPoints(cells.CellCount())
  {
    for (const auto & t : cells.tetrahedra)
    {
      spheres.push_back(MakeCircumSphere(points[t[0]], points[t[1]], points[t[2]], points[t[3]], weights));
    }
    for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
    {
      for (const std::uint32_t cell : cells.facetCells[facet])
      {
        if (cell != kOutside)
        {
          const auto polygon = cells.FacetPoints(facet);
          cellPoints.at(cell).insert(cellPoints.at(cell).end(), polygon.begin(), polygon.end());
        }
      }
    }
    for (auto & own : cellPoints)
    {
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
    }
  }
};

void
ExpectCanonicalOrder(const Case & c)
{
  const DelaunayCells & cells = c.cells;
  ASSERT_EQ(cells.centres.size(), cells.CellCount());
  ASSERT_EQ(cells.facetOffsets.size(), cells.FacetCount() + 1);
  ASSERT_EQ(cells.facetOffsets.back(), cells.facetPoints.size());
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    int sign = cell == 0 ? -1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_EQ(cells.centres[cell][axis], CentreCoordinate(c.spheres[cell], axis, c.weights));
      if (sign == 0)
      {
        sign = CompareCentreCoordinates(c.spheres[cell - 1], c.spheres[cell], axis, c.weights);
      }
    }
    ASSERT_EQ(sign, -1) << "cells " << cell - 1 << " and " << cell << " are out of order";
  }
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto polygon = cells.FacetPoints(facet);
    ASSERT_GE(polygon.size(), 3U);
    ASSERT_LT(cells.facetCells[facet][0], cells.facetCells[facet][1]);
    ASSERT_LT(cells.facetCells[facet][0], cells.CellCount());
    ASSERT_EQ(std::min_element(polygon.begin(), polygon.end()), polygon.begin());
    if (facet > 0)
    {
      const auto before = cells.FacetPoints(facet - 1);
      const auto key = [&](std::size_t f, std::span<const std::uint32_t> p) {
        return std::make_pair(cells.facetCells[f], std::vector<std::uint32_t>(p.begin(), p.end()));
      };
      ASSERT_LT(key(facet - 1, before), key(facet, polygon));
    }
  }
}

// Every boundary vertex lies outside the sphere or on it, and those on it are exactly the cell's own.
void
ExpectMaximalEmptySpheres(const Case & c)
{
  for (std::size_t cell = 0; cell < c.cells.CellCount(); ++cell)
  {
    ASSERT_GT(c.spheres[cell].det, 0);
    std::vector<std::uint32_t> on;
    for (std::uint32_t point = 0; point < c.points.size(); ++point)
    {
      const Int128 power = Power(c.spheres[cell], c.points[point], c.weights);
      ASSERT_GE(power, 0) << "boundary vertex " << point << " lies in the sphere of cell " << cell;
      if (power == 0)
      {
        on.push_back(point);
      }
    }
    ASSERT_EQ(on, c.cellPoints[cell]) << "cell " << cell;
  }
}

// Facets are plane, strictly convex, run counter-clockwise seen from outside cells[0], and support both their cells.
void
ExpectOrientedFacets(const Case & c)
{
  for (std::size_t facet = 0; facet < c.cells.FacetCount(); ++facet)
  {
    const auto        polygon = c.cells.FacetPoints(facet);
    const std::size_t n = polygon.size();
    const auto        corner = [&](std::size_t i) -> const LatticePoint & { return c.points[polygon[i % n]]; };
    for (std::size_t side = 0; side < 2; ++side)
    {
      const std::uint32_t cell = c.cells.facetCells[facet][side];
      if (cell == kOutside)
      {
        continue;
      }
      for (const std::uint32_t point : c.cellPoints[cell])
      {
        const bool own = std::find(polygon.begin(), polygon.end(), point) != polygon.end();
        for (std::size_t i = 0; i < n; ++i)
        {
          const Int128 volume = Orientation(corner(i), corner(i + 1), corner(i + 2), c.points[point]);
          const int    sign = (volume > 0) - (volume < 0);
          ASSERT_EQ(sign, own ? 0 : side == 0 ? -1 : 1) << "facet " << facet << ", cell " << cell;
        }
      }
    }
  }
}

// The facets of a cell close up to a sphere around a positive volume, and the volumes add up to the voxels.
void
ExpectClosedCellsThatFillTheShape(const Case & c)
{
  std::vector<Int128>                                            sixfoldVolume(c.cells.CellCount(), 0);
  std::vector<std::set<std::pair<std::uint32_t, std::uint32_t>>> sides(c.cells.CellCount());
  std::vector<std::int64_t>                                      facets(c.cells.CellCount(), 0);
  std::set<std::vector<std::uint32_t>>                           distinct;
  for (std::size_t facet = 0; facet < c.cells.FacetCount(); ++facet)
  {
    const auto                 polygon = c.cells.FacetPoints(facet);
    std::vector<std::uint32_t> sorted(polygon.begin(), polygon.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_TRUE(distinct.insert(sorted).second) << "facet " << facet << " is there twice";
    for (std::size_t side = 0; side < 2; ++side)
    {
      const std::uint32_t cell = c.cells.facetCells[facet][side];
      if (cell == kOutside)
      {
        continue;
      }
      ++facets[cell];
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const std::uint32_t u = polygon[i];
        const std::uint32_t v = polygon[(i + 1) % polygon.size()];
        ASSERT_TRUE(sides[cell].insert(side == 0 ? std::pair(u, v) : std::pair(v, u)).second);
        if (i > 0)
        {
          const Int128 part =
            Orientation(c.points[c.cellPoints[cell][0]], c.points[polygon[0]], c.points[u], c.points[v]);
          sixfoldVolume[cell] += side == 0 ? part : -part;
        }
      }
    }
  }
  Int128 total = 0;
  for (std::size_t cell = 0; cell < c.cells.CellCount(); ++cell)
  {
    for (const auto & [u, v] : sides[cell])
    {
      ASSERT_TRUE(sides[cell].contains({ v, u })) << "cell " << cell << " is open";
    }
    const auto corners = static_cast<std::int64_t>(c.cellPoints[cell].size());
    ASSERT_EQ(corners - static_cast<std::int64_t>(sides[cell].size()) / 2 + facets[cell], 2) << "cell " << cell;
    ASSERT_GT(sixfoldVolume[cell], 0) << "cell " << cell;
    total += sixfoldVolume[cell];
  }
  ASSERT_TRUE(total == 6 * static_cast<Int128>(c.shape.CountVoxels()));
}

// One boundary facet for each square between a voxel that is in and one that is out, and no other.
void
ExpectBoundarySquaresAsFacets(const Case & c)
{
  std::set<std::vector<LatticePoint>> expected;
  const auto & [lower, size] = c.shape.Box();
  for (std::int32_t z = lower[2]; z <= lower[2] + size[2]; ++z)
  {
    for (std::int32_t y = lower[1]; y <= lower[1] + size[1]; ++y)
    {
      for (std::int32_t x = lower[0]; x <= lower[0] + size[0]; ++x)
      {
        const bool in = c.shape.Contains(x, y, z);
        // Corners in lexicographic order.
        if (in != c.shape.Contains(x - 1, y, z))
        {
          expected.insert({ { x, y, z }, { x, y, z + 1 }, { x, y + 1, z }, { x, y + 1, z + 1 } });
        }
        if (in != c.shape.Contains(x, y - 1, z))
        {
          expected.insert({ { x, y, z }, { x, y, z + 1 }, { x + 1, y, z }, { x + 1, y, z + 1 } });
        }
        if (in != c.shape.Contains(x, y, z - 1))
        {
          expected.insert({ { x, y, z }, { x, y + 1, z }, { x + 1, y, z }, { x + 1, y + 1, z } });
        }
      }
    }
  }
  std::set<std::vector<LatticePoint>> found;
  for (std::size_t facet = 0; facet < c.cells.FacetCount(); ++facet)
  {
    if (c.cells.facetCells[facet][1] == kOutside)
    {
      std::vector<LatticePoint> square;
      for (const std::uint32_t point : c.cells.FacetPoints(facet))
      {
        square.push_back(c.points[point]);
      }
      std::sort(square.begin(), square.end());
      ASSERT_TRUE(found.insert(square).second);
    }
  }
  ASSERT_TRUE(found == expected) << found.size() << " boundary facets, " << expected.size() << " boundary squares";
}

void
ExpectAllOf(const Case & c)
{
  ASSERT_NO_FATAL_FAILURE(ExpectCanonicalOrder(c));
  ASSERT_NO_FATAL_FAILURE(ExpectMaximalEmptySpheres(c));
  ASSERT_NO_FATAL_FAILURE(ExpectOrientedFacets(c));
  ASSERT_NO_FATAL_FAILURE(ExpectClosedCellsThatFillTheShape(c));
  ASSERT_NO_FATAL_FAILURE(ExpectBoundarySquaresAsFacets(c));
}

TEST(DelaunayEngines, TheBestOneIsThere)
{
  EXPECT_TRUE(HasEngine(Engine::Auto));
}

// Whatever engine makes them, cells must have these properties, and they leave no freedom.
class DelaunayCellsOf : public testing::WithEngine
{};

INSTANTIATE_TEST_SUITE_P(Engines, DelaunayCellsOf, testing::AllEngines(), testing::EngineName);

TEST_P(DelaunayCellsOf, OfNothingAreNone)
{
  const DelaunayCells cells =
    ComputeDelaunayCells(VoxelShape(VoxelBox{ { 0, 0, 0 }, { 4, 4, 4 } }), {}, SpacingWeights{}, GetParam());
  EXPECT_EQ(cells.CellCount(), 0U);
  EXPECT_EQ(cells.FacetCount(), 0U);
}

TEST_P(DelaunayCellsOf, AVoxelIsOneCellWithSixSquares)
{
  for (const auto & spacing : testing::TestSpacings())
  {
    const Case c(GetParam(), Box({ 1, 1, 1 }, { 7, 8, 9 }), spacing);
    ASSERT_EQ(c.cells.CellCount(), 1U);
    EXPECT_EQ(c.cells.FacetCount(), 6U);
    EXPECT_EQ(c.cellPoints[0].size(), 8U);
    EXPECT_EQ(c.cells.centres[0], (std::array<double, 3>{ 7.5, 8.5, 9.5 }));
    ExpectAllOf(c);
  }
}

TEST_P(DelaunayCellsOf, ARodIsOneCellAVoxel)
{
  const Case c(GetParam(), Box({ 1, 1, 5 }), { 1, 1, 2 });
  EXPECT_EQ(c.cells.CellCount(), 5U);
  EXPECT_EQ(c.cells.FacetCount(), 22U + 4U);
  ExpectAllOf(c);
}

TEST_P(DelaunayCellsOf, ABlockOfTwoVoxelsASideIsOneCell)
{
  // Twenty-six boundary vertices; the sphere about the middle passes the eight corners only when nothing is nearer:
  // the six centres of sides are, so the cell about the middle is the octahedron they make.
  const Case                  c(GetParam(), Box({ 2, 2, 2 }), { 1, 1, 1 });
  const std::array<double, 3> middle{ 1, 1, 1 };
  const auto                  at = std::find(c.cells.centres.begin(), c.cells.centres.end(), middle);
  ASSERT_NE(at, c.cells.centres.end());
  EXPECT_EQ(c.cellPoints[static_cast<std::size_t>(at - c.cells.centres.begin())].size(), 6U);
  ExpectAllOf(c);
}

TEST_P(DelaunayCellsOf, TwoVoxelsAlongAnEdgeHaveNoCommonFacet)
{
  const Case c(GetParam(), ShapeWhere({ 2, 2, 1 }, [](int x, int y, int) { return x == y; }), { 1, 1, 1 });
  EXPECT_EQ(c.cells.CellCount(), 2U);
  EXPECT_EQ(c.cells.FacetCount(), 12U);
  ExpectAllOf(c);
}

TEST_P(DelaunayCellsOf, FillRandomShapesWithMaximalEmptySpheres)
{
  constexpr std::uint64_t firstSeed = 5000;
  std::cout << "seeds from " << firstSeed << '\n';
  for (std::uint64_t seed = firstSeed; seed < firstSeed + 300; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 1, 8);
    SCOPED_TRACE(volume.Describe());
    ASSERT_NO_FATAL_FAILURE(ExpectAllOf(Case(GetParam(), volume.shape, volume.spacing)));
  }
}

TEST_P(DelaunayCellsOf, FillSmoothAndThickShapesWithMaximalEmptySpheres)
{
  for (const auto & spacing : testing::TestSpacings())
  {
    ASSERT_NO_FATAL_FAILURE(ExpectAllOf(Case(GetParam(), testing::Ellipsoid(20), spacing)));
    ASSERT_NO_FATAL_FAILURE(ExpectAllOf(Case(GetParam(), Box({ 9, 8, 7 }), spacing)));
  }
}

TEST_P(DelaunayCellsOf, DoNotDependOnThePlace)
{
  Random           random(91);
  const VoxelShape shape = RandomShape(random, { 7, 6, 5 }, 0.6);
  const VoxelShape moved =
    ShapeWhere({ 7, 6, 5 }, [&](int x, int y, int z) { return shape.Contains(x, y, z); }, { 500000, 300000, 1000 });
  const Case a(GetParam(), shape, { 3, 3, 7 });
  const Case b(GetParam(), moved, { 3, 3, 7 });
  EXPECT_EQ(a.cells.facetCells, b.cells.facetCells);
  EXPECT_EQ(a.cells.facetOffsets, b.cells.facetOffsets);
  EXPECT_EQ(a.cells.facetPoints, b.cells.facetPoints);
  ExpectAllOf(b);
}

TEST_P(DelaunayCellsOf, BeyondTheExactRangeAreRefused)
{
  // Two voxels, 2^25 steps apart.
  VoxelShape far(VoxelBox{ { 0, 0, 0 }, { 1 << 25, 1, 1 } });
  far.Insert(0, 0, 0);
  far.Insert((1 << 25) - 1, 0, 0);
  EXPECT_THROW(ComputeDelaunayCells(far, BoundaryVertices(far), SpacingWeights{}, GetParam()), InputError);
  VoxelShape wide(VoxelBox{ { 0, 0, 0 }, { 1 << 20, 1, 1 } });
  wide.Insert(0, 0, 0);
  wide.Insert((1 << 20) - 1, 0, 0);
  SpacingWeights heavy;
  heavy.weight = { 4096, 1, 1 };
  EXPECT_THROW(ComputeDelaunayCells(wide, BoundaryVertices(wide), heavy, GetParam()), InputError);
  EXPECT_EQ(ComputeDelaunayCells(wide, BoundaryVertices(wide), SpacingWeights{}, GetParam()).CellCount(), 2U);
}

} // namespace
} // namespace voxelcore
