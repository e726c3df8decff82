#include "TemporaryFolder.h"

#include "voxelcore/Error.h"
#include "voxelcore/Parameters.h"
#include "voxelcore/SkeletonJob.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <sstream>

namespace voxelcore::testing
{

namespace
{

std::string
Bytes(const std::filesystem::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

class SkeletonJob : public ::testing::Test
{
protected:
  std::filesystem::path
  At(const std::string & name) const
  {
    return m_Folder.Path() / name;
  }

  void
  MakePhantom(const std::string & kind, const std::string & name) const
  {
    RunPhantomJob(PhantomOptionsFrom({ { "kind", kind }, { "size", "48" }, { "output", At(name).string() } }));
  }

  SkeletonResult
  Skeleton(const std::string & input, const std::string & output, ParameterValues more = {}) const
  {
    more["scan"] = At(input).string();
    more["output"] = At(output).string();
    return RunSkeletonJob(SkeletonOptionsFrom(more));
  }

  TemporaryFolder m_Folder;
};

TEST_F(SkeletonJob, ScanAndItsWholeCoreGiveTheSameLines)
{
  MakePhantom("root", "root.nrrd");
  RunCoreJob(CoreOptionsFrom(
    { { "scan", At("root.nrrd").string() }, { "lambda", "0" }, { "output", At("core.vtp").string() } }));
  Skeleton("root.nrrd", "a.vtp");
  Skeleton("core.vtp", "b.vtp");
  const SkeletonModel a = ReadSkeletonVtp(At("a.vtp"));
  const SkeletonModel b = ReadSkeletonVtp(At("b.vtp"));
  ASSERT_EQ(a.parts.size(), 1U);
  EXPECT_GT(a.parts[0].graph.BranchCount(), 3U);
  EXPECT_EQ(a.parts[0].graph.positions, b.parts[0].graph.positions);
  EXPECT_EQ(a.parts[0].graph.branchPoints, b.parts[0].graph.branchPoints);
  EXPECT_EQ(a.parts[0].graph.radius, b.parts[0].graph.radius);
}

TEST_F(SkeletonJob, MeasuringAgainGivesTheSameTables)
{
  MakePhantom("root", "root.nrrd");
  Skeleton("root.nrrd", "a.vtp", { { "also", "csv,swc,mrk.json,graphml,ma" }, { "root", "top" } });
  RunMeasureJob(MeasureOptionsFrom(
    { { "skeleton", At("a.vtp").string() }, { "output", At("b.csv").string() }, { "root", "top" } }));
  EXPECT_EQ(Bytes(At("a_branches.csv")), Bytes(At("b_branches.csv")));
  EXPECT_EQ(Bytes(At("a_summary.csv")), Bytes(At("b_summary.csv")));
  for (const char * name : { "a.swc", "a.mrk.json", "a.graphml", "a.ma", "a.r", "a_columns.json" })
  {
    EXPECT_FALSE(Bytes(At(name)).empty()) << name;
  }
}

TEST_F(SkeletonJob, SwcIsATreeWithParentsFirst)
{
  MakePhantom("torus", "torus.nrrd");
  Skeleton("torus.nrrd", "a.vtp", { { "also", "swc" } });
  std::ifstream file(At("a.swc"));
  std::string   line;
  int           roots = 0;
  long          count = 0;
  bool          saysCut = false;
  while (std::getline(file, line))
  {
    if (line[0] == '#')
    {
      saysCut |= line.find("cut") != std::string::npos;
      continue;
    }
    std::istringstream row(line);
    long               id = 0;
    long               type = 0;
    long               parent = 0;
    double             x = 0;
    double             y = 0;
    double             z = 0;
    double             radius = 0;
    ASSERT_TRUE(row >> id >> type >> x >> y >> z >> radius >> parent) << line;
    EXPECT_EQ(id, ++count);
    EXPECT_LT(parent, id);
    roots += parent == -1;
  }
  EXPECT_EQ(roots, 1);
  EXPECT_TRUE(saysCut);
  EXPECT_GT(count, 20);
}

TEST_F(SkeletonJob, WrongInputLeavesNothing)
{
  MakePhantom("ball", "ball.nrrd");
  EXPECT_THROW(Skeleton("ball.nrrd", "a.stl"), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "also", "xyz" } }), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "root", "1,2" } }), UsageError);
  EXPECT_THROW(Skeleton("ball.nrrd", "a.vtp", { { "prune-branches", "-1r" } }), UsageError);
  EXPECT_THROW(Skeleton("none.nrrd", "a.vtp"), InputError);
  EXPECT_THROW(Skeleton("none.vtp", "a.vtp"), InputError);
  EXPECT_FALSE(std::filesystem::exists(At("a.vtp")));
  Skeleton("ball.nrrd", "a.vtp");
  EXPECT_THROW(Skeleton("a.vtp", "b.vtp"), InputError); // a skeleton is no core
  EXPECT_THROW(
    RunMeasureJob(MeasureOptionsFrom({ { "skeleton", At("ball.nrrd").string() }, { "output", At("b.csv").string() } })),
    InputError);
}

TEST_F(SkeletonJob, RootsHaveTrueCentreLines)
{
  RunPhantomJob(PhantomOptionsFrom({ { "kind", "root" },
                                     { "size", "48" },
                                     { "output", At("root.nrrd").string() },
                                     { "centre-lines", At("root.swc").string() } }));
  EXPECT_NE(Bytes(At("root.swc")).find("\n1 0 "), std::string::npos);
  EXPECT_THROW(
    RunPhantomJob(PhantomOptionsFrom(
      { { "kind", "ball" }, { "output", At("ball.nrrd").string() }, { "centre-lines", At("ball.swc").string() } })),
    UsageError);
}

} // namespace

} // namespace voxelcore::testing
