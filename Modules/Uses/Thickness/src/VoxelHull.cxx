#include "voxelcore/Thickness/VoxelHull.h"

#include "voxelcore/Lattice/ConvexHull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <map>

namespace voxelcore
{

namespace
{

using Point = std::array<std::int64_t, 3>;
__extension__ using Wide = __int128;

/** Above 0 where c lies to the left of the way from a to b, in the plane of axes 0 and 1. */
std::int64_t
LeftOf(const Point & a, const Point & b, const Point & c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Of points in order of y, those that no corner of the slice's hull can miss. */
void
AddHullOfSlice(const std::vector<Point> & ends, std::vector<Point> & points)
{
  for (const int side : { 1, -1 })
  {
    const std::size_t first = points.size();
    for (const Point & end : ends)
    {
      while (points.size() >= first + 2 && side * LeftOf(points[points.size() - 2], points.back(), end) >= 0)
      {
        points.pop_back();
      }
      points.push_back(end);
    }
  }
}

/** First and last voxel of each row of a slice, in indices of the scan. */
class RowEnds
{
public:
  void
  Add(const VoxelShape & shape)
  {
    const VoxelBox & box = shape.Box();
    for (std::int32_t z = 0; z < box.size[2]; ++z)
    {
      for (std::int32_t y = 0; y < box.size[1]; ++y)
      {
        const auto  row = shape.Row(y, z);
        std::size_t first = 0;
        std::size_t last = row.size();
        while (first < last && row[first] == 0)
        {
          ++first;
        }
        if (first == last)
        {
          continue;
        }
        while (row[last - 1] == 0)
        {
          --last;
        }
        const auto lower = box.lower[0] + static_cast<std::int64_t>(64 * first) + std::countr_zero(row[first]);
        const auto upper = box.lower[0] + static_cast<std::int64_t>(64 * last) - 1 - std::countl_zero(row[last - 1]);
        auto [at, isNew] = m_Slices[box.lower[2] + z].try_emplace(box.lower[1] + y, lower, upper);
        if (!isNew)
        {
          at->second = { std::min(at->second.first, lower), std::max(at->second.second, upper) };
        }
      }
    }
  }

  std::vector<Point>
  Corners() const
  {
    std::vector<Point> corners;
    for (const auto & [z, rows] : m_Slices)
    {
      std::vector<Point> ends;
      for (const auto & [y, range] : rows)
      {
        ends.push_back({ range.first, y, z });
        ends.push_back({ range.second, y, z });
      }
      AddHullOfSlice(ends, corners);
    }
    return corners;
  }

private:
  std::map<std::int64_t, std::map<std::int64_t, std::pair<std::int64_t, std::int64_t>>> m_Slices; ///< z, y
};

/** The quotient rounded down. */
std::int64_t
Floor(Wide number, std::int64_t by)
{
  Wide quotient = number / by;
  if (number % by != 0 && (number < 0) != (by < 0))
  {
    --quotient;
  }
  return static_cast<std::int64_t>(quotient);
}

} // namespace

VoxelShape
HullOfVoxels(const std::vector<VoxelShape> & shapes)
{
  RowEnds ends;
  for (const VoxelShape & shape : shapes)
  {
    ends.Add(shape);
  }
  const std::vector<Point>     points = ends.Corners();
  const std::vector<HullFacet> facets = ConvexHull(points);
  if (facets.empty())
  {
    return {};
  }
  Point lower = points.front();
  Point upper = points.front();
  for (const Point & point : points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], point[axis]);
      upper[axis] = std::max(upper[axis], point[axis]);
    }
  }
  VoxelBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = static_cast<std::int32_t>(lower[axis]);
    box.size[axis] = static_cast<std::int32_t>(upper[axis] - lower[axis] + 1);
  }
  // Along a row the hull ends where the row meets two facets; those parallel to it are rims of others.
  struct Range
  {
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    std::int64_t most = std::numeric_limits<std::int64_t>::min();
  };
  const auto         rows = static_cast<std::size_t>(box.size[1]);
  std::vector<Range> ranges(rows * static_cast<std::size_t>(box.size[2]));
  for (const HullFacet & facet : facets)
  {
    const Point & n = facet.normal;
    if (n[0] == 0)
    {
      continue;
    }
    const auto corner = [&](std::size_t k) -> const Point & { return points[facet.corners[k]]; };
    const auto [yLeast, yMost] = std::minmax({ corner(0)[1], corner(1)[1], corner(2)[1] });
    const auto [zLeast, zMost] = std::minmax({ corner(0)[2], corner(1)[2], corner(2)[2] });
    for (std::int64_t z = zLeast; z <= zMost; ++z)
    {
      for (std::int64_t y = yLeast; y <= yMost; ++y)
      {
        bool isInside = true;
        for (std::size_t k = 0; k < 3 && isInside; ++k)
        {
          const Point &      a = corner(k);
          const Point &      b = corner((k + 1) % 3);
          const std::int64_t left = (b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1]);
          isInside = n[0] > 0 ? left >= 0 : left <= 0;
        }
        if (!isInside)
        {
          continue;
        }
        const Wide height =
          Wide{ n[0] } * corner(0)[0] + Wide{ n[1] } * (corner(0)[1] - y) + Wide{ n[2] } * (corner(0)[2] - z);
        Range & range = ranges[static_cast<std::size_t>(z - lower[2]) * rows + static_cast<std::size_t>(y - lower[1])];
        if (n[0] > 0)
        {
          range.most = Floor(height, n[0]);
        }
        else
        {
          range.least = -Floor(-height, n[0]);
        }
      }
    }
  }
  VoxelShape hull(box);
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    for (std::int64_t x = ranges[i].least; x <= ranges[i].most; ++x)
    {
      hull.Insert(static_cast<std::int32_t>(x),
                  box.lower[1] + static_cast<std::int32_t>(i % rows),
                  box.lower[2] + static_cast<std::int32_t>(i / rows));
    }
  }
  hull.Compact();
  return hull;
}

} // namespace voxelcore
