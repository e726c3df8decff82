#include "AxisCrossings.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{
namespace
{

constexpr unsigned kInnerShift = 33;

} // namespace

AxisCrossings::AxisCrossings(const IndexMesh &   mesh,
                             const MeshSurface & surface,
                             const VoxelGrid &   grid,
                             std::size_t         axis)
  : m_Mesh(mesh)
  , m_Surface(surface)
  , m_Axis(axis)
  , m_InnerSize(grid.size[axis == 0 ? 1 : 0])
  , m_OuterSize(grid.size[axis == 2 ? 1 : 2])
  , m_Length(grid.size[axis])
{
  const std::size_t outer = axis == 2 ? 1 : 2;
  const auto        slabs = [&](const std::array<std::uint32_t, 3> & corners) {
    double low = mesh.points[corners[0]][outer];
    double high = low;
    for (const std::uint32_t corner : corners)
    {
      low = std::min(low, mesh.points[corner][outer]);
      high = std::max(high, mesh.points[corner][outer]);
    }
    const auto first = std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(low - mesh.error)));
    const auto last = std::min(m_OuterSize - 1, static_cast<std::int64_t>(std::floor(high + mesh.error)));
    return first > last ? std::pair<std::int64_t, std::int64_t>{ 0, 0 } : std::pair{ first / kSlab, last / kSlab + 1 };
  };
  m_Offsets.assign(static_cast<std::size_t>((m_OuterSize + kSlab - 1) / kSlab) + 1, 0);
  for (const auto & corners : surface.triangles)
  {
    const auto [first, end] = slabs(corners);
    for (std::int64_t slab = first; slab < end; ++slab)
    {
      ++m_Offsets[static_cast<std::size_t>(slab) + 1];
    }
  }
  for (std::size_t slab = 1; slab < m_Offsets.size(); ++slab)
  {
    m_Offsets[slab] += m_Offsets[slab - 1];
  }
  m_Triangles.resize(m_Offsets.back());
  std::vector<std::size_t> next(m_Offsets.begin(), m_Offsets.end() - 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto [first, end] = slabs(surface.triangles[t]);
    for (std::int64_t slab = first; slab < end; ++slab)
    {
      m_Triangles[next[static_cast<std::size_t>(slab)]++] = static_cast<std::uint32_t>(t);
    }
  }
}

std::vector<PlaneRuns>
AxisCrossings::Runs(std::size_t slab) const
{
  const auto                         begin = static_cast<std::int64_t>(slab) * kSlab;
  const std::int64_t                 end = std::min(begin + kSlab, m_OuterSize);
  std::vector<std::vector<Crossing>> planes(static_cast<std::size_t>(end - begin));
  for (std::size_t at = m_Offsets[slab]; at < m_Offsets[slab + 1]; ++at)
  {
    const ExactTriangle triangle(m_Mesh, m_Surface.triangles[m_Triangles[at]], m_Axis);
    if (triangle.Facing() == 0)
    {
      continue;
    }
    // The frame (x, z, y) is mirrored.
    const Crossing leaves = (triangle.Facing() > 0) != (m_Axis == 1) ? 1 : 0;
    const auto     range = triangle.OuterRange();
    for (std::int64_t outer = std::max(begin, range[0]); outer <= std::min(end - 1, range[1]); ++outer)
    {
      const auto rays = triangle.InnerRange(outer);
      for (std::int64_t inner = std::max<std::int64_t>(0, rays[0]); inner <= std::min(m_InnerSize - 1, rays[1]);
           ++inner)
      {
        if (triangle.IsCrossedBy(inner, outer))
        {
          const auto index = std::clamp<std::int64_t>(triangle.FirstBeyond(inner, outer), 0, m_Length);
          planes[static_cast<std::size_t>(outer - begin)].push_back((static_cast<Crossing>(inner) << kInnerShift) |
                                                                    (static_cast<Crossing>(index) << 1U) | leaves);
        }
      }
    }
  }
  std::vector<PlaneRuns> runs;
  for (auto & crossings : planes)
  {
    std::sort(crossings.begin(), crossings.end());
    runs.push_back(RunsOfPlane(crossings));
  }
  return runs;
}

PlaneRuns
AxisCrossings::RunsOfPlane(const std::vector<Crossing> & crossings) const
{
  const bool isVoted = m_Surface.findings.rule == InsideRule::Votes;
  const bool isWinding = m_Surface.isOriented;
  const auto isIn = [isWinding](std::int64_t winding) { return isWinding ? winding != 0 : (winding & 1) != 0; };
  PlaneRuns  runs;
  const auto add = [](std::vector<RayRun> & to, std::int32_t inner, std::int32_t first, std::int32_t end) {
    if (!to.empty() && to.back().inner == inner && to.back().end == first)
    {
      to.back().end = end;
    }
    else
    {
      to.push_back({ inner, first, end });
    }
  };
  for (std::size_t at = 0; at < crossings.size();)
  {
    const auto   inner = static_cast<std::int32_t>(crossings[at] >> kInnerShift);
    std::size_t  rayEnd = at;
    std::int64_t total = 0;
    const auto   step = [&](std::size_t i) { return (crossings[i] & 1U) != 0 ? -1 : 1; };
    for (; rayEnd < crossings.size() && static_cast<std::int32_t>(crossings[rayEnd] >> kInnerShift) == inner; ++rayEnd)
    {
      total += step(rayEnd);
    }
    std::int64_t winding = 0;
    std::int32_t from = 0;
    for (std::size_t i = at; i <= rayEnd; ++i)
    {
      const auto to = i < rayEnd ? static_cast<std::int32_t>((crossings[i] >> 1U) & 0xffffffffU)
                                 : static_cast<std::int32_t>(m_Length);
      if (to > from)
      {
        if (isIn(winding))
        {
          add(runs.in, inner, from, to);
        }
        if (isVoted && isIn(winding - total))
        {
          add(runs.inBack, inner, from, to);
        }
        if (!isVoted && isWinding && winding != 0 && winding != m_Surface.sense)
        {
          add(runs.several, inner, from, to);
        }
        from = to;
      }
      winding += i < rayEnd ? step(i) : 0;
    }
    at = rayEnd;
  }
  return runs;
}

} // namespace voxelcore
