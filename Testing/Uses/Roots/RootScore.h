#pragma once
// The skeleton of a root phantom against the centre lines it was grown along.

#include "Core/Skeleton/TubeShapes.h"

#include "voxelcore/Skeleton/CrossSections.h"

#include <algorithm>
#include <bit>

namespace voxelcore::testing
{

struct Tip
{
  Spacing3 position{};
  double   radius = 0;
  bool     expected = true;
};

inline Spacing3
PlaceOf(const PhantomOptions & options, const CentreLinePoint & point)
{
  return { point.position[0] * options.spacing[0],
           point.position[1] * options.spacing[1],
           point.position[2] * options.spacing[2] };
}

/** How much of a lateral, from its tip inwards, is nowhere so near to another branch that their voxels may touch: where
 *  they do, the two are one in the scan and what is beyond is all there is to find. Up to 7 mm. */
inline double
FreeEnd(const PhantomOptions & options, const std::vector<CentreLinePoint> & lines, std::size_t tip)
{
  const double voxel = std::max({ options.spacing[0], options.spacing[1], options.spacing[2] });
  double       length = 0;
  for (std::size_t at = tip; length < 7;)
  {
    const Spacing3 place = PlaceOf(options, lines[at]);
    for (const CentreLinePoint & other : lines)
    {
      if (other.branch != lines[tip].branch &&
          Distance(PlaceOf(options, other), place) - other.radius - lines[at].radius <= voxel)
      {
        return length;
      }
    }
    if (lines[at].parent < 0)
    {
      break;
    }
    const auto before = static_cast<std::size_t>(lines[at].parent);
    length += Distance(place, PlaceOf(options, lines[before]));
    at = before;
  }
  return length;
}

inline std::vector<Tip>
TrueTips(const PhantomOptions & options)
{
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  std::vector<Tip>                   tips{ { PlaceOf(options, lines[0]), lines[0].radius, true } };
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    if (i + 1 == lines.size() || lines[i + 1].branch != lines[i].branch)
    {
      tips.push_back({ PlaceOf(options, lines[i]), lines[i].radius, FreeEnd(options, lines, i) > 6 });
    }
  }
  return tips;
}

struct Score
{
  std::size_t expected = 0;
  std::size_t missed = 0;
  std::size_t found = 0;
  std::size_t spurious = 0;
  double      worstLength = 0; ///< part of the true one
  double      sumOfLengths = 0;
  double      worstRadius = 0; ///< mean over a phantom, as part of a voxel (of the cube with the same diagonal)
};

/** Length and radius of a skeleton against the lines the phantom was grown along. */
inline void
CompareLines(const PhantomOptions & options, const SkeletonGraph & graph, Score & score)
{
  const std::vector<CentreLinePoint> lines = RootCentreLines(options);
  double                             length = 0;
  for (const CentreLinePoint & point : lines)
  {
    length += point.parent < 0
                ? 0
                : Distance(PlaceOf(options, point), PlaceOf(options, lines[static_cast<std::size_t>(point.parent)]));
  }
  const double error = (TotalLength(graph) - length) / length;
  score.sumOfLengths += error;
  score.worstLength = std::max(score.worstLength, std::abs(error));

  const double diagonal = Distance(options.spacing, { 0, 0, 0 });
  double       sum = 0;
  for (const ElementIndex point : graph.branchPoints)
  {
    double nearest = std::numeric_limits<double>::infinity();
    double radius = 0;
    for (const CentreLinePoint & line : lines)
    {
      const double away = Distance(PlaceOf(options, line), graph.positions[point]);
      if (away < nearest)
      {
        nearest = away;
        radius = line.radius;
      }
    }
    sum += SectionRadii(graph)[point] - radius;
  }
  const double mean = sum / static_cast<double>(graph.branchPoints.size());
  score.worstRadius = std::max(score.worstRadius, std::abs(mean) * std::sqrt(3.0) / diagonal);
}

/** Voxels of a root thinner than two slices may close a loop right at its tip: then the skeleton ends in that loop. */
inline bool
EndsInALoop(const SkeletonGraph & graph, const Tip & tip, double slice)
{
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto points = graph.Branch(branch);
    if (graph.branchNodes[branch][0] == graph.branchNodes[branch][1] && graph.BranchLength(branch) < 8 * slice &&
        Distance(graph.positions[points[points.size() / 2]], tip.position) <= tip.radius + 3 * slice)
    {
      return true;
    }
  }
  return false;
}

using GraphMaker = std::function<SkeletonGraph(const VoxelShape & shape, const Spacing3 & spacing)>;

inline void
CompareRoot(std::int32_t size, double slice, std::uint64_t seed, Score & score, const GraphMaker & graphOf = GraphOf)
{
  PhantomOptions options;
  options.kind = "root";
  options.spacing = { 1, 1, slice };
  options.size = { size, size, static_cast<std::int32_t>(size / slice) };
  options.seed = seed;
  const VoxelShape shape = MakePhantom(options);
  SkeletonGraph    graph = graphOf(shape, options.spacing);
  if (graph.sectionRadius.empty())
  {
    graph.sectionRadius = SectionRadiiOf(graph, shape, options.spacing);
  }
  std::vector<Spacing3> ends;
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Tip)
    {
      ends.push_back(graph.positions[graph.nodePoints[node]]);
    }
  }
  CompareLines(options, graph, score);
  std::vector<std::uint8_t> used(ends.size(), 0);
  for (const Tip & tip : TrueTips(options))
  {
    std::size_t nearest = 0;
    for (std::size_t end = 1; end < ends.size(); ++end)
    {
      nearest = Distance(ends[end], tip.position) < Distance(ends[nearest], tip.position) ? end : nearest;
    }
    const bool found =
      Distance(ends[nearest], tip.position) <= tip.radius + 3 * slice || EndsInALoop(graph, tip, slice);
    used[nearest] |= found ? 1 : 0;
    if (tip.expected)
    {
      ++score.expected;
      score.missed += found ? 0 : 1;
    }
  }
  score.found += ends.size();
  score.spurious += static_cast<std::size_t>(std::count(used.begin(), used.end(), std::uint8_t{ 0 }));
}

/** The shape turned: axis k of the result is `axes[k]` of the shape, backwards where bit k is set. */
inline VoxelShape
TurnedShape(const VoxelShape & shape, std::int32_t n, const Size3 & axes, unsigned mirrored)
{
  return ShapeWhere({ n, n, n }, [&](int x, int y, int z) {
    Size3       from{};
    const Size3 to{ x, y, z };
    for (std::size_t k = 0; k < 3; ++k)
    {
      from[static_cast<std::size_t>(axes[k])] = (mirrored >> k) % 2 == 1 ? n - 1 - to[k] : to[k];
    }
    return shape.Contains(from[0], from[1], from[2]);
  });
}

/** Calls `visit` with a cube of voxels in each of the 24 rotations of the grid, the first the identity. */
template <typename Visit>
void
ForRotations(const VoxelShape & shape, std::int32_t n, const Visit & visit)
{
  Size3 axes{ 0, 1, 2 };
  do
  {
    const int odd = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
    for (unsigned mirrored = 0; mirrored < 8; ++mirrored)
    {
      if ((odd + std::popcount(mirrored)) % 2 == 0) // else a reflection
      {
        visit(TurnedShape(shape, n, axes, mirrored));
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
}

} // namespace voxelcore::testing
