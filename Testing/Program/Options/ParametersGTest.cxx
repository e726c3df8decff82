#include "voxelcore/Options/Command.h"
#include "voxelcore/Options/Parameters.h"

#include <gtest/gtest.h>

namespace voxelcore
{
namespace
{

const Parameter &
Find(std::string_view command, std::string_view name)
{
  for (const Command & one : Commands())
  {
    if (one.name == command)
    {
      return *FindParameter(one.rows, name);
    }
  }
  throw std::out_of_range("no such command");
}

TEST(Parameters, PythonsKeywordIsTheNameUnlessTheRowSaysOtherwise)
{
  EXPECT_EQ(KeywordOf(Find("core", "min-voxels")), "min_voxels");
  EXPECT_EQ(KeywordOf(Find("core", "labels")), "label");
  EXPECT_EQ(KeywordOf(Find("core", "change-voxels")), "");
  EXPECT_EQ(KeywordOf(Find("core", "scan")), "");
  EXPECT_EQ(KeywordOf(Find("core", "force")), "overwrite=True");
  EXPECT_EQ(KeywordOf(Find("compare", "no-skeletons")), "no_skeletons");
}

TEST(Parameters, AFormerNameIsTakenForTheOneOfToday)
{
  EXPECT_EQ(WithoutFormerName("--bumps"), "--tolerance");
  EXPECT_EQ(WithoutFormerName("--bumps=1diag"), "--tolerance=1diag");
  EXPECT_EQ(WithoutFormerName("--bumpsy"), "--bumpsy");
}

} // namespace
} // namespace voxelcore
