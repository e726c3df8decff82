#pragma once
// Cores of test shapes, and what it means that two are equal.

#include "VoxelCoreTesting/Shapes.h"

#include "voxelcore/Lattice/TopologyNumbers.h"
#include "voxelcore/Shape/BoundaryVertices.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"
#include "voxelcore/VoxelCore/VoxelCore.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace voxelcore
{

/** For readable failures of GoogleTest. */
inline void
PrintTo(const TopologyNumbers & numbers, std::ostream * out)
{
  *out << "chi " << numbers.euler << ", b0 " << numbers.betti[0] << ", b1 " << numbers.betti[1] << ", b2 "
       << numbers.betti[2];
}

} // namespace voxelcore

namespace voxelcore::testing
{

inline MedialComplex
CoreOf(const VoxelShape & shape, const Spacing3 & spacing = { 1, 1, 1 })
{
  return ComputeVoxelCore(shape, ComputeSpacingWeights(spacing));
}

/** With its tolerances. */
inline MedialComplex
CoreWithTolerancesOf(const VoxelShape & shape,
                     const Spacing3 &   spacing = { 1, 1, 1 },
                     Engine             engine = Engine::Auto,
                     double             floor = 0)
{
  const SpacingWeights weights = ComputeSpacingWeights(spacing);
  const auto           points = BoundaryVertices(shape);
  DelaunayCells        cells = ComputeDelaunayCells(shape, points, weights, engine);
  auto                 touching = LargestTouchingBalls(shape, cells, points, weights);
  MedialComplex        core = BuildVoxelCore(shape, points, std::move(cells), weights);
  core.tolerances = ComputeTolerances(core, weights, points, std::move(touching), floor);
  return core;
}

/** Same cells in the same order and the same measures to the last bit; positions too unless `exactPositions` is off. */
inline void
ExpectSameCore(const MedialComplex & a, const MedialComplex & b, bool exactPositions = true)
{
  ASSERT_EQ(a.cells.vertexCount, b.cells.vertexCount);
  ASSERT_EQ(a.cells.edges, b.cells.edges);
  ASSERT_EQ(a.cells.faceOffsets, b.cells.faceOffsets);
  ASSERT_EQ(a.cells.faceVertices, b.cells.faceVertices);
  ASSERT_EQ(a.cells.faceEdges, b.cells.faceEdges);
  ASSERT_EQ(a.radius, b.radius);
  ASSERT_EQ(a.vertexLambda, b.vertexLambda);
  ASSERT_EQ(a.edgeLambda, b.edgeLambda);
  ASSERT_EQ(a.faceLambda, b.faceLambda);
  ASSERT_EQ(a.tolerances.vertices, b.tolerances.vertices);
  ASSERT_EQ(a.tolerances.edges, b.tolerances.edges);
  ASSERT_EQ(a.tolerances.faces, b.tolerances.faces);
  if (exactPositions)
  {
    ASSERT_EQ(a.positions, b.positions);
  }
}

/** Whether a place in lattice coordinates lies in the open shape: every voxel whose closure holds it must be in. */
inline bool
LiesInOpenShape(const VoxelShape & shape, const std::array<double, 3> & place)
{
  std::array<std::int32_t, 3> low{};
  std::array<std::int32_t, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    high[axis] = static_cast<std::int32_t>(std::floor(place[axis]));
    low[axis] = static_cast<std::int32_t>(std::ceil(place[axis])) - 1;
  }
  for (std::int32_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int32_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::int32_t x = low[0]; x <= high[0]; ++x)
      {
        if (!shape.Contains(x, y, z))
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace voxelcore::testing
