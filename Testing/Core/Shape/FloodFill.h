#pragma once
// Components by flood fill, voxel by voxel, and what an edited shape must be.

#include "VoxelCoreTesting/Shapes.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace voxelcore::testing
{

using Voxel = std::array<std::int32_t, 3>; // z, y, x: sorted means scan order
using Voxels = std::vector<Voxel>;

/** All voxels of value `value` in the shape's box grown by `rim`, in scan order. */
inline Voxels
VoxelsOf(const VoxelShape & shape, bool value = true, std::int32_t rim = 0)
{
  Voxels voxels;
  const auto & [lower, size] = shape.Box();
  for (std::int32_t z = lower[2] - rim; z < lower[2] + size[2] + rim; ++z)
  {
    for (std::int32_t y = lower[1] - rim; y < lower[1] + size[1] + rim; ++y)
    {
      for (std::int32_t x = lower[0] - rim; x < lower[0] + size[0] + rim; ++x)
      {
        if (shape.Contains(x, y, z) == value)
        {
          voxels.push_back({ z, y, x });
        }
      }
    }
  }
  return voxels;
}

/** Flood fill: components in the order of their first voxels, each sorted; neighbours differ along at most `axes` axes
 *  by one. */
inline std::vector<Voxels>
Flood(const Voxels & voxels, int axes)
{
  std::map<Voxel, bool> seen;
  for (const Voxel & voxel : voxels)
  {
    seen[voxel] = false;
  }
  std::vector<Voxels> components;
  for (const Voxel & first : voxels)
  {
    if (seen[first])
    {
      continue;
    }
    seen[first] = true;
    Voxels component{ first };
    for (std::size_t at = 0; at < component.size(); ++at)
    {
      for (int step = 0; step < 27; ++step)
      {
        const Voxel d{ step / 9 - 1, step / 3 % 3 - 1, step % 3 - 1 };
        const Voxel next{ component[at][0] + d[0], component[at][1] + d[1], component[at][2] + d[2] };
        const auto  found = seen.find(next);
        if (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) <= axes && found != seen.end() && !found->second)
        {
          found->second = true;
          component.push_back(next);
        }
      }
    }
    std::sort(component.begin(), component.end());
    components.push_back(std::move(component));
  }
  return components;
}

/** By size, the largest first, then by first voxel. */
inline std::vector<Voxels>
FloodBySize(const VoxelShape & shape)
{
  std::vector<Voxels> components = Flood(VoxelsOf(shape), 1);
  std::sort(components.begin(), components.end(), [](const Voxels & a, const Voxels & b) {
    return a.size() != b.size() ? a.size() > b.size() : a.front() < b.front();
  });
  return components;
}

inline Voxels
Joined(const std::vector<Voxels> & components)
{
  Voxels all;
  for (const Voxels & component : components)
  {
    all.insert(all.end(), component.begin(), component.end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/** The shape holds just these voxels, and its box is the one CropToVoxels would give, word for word. */
inline void
ExpectTight(const VoxelShape & shape, const Voxels & voxels)
{
  EXPECT_EQ(VoxelsOf(shape), voxels);
  EXPECT_EQ(shape.CountVoxels(), voxels.size()) << "bits beyond the box";
  const VoxelShape tight = CropToVoxels(shape);
  EXPECT_EQ(shape.Box().size, tight.Box().size);
  if (!voxels.empty())
  {
    EXPECT_EQ(shape.Box().lower, tight.Box().lower);
  }
}

/** Changes that were not expected are none. */
inline void
ExpectChange(const EditedShape & edited,
             std::uint64_t       voxelsRemoved,
             std::uint64_t       voxelsAdded,
             std::uint64_t       componentsRemoved,
             std::uint64_t       componentsJoined,
             std::uint64_t       cavitiesFilled)
{
  EXPECT_EQ(edited.voxelsRemoved, voxelsRemoved);
  EXPECT_EQ(edited.voxelsAdded, voxelsAdded);
  EXPECT_EQ(edited.componentsRemoved, componentsRemoved);
  EXPECT_EQ(edited.componentsJoined, componentsJoined);
  EXPECT_EQ(edited.cavitiesFilled, cavitiesFilled);
}

/** A hollow box of walls one voxel thick, at the origin. */
inline VoxelShape
Hollow(const Size3 & size)
{
  return ShapeWhere(size, [&size](int x, int y, int z) {
    return x == 0 || y == 0 || z == 0 || x == size[0] - 1 || y == size[1] - 1 || z == size[2] - 1;
  });
}

} // namespace voxelcore::testing
