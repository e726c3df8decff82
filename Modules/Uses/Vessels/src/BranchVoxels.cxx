#include "voxelcore/Vessels/BranchVoxels.h"

#include "NearestBranch.h"

#include "voxelcore/Base/Library.h"
#include "voxelcore/Base/ParallelTasks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

/** The voxels of a body that a segment passes through, in order. Places in lattice coordinates. */
std::vector<Voxel>
VoxelsAlong(const VoxelShape & shape, const Vector3 & from, const Vector3 & to)
{
  const Vector3       way = Minus(to, from);
  std::vector<double> cuts{ 0, 1 };
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto [low, high] = std::minmax(from[k], to[k]);
    for (double plane = std::ceil(low); plane <= high && way[k] != 0; ++plane)
    {
      cuts.push_back(std::clamp((plane - from[k]) / way[k], 0.0, 1.0));
    }
  }
  ranges::sort(cuts);
  std::vector<Voxel> voxels;
  for (std::size_t i = 1; i < cuts.size(); ++i)
  {
    const Vector3 middle = AddScaled(from, 0.5 * (cuts[i - 1] + cuts[i]), way);
    const Voxel   voxel{ static_cast<std::int32_t>(std::floor(middle[0])),
                       static_cast<std::int32_t>(std::floor(middle[1])),
                       static_cast<std::int32_t>(std::floor(middle[2])) };
    // In the plane between two voxels, and by rounding, it may be the one outside.
    if (shape.Contains(voxel[0], voxel[1], voxel[2]) && (voxels.empty() || voxels.back() != voxel))
    {
      voxels.push_back(voxel);
    }
  }
  return voxels;
}

bool
ShareACorner(const Voxel & a, const Voxel & b)
{
  return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
}

/** Leaves out each voxel whose neighbours before and behind share a corner. */
std::vector<Voxel>
WithoutSteps(const std::vector<Voxel> & line)
{
  std::vector<Voxel> kept;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    if (kept.empty() || i + 1 == line.size() || !ShareACorner(kept.back(), line[i + 1]))
    {
      kept.push_back(line[i]);
    }
  }
  return kept;
}

void
Add(VoxelShape & voxels, const std::vector<Voxel> & line)
{
  for (const Voxel & voxel : line)
  {
    voxels.Insert(voxel[0], voxel[1], voxel[2]);
  }
}

} // namespace

VoxelField<std::uint32_t>
BranchOfVoxels(const SkeletonGraph & graph, const VoxelShape & shape, const ImageGeometry & geometry)
{
  VoxelField<std::uint32_t> field = ZeroAtVoxels<std::uint32_t>(shape);
  if (graph.BranchCount() == 0)
  {
    return field;
  }
  const NearestBranch nearest(DenseBranches(graph, geometry), 0);
  const VoxelBox &    box = shape.Box();
  RunEach(static_cast<std::size_t>(box.size[2]), [&](std::size_t layer) {
    const auto                 z = static_cast<std::int32_t>(layer);
    std::size_t                hint = 0;
    std::vector<std::uint32_t> scratch;
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      std::size_t at = field.rowStarts[layer * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y)];
      const auto  row = shape.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
        {
          const auto    x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits);
          const Vector3 middle{ box.lower[0] + x + 0.5, box.lower[1] + y + 0.5, box.lower[2] + z + 0.5 };
          field.values[at++] = 1 + nearest.Of(Times(middle, geometry.spacing), hint, scratch);
        }
      }
    }
  });
  return field;
}

void
AddSkeletonVoxels(const SkeletonGraph & graph,
                  const VoxelShape &    shape,
                  const ImageGeometry & geometry,
                  VoxelShape &          voxels)
{
  const auto at = [&](ElementIndex point) { return PhysicalToLattice(geometry, graph.positions[point]); };
  for (std::size_t branch = 0; branch < graph.BranchCount(); ++branch)
  {
    const auto         points = graph.Branch(branch);
    std::vector<Voxel> line;
    for (std::size_t i = 1; i < points.size(); ++i)
    {
      for (const Voxel & voxel : VoxelsAlong(shape, at(points[i - 1]), at(points[i])))
      {
        if (line.empty() || line.back() != voxel)
        {
          line.push_back(voxel);
        }
      }
    }
    Add(voxels, WithoutSteps(line));
  }
  for (std::size_t node = 0; node < graph.nodePoints.size(); ++node)
  {
    if (graph.nodeKinds[node] == NodeKind::Isolated)
    {
      const Vector3 place = at(graph.nodePoints[node]);
      Add(voxels, VoxelsAlong(shape, place, place));
    }
  }
  // Of a face, triangles from its first corner, by segments from that corner a quarter of a voxel apart.
  constexpr double kApart = 0.25;
  for (std::size_t face = 0; face < graph.FaceCount(); ++face)
  {
    const std::size_t first = graph.faceOffsets[face];
    const Vector3     corner = at(graph.faceVertices[first]);
    for (std::size_t i = first + 1; i + 1 < graph.faceOffsets[face + 1]; ++i)
    {
      const Vector3 from = at(graph.faceVertices[i]);
      const Vector3 way = Minus(at(graph.faceVertices[i + 1]), from);
      const double  parts = std::ceil(Length(way) / kApart) + 1;
      for (double part = 0; part <= parts; ++part)
      {
        Add(voxels, VoxelsAlong(shape, corner, AddScaled(from, part / parts, way)));
      }
    }
  }
}

} // namespace voxelcore
