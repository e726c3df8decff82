#include "voxelcore/Base/Error.h"
#include "voxelcore/Lattice/CheckedGeometry.h"

#include <gtest/gtest.h>

#include <limits>

namespace voxelcore::testing
{
namespace
{

const StatedGeometry kStated{ { 4, 5, 6 }, { { { 0, 2, 0 }, { -3, 0, 0 }, { 0, 0, 1 } } }, { 0.5, 1, 2 }, { 7, 8, 9 } };

template <typename Work>
std::string
Refusal(const Work & work)
{
  try
  {
    work();
  }
  catch (const InputError & error)
  {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(CheckedGeometry, AxesOfAnyLengthBecomeADirection)
{
  std::vector<std::string> notes;
  const ImageGeometry      geometry = CheckedGeometry("a.nrrd", kStated, {}, notes);
  EXPECT_EQ(geometry.size, kStated.size);
  EXPECT_EQ(geometry.spacing, kStated.spacing);
  EXPECT_EQ(geometry.origin, kStated.origin);
  EXPECT_EQ(geometry.direction, (std::array<double, 9>{ 0, -1, 0, 1, 0, 0, 0, 0, 1 }));
  EXPECT_TRUE(notes.empty());
}

TEST(CheckedGeometry, SkewedAxesAreRefusedOrMadeRightAngled)
{
  StatedGeometry skewed = kStated;
  skewed.axes[0] = { 0.1, 2, 0 };
  std::vector<std::string> notes;
  EXPECT_EQ(Refusal([&] {
              CheckedGeometry("a.nrrd", skewed, {}, notes);
            }).find("a.nrrd: its axes are skewed, 2.86241 degrees off a right angle; "),
            0U);
  const ImageGeometry mended = CheckedGeometry("a.nrrd", skewed, { {}, true }, notes);
  EXPECT_LT(OrthonormalityDeviationDegrees(mended), 1e-12);
  ASSERT_EQ(notes.size(), 1U);
  skewed.axes[0] = { 1, 0, 0 };
  EXPECT_NE(Refusal([&] {
              CheckedGeometry("a.nrrd", skewed, { {}, true }, notes);
            }).find("in one plane"),
            std::string::npos);
}

TEST(CheckedGeometry, ASpacingThatIsNoneIsRefusedUnlessOneIsGiven)
{
  for (const double none : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    StatedGeometry stated = kStated;
    stated.spacing[1] = none;
    std::vector<std::string> notes;
    EXPECT_NE(Refusal([&] { CheckedGeometry("a.nrrd", stated, {}, notes); }).find("the voxel spacing along axis j is"),
              std::string::npos);
    EXPECT_EQ(CheckedGeometry("a.nrrd", stated, { Vector3{ 1, 2, 3 }, false }, notes).spacing, (Vector3{ 1, 2, 3 }));
    EXPECT_EQ(notes.size(), 1U);
  }
  std::vector<std::string> notes;
  EXPECT_THROW(CheckedGeometry("a.nrrd", kStated, { Vector3{ 1, 0, 3 }, false }, notes), UsageError);
}

TEST(CheckedGeometry, AnImageInMemoryHasAxesOfLengthOne)
{
  ImageGeometry geometry;
  geometry.size = { 2, 2, 2 };
  EXPECT_EQ(CheckedGeometry("the image", geometry, false).direction, geometry.direction);
  geometry.direction[4] = 1.01;
  EXPECT_NE(
    Refusal([&] { CheckedGeometry("the image", geometry, false); }).find("axis j of its direction has length 1.01"),
    std::string::npos);
  EXPECT_EQ(CheckedGeometry("the image", geometry, true).direction[4], 1.0);
  geometry.size[2] = 0;
  EXPECT_NE(Refusal([&] { CheckedGeometry("the image", geometry, true); }).find("a side of 0 voxels"),
            std::string::npos);
}

TEST(CheckedGeometry, SizesBeyondTheDataAreRefused)
{
  EXPECT_EQ(CheckSize("a.nrrd", { 2, 3, 4 }, 2, 48), 24U);
  EXPECT_NE(Refusal([] {
              CheckSize("a.nrrd", { 2, 3, 4 }, 2, 47);
            }).find("its data hold at most 47"),
            std::string::npos);
  const std::int64_t most = std::int64_t{ 1 } << 30;
  Refusal([&] { CheckSize("a.nrrd", { most, most, most }, 8, UINT64_MAX); });
  Refusal([&] { CheckSize("a.nrrd", { most + 1, 1, 1 }, 1, UINT64_MAX); });
}

} // namespace
} // namespace voxelcore::testing
