#include "SkeletonFixtures.h"

namespace voxelcore::testing
{

namespace
{

TEST(CurveSkeleton, OneVoxelIsOnePoint)
{
  const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(Box({ 1, 1, 1 })), 3);
  EXPECT_EQ(skeleton.complex.cells.vertexCount, 1U);
  EXPECT_TRUE(skeleton.complex.cells.edges.empty());
}

TEST(CurveSkeleton, EmptySurfaceIsEmpty)
{
  const CurveSkeleton skeleton = SkeletonOf(MedialComplex(), 3);
  EXPECT_EQ(skeleton.complex.cells.vertexCount, 0U);
}

TEST(CurveSkeleton, VoxelsThatTouchInAnEdgeOrACornerAreTwoPoints)
{
  for (const Size3 & other : { Size3{ 1, 1, 0 }, Size3{ 1, 1, 1 } })
  {
    VoxelShape shape(VoxelBox{ { 0, 0, 0 }, { 2, 2, 2 } });
    shape.Insert(0, 0, 0);
    shape.Insert(other[0], other[1], other[2]);
    const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(shape), 3);
    EXPECT_EQ(skeleton.complex.cells.vertexCount, 2U);
    EXPECT_TRUE(skeleton.complex.cells.edges.empty());
  }
}

TEST(CurveSkeleton, OfASurfaceWhoseOrderChangesMeanwhileIsTheSameAndTheSurfaceComesBack)
{
  std::size_t faces = 0;
  for (const VoxelShape & shape : { Box({ 30, 22, 3 }), PhantomShape("torus", 32), PhantomShape("porous", 24) })
  {
    for (const double plates : { std::numeric_limits<double>::infinity(), 2.0 })
    {
      const MedialComplex surface = SurfaceOf(shape);
      CurveOptions        options;
      options.branchThreshold = 2;
      options.plateThreshold = plates;
      options.sampling = 1.5;
      options.voxel = 1;
      const CurveSkeleton kept = ComputeCurveSkeleton(surface, options);
      MedialComplex       changes = surface;
      const CurveSkeleton once = ComputeCurveSkeleton(changes, options);
      ExpectSameCore(changes, surface);
      EXPECT_EQ(once.complex.cells.edges, kept.complex.cells.edges);
      EXPECT_EQ(once.complex.cells.faceVertices, kept.complex.cells.faceVertices);
      EXPECT_EQ(once.complex.cells.faceEdges, kept.complex.cells.faceEdges);
      EXPECT_EQ(once.complex.positions, kept.complex.positions);
      EXPECT_EQ(once.complex.radius, kept.complex.radius);
      EXPECT_EQ(once.places, kept.places);
      EXPECT_EQ(once.erosionThickness, kept.erosionThickness);
      EXPECT_EQ(once.branchThickness, kept.branchThickness);
      EXPECT_EQ(once.closedFace, kept.closedFace);
      EXPECT_EQ(once.inSurface.vertices, kept.inSurface.vertices);
      // The elements are those of the surface, in its order.
      for (std::size_t i = 0; i < kept.inSurface.faces.size(); ++i)
      {
        const auto of = surface.cells.FaceVertices(kept.inSurface.faces[i]);
        const auto left = kept.complex.cells.FaceVertices(i);
        ASSERT_EQ(of.size(), left.size());
        for (std::size_t corner = 0; corner < of.size(); ++corner)
        {
          ASSERT_EQ(kept.inSurface.vertices[left[corner]], of[corner]);
        }
      }
      faces += kept.complex.cells.FaceCount();
    }
  }
  EXPECT_GT(faces, 100U); // plates were among them
}

TEST(CurveSkeleton, RodIsItsAxis)
{
  for (const std::int32_t width : { 1, 2, 3, 4, 5, 6, 8 })
  {
    const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(Box({ 50, width, width })), 3);
    EXPECT_EQ(CountDegree(skeleton, 1), 2U) << width;
    EXPECT_EQ(skeleton.complex.cells.edges.size(), skeleton.complex.cells.vertexCount - 1) << width;
    double low = 50;
    double high = 0;
    for (const auto & p : skeleton.complex.positions)
    {
      if (std::min(p[0], 50 - p[0]) > 0.5 * width)
      {
        EXPECT_NEAR(p[1], 0.5 * width, 0.5) << width;
        EXPECT_NEAR(p[2], 0.5 * width, 0.5) << width;
      }
      low = std::min(low, p[0]);
      high = std::max(high, p[0]);
    }
    EXPECT_LE(low, 0.5 * width + 2) << width;
    EXPECT_GE(high, 50 - 0.5 * width - 2) << width;
  }
}

TEST(CurveSkeleton, BallIsNearlyAPoint)
{
  const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(PhantomShape("ball", 40)), 3);
  for (const auto & p : skeleton.complex.positions)
  {
    EXPECT_LT(Distance(p, { 20, 20, 20 }), 1.5);
  }
}

TEST(CurveSkeleton, EllipsoidIsASegmentAlongItsLongAxis)
{
  const std::int32_t  n = 64;
  const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(Ellipsoid(n)), 3);
  EXPECT_EQ(CountDegree(skeleton, 1), 2U);
  EXPECT_EQ(skeleton.complex.cells.edges.size(), skeleton.complex.cells.vertexCount - 1);
  double low = n;
  double high = 0;
  for (const auto & p : skeleton.complex.positions)
  {
    EXPECT_NEAR(p[1], 0.5 * n, 1.0);
    EXPECT_NEAR(p[2], 0.5 * n, 1.0);
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  }
  // The medial surface is an ellipse with semi-axes a = (A^2 - C^2) / A and b = (B^2 - C^2) / B; its own medial axis
  // ends (a^2 - b^2) / a from the centre. Where curve and rim run side by side the end is not sharp.
  const double a = n * (0.45 * 0.45 - 0.2 * 0.2) / 0.45;
  const double b = n * (0.3 * 0.3 - 0.2 * 0.2) / 0.3;
  const double half = (a * a - b * b) / a;
  EXPECT_NEAR(0.5 * n - low, half, 0.35 * half);
  EXPECT_NEAR(high - 0.5 * n, half, 0.35 * half);
}

TEST(CurveSkeleton, TorusIsOneRing)
{
  const CurveSkeleton skeleton = SkeletonOf(SurfaceOf(PhantomShape("torus", 48)), 3);
  EXPECT_EQ(CountDegree(skeleton, 2), skeleton.complex.cells.vertexCount);
  EXPECT_EQ(skeleton.complex.cells.edges.size(), skeleton.complex.cells.vertexCount);
  for (const double thickness : skeleton.branchThickness)
  {
    EXPECT_EQ(thickness, std::numeric_limits<double>::infinity());
  }
}

TEST(CurveSkeleton, ClosedShellStaysAsItIs)
{
  // A wall two voxels thick around a cavity: its middle surface has no free edge once the corners are pruned.
  const auto       hollow = [](int at) { return at >= 2 && at < 10; };
  const VoxelShape shape =
    ShapeWhere({ 12, 12, 12 }, [&](int x, int y, int z) { return !(hollow(x) && hollow(y) && hollow(z)); });
  const MedialComplex surface = SurfaceOf(shape);
  const CurveSkeleton skeleton = SkeletonOf(surface, 3);
  const auto          numbers = ComputeComplexTopology(skeleton.complex.cells);
  EXPECT_EQ(numbers.betti, (std::array<std::int64_t, 3>{ 1, 0, 1 }));
  EXPECT_EQ(skeleton.ClosedFaceCount(), skeleton.complex.cells.FaceCount());
  EXPECT_GT(skeleton.ClosedFaceCount(), 0U);
  // Nothing dangles: every edge is on faces that stay.
  std::vector<int> faces(skeleton.complex.cells.edges.size(), 0);
  for (const ElementIndex edge : skeleton.complex.cells.faceEdges)
  {
    ++faces[edge];
  }
  for (const int count : faces)
  {
    EXPECT_GE(count, 2);
  }
}

TEST(CurveSkeleton, PlateStaysWithAPlateThresholdAndARodDoesNot)
{
  // A plate 30 x 30 x 3 with a rod 5 x 5 x 40 on it.
  const VoxelShape shape =
    ShapeWhere({ 30, 30, 43 }, [](int x, int y, int z) { return z < 3 || (x >= 13 && x < 18 && y >= 13 && y < 18); });
  const MedialComplex surface = SurfaceOf(shape);
  const CurveSkeleton curves = SkeletonOf(surface, 3);
  EXPECT_EQ(curves.complex.cells.FaceCount(), 0U);
  const CurveSkeleton plates = SkeletonOf(surface, 3, 4);
  EXPECT_GT(plates.complex.cells.FaceCount(), 100U);
  EXPECT_EQ(plates.ClosedFaceCount(), 0U);
  double highestFace = 0;
  for (const ElementIndex corner : plates.complex.cells.faceVertices)
  {
    highestFace = std::max(highestFace, plates.complex.positions[corner][2]);
  }
  EXPECT_LT(highestFace, 6);
  double highest = 0;
  for (const auto & p : plates.complex.positions)
  {
    highest = std::max(highest, p[2]);
  }
  EXPECT_GT(highest, 38);
  EXPECT_EQ(ComputeComplexTopology(plates.complex.cells).betti, (std::array<std::int64_t, 3>{ 1, 0, 0 }));
}

TEST(CurveSkeleton, IsPartOfTheSurface)
{
  const MedialComplex        surface = SurfaceOf(PhantomShape("root", 48));
  const CurveSkeleton        skeleton = SkeletonOf(surface, 3);
  std::map<Spacing3, double> radii;
  for (std::size_t v = 0; v < surface.cells.vertexCount; ++v)
  {
    radii[surface.positions[v]] = surface.radius[v];
  }
  for (std::size_t v = 0; v < skeleton.complex.cells.vertexCount; ++v)
  {
    const auto found = radii.find(skeleton.complex.positions[v]);
    ASSERT_NE(found, radii.end());
    EXPECT_EQ(found->second, skeleton.complex.radius[v]);
  }
}

TEST(CurveSkeleton, StopsWhenAsked)
{
  const auto stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(ComputeCurveSkeleton(SurfaceOf(Ellipsoid(16)), CurveOptions(), stop), Cancelled);
}

} // namespace

} // namespace voxelcore::testing
