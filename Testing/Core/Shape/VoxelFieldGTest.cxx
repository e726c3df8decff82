#include "voxelcore/Shape/VoxelField.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace voxelcore::testing
{

TEST(VoxelField, HasANumberForEachVoxelInScanOrder)
{
  VoxelShape shape(VoxelBox{ { 3, 1, 2 }, { 70, 2, 2 } });
  shape.Insert(4, 1, 2);
  shape.Insert(72, 1, 2);
  shape.Insert(3, 2, 3);
  auto field = ZeroAtVoxels<std::uint32_t>(shape);
  EXPECT_EQ(field.values, (std::vector<std::uint32_t>{ 0, 0, 0 }));
  field.values = { 7, 8, 9 };
  EXPECT_EQ(field.Row(0, 0).size(), 2U);
  EXPECT_TRUE(field.Row(1, 0).empty());
  EXPECT_EQ(field.Row(1, 1)[0], 9U);
  std::vector<std::uint32_t> row(70, 0);
  WriteRow(shape, field, 0, 0, row.data());
  EXPECT_EQ(row[1], 7U);
  EXPECT_EQ(row[69], 8U);
  EXPECT_EQ(std::count(row.begin(), row.end(), 0U), 68);
}

} // namespace voxelcore::testing
