#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Phantom/PhantomJob.h"

#include <sstream>

namespace voxelcore::testing
{
namespace
{

class PhantomJob : public JobFolder
{
protected:
  PhantomJobOptions
  Options(const std::string & kind, const std::string & name) const
  {
    PhantomJobOptions options;
    options.phantom.kind = kind;
    options.phantom.size = { 20, 18, 16 };
    options.phantom.spacing = { 0.5, 0.5, 0.75 };
    options.output = At(name);
    return options;
  }
};

TEST_F(PhantomJob, TheVolumeHoldsTheVoxelsOfThePhantom)
{
  for (const char * name : { "a.nrrd", "a.nii.gz", "a.mha", "a.mhd", "a.tif" })
  {
    const PhantomJobOptions options = Options("torus", name);
    const std::string       line = RunPhantomJob(options);
    const VoxelShape        shape = MakePhantom(options.phantom);
    const LabelMap          volume = ReadLabelVolume(options.output, {});
    ASSERT_EQ(volume.labels.size(), 1U) << name;
    EXPECT_EQ(volume.labels[0].value, 1);
    EXPECT_EQ(volume.geometry.size, (std::array<std::int64_t, 3>{ 20, 18, 16 })) << name;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(volume.geometry.spacing[axis], options.phantom.spacing[axis], 1e-6) << name;
    }
    std::uint64_t voxels = 0;
    for (std::int32_t z = 0; z < 16; ++z)
    {
      for (std::int32_t y = 0; y < 18; ++y)
      {
        for (std::int32_t x = 0; x < 20; ++x)
        {
          voxels += shape.Contains(x, y, z) ? 1 : 0;
          ASSERT_EQ(volume.labels[0].shape.Contains(x, y, z), shape.Contains(x, y, z)) << name;
        }
      }
    }
    EXPECT_NE(line.find(std::to_string(voxels) + " of them in"), std::string::npos) << line;
  }
}

TEST_F(PhantomJob, TheTruthIsRsmlWithARootForEachBranch)
{
  PhantomJobOptions options = Options("root", "a.nrrd");
  options.phantom.size = { 64, 64, 64 };
  options.centreLines = At("a.rsml");
  RunPhantomJob(options);
  std::size_t branches = 0;
  const auto  lines = RootCentreLines(options.phantom);
  for (const CentreLinePoint & point : lines)
  {
    branches = std::max(branches, static_cast<std::size_t>(point.branch) + 1);
  }
  const std::string text = Bytes("a.rsml");
  const auto        count = [&text](const std::string & what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    {
      ++found;
    }
    return found;
  };
  EXPECT_EQ(count("<root "), branches);
  EXPECT_EQ(count("<point "), lines.size());
}

TEST_F(PhantomJob, AGreyScanHoldsTheValuesOfItsRoot)
{
  PhantomJobOptions options = Options("root", "a.nrrd");
  options.phantom.size = { 40, 40, 48 };
  options.scan.emplace();
  options.scan->noise = 0.1;
  const std::string line = RunPhantomJob(options);
  RootScanOptions   request = *options.scan;
  request.root = options.phantom;
  const RootScan scan = MakeRootScan(request);
  VoxelBox       box;
  box.size = options.phantom.size;
  const GreyVolume read = ReadGreyVolume(options.output, box);
  ASSERT_EQ(read.values.size(), scan.values.size());
  EXPECT_TRUE(std::equal(scan.values.begin(), scan.values.end(), read.values.begin()));
  EXPECT_NE(line.find("0 contacts"), std::string::npos) << line;
  options.phantom.kind = "ball";
  options.force = true;
  EXPECT_THROW(RunPhantomJob(options), UsageError);
}

TEST_F(PhantomJob, BodiesAreLabelsFromOneOn)
{
  PhantomJobOptions options = Options("cells", "a.nrrd");
  options.phantom.size = { 24, 24, 24 };
  const std::string line = RunPhantomJob(options);
  const auto        labels = ReadLabelVolume(options.output, {}).labels;
  ASSERT_GT(labels.size(), 3U);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    EXPECT_EQ(labels[i].value, static_cast<std::int64_t>(i + 1));
  }
  EXPECT_NE(line.find(std::to_string(labels.size()) + " labels"), std::string::npos) << line;
}

TEST_F(PhantomJob, CentreLinesLieInTheVolumeAndAreTrees)
{
  PhantomJobOptions options = Options("root", "a.nrrd");
  options.phantom.size = { 48, 48, 48 };
  options.phantom.spacing = { 0.5, 0.5, 0.5 };
  options.centreLines = At("a.swc");
  RunPhantomJob(options);
  const VoxelShape   shape = ReadLabelVolume(options.output, {}).labels.at(0).shape;
  std::istringstream file(Bytes("a.swc"));
  long               rows = 0;
  long               inside = 0;
  for (std::string line; std::getline(file, line);)
  {
    if (line[0] == '#')
    {
      continue;
    }
    std::istringstream    row(line);
    long                  id = 0;
    long                  order = 0;
    long                  parent = 0;
    std::array<double, 3> place{};
    double                radius = 0;
    ASSERT_TRUE(row >> id >> order >> place[0] >> place[1] >> place[2] >> radius >> parent) << line;
    EXPECT_EQ(id, ++rows);
    EXPECT_TRUE(parent == -1 || (parent >= 1 && parent < id)) << line;
    // Micrometres to voxels of half a millimetre, the first at the origin.
    const auto at = [&](std::size_t axis) { return static_cast<std::int32_t>(place[axis] / 500 + 0.5); };
    inside += shape.Contains(at(0), at(1), at(2)) ? 1 : 0;
  }
  EXPECT_GT(rows, 50);
  EXPECT_GT(static_cast<double>(inside), 0.9 * static_cast<double>(rows)) << "but for the thinnest tips";
}

TEST_F(PhantomJob, WhatFailsLeavesNothing)
{
  EXPECT_THROW(RunPhantomJob(Options("tours", "a.nrrd")), UsageError);
  EXPECT_THROW(RunPhantomJob(Options("ball", "a.xyz")), UsageError);
  EXPECT_THROW(RunPhantomJob(Options("ball", "none/a.nrrd")), OutputError);
  PhantomJobOptions lines = Options("ball", "a.nrrd");
  lines.centreLines = At("a.swc");
  EXPECT_THROW(RunPhantomJob(lines), UsageError);
  lines = Options("root", "a.nrrd");
  lines.centreLines = At("a.txt");
  EXPECT_THROW(RunPhantomJob(lines), UsageError);
  EXPECT_THROW(RunPhantomJob(Options("ball", "a.nrrd"), StoppingAfter(1)), Cancelled);
  EXPECT_TRUE(Names().empty());
  WriteAll(At("a.nrrd"), "mine");
  EXPECT_THROW(RunPhantomJob(Options("ball", "a.nrrd")), OutputError);
  EXPECT_EQ(Bytes("a.nrrd"), "mine");
  PhantomJobOptions force = Options("ball", "a.nrrd");
  force.force = true;
  EXPECT_NO_THROW(RunPhantomJob(force));
}

TEST_F(PhantomJob, EveryKindIsListed)
{
  const std::string list = PhantomList();
  for (const PhantomKind & kind : PhantomKinds())
  {
    EXPECT_NE(("\n" + list).find("\n" + std::string(kind.name) + ": " + std::string(kind.help) + "\n"),
              std::string::npos)
      << kind.name;
  }
}

} // namespace
} // namespace voxelcore::testing
