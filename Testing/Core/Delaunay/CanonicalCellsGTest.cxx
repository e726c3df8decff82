#include "SameCells.h"
#include "VoxelCoreTesting/ExactNumbers.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Delaunay/CanonicalCells.h"
#include "voxelcore/Lattice/Predicates.h"
#include "voxelcore/Lattice/SpacingWeights.h"

#include <algorithm>
#include <iostream>
#include <numeric>
#include <random>

namespace voxelcore::testing
{
namespace
{

/** A shape's cells as they come from an engine. */
struct Answer
{
  VoxelShape                shape;
  std::vector<LatticePoint> points;
  SpacingWeights            weights;
  DelaunayCells             cells;

  explicit Answer(const RandomVolume & volume)
    : shape(volume.shape)
    , points(BoundaryVertices(volume.shape))
    , weights(ComputeSpacingWeights(volume.spacing))
    , cells(ComputeDelaunayCells(volume.shape, points, weights, Engine::Lattice))
  {}
};

template <typename T>
void
Shuffle(Random & random, std::vector<T> & items)
{
  for (std::size_t i = items.size(); i > 1; --i)
  {
    std::swap(items[i - 1], items[static_cast<std::size_t>(random.Between(0, static_cast<std::int64_t>(i) - 1))]);
  }
}

/** The same cells under other numbers: facets in any order, from either side, polygons from any corner, and facets that
 *  no cell has among them. */
DelaunayCells
Disorder(const Answer & answer, Random & random)
{
  const DelaunayCells &      cells = answer.cells;
  std::vector<std::uint32_t> number(cells.CellCount());
  std::iota(number.begin(), number.end(), 0U);
  Shuffle(random, number);
  DelaunayCells raw;
  raw.tetrahedra.resize(cells.CellCount());
  for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
  {
    std::vector<std::uint32_t> corners(cells.tetrahedra[cell].begin(), cells.tetrahedra[cell].end());
    Shuffle(random, corners);
    std::copy(corners.begin(), corners.end(), raw.tetrahedra[number[cell]].begin());
  }
  std::vector<std::size_t> order(cells.FacetCount());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  Shuffle(random, order);
  for (const std::size_t facet : order)
  {
    const auto                 given = cells.FacetPoints(facet);
    std::vector<std::uint32_t> polygon(given.begin(), given.end());
    if (random.Chance(0.1))
    {
      raw.facetCells.push_back({ kOutside, kOutside });
      raw.facetPoints.insert(raw.facetPoints.end(), polygon.begin(), polygon.end());
      raw.facetOffsets.push_back(raw.facetPoints.size());
    }
    auto pair = cells.facetCells[facet];
    pair[0] = number[pair[0]];
    pair[1] = pair[1] == kOutside ? kOutside : number[pair[1]];
    if (pair[1] != kOutside && random.Chance(0.5))
    {
      std::swap(pair[0], pair[1]);
      std::reverse(polygon.begin(), polygon.end());
    }
    std::rotate(polygon.begin(),
                polygon.begin() + random.Between(0, static_cast<std::int64_t>(polygon.size()) - 1),
                polygon.end());
    raw.facetCells.push_back(pair);
    raw.facetPoints.insert(raw.facetPoints.end(), polygon.begin(), polygon.end());
    raw.facetOffsets.push_back(raw.facetPoints.size());
  }
  return raw;
}

/** Calls check(answer, random) for random volumes from a seed on. */
template <typename TCheck>
void
ForAnswers(std::uint64_t firstSeed, TCheck check)
{
  std::cout << "seeds from " << firstSeed << '\n';
  for (const RandomVolume & volume : RandomVolumes(firstSeed, 40))
  {
    SCOPED_TRACE(volume.Describe());
    Random random(volume.seed);
    ASSERT_NO_FATAL_FAILURE(check(Answer(volume), random));
  }
}

TEST(CanonicalCells, AreTheSameWhateverTheOrderOfWhatCameIn)
{
  ForAnswers(4400, [](const Answer & answer, Random & random) {
    ExpectSameCells(MakeCanonical(Disorder(answer, random), answer.points, answer.weights), answer.cells);
  });
}

TEST(CanonicalCells, ThousandsAreTheSameWithAnyNumberOfThreads)
{
  RandomVolume volume;
  Random       random(5);
  volume.shape = RandomShape(random, { 34, 34, 34 }, 0.8);
  volume.spacing = { 1, 1, 2 };
  const Answer answer(volume);
  ASSERT_GT(answer.cells.CellCount(), 20000U) << "enough for several threads";
  for (const int count : { 1, 3 })
  {
    const Threads       threads(count);
    const DelaunayCells raw = Disorder(answer, random);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCells(MakeCanonical(raw, answer.points, answer.weights), answer.cells));
  }
}

/** The same cells without the facets on the boundary, which are sides of voxels. */
DelaunayCells
WithoutBoundary(const Answer & answer)
{
  const auto &  w = answer.weights.weight;
  const bool    areAlike = w[0] == w[1] && w[1] == w[2];
  DelaunayCells left = answer.cells;
  left.centres.clear();
  left.facetCells.clear();
  left.facetOffsets.resize(1);
  left.facetPoints.clear();
  left.voxelSides.assign(left.CellCount(), 0);
  for (std::size_t facet = 0; facet < answer.cells.FacetCount(); ++facet)
  {
    const auto   polygon = answer.cells.FacetPoints(facet);
    const auto & pair = answer.cells.facetCells[facet];
    if (pair[1] == kOutside)
    {
      const LatticePoint & a = answer.points[polygon[0]];
      const LatticePoint & b = answer.points[polygon[2]];
      left.voxelSides[pair[0]] |= areAlike || a.x == b.x ? 1 : a.y == b.y ? 2 : 4;
      continue;
    }
    left.facetCells.push_back(pair);
    left.facetPoints.insert(left.facetPoints.end(), polygon.begin(), polygon.end());
    left.facetOffsets.push_back(left.facetPoints.size());
  }
  return left;
}

void
ExpectInside(const Answer & answer, const DelaunayCells & expected)
{
  const DelaunayCells asked =
    ComputeDelaunayCells(answer.shape, answer.points, answer.weights, Engine::Lattice, {}, Facets::Inside);
  ASSERT_NO_FATAL_FAILURE(ExpectSameCells(asked, expected));
  ASSERT_TRUE(asked.voxelSides == expected.voxelSides);
}

TEST(CanonicalCells, FacetsOnTheBoundaryCanBeLeftOut)
{
  ForAnswers(4600, [](const Answer & answer, Random & random) {
    const DelaunayCells expected = WithoutBoundary(answer);
    const DelaunayCells left = MakeCanonical(Disorder(answer, random), answer.points, answer.weights, Facets::Inside);
    ASSERT_NO_FATAL_FAILURE(ExpectSameCells(left, expected));
    ASSERT_TRUE(left.voxelSides == expected.voxelSides);
    ASSERT_NO_FATAL_FAILURE(ExpectInside(answer, expected));
  });
}

TEST(CanonicalCells, FacetsOnTheBoundaryAreLeftOutOfDeepCellsOnSeveralThreads)
{
  for (const double thick : { 1.0, 2.0 })
  {
    RandomVolume volume;
    volume.shape = Ellipsoid(192);
    volume.spacing = { 1, 1, thick };
    const Answer answer(volume);
    ASSERT_GT(answer.points.size(), 60000U) << "enough for three threads";
    const DelaunayCells expected = WithoutBoundary(answer);
    for (const int count : { 1, 2, 3 })
    {
      const Threads threads(count);
      ASSERT_NO_FATAL_FAILURE(ExpectInside(answer, expected));
    }
  }
}

TEST(CanonicalCells, CellsAreSortedByTheirExactCentres)
{
  constexpr std::uint64_t firstSeed = 4500;
  std::cout << "seeds from " << firstSeed << '\n';
  for (const RandomVolume & volume : RandomVolumes(firstSeed, 12))
  {
    SCOPED_TRACE(volume.Describe());
    const Answer        answer(volume);
    Random              random(volume.seed);
    const DelaunayCells raw = Disorder(answer, random);
    const auto          sorted = SortByCentre(raw, answer.points, answer.weights);
    ASSERT_EQ(sorted.size(), raw.CellCount());
    std::optional<BigVector> before;
    for (const std::uint32_t cell : sorted)
    {
      const auto &      t = raw.tetrahedra[cell];
      const std::array  corners{ answer.points[t[0]], answer.points[t[1]], answer.points[t[2]], answer.points[t[3]] };
      const CentredCell entry = CentreOfCorners(corners, answer.weights);
      const auto        centre = ExactCircumcentre({ corners.begin(), corners.end() }, answer.weights);
      ASSERT_TRUE(centre.has_value());
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_TRUE(IsNearestDouble(entry.centre[axis], (*centre)[axis]));
        ASSERT_LE(denominator((*centre)[axis]), BigInteger(static_cast<std::int64_t>(entry.denominator)));
      }
      ASSERT_TRUE(!before || *before < *centre) << "cell " << cell;
      before = centre;
    }
  }
}

TEST(CanonicalCells, TwoOfOneCentreAreRefusedWhereverTheyCome)
{
  const Answer answer(MakeRandomVolume(77, 4, 6));
  Random       random(77);
  for (const bool atTheEnd : { false, true })
  {
    DelaunayCells raw = Disorder(answer, random);
    const auto    twin = atTheEnd ? raw.tetrahedra.back() : raw.tetrahedra.front();
    raw.tetrahedra.push_back(twin);
    EXPECT_THROW(MakeCanonical(std::move(raw), answer.points, answer.weights), CertificateError) << atTheEnd;
  }
}

TEST(CanonicalCells, CentresAreTheExactOnesRoundedOnceHoweverFarApartTheCornersLie)
{
  std::mt19937_64 random(24);
  for (const std::int32_t reach : { 1, 3, 60, 1000, 100000 })
  {
    for (const SpacingWeights & weights :
         { ComputeSpacingWeights({ 1, 1, 1 }), ComputeSpacingWeights({ 0.5, 0.7, 2.5 }) })
    {
      std::uniform_int_distribution<std::int32_t> near(-reach, reach);
      for (int repetition = 0; repetition < 200; ++repetition)
      {
        std::array<LatticePoint, 4> corners{};
        for (LatticePoint & corner : corners)
        {
          corner = { near(random) + 5, near(random), near(random) + 900 };
        }
        if (Orientation(corners[0], corners[1], corners[2], corners[3]) == 0)
        {
          continue; // no cell
        }
        const CircumSphere sphere = MakeCircumSphere(corners[0], corners[1], corners[2], corners[3], weights);
        const CentredCell  found = CentreOfCorners(corners, weights);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          EXPECT_EQ(found.centre[axis], CentreCoordinate(sphere, axis, weights)) << reach;
        }
      }
    }
  }
}

TEST(CanonicalCells, CentresAreThoseOfTheirCornersWhateverCellsStandBesideThem)
{
  std::mt19937_64 random(25);
  for (const SpacingWeights & weights :
       { ComputeSpacingWeights({ 1, 1, 1 }), ComputeSpacingWeights({ 0.5, 0.7, 2.5 }) })
  {
    // Small cells, of which many are worked out at a time, among large ones and such far from the origin.
    std::vector<LatticePoint> points;
    DelaunayCells             raw;
    for (int cell = 0; cell < 1001; ++cell)
    {
      const std::int32_t                          reach = cell % 7 == 3 ? 1000 : cell % 5 == 2 ? 32 : 20;
      const std::int32_t                          away = cell % 11 == 6 ? (1 << 20) : 0;
      std::uniform_int_distribution<std::int32_t> near(-reach, reach);
      std::array<LatticePoint, 4>                 corners{};
      for (LatticePoint & corner : corners)
      {
        corner = { near(random) + 5, near(random) - away, near(random) + 900 };
      }
      if (Orientation(corners[0], corners[1], corners[2], corners[3]) != 0)
      {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), corners.begin(), corners.end());
        raw.tetrahedra.push_back({ first, first + 1, first + 2, first + 3 });
      }
    }
    const DelaunayCells cells = MakeCanonical(std::move(raw), points, weights);
    ASSERT_GT(cells.CellCount(), 900U);
    for (std::size_t cell = 0; cell < cells.CellCount(); ++cell)
    {
      const auto & t = cells.tetrahedra[cell];
      const auto   own = CentreOfCorners({ points[t[0]], points[t[1]], points[t[2]], points[t[3]] }, weights);
      ASSERT_EQ(cells.centres[cell], own.centre) << cell;
    }
  }
}

TEST(CanonicalCells, OfNothingAreNone)
{
  const DelaunayCells none = MakeCanonical({}, {}, ComputeSpacingWeights({ 1, 1, 1 }));
  EXPECT_EQ(none.CellCount(), 0U);
  EXPECT_EQ(none.FacetCount(), 0U);
  EXPECT_EQ(none.facetOffsets, (std::vector<std::uint64_t>{ 0 }));
}

} // namespace
} // namespace voxelcore::testing
