#include "ScanBytes.h"

#include <cmath>
#include <csignal>
#include <random>
#include <sys/resource.h>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

LabelShape
Blob(std::int64_t value, const VoxelBox & box)
{
  LabelShape label;
  label.value = value;
  label.shape = VoxelShape(box);
  for (int z = 0; z < box.size[2]; ++z)
  {
    for (int y = 0; y < box.size[1]; ++y)
    {
      for (int x = 0; x < box.size[0]; ++x)
      {
        if ((x + y + z) % 3 != 0 || x == 0)
        {
          label.shape.Insert(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z);
        }
      }
    }
  }
  label.voxels = label.shape.CountVoxels();
  return label;
}

ImageGeometry
Geometry()
{
  ImageGeometry geometry;
  geometry.size = { 90, 20, 10 };
  geometry.spacing = { 0.5, 1.0 / 3, 2.5 };
  geometry.origin = { -12.25, 100.0 / 7, 3 };
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  geometry.direction = { c, -s, 0, s, c, 0, 0, 0, -1 };
  return geometry;
}

std::size_t
FilesIn(const TempFolder & folder)
{
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.Path()), {}));
}

} // namespace

TEST(WriteLabelVolume, EveryFormatReadsBackTheSame)
{
  const ImageGeometry geometry = Geometry();
  for (const std::int64_t top : { 250L, 60000L, 70000L, 5000000000L })
  {
    const std::vector<LabelShape> labels{ Blob(3, { { 1, 2, 3 }, { 70, 5, 6 } }),
                                          Blob(top, { { 0, 10, 0 }, { 90, 10, 10 } }) };
    for (const char * name : { "a.nrrd", "a.nii", "a.nii.gz", "a.mha", "a.mhd", "a.tif" })
    {
      for (const bool compress : { true, false })
      {
        const TempFolder folder;
        WriteLabelVolume(folder / name, geometry, labels, compress);
        const LabelMap volume = ReadLabelVolume(folder / name);
        ASSERT_EQ(volume.labels.size(), 2U) << name;
        EXPECT_EQ(volume.pixelType,
                  top <= 255          ? "uint8"
                  : top <= 65535      ? "uint16"
                  : top <= 4294967295 ? "uint32"
                                      : "uint64")
          << name;
        for (std::size_t l = 0; l < 2; ++l)
        {
          EXPECT_EQ(volume.labels[l].value, labels[l].value);
          EXPECT_EQ(volume.labels[l].voxels, labels[l].voxels);
          const VoxelShape tight = CropToVoxels(labels[l].shape);
          ASSERT_EQ(volume.labels[l].shape.Box().lower, tight.Box().lower) << name;
          ASSERT_EQ(volume.labels[l].shape.Box().size, tight.Box().size) << name;
          for (int z = 0; z < tight.Box().size[2]; ++z)
          {
            for (int y = 0; y < tight.Box().size[1]; ++y)
            {
              const auto a = tight.Row(y, z);
              const auto b = volume.labels[l].shape.Row(y, z);
              EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << name;
            }
          }
        }
        if (std::string(name) != "a.tif")
        {
          const double tolerance = std::string(name).starts_with("a.nii") ? 1e-5 : 1e-12;
          ExpectNear(volume.geometry.spacing, geometry.spacing, tolerance);
          ExpectNear(volume.geometry.origin, geometry.origin, tolerance);
          for (std::size_t i = 0; i < 9; ++i)
          {
            EXPECT_NEAR(volume.geometry.direction[i], geometry.direction[i], tolerance) << name;
          }
        }
        EXPECT_EQ(FilesIn(folder), std::string(name) == "a.mhd" ? 2U : 1U) << name;
      }
    }
  }
}

TEST(WriteLabelVolume, WhatCannotBeWrittenIsSaidAndLeavesNothing)
{
  const TempFolder              folder;
  const ImageGeometry           geometry = Geometry();
  const std::vector<LabelShape> labels{ Blob(3, { { 1, 2, 3 }, { 70, 5, 6 } }) };
  EXPECT_THROW(WriteLabelVolume(folder / "a.png", geometry, labels), UsageError);
  EXPECT_THROW(WriteLabelVolume(folder / "a", geometry, labels), UsageError);
  EXPECT_THROW(WriteLabelVolume(folder / "nowhere/a.nrrd", geometry, labels), OutputError);
  EXPECT_THROW(WriteLabelVolume("/proc/a.nrrd", geometry, labels), OutputError);
  EXPECT_THROW(WriteLabelVolume(folder / "a.nrrd", geometry, { Blob(0, { { 0, 0, 0 }, { 2, 2, 2 } }) }), UsageError);
  EXPECT_THROW(WriteLabelVolume(folder / "a.nrrd", geometry, { Blob(1, { { 80, 0, 0 }, { 11, 2, 2 } }) }), UsageError);
  EXPECT_THROW(WriteLabelVolume(folder / "a.nrrd", geometry, { Blob(1, { { -1, 0, 0 }, { 2, 2, 2 } }) }), UsageError);
  const std::vector<LabelShape> overlapping{ labels[0], Blob(4, { { 1, 2, 3 }, { 2, 2, 2 } }) };
  EXPECT_THROW(WriteLabelVolume(folder / "a.nrrd", geometry, overlapping), UsageError);
  EXPECT_EQ(FilesIn(folder), 0U);
}

TEST(WriteLabelVolume, ReplacesAnOlderFile)
{
  const TempFolder folder;
  folder.Write("a.nrrd", "old");
  WriteLabelVolume(folder / "a.nrrd", Geometry(), { Blob(3, { { 1, 2, 3 }, { 70, 5, 6 } }) });
  EXPECT_EQ(ReadLabelVolume(folder / "a.nrrd").labels.size(), 1U);
}

TEST(WriteLabelVolume, OmeZarrHoldsAxesThatLieAlongThoseOfThePatient)
{
  ImageGeometry geometry = Geometry();
  geometry.direction = { 0, -1, 0, 0, 0, 1, -1, 0, 0 };
  const std::vector<LabelShape> labels{ Blob(3, { { 1, 2, 3 }, { 70, 5, 6 } }),
                                        Blob(5000000000, { { 0, 10, 0 }, { 90, 10, 10 } }) };
  const TempFolder              folder;
  for (int again = 0; again < 2; ++again) // replaces the older store, too
  {
    WriteLabelVolume(folder / "a.ome.zarr", geometry, labels);
    const LabelMap volume = ReadLabelVolume(folder / "a.ome.zarr");
    ASSERT_EQ(volume.labels.size(), 2U);
    for (std::size_t l = 0; l < 2; ++l)
    {
      EXPECT_EQ(volume.labels[l].value, labels[l].value);
      EXPECT_EQ(volume.labels[l].voxels, labels[l].voxels);
      EXPECT_EQ(volume.labels[l].shape.Box().lower, CropToVoxels(labels[l].shape).Box().lower);
    }
    ExpectNear(volume.geometry.spacing, geometry.spacing, 1e-12);
    ExpectNear(volume.geometry.origin, geometry.origin, 1e-12);
    EXPECT_EQ(volume.geometry.direction, geometry.direction);
    EXPECT_EQ(FilesIn(folder), 1U);
  }
  EXPECT_THROW(WriteLabelVolume(folder / "b.ome.zarr", Geometry(), labels), UsageError);
  EXPECT_EQ(FilesIn(folder), 1U);
}

TEST(WriteLabelVolume, AFullDiskIsSaidInOneLineAndLeavesNothing)
{
  // A limit on the size of files stands in for the end of a disk.
  ImageGeometry geometry;
  geometry.size = { 64, 64, 64 };
  LabelShape label;
  label.value = 70000;
  label.shape = VoxelShape({ { 0, 0, 0 }, { 64, 64, 64 } });
  std::mt19937 random(5);
  for (int i = 0; i < 100000; ++i)
  {
    label.shape.Insert(random() % 64, random() % 64, random() % 64);
  }
  const auto onSignal = std::signal(SIGXFSZ, SIG_IGN);
  rlimit     before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{ 16384, before.rlim_max };
  for (const char * name : { "a.nrrd", "a.nii", "a.nii.gz", "a.mha", "a.mhd", "a.tif", "a.ome.zarr" })
  {
    for (const bool compress : { true, false })
    {
      const TempFolder folder;
      std::string      message;
      ::testing::internal::CaptureStderr();
      setrlimit(RLIMIT_FSIZE, &small);
      try
      {
        WriteLabelVolume(folder / name, geometry, { label }, compress);
      }
      catch (const OutputError & error)
      {
        message = error.what();
      }
      setrlimit(RLIMIT_FSIZE, &before);
      EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << name;
      EXPECT_NE(message.find("cannot write '" + (folder / name).string() + "': File too large"), std::string::npos)
        << name << ": " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_EQ(FilesIn(folder), 0U) << name;
    }
  }
  std::signal(SIGXFSZ, onSignal);
}
