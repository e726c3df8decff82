#include "voxelcore/Refinement/RadiusMargin.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace voxelcore
{

namespace
{

// So many mean voxels around a side its voxels are looked at: more would see that walls are curved.
constexpr double kReachInVoxels = 3.5;

// A vertex whose faces' unit normals have a shorter mean lies where sheets meet.
constexpr double kOneSheet = 0.95;

/** How far a side may be shifted outwards; from `least` to `most`, mm. Both 0 where no plane fits. */
struct Shift
{
  double least = 0;
  double most = 0;
};

/** The sides of walls in a shape. */
class WallSides
{
public:
  WallSides(const VoxelShape & shape, const Vector3 & spacing)
    : m_Shape(shape)
    , m_Spacing(spacing)
    , m_Reach(kReachInVoxels * std::cbrt(spacing[0] * spacing[1] * spacing[2]))
  {}

  /** Of the side at a place, with its unit normal outwards; mm along the grid. */
  Shift
  At(const Vector3 & place, const Vector3 & normal) const
  {
    // Columns along the axis that is steepest in voxels.
    const Vector3 slopes{ normal[0] * m_Spacing[0], normal[1] * m_Spacing[1], normal[2] * m_Spacing[2] };
    std::size_t   along = 0;
    for (std::size_t axis = 1; axis < 3; ++axis)
    {
      along = std::abs(slopes[axis]) > std::abs(slopes[along]) ? axis : along;
    }
    const std::size_t  u = (along + 1) % 3;
    const std::size_t  v = (along + 2) % 3;
    const std::int32_t outwards = slopes[along] > 0 ? 1 : -1;
    const auto         nearest = [&](std::size_t axis) {
      return static_cast<std::int32_t>(std::floor(place[axis] / m_Spacing[axis]));
    };
    const auto   wideU = static_cast<std::int32_t>(m_Reach / m_Spacing[u]) + 1;
    const auto   wideV = static_cast<std::int32_t>(m_Reach / m_Spacing[v]) + 1;
    double       in = -std::numeric_limits<double>::infinity();
    double       out = std::numeric_limits<double>::infinity();
    std::int32_t at[3];
    for (at[u] = nearest(u) - wideU; at[u] <= nearest(u) + wideU; ++at[u])
    {
      for (at[v] = nearest(v) - wideV; at[v] <= nearest(v) + wideV; ++at[v])
      {
        const double offU = (at[u] + 0.5) * m_Spacing[u] - place[u];
        const double offV = (at[v] + 0.5) * m_Spacing[v] - place[v];
        // Where the column meets the plane.
        const double offAlong = -(offU * normal[u] + offV * normal[v]) / normal[along];
        if (offU * offU + offV * offV + offAlong * offAlong > m_Reach * m_Reach)
        {
          continue;
        }
        const double crossing = (place[along] + offAlong) / m_Spacing[along] - 0.5; // a voxel's index
        // The last voxel in, of those whose centres lie up to a voxel and a half from the plane.
        at[along] = static_cast<std::int32_t>(std::round(crossing)) - outwards;
        if (!IsIn(at))
        {
          continue;
        }
        int steps = 0;
        do
        {
          at[along] += outwards;
        } while (IsIn(at) && ++steps < 3);
        if (steps == 3)
        {
          continue;
        }
        const double height = outwards * (at[along] - crossing) * std::abs(normal[along]) * m_Spacing[along];
        out = std::min(out, height);
        in = std::max(in, height - std::abs(normal[along]) * m_Spacing[along]);
        if (in >= out)
        {
          return {};
        }
      }
    }
    return std::isfinite(in) ? Shift{ in, out } : Shift{};
  }

private:
  bool
  IsIn(const std::int32_t (&at)[3]) const
  {
    return m_Shape.Contains(at[0], at[1], at[2]);
  }

  const VoxelShape & m_Shape;
  const Vector3      m_Spacing;
  const double       m_Reach;
};

/** Per vertex the mean of its triangles' unit normals, turned alike, each with its triangle's area; mm along the grid.
 *  0 where there is none. */
std::vector<Vector3>
MeanNormals(const MedialComplex & core, const Vector3 & spacing)
{
  std::vector<Vector3> sums(core.positions.size(), Vector3{});
  std::vector<double>  weights(core.positions.size(), 0);
  for (std::size_t face = 0; face < core.cells.FaceCount(); ++face)
  {
    const auto    corners = core.cells.FaceVertices(face);
    const Vector3 origin = Times(core.positions[corners[0]], spacing);
    Vector3       normal{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    {
      normal = AddScaled(normal,
                         1,
                         Cross(Minus(Times(core.positions[corners[i]], spacing), origin),
                               Minus(Times(core.positions[corners[i + 1]], spacing), origin)));
    }
    const double area = Length(normal);
    for (const ElementIndex vertex : corners)
    {
      sums[vertex] = AddScaled(sums[vertex], Dot(sums[vertex], normal) < 0 ? -1 : 1, normal);
      weights[vertex] += area;
    }
  }
  for (std::size_t vertex = 0; vertex < sums.size(); ++vertex)
  {
    sums[vertex] = AddScaled({}, weights[vertex] > 0 ? 1 / weights[vertex] : 0, sums[vertex]);
  }
  return sums;
}

} // namespace

std::vector<double>
RadiusMargins(const MedialComplex & core, const VoxelShape & shape, const Vector3 & spacing)
{
  const std::vector<Vector3> normals = MeanNormals(core, spacing);
  const WallSides            sides(shape, spacing);
  const std::size_t          count = core.positions.size();
  const auto                 isOnOneSheet = [&](std::size_t vertex) { return Length(normals[vertex]) > kOneSheet; };
  std::vector<double>        margins(count, 0);
  RunInParts(count > 512, count, [&](std::size_t first, std::size_t last) {
    for (std::size_t vertex = first; vertex < last; ++vertex)
    {
      if (isOnOneSheet(vertex))
      {
        const Vector3 normal = AddScaled({}, 1 / Length(normals[vertex]), normals[vertex]);
        const Vector3 place = Times(core.positions[vertex], spacing);
        const double  radius = core.radius[vertex];
        const Shift   one = sides.At(AddScaled(place, radius, normal), normal);
        const Shift   other = sides.At(AddScaled(place, -radius, normal), AddScaled({}, -1, normal));
        margins[vertex] = 0.5 * std::max({ 0.0, one.most + other.most, -one.least - other.least });
      }
    }
  });
  // Where sheets meet, of the next vertices; these are no such places.
  std::vector<double> meeting(count, 0);
  for (const auto & [a, b] : core.cells.edges)
  {
    meeting[a] = std::max(meeting[a], margins[b]);
    meeting[b] = std::max(meeting[b], margins[a]);
  }
  for (std::size_t vertex = 0; vertex < count; ++vertex)
  {
    if (!isOnOneSheet(vertex) && Length(normals[vertex]) > 0)
    {
      margins[vertex] = meeting[vertex];
    }
  }
  return margins;
}

} // namespace voxelcore
