#include "voxelcore/Base/LengthUnit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace voxelcore
{
namespace
{

TEST(LengthUnit, SuitsTheSizeOfWhatIsShown)
{
  EXPECT_EQ(LengthUnit::For(250).Name(), "mm");
  EXPECT_EQ(LengthUnit::For(0.1).Name(), "mm");
  EXPECT_EQ(LengthUnit::For(0.0999).Name(), "um");
  EXPECT_EQ(LengthUnit::For(1e-4).Name(), "um");
  EXPECT_EQ(LengthUnit::For(0.999e-4).Name(), "nm");
  EXPECT_EQ(LengthUnit::For(1e-12).Name(), "nm");
  EXPECT_EQ(LengthUnit::For(-0.02).Name(), "um");
  EXPECT_EQ(LengthUnit::For(0).Name(), "mm");
  EXPECT_EQ(LengthUnit::For(std::numeric_limits<double>::quiet_NaN()).Name(), "mm");
}

TEST(LengthUnit, VoxelsStayVoxelsWhateverTheirSize)
{
  for (const double typical : { 0.0, 1e-9, 0.02, 7.0 })
  {
    const LengthUnit unit = LengthUnit::For(typical, SpatialUnit::Voxels);
    EXPECT_EQ(unit.Name(2), "vox2");
    EXPECT_EQ(unit.Symbol(3), "vox³");
    EXPECT_EQ(unit.Of(typical), typical);
  }
}

TEST(LengthUnit, SquaresAndCubesAreThoseOfTheUnit)
{
  const LengthUnit unit = LengthUnit::For(4e-6);
  EXPECT_EQ(unit.Name(3), "nm3");
  EXPECT_DOUBLE_EQ(unit.Of(4e-6), 4);
  EXPECT_DOUBLE_EQ(unit.Of(16e-12, 2), 16);
  EXPECT_DOUBLE_EQ(unit.Of(640e-18, 3), 640);
  EXPECT_EQ(LengthUnit::For(0.05).Name(2), "um2");
  EXPECT_EQ(LengthUnit::For(0.05).Symbol(2), "µm²");
  EXPECT_EQ(LengthUnit::For(5).Symbol(3), "mm³");
  EXPECT_EQ(LengthUnit::For(0.05).Text(0.012345, 1, 1), "12.3");
}

} // namespace
} // namespace voxelcore
