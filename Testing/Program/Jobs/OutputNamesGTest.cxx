#include "VoxelCoreTesting/TemporaryFolder.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Jobs/OutputNames.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

TEST(OutputNames, ScanNameLosesFolderAndExtensions)
{
  EXPECT_EQ(ScanName("/data/aal.nii.gz"), "aal");
  EXPECT_EQ(ScanName("liver.seg.nrrd"), "liver");
  EXPECT_EQ(ScanName("liver.v2.NRRD"), "liver.v2");
  EXPECT_EQ(ScanName("aparc+aseg.mgz"), ScanName("aparc+aseg.nrrd"));
  EXPECT_EQ(ScanName("a/cells.ome.zarr/"), "cells");
  EXPECT_EQ(ScanName("a/cells.zarr"), "cells");
  EXPECT_EQ(ScanName("a/slices/"), "slices");
  EXPECT_EQ(ScanName("a/slices"), "slices");
  EXPECT_EQ(ScanName("my scan (2).tif"), "my_scan__2_");
  EXPECT_EQ(ScanName("slice_*.tif"), "slice__");
  EXPECT_EQ(ScanName(".nrrd"), ".nrrd");
  EXPECT_EQ(ScanName(".."), "scan");
}

TEST(OutputNames, BareNumbersAreMillimetres)
{
  const auto lambdas = ParseLambdas("0,1,1.5mm,2.5vox,2.5%");
  ASSERT_EQ(lambdas.size(), 5U);
  std::vector<std::string> tags;
  for (const Lambda & lambda : lambdas)
  {
    tags.push_back(LambdaTag(lambda));
  }
  EXPECT_EQ(tags, (std::vector<std::string>{ "0", "1mm", "1.5mm", "2.5vox", "2.5pct" }));
}

TEST(OutputNames, LambdasGivenTwiceAreRefused)
{
  EXPECT_THROW(ParseLambdas("1,1mm"), UsageError);
  EXPECT_THROW(ParseLambdas("0vox,0mm"), UsageError);
}

TEST(OutputNames, LambdasWithoutSenseAreRefused)
{
  for (const char * text : { "", ",", "1,", "3apples", "-1", "1e400", "nan", "inf", "1 2", "vox", "0x10" })
  {
    EXPECT_THROW(ParseLambdas(text), UsageError) << text;
  }
}

TEST(OutputNames, SeveralLambdasGetTheirTextIntoTheName)
{
  const auto one = ResultSuffixes(ParseLambdas("1mm"));
  const auto two = ResultSuffixes(ParseLambdas("0,2.5%"));
  EXPECT_EQ(FileOutputPath("d/OUT.vtp", one[0]), "d/OUT.vtp");
  EXPECT_EQ(FileOutputPath("d/OUT.vtp", two[0]), "d/OUT_lambda-0.vtp");
  EXPECT_EQ(FileOutputPath("d/OUT.vtp", two[1]), "d/OUT_lambda-2.5pct.vtp");
  EXPECT_EQ(FolderOutputPath("d", "aal.nii.gz", 4, one[0]), "d/aal_label-4_medial.vtp");
  EXPECT_EQ(FolderOutputPath("d/", "aal.nii.gz", 4, two[1]), "d/aal_label-4_medial_lambda-2.5pct.vtp");
  EXPECT_EQ(FolderOutputPath("d", "aal.nii.gz", 4, two[1], 12), "d/aal_label-4_component-12_medial_lambda-2.5pct.vtp");
  const auto suffixes = ResultSuffixes(ParseLambdas("0"), ParseTolerances("0,1,1.2 diag"));
  EXPECT_EQ(suffixes, (std::vector<std::string>{ "_tolerance-0", "_tolerance-1mm", "_tolerance-1.2diag" }));
  EXPECT_EQ(FileOutputPath("d/OUT.vtp", suffixes[2]), "d/OUT_tolerance-1.2diag.vtp");
  EXPECT_EQ(ResultSuffixes(ParseLambdas("0"), ParseTolerances("1diag")), std::vector<std::string>{ "" });
}

TEST(OutputNames, ASlashOrAnExistingFolderMeansAFolder)
{
  const testing::TemporaryFolder folder;
  EXPECT_TRUE(IsFolderOutput("new/"));
  EXPECT_TRUE(IsFolderOutput(folder.Path()));
  EXPECT_FALSE(IsFolderOutput("new"));
  EXPECT_FALSE(IsFolderOutput("new.vtp"));
}

TEST(OutputNames, SkeletonsAreNamedAfterTheirScanOrTheCoreBeside)
{
  EXPECT_EQ(SkeletonFolderPath("d", "s/aal.nii.gz", 4), "d/aal_label-4_skeleton.vtp");
  EXPECT_EQ(SkeletonFolderPath("d/", "aal.nii.gz", 4, 2), "d/aal_label-4_component-2_skeleton.vtp");
  EXPECT_EQ(SkeletonFolderPath("d", "s/aal_label-4_component-2_medial_lambda-0.vtp", 4, 2),
            "d/aal_label-4_component-2_skeleton.vtp");
  EXPECT_EQ(SkeletonFolderPath("d", "whole.core.vtp", 4), "d/whole.core_label-4_skeleton.vtp");
  EXPECT_EQ(SkeletonTablesPath("d", "aal_medial.vtp"), "d/aal_skeleton.vtp");
  EXPECT_EQ(SkeletonBesideCore("d/OUT.ply"), "d/OUT_skeleton.vtp");
  EXPECT_EQ(SkeletonBesideCore("d/"), "d/");
}

} // namespace
} // namespace voxelcore
