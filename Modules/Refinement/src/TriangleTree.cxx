#include "voxelcore/TriangleTree.h"

#include "voxelcore/Vectors.h"


#include <algorithm>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kLeaf = 4;
constexpr std::size_t kTask = 16384; ///< triangles that are worth a thread of their own

// Of a tree of so many triangles, and of all its parts.
std::size_t
NodeCount(std::size_t triangles, std::map<std::size_t, std::size_t> & nodes)
{
  if (const auto known = nodes.find(triangles); known != nodes.end())
  {
    return known->second;
  }
  const std::size_t half = triangles / 2;
  const std::size_t count =
    triangles > kLeaf ? 1 + NodeCount(half, nodes) + NodeCount(triangles - half, nodes) : std::size_t{ 1 };
  nodes[triangles] = count;
  return count;
}

double
SquaredGap(const Vector3 & place, const Vector3 & lower, const Vector3 & upper)
{
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const double gap = std::max({ lower[i] - place[i], place[i] - upper[i], 0.0 });
    sum += gap * gap;
  }
  return sum;
}

Vector3
NearestOnSegment(const Vector3 & place, const Vector3 & a, const Vector3 & b)
{
  const Vector3 ab = Minus(b, a);
  const double  length = Dot(ab, ab);
  const double  t = length > 0 ? std::clamp(Dot(Minus(place, a), ab) / length, 0.0, 1.0) : 0.0;
  return AddScaled(a, t, ab);
}

} // namespace

Vector3
NearestOnTriangle(const Vector3 & place, const std::array<Vector3, 3> & corners)
{
  const auto & [a, b, c] = corners;
  const Vector3 ab = Minus(b, a);
  const Vector3 ac = Minus(c, a);
  const Vector3 ap = Minus(place, a);
  const double  d1 = Dot(ab, ap);
  const double  d2 = Dot(ac, ap);
  const Vector3 bp = Minus(place, b);
  const double  d3 = Dot(ab, bp);
  const double  d4 = Dot(ac, bp);
  const Vector3 cp = Minus(place, c);
  const double  d5 = Dot(ab, cp);
  const double  d6 = Dot(ac, cp);
  const double  va = d3 * d6 - d5 * d4;
  const double  vb = d5 * d2 - d1 * d6;
  const double  vc = d1 * d4 - d3 * d2;
  if (va > 0 && vb > 0 && vc > 0)
  {
    const double sum = va + vb + vc;
    return AddScaled(AddScaled(a, vb / sum, ab), vc / sum, ac);
  }
  // Outside, or no triangle: the nearest of the sides, of those that it lies beyond.
  Vector3    best{};
  double     least = std::numeric_limits<double>::infinity();
  const auto lookAt = [&](const Vector3 & from, const Vector3 & to) {
    const Vector3 other = NearestOnSegment(place, from, to);
    const Vector3 gap = Minus(place, other);
    const double  squared = Dot(gap, gap);
    if (squared < least)
    {
      least = squared;
      best = other;
    }
  };
  if (!(vc > 0))
  {
    lookAt(a, b);
  }
  if (!(va > 0))
  {
    lookAt(b, c);
  }
  if (!(vb > 0))
  {
    lookAt(c, a);
  }
  return best;
}

TriangleTree::TriangleTree(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles)
{
  m_Corners.reserve(triangles.size());
  for (const auto & triangle : triangles)
  {
    m_Corners.push_back({ vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]] });
  }
  m_Order.resize(m_Corners.size());
  std::iota(m_Order.begin(), m_Order.end(), std::uint32_t{ 0 });
  if (!m_Order.empty())
  {
    std::map<std::size_t, std::size_t> nodes;
    m_Boxes.resize(NodeCount(m_Order.size(), nodes));
    m_Right.resize(m_Boxes.size(), 0);
#pragma omp parallel if (m_Order.size() > 2 * kTask)
#pragma omp single
    Build(0, 0, m_Order.size(), nodes);
  }
}

void
TriangleTree::Build(std::size_t                                node,
                    std::size_t                                first,
                    std::size_t                                last,
                    const std::map<std::size_t, std::size_t> & nodes)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box              box{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  for (std::size_t i = first; i < last; ++i)
  {
    for (const Vector3 & corner : m_Corners[m_Order[i]])
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        box.lower[axis] = std::min(box.lower[axis], corner[axis]);
        box.upper[axis] = std::max(box.upper[axis], corner[axis]);
      }
    }
  }
  m_Boxes[node] = box;
  if (last - first > kLeaf)
  {
    std::size_t axis = 0;
    for (std::size_t other = 1; other < 3; ++other)
    {
      axis = box.upper[other] - box.lower[other] > box.upper[axis] - box.lower[axis] ? other : axis;
    }
    const auto centre = [&](std::uint32_t triangle) {
      const auto & corners = m_Corners[triangle];
      return corners[0][axis] + corners[1][axis] + corners[2][axis];
    };
    const std::size_t middle = first + (last - first) / 2;
    const auto        begin = m_Order.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                     begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double ca = centre(a);
                       const double cb = centre(b);
                       return ca != cb ? ca < cb : a < b;
                     });
    const std::size_t right = node + 1 + nodes.at(middle - first);
    m_Right[node] = static_cast<std::uint32_t>(right);
    if (last - first <= kTask)
    {
      Build(node + 1, first, middle, nodes);
      Build(right, middle, last, nodes);
      return;
    }
#pragma omp task shared(nodes)
    Build(node + 1, first, middle, nodes);
    Build(right, middle, last, nodes);
#pragma omp taskwait
  }
}

TriangleTree::Nearest
TriangleTree::FindNearest(const Vector3 & place, double within, std::uint32_t likely) const
{
  Nearest best;
  best.squaredDistance = within * within;
  best.triangle = kNoTriangle;
  if (likely < m_Corners.size())
  {
    LookAt(likely, place, best);
  }
  if (!m_Boxes.empty())
  {
    Descend(0, 0, m_Order.size(), place, best);
  }
  return best;
}

void
TriangleTree::LookAt(std::uint32_t triangle, const Vector3 & place, Nearest & best) const
{
  const Vector3 point = NearestOnTriangle(place, m_Corners[triangle]);
  const Vector3 gap = Minus(place, point);
  const double  squared = Dot(gap, gap);
  if (squared < best.squaredDistance || (squared == best.squaredDistance && triangle < best.triangle))
  {
    best = { point, squared, triangle };
  }
}

void
TriangleTree::Descend(std::size_t node, std::size_t first, std::size_t last, const Vector3 & place, Nearest & best)
  const
{
  if (last - first <= kLeaf)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      LookAt(m_Order[i], place, best);
    }
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  const std::size_t right = m_Right[node];
  const double      gapLeft = SquaredGap(place, m_Boxes[node + 1].lower, m_Boxes[node + 1].upper);
  const double      gapRight = SquaredGap(place, m_Boxes[right].lower, m_Boxes[right].upper);
  const bool        leftFirst = gapLeft <= gapRight;
  for (const bool left : { leftFirst, !leftFirst })
  {
    if ((left ? gapLeft : gapRight) <= best.squaredDistance)
    {
      left ? Descend(node + 1, first, middle, place, best) : Descend(right, middle, last, place, best);
    }
  }
}

Vector3
TriangleTree::Normal(std::uint32_t triangle) const
{
  const auto & corners = m_Corners[triangle];
  return Cross(Minus(corners[1], corners[0]), Minus(corners[2], corners[0]));
}

} // namespace voxelcore
