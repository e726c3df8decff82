#include "voxelcore/Verification/NetworkVerification.h"

#include <gtest/gtest.h>

#include <functional>

namespace voxelcore::testing
{
namespace
{

/** Two bars in a row, labels 4 and 7, and a line through both that is cut between them. */
struct TwoBars
{
  TwoBars()
  {
    for (std::int32_t i = 0; i < 90; ++i)
    {
      first.Insert(i % 10, i / 10 % 3, i / 30);
      second.Insert(10 + i % 10, i / 10 % 3, i / 30);
    }
    claims.labels = { { 4, &first }, { 7, &second } };
    claims.contacts = { { { 4, 7 }, 18, 9, { { 10, 1.5, 1.5 } } } };
    claims.components = 1;
    claims.euler = 1;
  }

  std::vector<std::string>
  Problems()
  {
    claims.positions = positions;
    claims.pointLabels = labels;
    claims.contactPoints = marks;
    claims.branchOffsets = offsets;
    claims.branchPoints = points;
    return CheckNetwork(claims);
  }

  VoxelShape                         first{ VoxelBox{ { 0, 0, 0 }, { 10, 3, 3 } } };
  VoxelShape                         second{ VoxelBox{ { 10, 0, 0 }, { 10, 3, 3 } } };
  std::vector<std::array<double, 3>> positions{ { 1, 1.5, 1.5 }, { 5, 1.5, 1.5 }, { 10, 1.5, 1.5 }, { 15, 1.5, 1.5 } };
  std::vector<std::int64_t>          labels{ 4, 4, 4, 7 };
  std::vector<std::uint8_t>          marks{ 0, 0, 1, 0 };
  std::vector<std::uint64_t>         offsets{ 0, 3, 5 };
  std::vector<std::uint32_t>         points{ 0, 1, 2, 2, 3 };
  NetworkClaims                      claims;
};

TEST(NetworkVerification, ATrueNetworkHasNoProblems)
{
  TwoBars bars;
  EXPECT_TRUE(bars.Problems().empty());
}

TEST(NetworkVerification, EveryFalseClaimIsFound)
{
  const std::vector<std::pair<const char *, std::function<void(TwoBars &)>>> damages{
    { "a component more", [](TwoBars & bars) { bars.claims.components = 2; } },
    { "a cycle more", [](TwoBars & bars) { bars.claims.euler = 0; } },
    { "a branch of two labels", [](TwoBars & bars) { bars.labels[1] = 7; } },
    { "a contact within a branch", [](TwoBars & bars) { bars.marks[1] = 1; } },
    { "a contact unsaid", [](TwoBars & bars) { bars.claims.contacts.clear(); } },
    { "a contact that is none",
      [](TwoBars & bars) {
        bars.claims.contacts.push_back({ { 4, 9 }, 1, 0, {} });
      } },
    { "voxels of a contact", [](TwoBars & bars) { bars.claims.contacts[0].voxels = 17; } },
    { "faces of a contact", [](TwoBars & bars) { bars.claims.contacts[0].faces = 8; } },
    { "a contact's labels",
      [](TwoBars & bars) {
        bars.claims.contacts[0].labels = { 4, 8 };
      } },
    { "a place at a tip",
      [](TwoBars & bars) {
        bars.claims.contacts[0].places[0] = { 1, 1.5, 1.5 };
      } },
    { "a place nobody has", [](TwoBars & bars) { bars.claims.contacts[0].places.clear(); } },
    { "a place within one label", [](TwoBars & bars) { bars.labels[3] = 4; } },
    { "a voxel of a label gone", [](TwoBars & bars) { bars.second.Row(1, 1)[0] &= ~std::uint64_t{ 1 }; } },
  };
  for (const auto & [what, damage] : damages)
  {
    TwoBars bars;
    damage(bars);
    EXPECT_FALSE(bars.Problems().empty()) << what;
  }
}

TEST(NetworkVerification, AGapIsAPlaceWithoutAContact)
{
  TwoBars bars;
  bars.claims.contacts[0].places.clear();
  bars.claims.gaps = { { 10, 1.5, 1.5 } };
  EXPECT_TRUE(bars.Problems().empty());
}

} // namespace
} // namespace voxelcore::testing
