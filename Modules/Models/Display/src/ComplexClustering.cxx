#include "ComplexClustering.h"

#include "voxelcore/Lattice/Vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace voxelcore
{

namespace
{

using Point = Vector3;

/** The sum of squared distances to planes, each times a weight; and to a point, so slightly that planes go first. */
class Quadric
{
public:
  void
  AddPlane(const Point & normal, const Point & on, double weight)
  {
    const double away = -Dot(normal, on);
    std::size_t  at = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = i; j < 3; ++j)
      {
        m_Square[at++] += weight * normal[i] * normal[j] * (i == j ? 1 : 2);
      }
      m_Linear[i] += 2 * weight * away * normal[i];
    }
    m_Weight += weight;
  }
  void
  AddPoint(const Point & point)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      m_Sum[k] += point[k];
    }
    m_Count += 1;
  }
  /** Up to a constant. */
  double
  At(const Point & p) const
  {
    constexpr double kPull = 0.01;
    double           error = 0;
    std::size_t      at = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = i; j < 3; ++j)
      {
        error += m_Square[at++] * p[i] * p[j];
      }
      error += m_Linear[i] * p[i];
    }
    const Point away = Minus(p, { m_Sum[0] / m_Count, m_Sum[1] / m_Count, m_Sum[2] / m_Count });
    return error + (m_Weight > 0 ? kPull * m_Weight : 1) * Dot(away, away);
  }

private:
  std::array<double, 6> m_Square{};
  Point                 m_Linear{};
  Point                 m_Sum{};
  double                m_Count = 0;
  double                m_Weight = 0;
};

struct Clusters
{
  std::vector<std::uint32_t> of; ///< per point
  std::size_t                count = 0;
};

Clusters
InCells(const std::vector<Point> & points, double side)
{
  Clusters                                         clusters;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  numbers.reserve(points.size());
  for (const Point & point : points)
  {
    std::uint64_t key = 0;
    for (const double coordinate : point)
    {
      constexpr std::uint64_t kMost = (1U << 21) - 1; // cells along an axis
      key = key << 21 | std::min(static_cast<std::uint64_t>(coordinate / side), kMost);
    }
    clusters.of.push_back(numbers.try_emplace(key, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  clusters.count = numbers.size();
  return clusters;
}

template <typename T>
void
SortUnique(std::vector<T> & items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

/** `mesh` over clusters in place of points: each element once, none that has fallen together to less. */
ShownMesh
Collapsed(const ShownMesh & mesh, const Clusters & clusters)
{
  ShownMesh                                 small;
  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<std::uint32_t>                dots;
  const auto                                addSegment = [&](std::uint32_t a, std::uint32_t b) {
    if (a == b)
    {
      dots.push_back(a);
    }
    else
    {
      segments.push_back({ std::min(a, b), std::max(a, b) });
    }
  };
  for (const auto & triangle : mesh.triangles)
  {
    std::array<std::uint32_t, 3> t{ clusters.of[triangle[0]], clusters.of[triangle[1]], clusters.of[triangle[2]] };
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
    {
      std::sort(t.begin(), t.end()); // both sides are drawn
      small.triangles.push_back(t);
    }
    else
    {
      addSegment(t[0], t[0] != t[1] ? t[1] : t[2]);
    }
  }
  for (const auto & segment : mesh.segments)
  {
    addSegment(clusters.of[segment[0]], clusters.of[segment[1]]);
  }
  for (const std::uint32_t dot : mesh.dots)
  {
    dots.push_back(clusters.of[dot]);
  }
  SortUnique(small.triangles);
  SortUnique(segments);
  SortUnique(dots);
  std::vector<std::array<std::uint32_t, 2>> sides;
  std::vector<bool>                         taken(clusters.count, false);
  for (const auto & t : small.triangles)
  {
    sides.insert(sides.end(), { { t[0], t[1] }, { t[1], t[2] }, { t[0], t[2] } });
    taken[t[0]] = taken[t[1]] = taken[t[2]] = true;
  }
  SortUnique(sides);
  std::set_difference(segments.begin(), segments.end(), sides.begin(), sides.end(), std::back_inserter(small.segments));
  for (const auto & segment : small.segments)
  {
    taken[segment[0]] = taken[segment[1]] = true;
  }
  std::copy_if(dots.begin(), dots.end(), std::back_inserter(small.dots), [&taken](std::uint32_t dot) {
    return !taken[dot];
  });
  return small;
}

} // namespace

ShownMesh
ClusteredMesh(const ShownMesh & mesh, const std::vector<std::array<std::uint32_t, 3>> & rims, std::size_t most)
{
  std::array<float, 3> low = mesh.points.at(0);
  for (const auto & point : mesh.points)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      low[k] = std::min(low[k], point[k]);
    }
  }
  std::vector<Point> points;
  double             longest = 0;
  for (const auto & point : mesh.points)
  {
    points.push_back({ double{ point[0] } - low[0], double{ point[1] } - low[1], double{ point[2] } - low[2] });
    longest = std::max({ longest, points.back()[0], points.back()[1], points.back()[2] });
  }

  // A surface has as many triangles as its area over half a cell's side; then by what came out.
  double area = 0;
  for (const auto & t : mesh.triangles)
  {
    const Point normal = Cross(Minus(points[t[1]], points[t[0]]), Minus(points[t[2]], points[t[0]]));
    area += std::sqrt(Dot(normal, normal)) / 2;
  }
  const auto    wanted = static_cast<double>(std::max<std::size_t>(most, 1));
  double        side = std::max(std::sqrt(2 * area / wanted), longest / 1e5);
  Clusters      clusters;
  ShownMesh     small;
  constexpr int kAttempts = 12;
  for (int attempt = 0; attempt < kAttempts && side > 0; ++attempt)
  {
    clusters = InCells(points, side);
    small = Collapsed(mesh, clusters);
    const auto now = static_cast<double>(small.triangles.size() + small.segments.size());
    if (now <= wanted * 1.05)
    {
      break;
    }
    side *= std::max(1.05, std::sqrt(now / wanted));
  }

  std::vector<Quadric> quadrics(clusters.count);
  const auto           addPlane = [&](const std::array<std::uint32_t, 3> & t, const Point & normal, double weight) {
    for (const std::uint32_t corner : t)
    {
      quadrics[clusters.of[corner]].AddPlane(normal, points[t[0]], weight);
    }
  };
  const auto unit = [](Point & v) {
    const double length = std::sqrt(Dot(v, v));
    for (double & x : v)
    {
      x = length > 0 ? x / length : 0;
    }
    return length;
  };
  for (const auto & t : mesh.triangles)
  {
    Point        normal = Cross(Minus(points[t[1]], points[t[0]]), Minus(points[t[2]], points[t[0]]));
    const double twice = unit(normal);
    addPlane(t, normal, twice / 2);
  }
  for (const auto & rim : rims) // a plane through the edge, across its triangle
  {
    Point        along = Minus(points[rim[1]], points[rim[0]]);
    const double length = unit(along);
    Point        across = Minus(points[rim[2]], points[rim[0]]);
    const double part = Dot(across, along);
    across = { across[0] - part * along[0], across[1] - part * along[1], across[2] - part * along[2] };
    unit(across);
    addPlane({ rim[0], rim[1], rim[1] }, across, length * side / 2);
  }
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    quadrics[clusters.of[point]].AddPoint(points[point]);
  }
  std::vector<double> least(clusters.count, std::numeric_limits<double>::infinity());
  small.points.resize(clusters.count);
  small.origin.resize(clusters.count);
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    const std::uint32_t cluster = clusters.of[point];
    const double        error = quadrics[cluster].At(points[point]);
    if (error < least[cluster])
    {
      least[cluster] = error;
      small.points[cluster] = mesh.points[point];
      small.origin[cluster] = mesh.origin[point];
    }
  }
  return small;
}

} // namespace voxelcore
