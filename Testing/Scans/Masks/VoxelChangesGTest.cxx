#include "voxelcore/Masks/VoxelChanges.h"

#include "VoxelCoreTesting/Shapes.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace voxelcore::testing
{
namespace
{

bool
AreSame(const VoxelShape & a, const VoxelShape & b)
{
  return ChangesBetween(a, b).empty();
}

TEST(VoxelChanges, WhatIsWrittenIsReadBack)
{
  const VoxelChanges changes{ { true, { 1, 2, 3 }, 1 }, { false, { 0, 70, 5 }, 130 } };
  EXPECT_EQ(VoxelChangesText(changes), "+1,2,3 -0,70,5x130");
  EXPECT_EQ(ParseVoxelChanges(VoxelChangesText(changes)), changes);
  EXPECT_EQ(ParseVoxelChanges("# a remark +9,9,9\n  +1,2,3  # another\n\n\t-0,70,5x130\r\n"), changes);
  EXPECT_TRUE(ParseVoxelChanges("").empty());
}

TEST(VoxelChanges, ARunThatIsNoneIsRefusedByItsName)
{
  for (const char * word :
       { "1,2,3", "+1,2", "+1,2,3,4", "-1,2,3x", "-1,2,3x0", "+1,-2,3", "+a,2,3", "+1,2,3y4", "+", "+99999999999,1,1" })
  {
    try
    {
      ParseVoxelChanges(std::string("+1,1,1 ") + word);
      FAIL() << word;
    }
    catch (const UsageError & error)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST(VoxelChanges, BetweenRandomShapesTheyMakeOneOfTheOther)
{
  const std::uint64_t seed = std::random_device{}();
  Random              random(seed);
  for (int turn = 0; turn < 20; ++turn)
  {
    const VoxelShape before = RandomShape(random, { 70, 5, 4 }, 0.3);
    VoxelShape       after = RandomShape(random, { 9, 8, 7 }, 0.4);
    const auto       changes = ParseVoxelChanges(VoxelChangesText(ChangesBetween(before, after)));
    const auto       made = ChangeVoxels(before, changes);
    EXPECT_TRUE(AreSame(made.shape, after)) << "seed " << seed;
    EXPECT_EQ(before.CountVoxels() + made.voxelsAdded - made.voxelsRemoved, after.CountVoxels());
    EXPECT_TRUE(AreSame(ChangeVoxels(made.shape, ChangesBetween(after, before)).shape, before)) << "seed " << seed;
  }
}

TEST(VoxelChanges, ALaterRunTakesPrecedenceAndBackgroundCanBeTakenOut)
{
  const auto made = ChangeVoxels(Box({ 3, 3, 3 }), ParseVoxelChanges("+5,1,1x2 -5,1,1 -40,40,40x9 -0,0,0"));
  EXPECT_TRUE(made.shape.Contains(6, 1, 1));
  EXPECT_FALSE(made.shape.Contains(5, 1, 1));
  EXPECT_FALSE(made.shape.Contains(0, 0, 0));
  EXPECT_EQ(made.voxelsAdded, 1U);
  EXPECT_EQ(made.voxelsRemoved, 1U);
  EXPECT_EQ(made.shape.CountVoxels(), 27U);
}

TEST(VoxelChanges, AFileThatIsMissingOrWrongIsNamed)
{
  EXPECT_THROW(ReadVoxelChanges("/no/such/file.txt"), InputError);
  const testing::TemporaryFolder folder;
  testing::WriteAll(folder / "bad.txt", "+1,2,3 nonsense");
  EXPECT_THROW(ReadVoxelChanges(folder / "bad.txt"), InputError);
}

} // namespace
} // namespace voxelcore::testing
