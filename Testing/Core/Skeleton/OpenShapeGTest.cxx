#include "voxelcore/Skeleton/OpenShape.h"

#include "TubeShapes.h"

#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/BoundaryVertices.h"

#include <cmath>
#include <limits>

namespace voxelcore::testing
{
namespace
{

/** Random places of a box around the shape. */
Vector3
PlaceIn(Random & random, const VoxelShape & shape, const ImageGeometry & geometry)
{
  Vector3 place{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    place[a] = shape.Box().lower[a] + random.Unit() * shape.Box().size[a];
  }
  return LatticeToPhysical(geometry, place);
}

TEST(OpenShape, HoldsASegmentWhereItHoldsAllOfItsPlaces)
{
  for (const RandomVolume & volume : RandomVolumes(8800, 20))
  {
    const ImageGeometry geometry = GridFromOrigin(volume.spacing);
    const OpenShape     open(volume.shape, geometry);
    Random              random(volume.seed);
    for (int i = 0; i < 50; ++i)
    {
      const Vector3 a = PlaceIn(random, volume.shape, geometry);
      const Vector3 b = AddScaled(a, 0.3, Minus(PlaceIn(random, volume.shape, geometry), a));
      EXPECT_EQ(open.Holds(a), LiesInOpenShape(volume.shape, PhysicalToLattice(geometry, a)));
      bool holds = true;
      for (int part = 0; part <= 200; ++part)
      {
        holds = holds && open.Holds(AddScaled(a, part / 200.0, Minus(b, a)));
      }
      EXPECT_TRUE(holds || !open.HoldsSegment(a, b)) << "seed " << volume.seed;
    }
  }
  const VoxelShape    box = Box({ 4, 4, 4 });
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  const OpenShape     open(box, geometry);
  EXPECT_TRUE(open.HoldsSegment({ 0.1, 0.1, 0.1 }, { 3.9, 3.9, 3.9 }));
  EXPECT_TRUE(open.HoldsSegment({ 1, 1, 1 }, { 3, 1, 1 })) << "along an edge of voxels that are in";
  EXPECT_FALSE(open.HoldsSegment({ 1, 1, 1 }, { 4, 1, 1 }));
  EXPECT_FALSE(open.HoldsSegment({ 1, 1, 0 }, { 3, 1, 0 })) << "along its boundary";
}

TEST(OpenShape, APlaceGoesAsFarAsItIsIn)
{
  const VoxelShape    box = Box({ 4, 4, 4 });
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 2 });
  const OpenShape     open(box, geometry);
  EXPECT_EQ(open.Towards({ 1, 1, 1 }, { 3, 2, 7 }), (Vector3{ 3, 2, 7 }));
  const Vector3 stopped = open.Towards({ 2, 2, 2 }, { 6, 2, 2 });
  EXPECT_TRUE(open.Holds(stopped));
  EXPECT_NEAR(stopped[0], 4, 1e-5);
  EXPECT_EQ(open.Towards({ -1, 2, 2 }, { -3, 2, 2 }), (Vector3{ -1, 2, 2 })) << "where no place is in";
}

TEST(OpenShape, TheDistanceIsThatToTheNearestBoundaryVertex)
{
  for (const RandomVolume & volume : RandomVolumes(8900, 20))
  {
    const ImageGeometry geometry = GridFromOrigin(volume.spacing);
    const OpenShape     open(volume.shape, geometry);
    const auto          boundary = BoundaryVertices(volume.shape);
    Random              random(volume.seed);
    for (int i = 0; i < 20; ++i)
    {
      const Vector3 place = PlaceIn(random, volume.shape, geometry);
      double        nearest = std::numeric_limits<double>::infinity();
      for (const LatticePoint & p : boundary)
      {
        const Vector3 at{ static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z) };
        nearest = std::min(nearest, Distance(place, LatticeToPhysical(geometry, at)));
      }
      const double slack = random.Unit();
      EXPECT_NEAR(open.DistanceToBoundary(place, nearest - slack, nearest + slack), nearest, 1e-9) << volume.seed;
      EXPECT_NEAR(open.DistanceToBoundary(place, 0, nearest + 0.5), nearest, 1e-9) << volume.seed;
      EXPECT_NEAR(open.DistanceToBoundary(place, nearest, nearest), nearest, 1e-9) << volume.seed;
    }
  }
}

TEST(OpenShape, OnlyPointsThatMovedAreMeasuredAnew)
{
  const VoxelShape    box = Box({ 9, 9, 9 });
  const ImageGeometry geometry = GridFromOrigin({ 1, 1, 1 });
  SkeletonGraph       graph;
  graph.positions = { { 4.5, 4.5, 4.5 }, { 4.5, 4.5, 3.5 } };
  graph.radius = { 4.7, std::sqrt(2 * 0.25 + 4.5 * 4.5) };
  graph.erosionThickness = { 0, 0 };
  SortBranches(graph, { { 0, 1 } }, false);
  const std::vector<Vector3> before{ { 4.5, 4.5, 4.5 }, { 4.5, 4.5, 4.5 } };
  MeasureBallsAnew(graph, before, 0, OpenShape(box, geometry));
  EXPECT_EQ(graph.radius[0], 4.7);
  EXPECT_DOUBLE_EQ(graph.radius[1], std::sqrt(2 * 0.25 + 3.5 * 3.5));
}

} // namespace
} // namespace voxelcore::testing
