#include "voxelcore/Base/Error.h"
#include "voxelcore/Labels/CropRange.h"

#include <gtest/gtest.h>

using namespace voxelcore;

TEST(CropRange, TextBecomesARange)
{
  const CropRange crop = ParseCrop("3:10,:7,:");
  EXPECT_EQ(crop.first, (std::array<std::int32_t, 3>{ 3, 0, 0 }));
  EXPECT_EQ(crop.end, (std::array<std::int32_t, 3>{ 10, 7, 0 }));
  for (const char * text : { "",
                             "1:2",
                             "1:2,3:4",
                             "5:5,:,:",
                             "9:5,:,:",
                             "a:b,:,:",
                             "-1:5,:,:",
                             "+1:5,:,:",
                             ":,:,:,:",
                             "1:99999999999,:,:",
                             "1 :2,:,:" })
  {
    EXPECT_THROW(ParseCrop(text), UsageError) << text;
  }
}

TEST(CropRange, OpenEndsAreThoseOfTheScan)
{
  const std::array<std::int64_t, 3> size{ 20, 7, 9 };
  const CropRange                   whole = ResolveCrop({}, size, "a.nrrd");
  EXPECT_EQ(whole.first, (std::array<std::int32_t, 3>{ 0, 0, 0 }));
  EXPECT_EQ(whole.end, (std::array<std::int32_t, 3>{ 20, 7, 9 }));
  EXPECT_EQ(CropText(ResolveCrop(ParseCrop("3:10,:,4:"), size, "a.nrrd")), "3:10,0:7,4:9");
  EXPECT_EQ(CropText(ParseCrop("3:10,:7,:")), "3:10,0:7,:");
}

TEST(CropRange, ThatReachesBeyondTheScanIsRefused)
{
  const std::array<std::int64_t, 3> size{ 20, 7, 9 };
  for (const char * text : { "20:,:,:", ":21,:,:", ":,:,9:10" })
  {
    try
    {
      ResolveCrop(ParseCrop(text), size, "a.nrrd");
      ADD_FAILURE() << text;
    }
    catch (const InputError & error)
    {
      EXPECT_EQ(std::string(error.what())
                  .find(std::string("a.nrrd: --crop ") + CropText(ParseCrop(text)) +
                        " reaches beyond the scan of 20 x 7 x 9 voxels"),
                0U)
        << error.what();
    }
  }
  CropRange empty;
  empty.first[1] = 3;
  empty.end[1] = 3;
  EXPECT_THROW(ResolveCrop(empty, size, "a.nrrd"), UsageError);
}
