// When the filter runs, and what it leaves behind when it stops.

#include "ItkShapeFixtures.h"

using namespace voxelcore;
using namespace voxelcore::testing;

TEST(ItkShapeUpdates, WorksAgainAfterARefusal)
{
  const auto spy = ScatteredSpy();
  auto       filter = ByteFilter::New();
  filter->SetInput(spy->GetOutput());
  filter->SetNumberOfStreamDivisions(4);
  filter->SetLabel(9);
  ThrownBy([&] { filter->Update(); });
  EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
  ThrownBy([&] { filter->Update(); }); // nothing was mended: it does not pretend to be up to date
  filter->SetLabels("all");
  filter->Update();
  ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });

  spy->failAt = static_cast<int>(spy->regions.size()) + 2;
  spy->Modified();
  EXPECT_NE(ThrownBy([&] { filter->Update(); }).find("the source failed"), std::string::npos);
  EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
  spy->failAt = -1;
  filter->Update();
  ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
}

TEST(ItkShapeUpdates, RunsOnlyWhenSomethingChanged)
{
  const auto spy = ScatteredSpy();
  auto       filter = ByteFilter::New();
  Watcher    watcher(filter);
  filter->SetInput(spy->GetOutput());
  filter->SetNumberOfStreamDivisions(4);
  const auto expectRuns = [&](int runs) {
    filter->Update();
    filter->UpdateLargestPossibleRegion();
    filter->GetOutput()->Update();
    EXPECT_EQ(watcher.starts, runs);
    EXPECT_EQ(spy->regions.size(), static_cast<std::size_t>(4 * runs));
  };
  expectRuns(1);
  filter->SetLabels("all");
  filter->SetBinary(false);
  filter->SetNumberOfStreamDivisions(4);
  filter->RemoveThreshold();
  expectRuns(1);
  spy->Modified();
  expectRuns(2);
  filter->SetThreshold(1, 2);
  expectRuns(3);
  filter->SetThreshold(1, 2);
  expectRuns(3);
  filter->GetOutput()->ReleaseData();
  EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
  expectRuns(4);
  EXPECT_EQ(filter->GetOutput()->GetLabels().size(), 1U);
}

TEST(ItkShapeUpdates, AnImageMarkedForReleaseIsReleasedEveryTime)
{
  const auto spy = ScatteredSpy();
  spy->ReleaseDataFlagOn();
  auto filter = ByteFilter::New();
  filter->SetInput(spy->GetOutput());
  filter->SetNumberOfStreamDivisions(4);
  for (int round = 0; round < 2; ++round)
  {
    filter->Modified();
    filter->Update();
    EXPECT_TRUE(spy->GetOutput()->GetDataReleased());
    EXPECT_TRUE(spy->GetReleaseDataFlag());
    EXPECT_EQ(filter->GetOutput()->GetLabels().size(), 3U);
  }
}

TEST(ItkShapeUpdates, ProgressGoesFrom0To1)
{
  for (const unsigned divisions : { 1U, 3U, 7U })
  {
    auto       filter = ByteFilter::New();
    Watcher    watcher(filter);
    const auto spy = ScatteredSpy();
    filter->SetInput(spy->GetOutput());
    filter->SetNumberOfStreamDivisions(divisions);
    filter->Update();
    watcher.ExpectMonotoneFrom0To1();
    EXPECT_EQ(watcher.ends, 1);
    EXPECT_GE(watcher.progress.size(), divisions);
  }
}

TEST(ItkShapeUpdates, AbortsWithoutOutputAndCanRunAgain)
{
  for (const float at : { 0.0F, 0.4F })
  {
    const auto spy = ScatteredSpy();
    auto       filter = ByteFilter::New();
    Watcher    watcher(filter);
    filter->SetInput(spy->GetOutput());
    filter->SetNumberOfStreamDivisions(8);
    watcher.abortAt = at;
    EXPECT_THROW(filter->Update(), itk::ProcessAborted);
    EXPECT_EQ(watcher.aborts, 1);
    EXPECT_EQ(watcher.ends, 0);
    EXPECT_LT(spy->regions.size(), 5U);
    EXPECT_TRUE(filter->GetOutput()->GetLabels().empty());
    watcher.abortAt = -1;
    filter->Update();
    ExpectShapes(*filter->GetOutput(), kShapeSize, Scattered, { 1, 2, 7 });
  }
}
