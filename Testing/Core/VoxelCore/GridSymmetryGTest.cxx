// The core belongs to the shape, not to the way it lies on the grid or in its image.

#include "VoxelCoreTesting/Cores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace voxelcore
{
namespace
{

using testing::CoreOf;
using testing::Random;
using testing::RandomShape;
using testing::ShapeWhere;
using testing::Size3;
using testing::Spacing3;

// Axis a of the image is axis from[a] of the original, turned round where flip[a].
struct Symmetry
{
  std::array<std::size_t, 3> from{ 0, 1, 2 };
  std::array<bool, 3>        flip{ false, false, false };
};

std::vector<Symmetry>
AllSymmetries()
{
  std::vector<Symmetry> all;
  Symmetry              symmetry;
  do
  {
    for (unsigned flips = 0; flips < 8; ++flips)
    {
      symmetry.flip = { (flips & 1) != 0, (flips & 2) != 0, (flips & 4) != 0 };
      all.push_back(symmetry);
    }
  } while (std::next_permutation(symmetry.from.begin(), symmetry.from.end()));
  return all;
}

VoxelShape
Apply(const Symmetry & symmetry, const VoxelShape & shape)
{
  const Size3 & size = shape.Box().size;
  const Size3   image{ size[symmetry.from[0]], size[symmetry.from[1]], size[symmetry.from[2]] };
  return ShapeWhere(image, [&](int x, int y, int z) {
    const Size3 at{ x, y, z };
    Size3       original{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      original[symmetry.from[axis]] = symmetry.flip[axis] ? image[axis] - 1 - at[axis] : at[axis];
    }
    return shape.Contains(original[0], original[1], original[2]);
  });
}

// A place to 2^-24 of a voxel: distinct centres in small shapes lie much farther apart, and rounding is much finer.
using Place = std::array<std::int64_t, 3>;

// Everything a core says, in a form that does not know the numbering.
struct Content
{
  std::map<Place, std::array<double, 2>>               vertices; // radius and measure
  std::map<std::set<Place>, double>                    edges;
  std::map<std::set<Place>, double>                    faces;
  std::map<std::set<Place>, std::set<std::set<Place>>> sides; // of each face
};

// The content of a core, taken back by the symmetry that made its shape.
Content
ContentOf(const MedialComplex & core, const Symmetry & symmetry, const Size3 & imageSize)
{
  std::vector<Place> places(core.cells.vertexCount);
  Content            content;
  for (std::size_t v = 0; v < places.size(); ++v)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double at = core.positions[v][axis];
      places[v][symmetry.from[axis]] = std::llround((symmetry.flip[axis] ? imageSize[axis] - at : at) * 0x1p24);
    }
    content.vertices[places[v]] = { core.radius[v], core.vertexLambda[v] };
  }
  const auto ends = [&](ElementIndex edge) {
    return std::set<Place>{ places[core.cells.edges[edge][0]], places[core.cells.edges[edge][1]] };
  };
  for (std::size_t edge = 0; edge < core.cells.edges.size(); ++edge)
  {
    content.edges[ends(static_cast<ElementIndex>(edge))] = core.edgeLambda[edge];
  }
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    std::set<Place> corners;
    for (const ElementIndex vertex : core.cells.FaceVertices(face))
    {
      corners.insert(places[vertex]);
    }
    content.faces[corners] = core.faceLambda[face];
    for (const ElementIndex edge : core.cells.FaceEdges(face))
    {
      content.sides[corners].insert(ends(edge));
    }
  }
  // Nothing may have coincided.
  EXPECT_EQ(content.vertices.size(), core.cells.vertexCount);
  EXPECT_EQ(content.edges.size(), core.cells.edges.size());
  EXPECT_EQ(content.faces.size(), core.cells.FaceCount());
  return content;
}

void
ExpectSameContentUnder(const std::vector<Symmetry> & symmetries, const VoxelShape & shape, const Spacing3 & spacing)
{
  const Content original = ContentOf(CoreOf(shape, spacing), Symmetry{}, shape.Box().size);
  for (const Symmetry & symmetry : symmetries)
  {
    SCOPED_TRACE(::testing::Message() << "axes from " << symmetry.from[0] << symmetry.from[1] << symmetry.from[2]
                                      << ", flipped " << symmetry.flip[0] << symmetry.flip[1] << symmetry.flip[2]);
    const VoxelShape image = Apply(symmetry, shape);
    const Spacing3   imageSpacing{ spacing[symmetry.from[0]], spacing[symmetry.from[1]], spacing[symmetry.from[2]] };
    const Content    content = ContentOf(CoreOf(image, imageSpacing), symmetry, image.Box().size);
    ASSERT_TRUE(content.vertices == original.vertices);
    ASSERT_TRUE(content.edges == original.edges);
    ASSERT_TRUE(content.faces == original.faces);
    ASSERT_TRUE(content.sides == original.sides);
  }
}

TEST(GridSymmetry, AllFortyEightGiveTheSameCoreOfCubes)
{
  const auto symmetries = AllSymmetries();
  ASSERT_EQ(symmetries.size(), 48U);
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
  {
    Random           random(seed);
    const VoxelShape shape = RandomShape(random,
                                         { 5, static_cast<std::int32_t>(random.Between(3, 7)), 6 },
                                         0.1 + 0.07 * static_cast<double>(seed));
    SCOPED_TRACE("seed " + std::to_string(seed));
    ASSERT_NO_FATAL_FAILURE(ExpectSameContentUnder(symmetries, shape, { 1, 1, 1 }));
  }
  ASSERT_NO_FATAL_FAILURE(ExpectSameContentUnder(symmetries, testing::Ellipsoid(18), { 0.7, 0.7, 0.7 }));
}

TEST(GridSymmetry, SixteenKeepAGridOfThickSlices)
{
  std::vector<Symmetry> symmetries = AllSymmetries();
  std::erase_if(symmetries, [](const Symmetry & s) { return s.from[2] != 2; });
  ASSERT_EQ(symmetries.size(), 16U);
  for (std::uint64_t seed = 21; seed <= 32; ++seed)
  {
    Random           random(seed);
    const VoxelShape shape = RandomShape(random, { 6, 5, 5 }, 0.1 + 0.07 * static_cast<double>(seed - 20));
    SCOPED_TRACE("seed " + std::to_string(seed));
    ASSERT_NO_FATAL_FAILURE(ExpectSameContentUnder(symmetries, shape, { 1, 1, 2 }));
  }
}

TEST(GridSymmetry, TurningTheSpacingsWithTheShapeGivesTheSameCore)
{
  Random           random(33);
  const VoxelShape shape = RandomShape(random, { 6, 5, 5 }, 0.7);
  ASSERT_NO_FATAL_FAILURE(ExpectSameContentUnder(AllSymmetries(), shape, { 2, 1, 3 }));
}

TEST(GridSymmetry, AWiderBoxChangesNoBit)
{
  for (std::uint64_t seed = 41; seed <= 80; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 3, 9);
    SCOPED_TRACE(volume.Describe());
    const Size3 &    size = volume.shape.Box().size;
    const VoxelShape padded =
      ShapeWhere({ size[0] + 70, size[1] + 5, size[2] + 3 },
                 [&](int x, int y, int z) { return volume.shape.Contains(x - 66, y - 2, z - 3); },
                 { -66, -2, -3 });
    const MedialComplex core = CoreOf(volume.shape, volume.spacing);
    ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(core, CoreOf(padded, volume.spacing)));
    ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(core, CoreOf(CropToVoxels(padded), volume.spacing)));
  }
}

TEST(GridSymmetry, AnotherPlaceInTheScanMovesThePositionsAlone)
{
  for (std::uint64_t seed = 81; seed <= 100; ++seed)
  {
    const testing::RandomVolume volume = testing::MakeRandomVolume(seed, 3, 9);
    SCOPED_TRACE(volume.Describe());
    const Size3      shift{ 100000, 300, 7 };
    const VoxelShape moved = ShapeWhere(
      volume.shape.Box().size,
      [&](int x, int y, int z) { return volume.shape.Contains(x, y, z); },
      shift);
    const MedialComplex a = CoreOf(volume.shape, volume.spacing);
    const MedialComplex b = CoreOf(moved, volume.spacing);
    ASSERT_NO_FATAL_FAILURE(testing::ExpectSameCore(a, b, false));
    for (std::size_t v = 0; v < a.cells.vertexCount; ++v)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(a.positions[v][axis] + shift[axis], b.positions[v][axis], 1e-10);
      }
    }
  }
}

} // namespace
} // namespace voxelcore
