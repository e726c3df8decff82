// Root systems found in phantoms whose truth is known, scored.

#include "RootScores.h"

#include "../Phantom/PhantomFixtures.h"

#include "voxelcore/BranchTable.h"
#include "voxelcore/RootScan.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace voxelcore::testing
{

namespace
{

void
ScoreHierarchy(std::uint64_t seeds, std::int32_t size, double slice, int contacts)
{
  double length = 0;
  double right = 0;
  double old = 0;
  double oldLength = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
  {
    RootScanOptions options;
    options.root.kind = "root";
    options.root.spacing = { 1, 1, slice };
    options.root.size = { size, size, static_cast<std::int32_t>(size / slice) };
    options.root.seed = seed;
    options.root.laterals = 14;
    options.root.subLaterals = 3;
    options.root.contacts = contacts;
    const VoxelShape shape = Brighter(MakeRootScan(options), options.root);
    SkeletonGraph    graph = GraphOf(shape, options.root.spacing);
    graph.sectionRadius = SectionRadiiOf(graph, shape, options.root.spacing);
    PruneBranches(graph, { 0, 1 });
    const RootHierarchy roots = FindRoots(graph);
    const RootScores    score = ScoreRoots(options.root, graph, roots);
    if (std::getenv("AXES") && static_cast<int>(seed) == std::atoi(std::getenv("AXES")))
    {
      std::printf("up %g %g %g\n", roots.up[0], roots.up[1], roots.up[2]);
      for (std::size_t i = 0; i < roots.axes.size(); ++i)
      {
        const auto & a = roots.axes[i];
        const auto & p = graph.positions[a.points.front()];
        const auto & q = graph.positions[a.points.back()];
        std::printf("axis %zu level %d parent %d points %zu  %.0f %.0f %.0f r %.2f -> %.0f %.0f %.0f r %.2f\n",
                    i,
                    a.level,
                    static_cast<int>(a.parent),
                    a.points.size(),
                    p[0],
                    p[1],
                    p[2],
                    SectionRadii(graph)[a.points.front()],
                    q[0],
                    q[1],
                    q[2],
                    SectionRadii(graph)[a.points.back()]);
      }
      for (const auto & m : roots.meetings)
        std::printf("meeting %.0f %.0f %.0f r %.2f margin %.2f pairs %zu\n",
                    m.position[0],
                    m.position[1],
                    m.position[2],
                    m.radius,
                    m.margin,
                    m.pairs.size());
    }
    // As it was: the tree of the thickest branches.
    MeasureOptions before;
    before.root.kind = RootChoice::Kind::Top;
    const BranchTable table = MeasureBranches(graph, before);
    RootHierarchy     tree;
    for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
    {
      RootAxis axis;
      axis.level = table.branches[branch].level;
      axis.points.assign(graph.Branch(branch).begin(), graph.Branch(branch).end());
      tree.axes.push_back(axis);
    }
    const RootScores former = ScoreRoots(options.root, graph, tree);
    old += former.rightLevel;
    oldLength += former.length;
    length += score.length;
    right += score.rightLevel;
    if (std::getenv("VERBOSE"))
    {
      std::printf(
        "  seed %d: tips %zu missed %zu found %zu spurious %zu, length %.3f, right %.3f (was %.3f), meetings %zu of "
        "%zu, "
        "undecided %zu, axes %zu\n",
        static_cast<int>(seed),
        score.tips,
        score.missed,
        score.found,
        score.spurious,
        score.length / score.trueLength,
        score.rightLevel / score.length,
        former.rightLevel / former.length,
        roots.meetings.size(),
        score.contacts,
        score.undecided,
        roots.axes.size());
    }
  }
  std::printf("%4d, 1:1:%.0f, %2d contacts: %6.2f %% of the length has its level (was %6.2f %%)\n",
              size,
              slice,
              contacts,
              100 * right / length,
              100 * old / oldLength);
}

} // namespace

} // namespace voxelcore::testing

int
main(int argc, char ** argv)
{
  using namespace voxelcore::testing;
  const auto seeds = static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 3);
  const int  size = argc > 2 ? std::atoi(argv[2]) : 160;
  for (const int contacts : { 0, 5, 10 })
  {
    ScoreHierarchy(seeds, size, 1, contacts);
  }
  return 0;
}
