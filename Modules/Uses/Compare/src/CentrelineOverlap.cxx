#include "voxelcore/Compare/CentrelineOverlap.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

bool
IsIn(const VoxelShape & shape, const Voxel & voxel)
{
  return shape.Contains(voxel[0], voxel[1], voxel[2]);
}

Voxel
VoxelAt(const Vector3 & lattice)
{
  return { static_cast<std::int32_t>(std::floor(lattice[0])),
           static_cast<std::int32_t>(std::floor(lattice[1])),
           static_cast<std::int32_t>(std::floor(lattice[2])) };
}

/** Calls visit(voxel, length in mm) along the line from one place to another. */
template <typename TVisit>
void
WalkVoxels(const Vector3 & from, const Vector3 & to, const ImageGeometry & geometry, const TVisit & visit)
{
  const Vector3       p = PhysicalToLattice(geometry, from);
  const Vector3       d = Minus(PhysicalToLattice(geometry, to), p);
  const double        length = Distance(from, to);
  std::vector<double> cuts{ 0, 1 };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double low = std::min(p[k], p[k] + d[k]);
    const double high = std::max(p[k], p[k] + d[k]);
    for (double plane = std::floor(low) + 1; plane < high; ++plane)
    {
      cuts.push_back((plane - p[k]) / d[k]);
    }
  }
  ranges::sort(cuts);
  for (std::size_t i = 1; i < cuts.size(); ++i)
  {
    if (cuts[i] > cuts[i - 1])
    {
      visit(VoxelAt(AddScaled(p, (cuts[i] + cuts[i - 1]) / 2, d)), (cuts[i] - cuts[i - 1]) * length);
    }
  }
}

template <typename TVisit>
void
WalkBranch(const SkeletonGraph & graph, std::size_t branch, const ImageGeometry & geometry, const TVisit & visit)
{
  const auto points = graph.Branch(branch);
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    WalkVoxels(graph.positions[points[i - 1]], graph.positions[points[i]], geometry, visit);
  }
}

double
Share(double part, double whole)
{
  return whole > 0 ? part / whole : std::numeric_limits<double>::quiet_NaN();
}

/** The branches of the way along a forest from one node to another. */
std::vector<std::size_t>
WayBetween(const SkeletonGraph &                         graph,
           const std::vector<std::vector<std::size_t>> & branchesAt,
           ElementIndex                                  from,
           ElementIndex                                  to)
{
  constexpr std::size_t     none = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t>  cameBy(graph.nodePoints.size(), none);
  std::vector<ElementIndex> front{ from };
  const auto                other = [&](std::size_t branch, ElementIndex node) {
    return graph.branchNodes[branch][graph.branchNodes[branch][0] == node ? 1 : 0];
  };
  for (std::size_t next = 0; next < front.size() && cameBy[to] == none; ++next)
  {
    for (const std::size_t branch : branchesAt[front[next]])
    {
      const ElementIndex node = other(branch, front[next]);
      if (node != from && cameBy[node] == none)
      {
        cameBy[node] = branch;
        front.push_back(node);
      }
    }
  }
  std::vector<std::size_t> way;
  for (ElementIndex node = to; node != from; node = other(way.back(), node))
  {
    way.push_back(cameBy[node]);
  }
  return way;
}

} // namespace

double
CentrelineOverlap::VoxelShare() const
{
  return Share(static_cast<double>(voxelsInside), static_cast<double>(voxels));
}

double
CentrelineOverlap::LengthShare() const
{
  return Share(lengthInside, length);
}

double
CentrelineOverlap::BranchShare() const
{
  return Share(static_cast<double>(detected), static_cast<double>(branches));
}

std::vector<Voxel>
SkeletonVoxels(const SkeletonGraph & graph, const ImageGeometry & geometry, const VoxelShape & own)
{
  std::vector<Voxel> voxels;
  const auto         take = [&](const Voxel & voxel, double) {
    if (IsIn(own, voxel) && (voxels.empty() || voxels.back() != voxel))
    {
      voxels.push_back(voxel);
    }
  };
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    WalkBranch(graph, branch, geometry, take);
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Isolated)
    {
      take(VoxelAt(PhysicalToLattice(geometry, graph.positions[graph.nodePoints[node]])), 0);
    }
  }
  ranges::sort(voxels, [](const Voxel & a, const Voxel & b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  });
  voxels.erase(ranges::unique(voxels).begin(), voxels.end());
  return voxels;
}

CentrelineOverlap
MeasureCentreline(const SkeletonGraph & graph,
                  const ImageGeometry & geometry,
                  const VoxelShape &    own,
                  const VoxelShape &    other)
{
  CentrelineOverlap overlap;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    double length = 0;
    double inside = 0;
    WalkBranch(graph, branch, geometry, [&](const Voxel & voxel, double piece) {
      if (IsIn(own, voxel))
      {
        length += piece;
        inside += IsIn(other, voxel) ? piece : 0;
      }
    });
    overlap.length += length;
    overlap.lengthInside += inside;
    overlap.branches += length > 0 ? 1 : 0;
    overlap.detected += length > 0 && inside >= kDetectedShare * length * (1 - kLengthRounding) ? 1 : 0;
  }
  for (const Voxel & voxel : SkeletonVoxels(graph, geometry, own))
  {
    ++overlap.voxels;
    overlap.voxelsInside += IsIn(other, voxel) ? 1 : 0;
  }
  return overlap;
}

double
ClDice(const CentrelineOverlap & ofA, const CentrelineOverlap & ofB)
{
  const double precision = ofB.VoxelShare();
  const double sensitivity = ofA.VoxelShare();
  return precision + sensitivity == 0 ? 0 : 2 * (precision * sensitivity) / (precision + sensitivity);
}

std::vector<DifferingPart>
FindLeavingLoops(const SkeletonGraph & graph,
                 const ImageGeometry & geometry,
                 const VoxelShape &    other,
                 PartChange            change)
{
  std::vector<double> lengths(graph.BranchCount());
  for (std::size_t branch = 0; branch < lengths.size(); ++branch)
  {
    lengths[branch] = graph.BranchLength(branch);
  }
  std::vector<std::size_t> order(lengths.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return lengths[a] < lengths[b]; });
  UnionFind                             sets(graph.nodePoints.size());
  std::vector<std::vector<std::size_t>> branchesAt(graph.nodePoints.size());
  std::vector<std::size_t>              closing;
  for (const std::size_t branch : order)
  {
    const auto [first, last] = graph.branchNodes[branch];
    if (sets.Find(first) == sets.Find(last))
    {
      closing.push_back(branch);
      continue;
    }
    sets.Unite(first, last);
    branchesAt[first].push_back(branch);
    branchesAt[last].push_back(branch);
  }
  ranges::sort(closing);
  std::vector<DifferingPart> loops;
  for (const std::size_t branch : closing)
  {
    std::vector<Voxel> outside;
    const auto         take = [&](const Voxel & voxel, double) {
      if (!IsIn(other, voxel) && (outside.empty() || outside.back() != voxel))
      {
        outside.push_back(voxel);
      }
    };
    WalkBranch(graph, branch, geometry, take);
    for (const std::size_t further :
         WayBetween(graph, branchesAt, graph.branchNodes[branch][0], graph.branchNodes[branch][1]))
    {
      WalkBranch(graph, further, geometry, take);
    }
    if (!outside.empty())
    {
      loops.push_back({ PartKind::Loop, change, outside.size(), outside[outside.size() / 2] });
    }
  }
  return loops;
}

} // namespace voxelcore
