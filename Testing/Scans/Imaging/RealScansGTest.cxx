// Scans of others: those Debian's mricron-data brings, and those in VOXELCORE_TEST_DATA. Skipped where they are not.

#include "ScanBytes.h"

#include <chrono>
#include <cstdlib>

using namespace voxelcore;
using namespace voxelcore::testing;

namespace
{

/** What nibabel finds in a file: numbers of labels and of voxels that have one, and the origin in LPS. */
struct ExpectedScan
{
  const char *  file;
  const char *  type;
  std::size_t   labels;
  std::uint64_t voxels;
  Vector3       spacing;
  Vector3       origin;
};

void
Check(const std::filesystem::path & path, const ExpectedScan & expected)
{
  SCOPED_TRACE(path.string());
  const LabelMap volume = ReadLabelVolume(path);
  std::uint64_t  voxels = 0;
  for (const LabelShape & label : volume.labels)
  {
    voxels += label.voxels;
  }
  EXPECT_EQ(volume.pixelType, expected.type);
  EXPECT_EQ(volume.labels.size(), expected.labels);
  EXPECT_EQ(voxels, expected.voxels);
  ExpectNear(volume.geometry.spacing, expected.spacing, 1e-5);
  ExpectNear(volume.geometry.origin, expected.origin, 1e-3);
}

std::filesystem::path
TestData()
{
  const char * folder = std::getenv("VOXELCORE_TEST_DATA");
  return folder == nullptr ? "" : folder;
}

bool
IsThere(const std::filesystem::path & path)
{
  std::error_code ignored;
  return !path.empty() && std::filesystem::exists(path, ignored);
}

} // namespace

TEST(RealScans, AtlasesOfMricron)
{
  const std::filesystem::path folder = "/usr/share/mricron/templates";
  if (!IsThere(folder))
  {
    GTEST_SKIP() << "the package mricron-data is not installed";
  }
  for (const ExpectedScan & expected : std::initializer_list<ExpectedScan>{
         { "AICHAmc.nii.gz", "uint8", 192, 144208, { 2, 2, 2 }, { -90, 0, 0 } },
         { "HarvardOxford-cort-maxprob-thr0-1mm.nii.gz", "uint8", 48, 1689547, { 1, 1, 1 }, { -90, 0, 0 } },
         { "JHU-WhiteMatter-labels-1mm.nii.gz", "uint8", 48, 170006, { 1, 1, 1 }, { 91, 126, -72 } },
         { "JHU-WhiteMatter-labels-2mm.nii.gz", "uint8", 48, 21118, { 2, 2, 2 }, { 90, 126, -72 } },
         { "aal.nii.gz", "uint8", 116, 1479969, { 1, 1, 1 }, { 90, 125, -71 } },
         { "brodmann.nii.gz", "uint8", 41, 1352119, { 1, 1, 1 }, { 90, 125, -71 } },
         { "inia19-NeuroMaps.nii.gz", "int16", 724, 801388, { 0.5, 0.5, 0.5 }, { 42, 57.5, -30 } },
         { "jhu189.nii.gz", "uint8", 189, 1771330, { 1, 1, 1 }, { 0, 0, 0 } },
         { "natbrainlab.nii.gz", "uint8", 32, 407432, { 1, 1, 1 }, { -78, 0, 0 } } })
  {
    Check(folder / expected.file, expected);
  }
  const LabelMap aal = ReadLabelVolume(folder / "aal.nii.gz");
  EXPECT_EQ(aal.labels.front().name, "Precentral_L");
  EXPECT_EQ(aal.labels.back().value, 116);
  EXPECT_EQ(aal.labels.back().name, "Vermis_10");
  ExpectRefused(folder / "inia19-t1-brain.nii.gz", { "fraction", "--threshold" });
}

TEST(RealScans, FormsThatDisagreeAreReported)
{
  const std::filesystem::path path = "/usr/share/mricron/templates/JHU-WhiteMatter-labels-1mm.nii.gz";
  if (!IsThere(path))
  {
    GTEST_SKIP() << "the package mricron-data is not installed";
  }
  const LabelMap volume = ReadLabelVolume(path);
  EXPECT_TRUE(HasNote(volume.warnings, "disagree by up to 362 mm: the qform")); // 181 voxels the other way
  EXPECT_EQ(volume.geometry.direction[8], -1);
  ReadOptions options;
  options.niftiForm = "sform";
  EXPECT_EQ(ReadLabelVolume(path, options).geometry.direction[8], 1);
}

TEST(RealScans, SegmentationsOfManyPrograms)
{
  const auto folder = TestData();
  if (!IsThere(folder / "mhalle+spl-knee-atlas/seg.nrrd"))
  {
    GTEST_SKIP() << "VOXELCORE_TEST_DATA names no folder with foreign scans";
  }
  for (const ExpectedScan & expected : std::initializer_list<ExpectedScan>{
         { "AIM-Harvard+pyradiomics/brain1_label.nrrd",
           "int32",
           1,
           4137,
           { 0.78125, 0.78125, 6.5 },
           { -99.609375, 99.609375, -78 } },
         { "SCIInstitute+Cleaver2/mickey.nrrd", "uint16", 5, 250047, { 1, 1, 1 }, { 0, 0, 0 } },
         { "mhalle+spl-abdominal-atlas/seg.nrrd",
           "int16",
           95,
           1446889,
           { 0.9375, 0.9375, 1.5 },
           { -119.53, 119.53, 84 } },
         { "mhalle+spl-knee-atlas/seg.nrrd",
           "int16",
           49,
           7338572,
           { 0.27734, 0.27734, 1 },
           { -70.86042, 70.86042, -59 } },
         { "stardist+stardist/mask3d.tif", "uint16", 51, 41468, { 1, 1, 1 }, { 0, 0, 0 } },
         { "wasserth+TotalSegmentator/example_seg_fast_force_split.nii.gz",
           "uint8",
           61,
           345988,
           { 3, 3, 3 },
           { 177.9563, -11.3190, 94.3018 } },
         { "Gubra-ApS+LSFM-mouse-brain-atlas/gubra_ventricular_mask_olf.nii.gz",
           "uint16",
           1,
           1167419,
           { 1, 1, 1 },
           { 230, 310, -162 } } })
  {
    Check(folder / expected.file, expected);
  }
  ExpectRefused(folder / "wasserth+TotalSegmentator/lung_vessels/lung_airways.nii.gz", { "nothing but background" });
}

TEST(RealScans, OddFilesAreReadOrRefusedInOneLineAndInTime)
{
  const auto folder = TestData();
  if (!IsThere(folder))
  {
    GTEST_SKIP() << "VOXELCORE_TEST_DATA names no folder";
  }
  const TempFolder temp;
  std::size_t      files = 0;
  for (const auto & entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (!entry.is_regular_file())
    {
      continue;
    }
    // Under every extension that a reader might be chosen by, so that fuzzed files meet the reader they were made for.
    std::vector<std::filesystem::path> paths{ entry.path() };
    if (entry.path().string().find("fuzz") != std::string::npos)
    {
      for (const char * name : { "a.tif", "a.nii", "a.nrrd", "a.mha" })
      {
        std::filesystem::copy_file(entry.path(), temp / name, std::filesystem::copy_options::overwrite_existing);
        paths.push_back(temp / name);
      }
    }
    for (const auto & path : paths)
    {
      const auto begin = std::chrono::steady_clock::now();
      try
      {
        ReadLabelVolume(path);
      }
      catch (const InputError & error)
      {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      }
      EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10)) << entry.path();
      ++files;
    }
  }
  EXPECT_GT(files, 0U);
}
