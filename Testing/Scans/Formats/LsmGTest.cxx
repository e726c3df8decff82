// LSM of Zeiss microscopes: TIFF with thumbnails between its slices, and a block of its own.

#include "ForeignBytes.h"
#include "ScanBytes.h"

#include <cmath>
#include <limits>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

class Lsm : public ::testing::Test
{
protected:
  LabelMap
  Read(const LsmLayout & layout, const ReadOptions & options = {}) const
  {
    return ReadLabelVolume(Write(layout), options);
  }
  std::filesystem::path
  Write(const LsmLayout & layout) const
  {
    return m_Folder.Write("a.lsm", LsmBytes(layout));
  }
  void
  ExpectForeignValues(const LabelMap & volume) const
  {
    const auto values = ForeignValues();
    EXPECT_EQ(AllValues(volume), std::vector<std::int64_t>(values.begin(), values.end()));
  }

  TempFolder m_Folder;
};

} // namespace

TEST_F(Lsm, SlicesAreReadAndThumbnailsPassedOver)
{
  for (const bool thumbnails : { true, false })
  {
    LsmLayout layout;
    layout.thumbnails = thumbnails;
    const LabelMap volume = Read(layout);
    ExpectForeignValues(volume);
    EXPECT_EQ(volume.format, "LSM");
    ExpectNear(volume.geometry.spacing, { 2e-4, 3e-4, 5e-4 });
    EXPECT_TRUE(HasNote(volume.notes, "the voxel size is from LSM"));
    EXPECT_TRUE(volume.warnings.empty());
  }
}

TEST_F(Lsm, ChannelsAndTimePointsMustBeChosen)
{
  LsmLayout layout;
  layout.channels = 2;
  ExpectRefused(Write(layout), { "several values", "--component" });
  ReadOptions options;
  options.component = 0;
  ExpectForeignValues(Read(layout, options));
  layout.channels = 1;
  layout.frames = 2;
  layout.kind = 6;
  ExpectRefused(Write(layout), { "LSM with 2 time points", "--volume 0 to --volume 1" });
  options = {};
  options.volume = 0;
  ExpectForeignValues(Read(layout, options));
}

TEST_F(Lsm, WithoutAVoxelSizeLengthsAreInVoxels)
{
  LsmLayout layout;
  layout.metres = { 0, -1, 0 };
  const LabelMap volume = Read(layout);
  EXPECT_EQ(volume.geometry.unit, SpatialUnit::Voxels);
  layout.metres = { std::numeric_limits<double>::infinity(), 1e-7, std::nan("") };
  EXPECT_EQ(Read(layout).geometry.unit, SpatialUnit::Voxels);
}

TEST_F(Lsm, WhatIsNoStackOrDamagedIsRefused)
{
  LsmLayout layout;
  layout.kind = 2;
  ExpectRefused(Write(layout), { "no stack of slices (kind 2)", "bfconvert" });
  layout = {};
  layout.slices = 5;
  ExpectRefused(Write(layout), { "LSM speaks of 5 slices, it has 4" });
  layout = {};
  layout.magic = 7;
  ExpectRefused(Write(layout), { "block of LSM" });
  layout = {};
  layout.blockBytes = 40;
  ExpectRefused(Write(layout), { "block of LSM" });
  layout = {};
  layout.frames = -1;
  ExpectRefused(Write(layout), { "a side that is none" });
  layout = {};
  layout.width = 7;
  ExpectRefused(Write(layout), { "speaks of other pages" });
  layout = {};
  layout.magic = 0x0300494C; // of older microscopes
  ExpectForeignValues(Read(layout));
}
