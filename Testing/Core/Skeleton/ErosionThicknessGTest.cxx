#include "BurnNetwork.h"
#include "SkeletonFixtures.h"
#include "SurfaceFire.h"

#include "voxelcore/Skeleton/ErosionThickness.h"

#include <omp.h>

namespace voxelcore::testing
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** Burn times of vertices by trying every way again and again until no time falls any more. */
std::vector<double>
TimesByTrying(const MedialComplex & surface, double sampling)
{
  const BurnNetwork   network(surface, sampling);
  const CellComplex & cells = surface.cells;
  std::vector<double> times(network.SectorCount(), kInfinity);
  const auto          atSample = [&](std::uint32_t corner, ElementIndex edge, std::uint32_t i) {
    return std::pair{ network.sides[corner].sector[1] + i, network.edgeFirst[edge].point + i };
  };
  struct Place
  {
    std::uint32_t sector;
    Vector3       at;
    double        radius;
  };
  std::vector<std::vector<Place>> faces(cells.FaceCount());
  for (std::size_t face = 0; face < cells.FaceCount(); ++face)
  {
    for (std::uint64_t corner = cells.faceOffsets[face]; corner < cells.faceOffsets[face + 1]; ++corner)
    {
      const auto         c = static_cast<std::uint32_t>(corner);
      const ElementIndex vertex = cells.faceVertices[corner];
      const ElementIndex edge = cells.faceEdges[corner];
      faces[face].push_back({ network.sides[c].sector[0], surface.positions[vertex], surface.radius[vertex] });
      if (network.openSector[network.sides[c].sector[0]])
      {
        times[network.sides[c].sector[0]] = surface.radius[vertex];
      }
      for (std::uint32_t i = 0; i < network.SampleCount(edge); ++i)
      {
        const auto [sector, point] = atSample(c, edge, i);
        faces[face].push_back({ sector, network.Position(point), network.SampleRadius(edge, i) });
        if (network.EdgeFaceCount(edge) == 1)
        {
          times[sector] = network.SampleRadius(edge, i);
        }
      }
    }
  }
  for (bool falls = true; falls;)
  {
    falls = false;
    const auto note = [&](std::uint32_t sector, double time) {
      if (time < times[sector])
      {
        times[sector] = time;
        falls = true;
      }
    };
    // A sector at a seam burns when all others there have.
    const auto free = [&](const std::vector<std::uint32_t> & seam) {
      for (std::size_t i = 0; i < seam.size(); ++i)
      {
        double latest = 0;
        for (std::size_t j = 0; j < seam.size(); ++j)
        {
          latest = j == i ? latest : std::max(latest, times[seam[j]]);
        }
        note(seam[i], latest);
      }
    };
    for (const auto & places : faces)
    {
      for (const Place & from : places)
      {
        for (const Place & to : places)
        {
          const Vector3 way = Minus(to.at, from.at);
          note(to.sector, std::max(times[from.sector] + std::sqrt(Dot(way, way)), to.radius));
        }
      }
    }
    for (std::size_t vertex = 0; vertex < cells.vertexCount; ++vertex)
    {
      std::vector<std::uint32_t> seam;
      for (std::uint32_t i = network.seamEndOffsets[vertex]; i < network.seamEndOffsets[vertex + 1]; ++i)
      {
        const BurnNetwork::SeamEnd end = network.seamEnds[i];
        seam.push_back(network.vertexSectorOffsets[vertex] + (end & ~BurnNetwork::kLastAtSeam));
        if ((end & BurnNetwork::kLastAtSeam) != 0)
        {
          free(seam);
          seam.clear();
        }
      }
    }
    for (std::uint32_t point = static_cast<std::uint32_t>(cells.vertexCount); point < network.PointCount(); ++point)
    {
      const BurnNetwork::SectorRange range = network.Sectors(point);
      std::vector<std::uint32_t>     seam;
      for (std::uint32_t i = 0; range.count > 1 && i < range.count; ++i)
      {
        seam.push_back(range.first + i * range.stride);
      }
      free(seam);
    }
  }
  std::vector<double> result(surface.radius);
  for (std::uint32_t vertex = 0; vertex < cells.vertexCount; ++vertex)
  {
    const BurnNetwork::SectorRange range = network.Sectors(vertex);
    for (std::uint32_t i = 0; i < range.count; ++i)
    {
      result[vertex] = i == 0 ? times[range.first] : std::max(result[vertex], times[range.first + i]);
    }
  }
  return result;
}

TEST(ErosionThickness, SheetBurnsFromItsRimInwards)
{
  SurfaceBuilder builder;
  builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 12, 8, 2.5);
  const MedialComplex & sheet = builder.Surface();
  const BurnTimes       times = ComputeBurnTimes(sheet, 1);
  for (std::size_t v = 0; v < sheet.cells.vertexCount; ++v)
  {
    const auto & p = sheet.positions[v];
    const double rim = std::min(std::min(p[0], 12 - p[0]), std::min(p[1], 8 - p[1]));
    EXPECT_DOUBLE_EQ(times.vertices[v], 2.5 + rim) << p[0] << " " << p[1];
  }
}

TEST(ErosionThickness, FireIsNotBeforeTheRadius)
{
  // The radius grows faster than fire runs: the rim of a cone of radii burns in the middle at the radius there.
  SurfaceBuilder builder;
  for (int i = 0; i < 6; ++i)
  {
    for (int j = 0; j < 6; ++j)
    {
      const auto at = [&](int x, int y) {
        const int rim = std::min(std::min(x, 6 - x), std::min(y, 6 - y));
        return builder.Point(x, y, 0, 1 + 3 * rim);
      };
      builder.Face({ at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  const BurnTimes times = ComputeBurnTimes(builder.Surface(), 1);
  for (std::size_t v = 0; v < times.vertices.size(); ++v)
  {
    EXPECT_DOUBLE_EQ(times.vertices[v], builder.Surface().radius[v]);
  }
}

TEST(ErosionThickness, CurvesAndPointsBurnAtTheirRadius)
{
  SurfaceBuilder builder;
  for (int i = 0; i < 5; ++i)
  {
    builder.Edge(builder.Point(i, 0, 0, 1 + i), builder.Point(i + 1, 0, 0, 2 + i));
  }
  builder.Point(9, 9, 9, 4);
  EXPECT_EQ(ComputeBurnTimes(builder.Surface(), 1).vertices, builder.Surface().radius);
}

TEST(ErosionThickness, FireComesToAnEndHoweverFarItsTimesAreApart)
{
  for (const double far : { 1e16, 1e17, 1e300, std::numeric_limits<double>::max() })
  {
    SurfaceBuilder builder;
    builder.Point(0, 0, 0, far); // of the rim: a window is less than a bit of its time
    builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 6, 5, 2.5);
    int             windows = 0;
    const BurnTimes times =
      ComputeBurnTimes(builder.Surface(), 1, [&](std::string_view, double) { return ++windows < 1000; });
    EXPECT_EQ(times.vertices.front(), far);
    EXPECT_EQ(*std::max_element(times.vertices.begin() + 1, times.vertices.end()), 4.5);
  }
}

TEST(ErosionThickness, WhatIsNoTimeIsRefused)
{
  for (const double value : { -1.0, kInfinity, std::numeric_limits<double>::quiet_NaN() })
  {
    SurfaceBuilder builder;
    builder.Point(0, 0, 0, value);
    builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 2);
    EXPECT_THROW(ComputeBurnTimes(builder.Surface(), 1), InputError) << value;
  }
  SurfaceBuilder builder;
  builder.Point(0, 0, kInfinity);
  EXPECT_THROW(ComputeBurnTimes(builder.Surface(), 1), InputError);
}

TEST(ErosionThickness, ClosedSurfaceNeverBurns)
{
  SurfaceBuilder builder;
  builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  builder.Sheet({ 0, 0, 3 }, { 1, 0, 0 }, { 0, 1, 0 }, 3, 3);
  builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 3, 3);
  builder.Sheet({ 0, 3, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, 3, 3);
  builder.Sheet({ 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3);
  builder.Sheet({ 3, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 3);
  for (const double time : ComputeBurnTimes(builder.Surface(), 1).vertices)
  {
    EXPECT_EQ(time, kInfinity);
  }
}

TEST(ErosionThickness, SeamBurnsWhenAllButOneOfItsSheetsHaveBurned)
{
  // Sheets of width 2, 3 and 9 meet at the line x = y = 0; all are so long that only their width counts in the middle.
  SurfaceBuilder builder;
  builder.Sheet({ 0, 0, -12 }, { 1, 0, 0 }, { 0, 0, 1 }, 2, 24, 10);
  builder.Sheet({ 0, 0, -12 }, { 0, 1, 0 }, { 0, 0, 1 }, 3, 24, 10);
  builder.Sheet({ 0, 0, -12 }, { -1, 0, 0 }, { 0, 0, 1 }, 9, 24, 10);
  const MedialComplex & surface = builder.Surface();
  const BurnTimes       times = ComputeBurnTimes(surface, 1);
  for (std::size_t v = 0; v < surface.cells.vertexCount; ++v)
  {
    const auto & p = surface.positions[v];
    if (p[2] != 0)
    {
      continue;
    }
    const double expected = p[0] > 0   ? 10 + std::min(2 - p[0], 3 + p[0]) // its rim
                            : p[1] > 0 ? 10 + 3 - p[1]
                            : p[0] < 0
                              ? 10 + std::min(9 + p[0], 3 - p[0]) // its rim, or the seam, which burns at 10 + 3
                              : 10 + 3;
    EXPECT_DOUBLE_EQ(times.vertices[v], expected) << p[0] << " " << p[1];
  }
}

TEST(ErosionThickness, SheetsThatTouchInAPointBurnEachByItself)
{
  SurfaceBuilder builder;
  builder.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 8, 8, 10);
  // A second sheet through the first one's middle in one point of both, standing upright.
  const ElementIndex middle = builder.Point(4, 4, 0);
  builder.Face({ middle, builder.Point(5, 4, 1), builder.Point(4, 4, 2), builder.Point(3, 4, 1) });
  const BurnTimes times = ComputeBurnTimes(builder.Surface(), 1);
  EXPECT_DOUBLE_EQ(times.vertices[middle], 10 + 4);
}

TEST(ErosionThickness, IsAtLeastZeroOnRandomVolumes)
{
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    const RandomVolume  volume = MakeRandomVolume(seed, 2, 9);
    const MedialComplex surface = SurfaceOf(volume.shape, volume.spacing);
    const BurnTimes     times = ComputeBurnTimes(surface, 1);
    for (std::size_t v = 0; v < times.vertices.size(); ++v)
    {
      ASSERT_GE(times.vertices[v], surface.radius[v]) << volume.Describe();
    }
  }
}

TEST(ErosionThickness, IsTheLeastBoundOverAllWays)
{
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    const RandomVolume        volume = MakeRandomVolume(seed, 3, 12);
    const MedialComplex       surface = SurfaceOf(volume.shape, volume.spacing);
    const BurnTimes           times = ComputeBurnTimes(surface, 1);
    const std::vector<double> expected = TimesByTrying(surface, 1);
    for (std::size_t v = 0; v < expected.size(); ++v)
    {
      ASSERT_EQ(times.vertices[v], expected[v]) << volume.Describe() << ", vertex " << v;
    }
  }
  for (const char * kind : { "gyroid", "root", "ellipsoid" })
  {
    const MedialComplex surface = SurfaceOf(PhantomShape(kind, 40, 2));
    ASSERT_EQ(ComputeBurnTimes(surface, 1.5).vertices, TimesByTrying(surface, 1.5)) << kind;
  }
}

TEST(ErosionThickness, IsTheSameOnAnyNumberOfThreads)
{
  // Some forty blocks.
  const MedialComplex surface = SurfaceOf(PhantomShape("gyroid", 64));
  ASSERT_GT(surface.cells.vertexCount, 80000U);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const BurnTimes expected = ComputeBurnTimes(surface, 1.5);
  for (const int threads : { 2, 3, 7 })
  {
    omp_set_num_threads(threads);
    const BurnTimes times = ComputeBurnTimes(surface, 1.5);
    EXPECT_TRUE(times.vertices == expected.vertices && times.edges == expected.edges && times.faces == expected.faces)
      << threads;
  }
  omp_set_num_threads(before);
}

TEST(ErosionThickness, GrowsWithTheShape)
{
  // Scale-covariant: the same shape in voxels twice as large burns twice as long, to the last bit.
  const VoxelShape shape = Ellipsoid(24);
  const BurnTimes  one = ComputeBurnTimes(SurfaceOf(shape), 1.5);
  const BurnTimes  two = ComputeBurnTimes(SurfaceOf(shape, { 2, 2, 2 }), 3);
  ASSERT_EQ(one.vertices.size(), two.vertices.size());
  for (std::size_t v = 0; v < one.vertices.size(); ++v)
  {
    ASSERT_EQ(2 * one.vertices[v], two.vertices[v]);
  }
}

TEST(EntryPlaces, AreInTheOrderOfTheFaces)
{
  const std::vector<std::size_t> faces{ 0, 5, 63, 64, 127, 200 };
  const EntryPlaces              places(faces, 201);
  for (std::uint32_t face = 0, next = 0; face < 201; ++face)
  {
    const bool isNamed = next < faces.size() && faces[next] == face;
    EXPECT_EQ(places.Of(face), isNamed ? next++ : EntryPlaces::none) << face;
  }
}

} // namespace

} // namespace voxelcore::testing
