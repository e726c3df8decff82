#include "voxelcore/Labels/StoredVoxels.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <string>

namespace voxelcore::testing
{
namespace
{

/** A type of C++ and the one that is its name here. */
template <typename T, PixelType Type>
struct Pair
{
  using Value = T;
  static constexpr PixelType type = Type;
};

template <typename TPair>
class StoredVoxelsOf : public ::testing::Test
{};
using Pairs = ::testing::Types<Pair<std::uint8_t, PixelType::UInt8>,
                               Pair<std::int8_t, PixelType::Int8>,
                               Pair<std::uint16_t, PixelType::UInt16>,
                               Pair<std::int16_t, PixelType::Int16>,
                               Pair<std::uint32_t, PixelType::UInt32>,
                               Pair<std::int32_t, PixelType::Int32>,
                               Pair<std::uint64_t, PixelType::UInt64>,
                               Pair<std::int64_t, PixelType::Int64>,
                               Pair<float, PixelType::Float32>,
                               Pair<double, PixelType::Float64>>;
TYPED_TEST_SUITE(StoredVoxelsOf, Pairs);

TYPED_TEST(StoredVoxelsOf, BytesAndNameAreThoseOfTheType)
{
  using T = typename TypeParam::Value;
  EXPECT_EQ(PixelBytes(TypeParam::type), sizeof(T));
  EXPECT_EQ(IsFloat(TypeParam::type), std::is_floating_point_v<T>);
  const std::string kind = std::is_floating_point_v<T> ? "float" : std::is_signed_v<T> ? "int" : "uint";
  EXPECT_EQ(PixelName(TypeParam::type), kind + std::to_string(8 * sizeof(T)));
}

TYPED_TEST(StoredVoxelsOf, ValuesAreReadFromAnyAddress)
{
  using T = typename TypeParam::Value;
  using Limits = std::numeric_limits<T>;
  for (const T value : { T(0), T(1), T(100), Limits::lowest(), Limits::max(), Limits::min() })
  {
    for (std::size_t shift = 0; shift < 8; ++shift)
    {
      std::array<std::byte, 24> bytes;
      bytes.fill(std::byte{ 0xA5 });
      std::memcpy(bytes.data() + shift, &value, sizeof value);
      EXPECT_EQ(StoredValue(bytes.data() + shift, TypeParam::type), static_cast<double>(value)) << "shift " << shift;
    }
  }
}

TEST(StoredVoxels, WholeNumbersBeyond53BitsAreRounded)
{
  const auto read = [](auto value, PixelType type) {
    std::array<std::byte, 8> bytes;
    std::memcpy(bytes.data(), &value, 8);
    return StoredValue(bytes.data(), type);
  };
  EXPECT_EQ(read((std::uint64_t{ 1 } << 53U) + 1, PixelType::UInt64), 0x1p53); // a tie goes to the even one
  EXPECT_EQ(read((std::uint64_t{ 1 } << 53U) + 3, PixelType::UInt64), 0x1p53 + 4);
  EXPECT_EQ(read(std::numeric_limits<std::uint64_t>::max(), PixelType::UInt64), 0x1p64);
  EXPECT_EQ(read(std::numeric_limits<std::int64_t>::min(), PixelType::Int64), -0x1p63);
}

TEST(StoredVoxels, SeveralValuesAVoxelAreLayersUnlessOneIsTaken)
{
  StoredVoxels scan;
  EXPECT_FALSE(scan.HasLayers());
  scan.interleaved = 3;
  EXPECT_TRUE(scan.HasLayers());
  scan.component = 0;
  EXPECT_FALSE(scan.HasLayers());
  scan.interleaved = 1;
  scan.component = -1;
  EXPECT_FALSE(scan.HasLayers());
}

TEST(StoredVoxels, AreScaledByASlopeOrAnIntercept)
{
  StoredVoxels scan;
  EXPECT_FALSE(scan.IsScaled());
  scan.slope = -1;
  EXPECT_TRUE(scan.IsScaled());
  scan.slope = 1;
  scan.intercept = 0.5;
  EXPECT_TRUE(scan.IsScaled());
}

} // namespace
} // namespace voxelcore::testing
