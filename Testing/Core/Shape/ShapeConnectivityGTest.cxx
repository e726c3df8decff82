#include "voxelcore/Shape/ShapeConnectivity.h"

#include "ContactPlaces.h"
#include "voxelcore/Shape/SimpleVoxel.h"
#include "voxelcore/Shape/TouchingPieces.h"

#include "VoxelCoreTesting/BruteShape.h"
#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <bitset>
#include <map>
#include <set>
#include <vector>

namespace voxelcore
{

// For readable failures.
void
PrintTo(const TopologyNumbers & numbers, std::ostream * out);

namespace
{

using testing::Box;
using testing::BruteComponents;
using testing::CountIn;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;
using testing::Size3;

/** The homology of the closed cells of the voxels over the field of two elements, by the ranks of the boundary maps:
 *  nothing but the definition. For boxes of up to 4 voxels a side. */
TopologyNumbers
ClosedHomology(const VoxelShape & shape)
{
  const auto & [lower, size] = shape.Box();
  const Size3           doubled{ 2 * size[0] + 1,
                       2 * size[1] + 1,
                       2 * size[2] + 1 }; // odd along the axes in which a cell extends
  const auto            number = [&](const Size3 & at) { return (at[2] * doubled[1] + at[1]) * doubled[0] + at[0]; };
  constexpr std::size_t most = 9 * 9 * 9;
  std::array<std::vector<std::bitset<most>>, 4> columns; // by dimension: the boundary of each cell
  for (std::int32_t z = 0; z < doubled[2]; ++z)
  {
    for (std::int32_t y = 0; y < doubled[1]; ++y)
    {
      for (std::int32_t x = 0; x < doubled[0]; ++x)
      {
        const Size3        at{ x, y, z };
        std::size_t        dimension = 0;
        std::bitset<most>  column;
        LatticePoint       low{ lower[0] + (x - 1) / 2, lower[1] + (y - 1) / 2, lower[2] + (z - 1) / 2 };
        const LatticePoint high{ lower[0] + x / 2, lower[1] + y / 2, lower[2] + z / 2 };
        low.x -= x == 0 ? 1 : 0; // (0 - 1) / 2 is 0
        low.y -= y == 0 ? 1 : 0;
        low.z -= z == 0 ? 1 : 0;
        if (CountIn(shape, low, high) == 0)
        {
          continue;
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          if (at[axis] % 2 == 1)
          {
            ++dimension;
            for (const std::int32_t step : { -1, 1 })
            {
              Size3 side = at;
              side[axis] += step;
              column.flip(static_cast<std::size_t>(number(side)));
            }
          }
        }
        columns[dimension].push_back(column);
      }
    }
  }
  std::array<std::int64_t, 5> rank{};
  for (std::size_t dimension = 1; dimension < 4; ++dimension)
  {
    std::vector<std::bitset<most>> reduced(most);
    for (std::bitset<most> column : columns[dimension])
    {
      for (std::size_t i = column._Find_first(); i < most; i = column._Find_first())
      {
        if (reduced[i].none())
        {
          reduced[i] = column;
          ++rank[dimension];
          break;
        }
        column ^= reduced[i];
      }
    }
  }
  TopologyNumbers numbers;
  for (std::size_t dimension = 0; dimension < 3; ++dimension)
  {
    numbers.betti[dimension] =
      static_cast<std::int64_t>(columns[dimension].size()) - rank[dimension] - rank[dimension + 1];
  }
  numbers.euler = numbers.betti[0] - numbers.betti[1] + numbers.betti[2];
  return numbers;
}

TEST(ShapeConnectivity, TheClosedUnionsNumbersAreThoseOfItsHomology)
{
  Random random(2101);
  for (int i = 0; i < 400; ++i)
  {
    const auto       side = [&] { return static_cast<std::int32_t>(random.Between(1, 4)); };
    const VoxelShape shape =
      RandomShape(random, { side(), side(), side() }, 0.05 * static_cast<double>(random.Between(1, 19)));
    EXPECT_EQ(ComputeClosedTopology(shape), ClosedHomology(shape)) << "shape " << i;
  }
}

TEST(ShapeConnectivity, TheClosedUnionsNumbersDoNotDependOnWhereItsVoxelsLieInWords)
{
  Random random(2102);
  for (int i = 0; i < 60; ++i)
  {
    const VoxelShape      shape = RandomShape(random, { 12, 5, 4 }, 0.05 * static_cast<double>(random.Between(1, 19)));
    const TopologyNumbers numbers = ComputeClosedTopology(shape);
    for (const std::int32_t before : { 1, 52, 53, 58, 116 })
    {
      for (const std::int32_t after : { 0, 1 })
      {
        const VoxelShape moved = ShapeWhere({ before + 12 + after, 5, 4 + after },
                                            [&](int x, int y, int z) { return shape.Contains(x - before, y, z); });
        EXPECT_EQ(ComputeClosedTopology(moved), numbers) << i << ", " << before;
      }
    }
  }
  EXPECT_EQ(ComputeClosedTopology(VoxelShape()), TopologyNumbers());
}

TEST(ShapeConnectivity, AVoxelOfTheComplementIsSimpleWhereItsCubeMeetsTheRestInADisk)
{
  // Faces, edges and corners of a cube, each with the voxels around the cube that hold it.
  std::vector<Neighbourhood>      cells;
  std::vector<std::array<int, 3>> places;
  for (int cell = 0; cell < 27; ++cell)
  {
    const std::array<int, 3> at{ cell % 3 - 1, cell / 3 % 3 - 1, cell / 9 - 1 };
    Neighbourhood            holders = 0;
    for (int voxel = 0; voxel < 27; ++voxel)
    {
      const std::array<int, 3> of{ voxel % 3 - 1, voxel / 3 % 3 - 1, voxel / 9 - 1 };
      bool                     holds = voxel != 13;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        holds = holds && (at[axis] == 0 ? of[axis] == 0 : of[axis] == 0 || of[axis] == at[axis]);
      }
      holders |= holds ? 1U << voxel : 0U;
    }
    if (cell != 13)
    {
      cells.push_back(holders);
      places.push_back(at);
    }
  }
  Random       random(2103);
  SimpleVoxels simple;
  int          count = 0;
  for (int i = 0; i < 300000; ++i)
  {
    Neighbourhood shape = static_cast<Neighbourhood>(random.Next()) & kAll27 & ~kCentre27;
    for (auto thinner = random.Between(0, 3); thinner > 0; --thinner)
    {
      shape &= static_cast<Neighbourhood>(random.Next());
    }
    std::uint32_t met = 0;
    int           euler = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
    {
      if ((cells[cell] & shape) != 0)
      {
        const auto & at = places[cell];
        met |= 1U << cell;
        euler += (std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2])) % 2 == 0 ? -1 : 1; // faces, edges, corners
      }
    }
    std::uint32_t piece = met & (~met + 1);
    for (std::uint32_t before = 0; before != piece;)
    {
      before = piece;
      for (std::size_t a = 0; a < cells.size(); ++a)
      {
        for (std::size_t b = 0; b < cells.size() && (piece >> a & 1U) != 0; ++b)
        {
          // One holds the other when the voxels around it are among the other's.
          const bool isFace = (cells[a] & cells[b]) == cells[a] || (cells[a] & cells[b]) == cells[b];
          piece |= isFace ? met & (1U << b) : 0U;
        }
      }
    }
    const bool isDisk = met != 0 && piece == met && euler == 1;
    count += isDisk ? 1 : 0;
    ASSERT_EQ(simple.IsSimple(~shape & kAll27), isDisk) << std::hex << shape;
  }
  EXPECT_GT(count, 10000);
}

TEST(ShapeConnectivity, PlacesThatAreNotWellComposedAreFoundInWords)
{
  Random random(2104);
  for (int i = 0; i < 40; ++i)
  {
    const std::int32_t wide = i % 2 == 0 ? 64 : static_cast<std::int32_t>(random.Between(1, 140));
    const VoxelShape   shape = RandomShape(random, { wide, 5, 6 }, 0.05 * static_cast<double>(random.Between(1, 19)));
    std::set<Size3>    wanted;
    const auto &       size = shape.Box().size;
    testing::VisitCorners(shape, [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      if (!IsWellComposed(shape.Around(x, y, z)) && x < size[0] && y < size[1] && z < size[2])
      {
        wanted.insert({ x, y, z });
      }
    });
    std::set<Size3> found;
    for (const Size3 & place : FindContacts(shape))
    {
      if (place[0] < size[0]) // those behind the last voxel are seen from their other end
      {
        found.insert(place);
      }
    }
    EXPECT_EQ(found, wanted) << i;
  }
}

/** Densities of 2 to 60 %. */
double
AnyDensity(Random & random)
{
  return 0.02 * static_cast<double>(random.Between(1, 30));
}

TEST(ShapeConnectivity, TheShapeHasTheTopologyOfTheClosedMaskOrItsPlacesAreNamed)
{
  Random random(2105);
  int    settled = 0;
  for (int i = 0; i < 300; ++i)
  {
    const auto           side = [&] { return static_cast<std::int32_t>(random.Between(2, 7)); };
    const VoxelShape     mask = RandomShape(random, { side(), side(), side() }, AnyDensity(random));
    const ConnectedShape connected = ConnectOverCorners(mask);
    if (!connected.left.empty())
    {
      for (const auto & [x, y, z] : connected.left)
      {
        EXPECT_FALSE(IsWellComposed(connected.shape.Around(x, y, z))) << "mask " << i;
      }
      continue;
    }
    ++settled;
    EXPECT_EQ(testing::BruteTopology(connected.shape), ComputeClosedTopology(mask)) << "mask " << i;
    std::uint64_t added = 0;
    std::uint64_t removed = 0;
    for (const VoxelRun & run : ChangesBetween(mask, connected.shape))
    {
      (run.isAdded ? added : removed) += static_cast<std::uint64_t>(run.length);
    }
    EXPECT_EQ(connected.voxelsAdded, added);
    EXPECT_EQ(connected.voxelsRemoved, removed);
  }
  EXPECT_GT(settled, 295);
}

TEST(ShapeConnectivity, NoChangeCouldBeTakenBack)
{
  Random random(2106);
  int    changes = 0;
  for (int i = 0; i < 60; ++i)
  {
    const VoxelShape     mask = RandomShape(random, { 6, 6, 6 }, 0.1);
    const ConnectedShape connected = ConnectOverCorners(mask);
    for (const VoxelRun & run : ChangesBetween(mask, connected.shape))
    {
      VoxelRun back{ !run.isAdded, run.first, 1 };
      for (; back.first[0] < run.first[0] + run.length; ++back.first[0])
      {
        Neighbourhood around = 0;
        for (std::int32_t bit = 0; bit < 27; ++bit)
        {
          const bool in = connected.shape.Contains(back.first[0] + bit % 3 - 1,
                                                   back.first[1] + bit / 3 % 3 - 1,
                                                   back.first[2] + bit / 9 - 1);
          around |= in ? 1U << bit : 0U;
        }
        EXPECT_FALSE(IsSimpleVoxel(around)) << "mask " << i;
        ++changes;
      }
    }
  }
  EXPECT_GT(changes, 500);
}

TEST(ShapeConnectivity, AWellComposedMaskStaysAsItIs)
{
  const VoxelShape     ball = testing::Ellipsoid(24);
  const ConnectedShape connected = ConnectOverCorners(Box({ 70, 5, 3 }, { -4, 2, 9 }));
  EXPECT_EQ(connected.voxelsAdded + connected.voxelsRemoved, 0U);
  EXPECT_EQ(connected.shape.CountVoxels(), 1050U);
  EXPECT_EQ(connected.shape.Box().lower, (Size3{ -4, 2, 9 }));
  EXPECT_EQ(ComputeShapeTopology(ConnectOverCorners(ball).shape), ComputeClosedTopology(ball));
  EXPECT_TRUE(ConnectOverCorners(VoxelShape()).left.empty());
}

TEST(ShapeConnectivity, ALineOfVoxelsOverCornersTakesTwoFillsAStep)
{
  const VoxelShape     line = ShapeWhere({ 9, 9, 9 }, [](int x, int y, int z) { return x == y && y == z; });
  const ConnectedShape connected = ConnectOverCorners(line);
  EXPECT_EQ(connected.voxelsAdded, 16U);
  EXPECT_EQ(connected.voxelsRemoved, 0U);
  EXPECT_EQ(ComputeShapeTopology(connected.shape), (TopologyNumbers{ 1, { 1, 0, 0 } }));
  const VoxelShape edges = ShapeWhere({ 9, 9, 1 }, [](int x, int y, int) { return x == y; });
  EXPECT_EQ(ConnectOverCorners(edges).voxelsAdded, 8U);
}

TEST(ShapeConnectivity, WhatIsNoPathStaysOpen)
{
  // Two columns that touch along an edge, on a floor: one piece, whether they are joined or not.
  const VoxelShape     shape = ShapeWhere({ 6, 6, 4 }, [](int x, int y, int z) {
    return z == 0 || (z == 1 && ((x == 2 && y == 2) || (x == 3 && y == 3)));
  });
  const ConnectedShape connected = ConnectOverCorners(shape);
  EXPECT_EQ(connected.voxelsAdded + connected.voxelsRemoved, 0U);
  // Two voxels high they touch above a gap of one voxel no more than below: still no loop.
  EXPECT_EQ(ComputeShapeTopology(connected.shape), ComputeClosedTopology(shape));
}

/** For each voxel the number of its 26-connected piece, by flooding. */
std::map<Size3, int>
PiecesByTouch(const VoxelShape & mask)
{
  const auto &         size = mask.Box().size;
  std::map<Size3, int> pieces;
  int                  count = 0;
  for (std::int32_t i = 0; i < size[0] * size[1] * size[2]; ++i)
  {
    std::vector<Size3> front{ { i % size[0], i / size[0] % size[1], i / size[0] / size[1] } };
    count += pieces.contains(front[0]) ? 0 : 1;
    while (!front.empty())
    {
      const Size3 at = front.back();
      front.pop_back();
      if (!mask.Contains(at[0], at[1], at[2]) || !pieces.emplace(at, count).second)
      {
        continue;
      }
      for (int k = 0; k < 27; ++k)
      {
        front.push_back({ at[0] + k % 3 - 1, at[1] + k / 3 % 3 - 1, at[2] + k / 9 - 1 });
      }
    }
  }
  return pieces;
}

TEST(ShapeConnectivity, PiecesThatTouchAreJoinedAndNothingElseChanges)
{
  Random random(2111);
  int    joined = 0;
  int    apart = 0;
  for (int i = 0; i < 100; ++i)
  {
    const VoxelShape mask = RandomShape(random, { 6, 70, 5 }, 0.01 * static_cast<double>(random.Between(1, 30)));
    if (mask.CountVoxels() == 0)
    {
      continue;
    }
    const auto         before = ComputeShapeTopology(mask).betti;
    const auto         touching = CountComponents26(mask);
    const auto         byTouch = PiecesByTouch(mask);
    const std::int64_t least = i % 3 == 0 ? random.Between(1, before[0]) : 1;
    const JoinedPieces made = JoinTouchingPieces(mask, least);
    const auto         after = ComputeShapeTopology(made.shape).betti;
    EXPECT_EQ(after[0], before[0] - static_cast<std::int64_t>(made.PiecesJoined())) << "mask " << i;
    EXPECT_EQ(after[1], before[1]) << "mask " << i;
    EXPECT_EQ(after[2], before[2]) << "mask " << i;
    for (const VoxelShape & piece : SplitComponents(made.shape))
    {
      std::set<int> numbers;
      for (const auto & [at, number] : byTouch)
      {
        if (piece.Contains(at[0], at[1], at[2]))
        {
          numbers.insert(number);
        }
      }
      EXPECT_EQ(numbers.size(), 1U) << "mask " << i << ": pieces that do not touch were joined";
    }
    EXPECT_GE(after[0], std::min(before[0], least));
    EXPECT_EQ(made.shape.CountVoxels(), mask.CountVoxels() + made.VoxelsAdded());
    EXPECT_LE(made.VoxelsAdded(), 2 * made.PiecesJoined());
    for (const JoinedPieces::Joint & joint : made.joints)
    {
      for (const auto & [x, y, z] : joint.voxels)
      {
        EXPECT_FALSE(mask.Contains(x, y, z));
        EXPECT_TRUE(made.shape.Contains(x, y, z));
      }
    }
    joined += static_cast<int>(made.PiecesJoined());
    apart += least == 1 ? static_cast<int>(after[0] - touching) : 0;
  }
  EXPECT_GT(joined, 1000);
  EXPECT_LT(apart, joined / 20) << "crowded places are left";
}

TEST(ShapeConnectivity, PiecesAreJoinedByTheFewestVoxels)
{
  const VoxelShape corners = ShapeWhere({ 9, 9, 9 }, [](int x, int y, int z) { return x == y && y == z; });
  EXPECT_EQ(JoinTouchingPieces(corners).VoxelsAdded(), 16U);
  EXPECT_EQ(JoinTouchingPieces(corners, 4).PiecesJoined(), 5U);
  const VoxelShape edges = ShapeWhere({ 9, 9, 1 }, [](int x, int y, int) { return x == y; });
  EXPECT_EQ(JoinTouchingPieces(edges).VoxelsAdded(), 8U);
  // Two bows that meet in two places are joined at one: no loop is made.
  const VoxelShape bows = ShapeWhere({ 6, 6, 1 }, [](int x, int y, int) {
    return ((x == 0 || x == 5) && y >= 1 && y <= 2) || (y == 0 && x >= 1 && x <= 4) || (y == 3 && x >= 1 && x <= 4);
  });
  ASSERT_EQ(ComputeShapeTopology(bows).betti[0], 4);
  const JoinedPieces one = JoinTouchingPieces(bows);
  EXPECT_EQ(one.VoxelsAdded(), 3U);
  EXPECT_EQ(ComputeShapeTopology(one.shape), (TopologyNumbers{ 1, { 1, 0, 0 } }));
  EXPECT_EQ(JoinTouchingPieces(VoxelShape()).PiecesJoined(), 0U);
}

TEST(ShapeConnectivity, ATurnedOrShiftedMaskGivesTheTurnedResult)
{
  Random random(2107);
  for (int i = 0; i < 40; ++i)
  {
    const VoxelShape mask = RandomShape(random, { 7, 6, 8 }, 0.02 * static_cast<double>(random.Between(1, 12)));
    if (mask.CountVoxels() < 5)
    {
      continue;
    }
    const VoxelShape wanted = ConnectOverCorners(mask).shape;
    const VoxelShape joined = JoinTouchingPieces(mask).shape;
    const auto       axis = static_cast<std::size_t>(random.Between(0, 2));
    const auto       next = (axis + 1 + static_cast<std::size_t>(random.Between(0, 1))) % 3;
    const auto       last = 3 - axis - next;
    const auto       backs = random.Between(0, 7);
    const Size3      shift{ 100, 3, 17 };
    const auto       turn = [&](const VoxelShape & shape) {
      VoxelShape turned(VoxelBox{ { shift[0] - 9, shift[1] - 9, shift[2] - 9 }, { 18, 18, 18 } });
      for (std::int32_t z = 0; z < 8; ++z)
      {
        for (std::int32_t y = 0; y < 6; ++y)
        {
          for (std::int32_t x = 0; x < 7; ++x)
          {
            if (shape.Contains(x, y, z))
            {
              const Size3 at{ x, y, z };
              Size3       to{ at[axis], at[next], at[last] };
              for (std::size_t k = 0; k < 3; ++k)
              {
                to[k] = shift[k] + ((backs >> k & 1) != 0 ? -to[k] : to[k]);
              }
              turned.Insert(to[0], to[1], to[2]);
            }
          }
        }
      }
      return turned;
    };
    EXPECT_TRUE(ChangesBetween(ConnectOverCorners(turn(mask)).shape, turn(wanted)).empty()) << "mask " << i;
    EXPECT_TRUE(ChangesBetween(JoinTouchingPieces(turn(mask)).shape, turn(joined)).empty()) << "mask " << i;
  }
}

} // namespace
} // namespace voxelcore
