#include "NearestBranch.h"

#include "voxelcore/Lattice/SpacingWeights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr double kDense = 0.5; // between places on a branch, in sides of the cube with a voxel's diagonal

DenseBranch
Dense(const SkeletonGraph & graph, std::size_t branch, const ImageGeometry & geometry)
{
  const double side = VoxelSide(geometry);
  DenseBranch  line;
  const auto   points = graph.Branch(branch);
  line.isClosed = graph.branchNodes[branch][0] == graph.branchNodes[branch][1];
  double arc = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vector3 place = Times(PhysicalToLattice(geometry, graph.positions[points[i]]), geometry.spacing);
    const double  radius = graph.radius[points[i]];
    const double  wide = std::max(radius, SectionRadii(graph)[points[i]]);
    if (i > 0)
    {
      const double  fromWide = line.wide.back();
      const Vector3 from = line.places.back();
      const double  fromRadius = line.radius.back();
      const Vector3 way = Minus(place, from);
      const double  length = Length(way);
      const auto    parts = static_cast<int>(std::ceil(length / (kDense * side)));
      for (int part = 1; part < parts; ++part)
      {
        const double t = static_cast<double>(part) / parts;
        line.places.push_back(AddScaled(from, t, way));
        line.radius.push_back((1 - t) * fromRadius + t * radius);
        line.wide.push_back((1 - t) * fromWide + t * wide);
        line.arc.push_back(arc + t * length);
      }
      arc += length;
    }
    line.places.push_back(place);
    line.radius.push_back(radius);
    line.wide.push_back(wide);
    line.arc.push_back(arc);
    line.arcOfPoint.push_back(arc);
  }
  return line;
}

} // namespace

double
VoxelSide(const ImageGeometry & geometry)
{
  return Length(geometry.spacing) / std::sqrt(3.0);
}

std::vector<DenseBranch>
DenseBranches(const SkeletonGraph & graph, const ImageGeometry & geometry)
{
  std::vector<DenseBranch> branches;
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    branches.push_back(Dense(graph, branch, geometry));
  }
  return branches;
}

NearestBranch::NearestBranch(const std::vector<DenseBranch> & branches, double margin)
  : m_Margin(margin)
{
  std::vector<Vector3> places;
  std::vector<double>  radius;
  for (const DenseBranch & line : branches)
  {
    places.insert(places.end(), line.places.begin(), line.places.end());
    radius.insert(radius.end(), line.radius.begin(), line.radius.end());
    m_BranchOf.resize(places.size(), static_cast<ElementIndex>(m_Own.size()));
    m_Own.push_back(std::make_unique<BallTree>(line.places, line.radius, SpacingWeights()));
  }
  m_All = std::make_unique<BallTree>(places, radius, SpacingWeights());
}

ElementIndex
NearestBranch::Of(const Vector3 & place, std::size_t & hint, std::vector<std::uint32_t> & scratch) const
{
  const double gap = m_All->Gap(place, -HUGE_VAL, hint);
  m_All->FindWithin(place, gap, scratch);
  return m_BranchOf[scratch.front()];
}

ElementIndex
NearestBranch::Other(ElementIndex own, const std::vector<Vector3> & places) const
{
  std::map<ElementIndex, std::size_t> found;
  std::size_t                         hint = 0;
  std::size_t                         ownHint = 0;
  for (const Vector3 & place : places)
  {
    const double       gap = m_All->Gap(place, -HUGE_VAL, hint);
    const ElementIndex branch = m_BranchOf[m_All->BallOf(hint)];
    if (branch != own && m_Own[own]->Gap(place, -HUGE_VAL, ownHint) > gap + m_Margin)
    {
      ++found[branch];
    }
  }
  ElementIndex most = kNoBranch;
  std::size_t  count = 0;
  for (const auto & [branch, times] : found)
  {
    if (times > count)
    {
      most = branch;
      count = times;
    }
  }
  return most;
}

} // namespace voxelcore
