#pragma once
// Scattered labels, and what is expected of their shapes.

#include "ItkFixtures.h"
#include "VoxelCoreTesting/Shapes.h"

#include "itkLabelImageToVoxelShapeFilter.h"

namespace voxelcore::testing
{

using ByteImage = itk::Image<std::uint8_t, 3>;
using ByteFilter = itk::LabelImageToVoxelShapeFilter<ByteImage>;
using Spy = SpySource<ByteImage>;

inline constexpr itk::Size<3> kShapeSize{ { 70, 9, 16 } };

/** Labels 1, 2 and 7 here and there; equal for equal arguments. */
inline double
Scattered(int x, int y, int z)
{
  const auto hash = Random(static_cast<std::uint64_t>(x + 100 * (y + 100 * z))).Next() % 8;
  return hash == 1 || hash == 2 || hash == 7 ? static_cast<double>(hash) : 0.0;
}

inline Spy::Pointer
ScatteredSpy()
{
  auto spy = Spy::New();
  spy->size = kShapeSize;
  spy->value = Scattered;
  return spy;
}

/** Each label's voxels are those of `value`, no others. */
inline void
ExpectShapes(const itk::VoxelShapeObject & shapes,
             const itk::Size<3> &          size,
             const VoxelFunction &         value,
             const std::vector<int> &      labels)
{
  ASSERT_EQ(shapes.GetLabels().size(), labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    const LabelShape & label = shapes.GetLabels()[n];
    ASSERT_EQ(label.value, labels[n]);
    EXPECT_EQ(label.name, "label-" + std::to_string(labels[n]));
    std::uint64_t voxels = 0;
    for (int z = 0; z < static_cast<int>(size[2]); ++z)
    {
      for (int y = 0; y < static_cast<int>(size[1]); ++y)
      {
        for (int x = 0; x < static_cast<int>(size[0]); ++x)
        {
          const bool isIn = value(x, y, z) == labels[n];
          ASSERT_EQ(label.shape.Contains(x, y, z), isIn) << labels[n] << ": " << x << " " << y << " " << z;
          voxels += isIn;
        }
      }
    }
    EXPECT_EQ(label.voxels, voxels);
    EXPECT_EQ(label.shape.CountVoxels(), voxels);
  }
}

} // namespace voxelcore::testing
