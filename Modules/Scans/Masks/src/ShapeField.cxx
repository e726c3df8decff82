#include "ShapeField.h"

namespace voxelcore
{

namespace
{

/** Of five voxels in a row, for each set of those that are in. */
struct RowSums
{
  std::array<std::int32_t, 32> once{};
  std::array<std::int32_t, 32> twice{};
};

constexpr RowSums
SumRows()
{
  RowSums sums;
  for (std::size_t bits = 0; bits < 32; ++bits)
  {
    for (std::size_t i = 0; i < 5; ++i)
    {
      sums.once[bits] += (bits >> i) % 2 == 1 ? kBlurOnce[i] : 0;
      sums.twice[bits] += (bits >> i) % 2 == 1 ? kBlurTwice[i] : 0;
    }
  }
  return sums;
}

constexpr RowSums kRowSums = SumRows();

} // namespace

std::int32_t
FieldAround(const PaddedShape & shape, const Voxel & at)
{
  std::int32_t once = 0;
  std::int32_t twice = 0;
  for (std::int32_t dz = -2; dz <= 2; ++dz)
  {
    for (std::int32_t dy = -2; dy <= 2; ++dy)
    {
      const std::uint32_t bits = shape.Bits(at[0] - 2, at[1] + dy, at[2] + dz, 5);
      const auto          y = static_cast<std::size_t>(dy + 2);
      const auto          z = static_cast<std::size_t>(dz + 2);
      once += kBlurOnce[y] * kBlurOnce[z] * kRowSums.once[bits];
      twice += kBlurTwice[y] * kBlurTwice[z] * kRowSums.twice[bits];
    }
  }
  return 2 * once - twice - (shape.Contains(at) ? kFieldOwn : 0);
}

} // namespace voxelcore
