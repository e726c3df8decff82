#include "GrowingBallTree.h"
#include "HilbertOrder.h"
#include "PointPredicates.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <iostream>
#include <numeric>
#include <random>

namespace voxelcore
{
namespace
{

/** Of some points those that no other lies inside the sphere of, through a facet and them. */
std::vector<std::uint32_t>
FirstOf(const std::vector<LatticePoint> &    at,
        const std::array<std::uint32_t, 3> & facet,
        const std::vector<std::uint32_t> &   points,
        const SpacingWeights &               weights)
{
  std::vector<std::uint32_t> first;
  for (const std::uint32_t p : points)
  {
    const __int128 side =
      first.empty() ? 1
                    : InSphere<__int128>({ at[facet[0]], at[facet[1]], at[facet[2]], at[first[0]] }, at[p], weights);
    if (side > 0)
    {
      first.clear();
    }
    if (side >= 0)
    {
      first.push_back(p);
    }
  }
  std::sort(first.begin(), first.end());
  return first;
}

std::int64_t
Height(const LatticePoint & a, const LatticePoint & b, const LatticePoint & c, const LatticePoint & q)
{
  const std::array<std::int64_t, 3> u{ b.x - a.x, b.y - a.y, b.z - a.z };
  const std::array<std::int64_t, 3> v{ c.x - a.x, c.y - a.y, c.z - a.z };
  return (u[1] * v[2] - u[2] * v[1]) * (q.x - a.x) + (u[2] * v[0] - u[0] * v[2]) * (q.y - a.y) +
         (u[0] * v[1] - u[1] * v[0]) * (q.z - a.z);
}

// Coordinates of few values make many points cospherical, long boxes thin triangles and large spheres.
TEST(GrowingBallTree, FindsWhatGrowingBallsMeetFirst)
{
  const auto seed = std::random_device{}();
  std::cout << "seed " << seed << "\n";
  std::mt19937_64 random(seed);
  int             ties = 0;
  int             none = 0;
  for (const std::array<std::int32_t, 3> & box :
       { std::array{ 8, 8, 8 }, std::array{ 60, 60, 60 }, std::array{ 3000, 40, 9 }, std::array{ 900, 900, 900 } })
  {
    for (const Vector3 & spacing : { Vector3{ 1, 1, 1 }, Vector3{ 1, 1.5, 3 } })
    {
      const SpacingWeights      weights = ComputeSpacingWeights(spacing);
      std::vector<LatticePoint> at;
      const auto any = [&](std::int32_t most) { return static_cast<std::int32_t>(random() % (most + 1)); };
      while (at.size() < 400)
      {
        at.push_back({ any(box[0]), any(box[1]), any(box[2]) });
      }
      const auto isLess = [](const LatticePoint & a, const LatticePoint & b) {
        return std::array{ a.z, a.y, a.x } < std::array{ b.z, b.y, b.x };
      };
      const auto isSame = [](const LatticePoint & a, const LatticePoint & b) {
        return a.x == b.x && a.y == b.y && a.z == b.z;
      };
      std::sort(at.begin(), at.end(), isLess);
      at.erase(std::unique(at.begin(), at.end(), isSame), at.end());
      std::vector<std::uint32_t> chosen(at.size());
      std::iota(chosen.begin(), chosen.end(), 0);
      SortAlongCurve(at, chosen);
      std::vector<GrowingBallTree::Direction> outwards(chosen.size());
      for (GrowingBallTree::Direction & one : outwards)
      {
        one.to = { static_cast<float>(any(4) - 2), static_cast<float>(any(4) - 2), static_cast<float>(any(4) - 2) };
      }
      GrowingBallTree tree;
      tree.Build(at, chosen, outwards, weights);
      for (int k = 0; k < 200; ++k)
      {
        std::array<std::uint32_t, 3> facet{};
        std::array<std::uint32_t, 3> near{};
        for (std::size_t i = 0; i < 3; ++i)
        {
          // Some facets among the last points, by z, beyond which there may be none.
          const std::size_t last = k < 20 ? at.size() - 1 - random() % 20 : at.size();
          const auto        place = k < 20 ? std::find(chosen.begin(), chosen.end(), last) - chosen.begin()
                                           : static_cast<std::ptrdiff_t>(random() % chosen.size());
          near[i] = static_cast<std::uint32_t>(place);
          facet[i] = chosen[near[i]];
        }
        std::vector<std::uint32_t> beyond;
        bool                       isFlat = true;
        for (std::uint32_t p = 0; p < at.size(); ++p)
        {
          const std::int64_t height = Height(at[facet[0]], at[facet[1]], at[facet[2]], at[p]);
          isFlat = isFlat && height == 0;
          if (height > 0)
          {
            beyond.push_back(p);
          }
        }
        if (isFlat)
        {
          continue;
        }
        std::vector<std::uint32_t> found;
        tree.Find(FacetSpheres(at[facet[0]], at[facet[1]], at[facet[2]], weights), 1 + any(30), near, found);
        const auto expected = FirstOf(at, facet, beyond, weights);
        EXPECT_EQ(FirstOf(at, facet, found, weights), expected) << "seed " << seed;
        ties += expected.size() > 1 ? 1 : 0;
        none += expected.empty() ? 1 : 0;
      }
    }
  }
  EXPECT_GT(ties, 5);
  EXPECT_GT(none, 0);
}

} // namespace
} // namespace voxelcore
