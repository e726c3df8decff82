#include "voxelcore/Complex/SoundComplex.h"

#include <gtest/gtest.h>

#include <functional>

namespace voxelcore
{
namespace
{

/** A square, a triangle at one of its sides, and an edge. */
CellComplex
Small()
{
  CellComplex cells;
  cells.vertexCount = 6;
  cells.edges = { { 0, 1 }, { 0, 3 }, { 1, 2 }, { 1, 4 }, { 2, 3 }, { 2, 4 }, { 4, 5 } };
  cells.faceOffsets = { 0, 4, 7 };
  cells.faceVertices = { 0, 1, 2, 3, 1, 4, 2 };
  cells.faceEdges = { 0, 2, 4, 1, 3, 5, 2 };
  return cells;
}

TEST(SoundComplex, IsOneWhoseArraysAgree)
{
  EXPECT_TRUE(IsComplex(Small()));
  EXPECT_TRUE(IsComplex(CellComplex()));
  CellComplex points;
  points.vertexCount = 3;
  EXPECT_TRUE(IsComplex(points));
}

TEST(SoundComplex, IsNoneWhoseIndicesLeadElsewhere)
{
  const auto expect = [](const char * what, const std::function<void(CellComplex &)> & change) {
    CellComplex cells = Small();
    change(cells);
    EXPECT_FALSE(IsComplex(cells)) << what;
  };
  expect("a vertex that is not there", [](CellComplex & c) { c.vertexCount = 5; });
  expect("ends out of order", [](CellComplex & c) { c.edges[2] = { 2, 1 }; });
  expect("an edge of one end", [](CellComplex & c) { c.edges[2] = { 2, 2 }; });
  expect("an edge twice", [](CellComplex & c) { c.edges[3] = c.edges[2]; });
  expect("edges out of order", [](CellComplex & c) { std::swap(c.edges[2], c.edges[3]); });
  expect("no offsets", [](CellComplex & c) { c.faceOffsets.clear(); });
  expect("a late beginning", [](CellComplex & c) { c.faceOffsets.front() = 1; });
  expect("offsets that fall", [](CellComplex & c) { c.faceOffsets = { 0, 8, 7 }; });
  expect("offsets beyond the corners", [](CellComplex & c) { c.faceOffsets.back() = 8; });
  expect("corners left over", [](CellComplex & c) { c.faceOffsets.back() = 6; });
  expect("a face of two corners", [](CellComplex & c) { c.faceOffsets = { 0, 4, 5, 7 }; });
  expect("sides that are missing", [](CellComplex & c) { c.faceEdges.pop_back(); });
  expect("a side that is not there", [](CellComplex & c) { c.faceEdges[6] = 7; });
  expect("a side of other corners", [](CellComplex & c) { c.faceEdges[6] = 3; });
  expect("a corner that is not there", [](CellComplex & c) { c.faceVertices[6] = 6; });
  expect("a corner twice", [](CellComplex & c) { c.faceVertices = { 0, 1, 0, 3, 1, 4, 2 }; });
}

} // namespace
} // namespace voxelcore
