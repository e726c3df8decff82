// `voxelcore roots` on grey phantoms of hollow, touching, noisy roots whose truth is known: one table. Beside it the
// hierarchy as it was, a tree of the thickest branches, on the same skeletons.
// usage: VoxelCoreRootEvaluation [SEEDS [BREAKS [FIRST [ONLY]]]]
// FIRST is the first seed; ONLY a part of the names of the lines to run. In the environment, SIMPLIFY=D adds
// --simplify-topology D, and VERBOSE=1 prints each phantom.

#include "RootScores.h"
#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Masks/ShapeClosing.h"
#include "voxelcore/Phantom/PhantomJob.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Skeleton/BranchTable.h"

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

namespace voxelcore::testing
{

namespace
{

struct Sum
{
  int        phantoms = 0;
  int        spheres = 0;  ///< with b = (1, 0, 0)
  int        likeTree = 0; ///< with b = (1, 0, 0) but for loops where roots touch
  double     worstLength = 0;
  double     sumOfLengths = 0;
  double     formerRight = 0;
  double     formerLength = 0;
  double     seconds = 0;
  RootScores scores;
};

void
Add(Sum & sum, const RootScores & one)
{
  RootScores & all = sum.scores;
  all.tips += one.tips;
  all.missed += one.missed;
  all.found += one.found;
  all.spurious += one.spurious;
  all.trueLength += one.trueLength;
  all.length += one.length;
  all.rightLevel += one.rightLevel;
  all.undecided += one.undecided;
  all.contacts += one.contacts;
  all.angles += one.angles;
  all.angleError += one.angleError;
  all.angleBias += one.angleBias;
  const double error = (one.length - one.trueLength) / one.trueLength;
  sum.worstLength = std::max(sum.worstLength, std::abs(error));
  sum.sumOfLengths += std::abs(error);
  ++sum.phantoms;
}

/** The same skeleton with the levels of a spanning tree of the thickest branches. */
RootScores
ScoreFormer(const PhantomOptions & options, const SkeletonGraph & graph)
{
  MeasureOptions measure;
  measure.root.kind = RootChoice::Kind::Top;
  const BranchTable table = MeasureBranches(graph, measure);
  RootHierarchy     tree;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    RootAxis axis;
    axis.level = table.branches[branch].level;
    axis.points.assign(graph.Branch(branch).begin(), graph.Branch(branch).end());
    tree.axes.push_back(axis);
  }
  return ScoreRoots(options, graph, tree);
}

void
RunOne(const PhantomJobOptions & phantom, const std::filesystem::path & folder, Sum & sum)
{
  RunPhantomJob(phantom);
  RootsOptions options = RootsOptions();
  options.scan = phantom.output;
  options.reading.labels = "all";
  options.stage.lambda = ParseLambda("0");
  options.stage.lambda.text = "0";
  options.stage.standOut = ParseLambda("3vox");
  options.stage.smooth = ParseLambda("6vox");
  options.stage.branches.pruneRadii = 0.5;
  options.pictures = false;
  options.output = folder / "out/";
  options.force = true;
  if (const char * depth = std::getenv("SIMPLIFY"))
  {
    options.edits.simplify = ParseGapWidth(depth);
  }
  RootsResult     result = RunRootsJob(options);
  SkeletonGraph & graph = result.model.graph;
  for (auto & place : graph.positions)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] += 0.5 * phantom.phantom.spacing[axis]; // from the first voxel's centre to the grid's corner
    }
  }
  RootScores score = ScoreRoots(phantom.phantom, graph, result.model.roots);
  CompareAngles(phantom.phantom, graph, result.model.roots, result.model.traits, score);
  const RootScores former = ScoreFormer(phantom.phantom, graph);
  sum.formerRight += former.rightLevel;
  sum.formerLength += former.length;
  const auto & betti = result.report.labels.at(0).shape.betti;
  sum.spheres += betti[0] == 1 && betti[1] == 0 && betti[2] == 0 ? 1 : 0;
  sum.likeTree += betti[0] == 1 && betti[1] <= static_cast<std::int64_t>(score.contacts) && betti[2] == 0 ? 1 : 0;
  sum.seconds += result.report.seconds.total;
  Add(sum, score);
  if (std::getenv("VERBOSE"))
  {
    std::printf(
      "  %d %g seed %d: b %d %d %d, tips %zu missed %zu found %zu spurious %zu, length %.3f, level %.3f (%.3f), "
      "angle %.1f, contacts %zu, meetings %zu\n",
      phantom.phantom.size[0],
      phantom.phantom.spacing[2] / phantom.phantom.spacing[0],
      static_cast<int>(phantom.phantom.seed),
      static_cast<int>(betti[0]),
      static_cast<int>(betti[1]),
      static_cast<int>(betti[2]),
      score.tips,
      score.missed,
      score.found,
      score.spurious,
      score.length / score.trueLength,
      score.rightLevel / score.length,
      former.rightLevel / former.length,
      score.angleError / std::max<double>(1, static_cast<double>(score.angles)),
      score.contacts,
      result.model.roots.meetings.size());
  }
}

void
Print(const char * name, const Sum & sum)
{
  const RootScores & s = sum.scores;
  const auto         percent = [](double part, double whole) { return whole > 0 ? 100 * part / whole : 0; };
  std::printf("%-30s %4d %9d %9d %9.2f %10.2f %7.2f %7.2f %9.2f %9.2f %8.2f %7.2f %7zu %9zu %7.2f\n",
              name,
              sum.phantoms,
              sum.spheres,
              sum.likeTree,
              percent(static_cast<double>(s.tips - s.missed), static_cast<double>(s.tips)),
              percent(static_cast<double>(s.spurious), static_cast<double>(s.found)),
              100 * sum.sumOfLengths / std::max(1, sum.phantoms),
              100 * sum.worstLength,
              percent(s.rightLevel, s.length),
              percent(sum.formerRight, sum.formerLength),
              s.angleError / std::max<double>(1, static_cast<double>(s.angles)),
              s.angleBias / std::max<double>(1, static_cast<double>(s.angles)),
              s.contacts,
              s.undecided,
              sum.seconds / std::max(1, sum.phantoms));
  std::fflush(stdout);
}

struct Kind
{
  const char * name;
  int          contacts;
  double       hollow;
  double       noise;
  double       rings;
};

constexpr Kind kKinds[]{ { "hollow", 0, 0.65, 0.08, 0.03 },
                         { "hollow, 5 contacts", 5, 0.65, 0.08, 0.03 },
                         { "hollow, 10 contacts", 10, 0.65, 0.08, 0.03 },
                         { "solid, 5 contacts", 5, 0, 0.02, 0 },
                         { "solid, noisy", 0, 0, 0.16, 0.06 } };

void
Evaluate(int seeds, int breaks, int first, const std::string & only)
{
  std::printf(
    "                              runs  (1,0,0) tree but     tips spurious   length    worst    level   before   "
    "angles     bias contacts undecided seconds\n"
    "                                                 for    found %%        %%    off %%    off %%  right %%  right "
    "%%  "
    "off deg      deg    there\n"
    "                                            contacts\n");
  for (const Kind & kind : kKinds)
  {
    for (const double slice : { 1.0, 2.0 })
    {
      for (const double voxel : { 1.0, 0.75, 0.5 })
      {
        char name[64];
        std::snprintf(name, sizeof(name), "%s %g 1:1:%g", kind.name, voxel, slice);
        if (std::string(name).find(only) == std::string::npos)
        {
          continue;
        }
        Sum sum;
        for (int seed = first; seed < first + seeds; ++seed)
        {
          const TemporaryFolder folder;
          PhantomJobOptions     phantom;
          phantom.phantom.kind = "root";
          phantom.phantom.spacing = { voxel, voxel, slice * voxel };
          const auto side = static_cast<std::int32_t>(160 / voxel);
          phantom.phantom.size = { side, side, static_cast<std::int32_t>(side / slice) };
          phantom.phantom.seed = static_cast<std::uint64_t>(seed);
          phantom.phantom.detail = 1.1;
          phantom.phantom.laterals = 14;
          phantom.phantom.subLaterals = 2;
          phantom.phantom.contacts = kind.contacts;
          phantom.scan.emplace();
          phantom.scan->hollow = kind.hollow;
          phantom.scan->holes = kind.hollow > 0 ? 6 : 0;
          phantom.scan->breaks = breaks;
          phantom.scan->noise = kind.noise;
          phantom.scan->rings = kind.rings;
          phantom.output = folder.Path() / "scan.nrrd";
          RunOne(phantom, folder.Path(), sum);
        }
        Print(name, sum);
      }
    }
  }
}

} // namespace

} // namespace voxelcore::testing

int
main(int argc, char ** argv)
{
  try
  {
    const auto number = [&](int at, int otherwise) { return argc > at ? std::atoi(argv[at]) : otherwise; };
    voxelcore::testing::Evaluate(number(1, 2), number(2, 0), number(3, 1), argc > 4 ? argv[4] : "");
    return 0;
  }
  catch (const std::exception & error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
