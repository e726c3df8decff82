#include "TouchedVoxels.h"

#include "RowBits.h"

#include "voxelcore/Base/Library.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxelcore
{
namespace
{

// Far more than rounding, far less than anybody measures.
constexpr double kClose = 1e-9;

using Polygon = std::vector<Vector3>; ///< convex, in the coordinates of indices

/** The part on one side of a plane across an axis. */
void
Cut(const Polygon & whole, std::size_t axis, double at, bool above, Polygon & part)
{
  part.clear();
  const auto over = [&](const Vector3 & point) { return above ? point[axis] - at : at - point[axis]; };
  for (std::size_t i = 0; i < whole.size(); ++i)
  {
    const Vector3 & here = whole[i];
    const Vector3 & next = whole[(i + 1) % whole.size()];
    const double    first = over(here);
    const double    second = over(next);
    if (first >= 0)
    {
      part.push_back(here);
    }
    if ((first < 0) != (second < 0))
    {
      const double t = first / (first - second);
      part.push_back(
        { here[0] + t * (next[0] - here[0]), here[1] + t * (next[1] - here[1]), here[2] + t * (next[2] - here[2]) });
      part.back()[axis] = at;
    }
  }
}

/** The first and the last voxel that a polygon reaches along an axis. */
std::pair<std::int32_t, std::int32_t>
Reach(const Polygon & polygon, std::size_t axis, std::int32_t size)
{
  const auto   along = [axis](const Vector3 & point) { return point[axis]; };
  const double low = along(*ranges::min_element(polygon, {}, along));
  const double high = along(*ranges::max_element(polygon, {}, along));
  const auto   within = [size](double index) {
    return static_cast<std::int32_t>(std::clamp(std::floor(index), 0.0, static_cast<double>(size - 1)));
  };
  return { within(low + 0.5 - kClose), within(high + 0.5 + kClose) };
}

/** Between the faces of the voxels with this index. */
void
CutToLayer(const Polygon & whole, std::size_t axis, std::int32_t index, Polygon & buffer, Polygon & layer)
{
  Cut(whole, axis, index - 0.5 - kClose, true, buffer);
  Cut(buffer, axis, index + 0.5 + kClose, false, layer);
}

} // namespace

std::uint64_t
AddTouchedVoxels(const IndexMesh & mesh, const MeshSurface & surface, VoxelShape & shape)
{
  const auto &  size = shape.Box().size;
  std::uint64_t added = 0;
  Polygon       triangle;
  Polygon       slice;
  Polygon       row;
  Polygon       buffer;
  for (const auto & corners : surface.triangles)
  {
    triangle.assign({ mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]] });
    const auto [firstZ, lastZ] = Reach(triangle, 2, size[2]);
    for (std::int32_t z = firstZ; z <= lastZ; ++z)
    {
      CutToLayer(triangle, 2, z, buffer, slice);
      if (slice.empty())
      {
        continue;
      }
      const auto [firstY, lastY] = Reach(slice, 1, size[1]);
      for (std::int32_t y = firstY; y <= lastY; ++y)
      {
        CutToLayer(slice, 1, y, buffer, row);
        if (!row.empty())
        {
          const auto [first, last] = Reach(row, 0, size[0]);
          added += SetBits(shape.Row(y, z), first, last + 1);
        }
      }
    }
  }
  return added;
}

} // namespace voxelcore
