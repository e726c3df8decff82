#include "JobFolder.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Jobs/InfoJob.h"
#include "voxelcore/Shape/ShapeTopology.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace voxelcore::testing
{
namespace
{

class InfoJob : public JobFolder
{
protected:
  ScanInfo
  Info(const std::string & scan, ParameterValues more = {}) const
  {
    more.insert({ { "scan", At(scan) } });
    return RunInfoJob(InfoOptionsFrom(more));
  }
};

TEST_F(InfoJob, TellsOfEachLabelWhatIsThere)
{
  RunPhantomJob(PhantomOptionsFrom(
    { { "kind", "shell" }, { "size", "20" }, { "spacing", "0.5,0.5,2" }, { "output", At("a.nrrd") } }));
  const LabelMap volume = ReadLabelVolume(At("a.nrrd"), {});
  const ScanInfo info = Info("a.nrrd");
  ASSERT_EQ(info.labels.size(), 1U);
  const LabelInfo & label = info.labels[0];
  EXPECT_EQ(info.format, volume.format);
  EXPECT_EQ(info.geometry.spacing, volume.geometry.spacing);
  EXPECT_EQ(info.orientation, OrientationLetters(volume.geometry));
  EXPECT_EQ(label.label, 1);
  EXPECT_EQ(label.voxels, volume.labels[0].voxels);
  EXPECT_DOUBLE_EQ(label.volumeMm3, 0.5 * static_cast<double>(label.voxels));
  EXPECT_EQ(label.box.lower, volume.labels[0].shape.Box().lower);
  EXPECT_EQ(label.box.size, volume.labels[0].shape.Box().size);
  EXPECT_EQ(label.topology, ComputeShapeTopology(volume.labels[0].shape));
  EXPECT_EQ(label.closed, ComputeClosedTopology(volume.labels[0].shape));
  ASSERT_TRUE(info.core && info.skeleton && info.page);
  EXPECT_GT(info.skeleton->memoryBytes, 0);
  EXPECT_FALSE(info.grey);

  const auto json = nlohmann::json::parse(InfoJson(info));
  EXPECT_EQ(json.at("labels").at(0).at("voxels"), label.voxels);
  EXPECT_EQ(InfoJson(info).back(), '\n');
  const std::string text = InfoText(info);
  EXPECT_NE(text.find(std::to_string(label.voxels)), std::string::npos) << text;
}

TEST_F(InfoJob, ASkeletonOfABodyThatTheBorderCutsIsForetoldToTakeLonger)
{
  RunPhantomJob(
    PhantomOptionsFrom({ { "kind", "cells" }, { "size", "40" }, { "cells", "30" }, { "output", At("a.nrrd") } }));
  InfoOptions options = InfoOptionsFrom({ { "scan", At("a.nrrd") } });
  EXPECT_EQ(options.skeletonBorder, BorderEnds::Open) << "as skeleton has it";
  const ScanInfo open = RunInfoJob(options);
  options.skeletonBorder = BorderEnds::Closed;
  const ScanInfo closed = RunInfoJob(options);
  EXPECT_GT(open.skeleton->seconds, 1.1 * closed.skeleton->seconds);
  EXPECT_EQ(open.core->seconds, closed.core->seconds);
}

TEST_F(InfoJob, PiecesThatTouchInCornersAreCountedBothWays)
{
  RunPhantomJob(PhantomOptionsFrom({ { "kind", "noise" }, { "size", "9" }, { "output", At("a.nrrd") } }));
  const LabelInfo label = Info("a.nrrd").labels.at(0);
  EXPECT_LT(label.closed.betti[0], label.topology.betti[0]);
  const auto split = Info("a.nrrd", { { "split-components", "true" } }).labels;
  ASSERT_EQ(split.size(), static_cast<std::size_t>(label.topology.betti[0]));
  std::uint64_t voxels = 0;
  for (std::size_t i = 0; i < split.size(); ++i)
  {
    EXPECT_EQ(split[i].component, static_cast<std::int64_t>(i + 1));
    EXPECT_TRUE(i == 0 || split[i].voxels <= split[i - 1].voxels) << "by size";
    EXPECT_EQ(split[i].topology.betti[0], 1);
    voxels += split[i].voxels;
  }
  EXPECT_EQ(voxels, label.voxels);
}

TEST_F(InfoJob, OrientationIsThatOfEveryTurnOfTheAxes)
{
  const std::string          positive = "LPS";
  const std::string          negative = "RAI";
  std::array<std::size_t, 3> order{ 0, 1, 2 };
  do
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      ImageGeometry geometry;
      geometry.direction.fill(0);
      std::string expected;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const bool isNegative = (signs >> axis & 1) != 0;
        // A little oblique.
        for (std::size_t row = 0; row < 3; ++row)
        {
          geometry.direction[3 * row + axis] = 0.1;
        }
        geometry.direction[3 * order[axis] + axis] = isNegative ? -0.98 : 0.98;
        expected += (isNegative ? negative : positive)[order[axis]];
      }
      EXPECT_EQ(OrientationLetters(geometry), expected);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(OrientationLetters(ImageGeometry{}), "LPS");
  ImageGeometry between; // 45 degrees: no letter twice
  const double  c = std::sqrt(0.5);
  between.direction = { c, -c, 0, c, c, 0, 0, 0, 1 };
  const std::string letters = OrientationLetters(between);
  EXPECT_EQ((std::set<char>(letters.begin(), letters.end()).size()), 3U) << letters;
}

TEST_F(InfoJob, AGreyScanIsToldUnlessTheUserSaysWhatItIs)
{
  std::string   bytes = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 30 30 30\nspacings: 1 1 1\nencoding: raw\n\n";
  std::uint32_t state = 1;
  for (int i = 0; i < 30 * 30 * 30; ++i)
  {
    state = state * 1664525U + 1013904223U;
    bytes += static_cast<char>(40 + (state >> 24U) % 150);
  }
  WriteAll(At("grey.nrrd"), bytes);
  const ScanInfo info = Info("grey.nrrd");
  ASSERT_TRUE(info.grey.has_value());
  EXPECT_TRUE(info.labels.empty());
  EXPECT_FALSE(info.core || info.skeleton || info.page) << "nothing is foretold of what is no label";
  EXPECT_NE(InfoText(info).find("--threshold " + ProposedRange(*info.grey)), std::string::npos);
  EXPECT_NE(InfoJson(info).find(ProposedRange(*info.grey)), std::string::npos);
  ASSERT_EQ(info.proposals.size(), 2U);
  for (const GreyProposal & one : info.proposals)
  {
    // What is said of a threshold is what it gives.
    const ScanInfo taken = Info("grey.nrrd", { { "threshold", std::to_string(one.threshold) + ":inf" } });
    ASSERT_EQ(taken.labels.size(), 1U) << one.name;
    EXPECT_EQ(taken.labels[0].voxels, one.voxels) << one.name;
    EXPECT_EQ(taken.labels[0].topology, one.topology) << one.name;
  }
  EXPECT_FALSE(Info("grey.nrrd", { { "threshold", "100:inf" } }).grey);
  EXPECT_FALSE(Info("grey.nrrd", { { "binary", "true" } }).grey);
}

TEST_F(InfoJob, WhatCannotBeReadIsRefusedAndAWishToStopIsHeard)
{
  EXPECT_THROW(Info("none.nrrd"), InputError);
  Phantom("ball", "a.nrrd");
  EXPECT_THROW(Info("a.nrrd", { { "labels", "4" } }), InputError);
  EXPECT_THROW(RunInfoJob(InfoOptionsFrom({ { "scan", At("a.nrrd") } }), StoppingAfter(1)), Cancelled);
}

} // namespace
} // namespace voxelcore::testing
