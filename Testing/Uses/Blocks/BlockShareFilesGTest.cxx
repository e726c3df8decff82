// Shares that are missing, repeated, foreign, damaged or wrong are refused with one line, never joined.

#include "voxelcore/Blocks/HaloBlocks.h"

#include "HaloBlocksFixture.h"
#include "ShareCoding.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>
#include <functional>
#include <sstream>
#include <sys/resource.h>

namespace voxelcore
{
namespace
{

using testing::SharesOf;
using testing::WholeShape;

std::string
Written(const BlockShare & share)
{
  std::ostringstream stream;
  WriteBlockShare(share, stream);
  return stream.str();
}

BlockShare
Read(const std::string & bytes)
{
  std::istringstream stream(bytes);
  return ReadBlockShare(stream, "part.vxb");
}

template <typename TError>
std::string
MessageOf(const std::function<void()> & act)
{
  try
  {
    act();
  }
  catch (const TError & error)
  {
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos);
    return text;
  }
  catch (const std::exception & error)
  {
    ADD_FAILURE() << "another error: " << error.what();
    return "";
  }
  ADD_FAILURE() << "no error";
  return "";
}

class Shares : public ::testing::Test
{
protected:
  Shares()
    : whole(testing::Ellipsoid(24), { 1, 1, 2 })
    , shares(SharesOf(whole.shape, whole.weights, PlanBlocks(whole.shape, whole.weights, 3), Engine::Lattice))
  {}

  void
  ExpectInputError(const std::vector<BlockShare> & given, const std::string & says) const
  {
    const std::string text = MessageOf<InputError>([&] { JoinBlockShares(given); });
    EXPECT_NE(text.find(says), std::string::npos) << text;
  }

  // The join of shares one of which was changed is refused.
  void
  ExpectMisfit(const std::function<void(BlockShare &)> & change, const std::string & says) const
  {
    std::vector<BlockShare> changed = shares;
    change(changed[1]);
    const std::string text = MessageOf<CertificateError>([&] { JoinBlockShares(changed); });
    EXPECT_NE(text.find(says), std::string::npos) << text;
  }

  // The first facet whose second cell is `beyond`, or another cell of the share when that is a number of one.
  static std::size_t
  FacetTo(const BlockShare & share, std::uint32_t beyond)
  {
    for (std::size_t facet = 0; facet < share.cells.FacetCount(); ++facet)
    {
      const std::uint32_t second = share.cells.facetCells[facet][1];
      if (beyond < kOtherBlock ? second < kOtherBlock : second == beyond)
      {
        return facet;
      }
    }
    throw Error("there is none");
  }

  WholeShape              whole;
  std::vector<BlockShare> shares;
};

TEST_F(Shares, AreReadAsTheyWereWritten)
{
  std::vector<BlockShare> read;
  for (const BlockShare & share : shares)
  {
    const std::string bytes = Written(share);
    read.push_back(Read(bytes));
    const BlockShare & back = read.back();
    EXPECT_TRUE(back.digest == share.digest && back.blockCount == 3 && back.block == share.block);
    EXPECT_TRUE(back.weight == share.weight && back.boundaryVertices == share.boundaryVertices &&
                back.boundarySquares == share.boundarySquares);
    EXPECT_TRUE(back.points == share.points && back.isOwn == share.isOwn);
    EXPECT_TRUE(back.cells.tetrahedra == share.cells.tetrahedra && back.cells.facetCells == share.cells.facetCells &&
                back.cells.facetOffsets == share.cells.facetOffsets &&
                back.cells.facetPoints == share.cells.facetPoints);
    EXPECT_EQ(Written(back), bytes);
  }
  whole.ExpectJoined(JoinBlockShares(read));
}

TEST_F(Shares, OfNegativeAndFarCoordinatesAreReadAsTheyWereWritten)
{
  const WholeShape        far(testing::Box({ 3, 4, 5 }, { -1000000, 900000, -3 }));
  std::vector<BlockShare> read;
  for (const BlockShare & share : SharesOf(far.shape, far.weights, PlanBlocks(far.shape, far.weights, 2), far.engine))
  {
    read.push_back(Read(Written(share)));
  }
  far.ExpectJoined(JoinBlockShares(read));
}

TEST_F(Shares, MissingOrRepeatedAreRefused)
{
  ExpectInputError({}, "no blocks");
  ExpectInputError({ shares[0], shares[2] }, "block 2 of 3 is missing");
  ExpectInputError({ shares[0], shares[1] }, "block 3 of 3 is missing");
  ExpectInputError({ shares[0], shares[1], shares[1] }, "block 2 was given twice");
  ExpectInputError({ shares[0], shares[1], shares[2], shares[0] }, "block 1 was given twice");
}

TEST_F(Shares, OfOtherShapesWeightsOrCutsAreRefused)
{
  const auto from = [](const VoxelShape & shape, const SpacingWeights & weights, std::size_t count) {
    return ComputeBlockShare(shape, weights, PlanBlocks(shape, weights, count), 1);
  };
  VoxelShape dented = whole.shape;
  dented.Row(12, 12)[0] ^= std::uint64_t{ 1 } << 12;
  ExpectInputError({ shares[0], from(dented, whole.weights, 3), shares[2] }, "block 2 was cut from another shape");
  ExpectInputError({ shares[0], from(whole.shape, ComputeSpacingWeights({ 1, 1, 3 }), 3), shares[2] }, "another shape");
  ExpectInputError({ shares[0], from(whole.shape, whole.weights, 4), shares[2] }, "with other options");
}

TEST_F(Shares, DamagedAnywhereAreRefused)
{
  const WholeShape  small(testing::Box({ 3, 2, 2 }));
  const std::string bytes =
    Written(ComputeBlockShare(small.shape, small.weights, PlanBlocks(small.shape, small.weights, 2), 1));
  ASSERT_GT(bytes.size(), 100U);
  for (std::size_t at = 0; at < bytes.size(); ++at)
  {
    for (const int bit : { 0, 3, 7 })
    {
      std::string damaged = bytes;
      damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
      const std::string text = MessageOf<InputError>([&] { Read(damaged); });
      ASSERT_EQ(text.rfind("part.vxb ", 0), 0U) << text;
    }
  }
  for (std::size_t length = 0; length < bytes.size(); ++length)
  {
    const std::string text = MessageOf<InputError>([&] { Read(bytes.substr(0, length)); });
    ASSERT_NE(text.find(length < 8 ? "is not a block's part" : "is cut off"), std::string::npos) << text;
  }
  EXPECT_NE(MessageOf<InputError>([&] { Read(bytes + "x"); }).find("goes on after its end"), std::string::npos);
  std::string newer = bytes;
  newer[8] = 3;
  EXPECT_NE(MessageOf<InputError>([&] { Read(newer); }).find("version 3"), std::string::npos);
}

TEST_F(Shares, WithMoreOfAnythingThanTheirBytesCanHoldAreRefusedBeforeMemoryIsTaken)
{
  const std::array<std::uint64_t, 4> few{ 1, 1, 4, 12 }; // points, cells, facets, corners
  const std::array<std::uint64_t, 4> many{ 1U << 24, 1U << 24, 1U << 24, std::uint64_t{ 1 } << 62 };
  rusage                             before{};
  getrusage(RUSAGE_SELF, &before);
  for (std::size_t which = 0; which < few.size(); ++which)
  {
    std::ostringstream stream;
    Encoder            to(stream);
    for (const char c : std::string("VoxelBlk"))
    {
      to.Byte(static_cast<std::uint8_t>(c));
    }
    for (const std::uint64_t number : { 2, 7, 7, 2, 1, 1, 1, 1, 8, 6, 6 })
    {
      to.Number(number);
    }
    for (std::size_t i = 0; i < few.size(); ++i)
    {
      to.Number(i == which ? many[i] : few[i]);
    }
    to.Sum();
    to.Flush();
    EXPECT_NE(MessageOf<InputError>([&] { Read(stream.str()); }).find("is cut off"), std::string::npos) << which;
  }
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 50 << 10);
}

TEST_F(Shares, ThatCannotBeWrittenAreReported)
{
  std::ostringstream stream;
  stream.setstate(std::ios::badbit);
  MessageOf<OutputError>([&] { WriteBlockShare(shares[0], stream); });
}

TEST_F(Shares, WithoutACellDoNotFit)
{
  ExpectMisfit(
    [](BlockShare & share) {
      // All facets of the last cell towards others become the others' open ones.
      DelaunayCells & cells = share.cells;
      const auto      gone = static_cast<std::uint32_t>(cells.CellCount() - 1);
      DelaunayCells   left;
      left.tetrahedra.assign(cells.tetrahedra.begin(), cells.tetrahedra.end() - 1);
      for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
      {
        auto pair = cells.facetCells[facet];
        if (pair[0] == gone)
        {
          continue;
        }
        pair[1] = pair[1] == gone ? kOtherBlock : pair[1];
        const auto polygon = cells.FacetPoints(facet);
        left.facetCells.push_back(pair);
        left.facetPoints.insert(left.facetPoints.end(), polygon.begin(), polygon.end());
        left.facetOffsets.push_back(left.facetPoints.size());
      }
      cells = left;
    },
    "a facet of a cell there has no cell on its other side");
}

TEST_F(Shares, WithoutAFacetDoNotFit)
{
  for (const std::uint32_t beyond : { kOutside, kOtherBlock, std::uint32_t{ 0 } })
  {
    ExpectMisfit(
      [beyond](BlockShare & share) {
        DelaunayCells &     cells = share.cells;
        const std::size_t   facet = FacetTo(share, beyond);
        const std::uint64_t size = cells.FacetPoints(facet).size();
        const auto          at = static_cast<std::ptrdiff_t>(cells.facetOffsets[facet]);
        cells.facetPoints.erase(cells.facetPoints.begin() + at,
                                cells.facetPoints.begin() + at + static_cast<std::ptrdiff_t>(size));
        cells.facetCells.erase(cells.facetCells.begin() + static_cast<std::ptrdiff_t>(facet));
        cells.facetOffsets.erase(cells.facetOffsets.begin() + static_cast<std::ptrdiff_t>(facet));
        for (std::size_t i = facet; i < cells.facetOffsets.size(); ++i)
        {
          cells.facetOffsets[i] -= size;
        }
      },
      "the surface of a cell there is not closed");
  }
}

TEST_F(Shares, WithAWrongSphereDoNotFit)
{
  // Another point in place of one of the four: another cell's, or one that makes them flat.
  ExpectMisfit([](BlockShare & share) { share.cells.tetrahedra[1][3] = share.cells.tetrahedra[1][0]; },
               "do not span a cell");
  ExpectMisfit([](BlockShare & share) { share.cells.tetrahedra.front() = share.cells.tetrahedra.back(); },
               "do not span a cell");
  // A point that moved, in whole shares that agree about it.
  std::vector<BlockShare> changed = shares;
  const LatticePoint      moved = shares[1].points[shares[1].points.size() / 2];
  for (BlockShare & share : changed)
  {
    const auto at = std::find(share.points.begin(), share.points.end(), moved);
    if (at != share.points.end())
    {
      at->y += 1;
    }
  }
  MessageOf<CertificateError>([&] { JoinBlockShares(changed); });
}

TEST_F(Shares, WithFacetsToTheWrongSideDoNotFit)
{
  ExpectMisfit([](BlockShare & share) { share.cells.facetCells[FacetTo(share, kOtherBlock)][1] = kOutside; },
               "is not a side of a voxel");
  ExpectMisfit([](BlockShare & share) { share.cells.facetCells[FacetTo(share, kOutside)][1] = kOtherBlock; },
               "squares");
}

TEST_F(Shares, ThatHoldAnothersCellsDoNotFit)
{
  // Block 2 with the cells of block 1: all of them twice, its own missing.
  std::vector<BlockShare> changed = shares;
  changed[1].cells = shares[0].cells;
  changed[1].points = shares[0].points;
  changed[1].isOwn = shares[0].isOwn;
  MessageOf<CertificateError>([&] { JoinBlockShares(changed); });
}

TEST_F(Shares, ThatDisagreeAboutPointsDoNotFit)
{
  const auto claimed = [](BlockShare & share) { return std::find(share.isOwn.begin(), share.isOwn.end(), 0); };
  ASSERT_NE(claimed(shares[1]), shares[1].isOwn.end());
  ExpectMisfit([&](BlockShare & share) { *claimed(share) = 1; }, "two blocks claim it");
  ExpectMisfit([](BlockShare & share) { *std::find(share.isOwn.begin(), share.isOwn.end(), 1) = 0; },
               "boundary vertices; compute them again");
  ExpectMisfit(
    [&](BlockShare & share) { ++share.points[static_cast<std::size_t>(claimed(share) - share.isOwn.begin())].z; },
    "it is no boundary vertex of any block");
}

} // namespace
} // namespace voxelcore
