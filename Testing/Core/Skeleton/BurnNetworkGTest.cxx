// Sectors of faces around a vertex, against their definition, and of very many faces.

#include "BurnNetwork.h"
#include "SkeletonFixtures.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <vector>

namespace voxelcore::testing
{
namespace
{

using Corners = std::vector<std::array<int, 2>>; // of triangles beside the middle, as numbers of rim points

/** Triangles from a middle to two points on a circle each. The middle is vertex 0. */
MedialComplex
FanOf(const Corners & triangles, int points)
{
  constexpr double   turn = 6.283185307179586;
  SurfaceBuilder     surface;
  const ElementIndex middle = surface.Point(0, 0, 0);
  for (const auto & [a, b] : triangles)
  {
    const auto rim = [&](int point) {
      const double angle = turn * point / points;
      return surface.Point(std::cos(angle), std::sin(angle), 0);
    };
    const ElementIndex first = rim(a);
    surface.Face({ middle, first, rim(b) });
  }
  return surface.Surface();
}

TEST(BurnNetwork, SectorsHangTogetherAcrossEdgesWithTwoFaces)
{
  for (unsigned seed = 1; seed <= 200; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const int    points = 3 + static_cast<int>(random() % 12);
    Corners      triangles;
    for (unsigned i = 0; i < 3 + random() % 14; ++i)
    {
      const int a = static_cast<int>(random() % static_cast<unsigned>(points));
      triangles.push_back({ a, (a + 1 + static_cast<int>(random() % static_cast<unsigned>(points - 1))) % points });
    }
    const MedialComplex surface = FanOf(triangles, points);
    const BurnNetwork   network(surface, 1);
    // By definition: the smallest number of a face goes from face to face until nothing changes.
    std::vector<int> faces(static_cast<std::size_t>(points), 0);
    for (const auto & triangle : triangles)
    {
      ++faces[static_cast<std::size_t>(triangle[0])];
      ++faces[static_cast<std::size_t>(triangle[1])];
    }
    std::vector<std::size_t> smallest(triangles.size());
    std::iota(smallest.begin(), smallest.end(), std::size_t{ 0 });
    for (bool changes = true; changes;)
    {
      changes = false;
      for (std::size_t i = 0; i < triangles.size(); ++i)
      {
        for (std::size_t j = 0; j < triangles.size(); ++j)
        {
          const bool meet = std::ranges::any_of(triangles[i], [&](int point) {
            return faces[static_cast<std::size_t>(point)] == 2 &&
                   std::ranges::find(triangles[j], point) != triangles[j].end();
          });
          if (meet && smallest[i] < smallest[j])
          {
            smallest[j] = smallest[i];
            changes = true;
          }
        }
      }
    }
    std::vector<std::size_t> firsts; // sectors are numbered by their first faces
    std::vector<bool>        open;
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      if (smallest[i] == i)
      {
        firsts.push_back(i);
        open.push_back(false);
      }
      const auto sector = static_cast<std::size_t>(std::ranges::find(firsts, smallest[i]) - firsts.begin());
      EXPECT_EQ(network.sides[3 * i].sector[0] - network.vertexSectorOffsets[0], sector) << "face " << i;
      open[sector] = open[sector] || std::ranges::any_of(triangles[i], [&](int point) {
                       return faces[static_cast<std::size_t>(point)] == 1;
                     });
    }
    ASSERT_EQ(network.Sectors(0).count, firsts.size());
    for (std::size_t sector = 0; sector < firsts.size(); ++sector)
    {
      EXPECT_EQ(network.openSector[network.vertexSectorOffsets[0] + sector] != 0, open[sector]) << sector;
    }
  }
}

/** Processor seconds. */
double
SecondsFor(const MedialComplex & surface, std::size_t & sectors)
{
  const std::clock_t start = std::clock();
  sectors = BurnNetwork(surface, 1).Sectors(0).count;
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

TEST(BurnNetwork, FortyThousandFacesAtOneVertexTakeAboutAsLongAsElsewhere)
{
  constexpr int count = 40000;
  Corners       triangles;
  for (int i = 0; i < count; ++i)
  {
    triangles.push_back({ i, (i + 1) % count });
  }
  std::shuffle(triangles.begin(), triangles.end(), std::mt19937(7));
  const MedialComplex fan = FanOf(triangles, count);
  SurfaceBuilder      sheet;
  sheet.Sheet({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 200, 200);
  std::size_t  sectors = 0;
  const double spread = SecondsFor(sheet.Surface(), sectors);
  const double together = SecondsFor(fan, sectors);
  EXPECT_EQ(sectors, 1U);
  // Looking at each pair of faces took 380 times as long.
  EXPECT_LT(together, 20 * std::max(spread, 0.005));
}

} // namespace
} // namespace voxelcore::testing
