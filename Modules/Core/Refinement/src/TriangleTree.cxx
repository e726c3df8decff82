#include "voxelcore/Refinement/TriangleTree.h"

#include "voxelcore/Lattice/Vectors.h"


#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace voxelcore
{

namespace
{

constexpr std::size_t kTask = 16384; ///< triangles that are worth a thread of their own
constexpr double      kInfinity = std::numeric_limits<double>::infinity();
struct Box
{
  Vector3 lower{ kInfinity, kInfinity, kInfinity };
  Vector3 upper{ -kInfinity, -kInfinity, -kInfinity };

  void
  Add(const Vector3 & place)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], place[axis]);
      upper[axis] = std::max(upper[axis], place[axis]);
    }
  }
};

} // namespace

TriangleTree::TriangleTree(std::span<const Vector3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles)
{
  m_Corners.reserve(triangles.size());
  Box all;
  for (const auto & triangle : triangles)
  {
    m_Corners.push_back({ vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]] });
    std::for_each(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) { all.Add(vertices[vertex]); });
  }
  if (triangles.empty())
  {
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    m_Middle[axis] = 0.5 * (all.lower[axis] + all.upper[axis]);
    m_Extent = std::max(m_Extent, 0.5 * (all.upper[axis] - all.lower[axis]));
  }
  std::vector<std::uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), std::uint32_t{ 0 });
#pragma omp parallel if (order.size() > 2 * kTask)
#pragma omp single
  Order(0, order.size(), order);
  m_Leaves.reserve((order.size() + kLanes - 1) / kLanes);
  for (std::size_t first = 0; first < order.size(); first += kLanes)
  {
    m_Leaves.push_back(LeafOf(std::span(order).subspan(first, std::min(kLanes, order.size() - first))));
  }
  AddLevels();
}

// Such that what follows each other in eights, and eights of eights, and so on, lies together: halves, in such blocks,
// along what is longest.
void
TriangleTree::Order(std::size_t first, std::size_t last, std::vector<std::uint32_t> & order) const
{
  const std::size_t count = last - first;
  if (count <= kLanes)
  {
    return;
  }
  std::size_t block = kLanes;
  while (block * kLanes < count)
  {
    block *= kLanes;
  }
  Box box;
  for (std::size_t i = first; i < last; ++i)
  {
    std::for_each(m_Corners[order[i]].begin(), m_Corners[order[i]].end(), [&](const Vector3 & at) { box.Add(at); });
  }
  const Vector3 sides = Minus(box.upper, box.lower);
  const auto    axis = static_cast<std::size_t>(std::max_element(sides.begin(), sides.end()) - sides.begin());
  const auto    centre = [&](std::uint32_t triangle) {
    const auto & corners = m_Corners[triangle];
    return corners[0][axis] + corners[1][axis] + corners[2][axis];
  };
  const std::size_t middle = first + (count + block - 1) / block / 2 * block;
  const auto        begin = order.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                   begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(last),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double ca = centre(a);
                     const double cb = centre(b);
                     return ca != cb ? ca < cb : a < b;
                   });
#pragma omp task shared(order) if (count > kTask)
  Order(first, middle, order);
  Order(middle, last, order);
#pragma omp taskwait
}

TriangleTree::Leaf
TriangleTree::LeafOf(std::span<const std::uint32_t> triangles) const
{
  constexpr double thinnest = 1e-6; // sine of an angle
  Leaf             leaf{};
  leaf.triangles.fill(kNoTriangle);
  leaf.planes[0][3].fill(std::numeric_limits<float>::infinity());
  for (std::size_t lane = 0; lane < triangles.size(); ++lane)
  {
    leaf.triangles[lane] = triangles[lane];
    leaf.planes[0][3][lane] = 0;
    const auto &  corners = m_Corners[triangles[lane]];
    const Vector3 normal = Normal(triangles[lane]);
    const double  area = Length(normal);
    const double  sides = Length(Minus(corners[1], corners[0])) * Length(Minus(corners[2], corners[0]));
    const double  other = Length(Minus(corners[2], corners[1]));
    if (!(area > thinnest * sides) || !(area > thinnest * other * other))
    {
      continue;
    }
    const auto set = [&](std::size_t plane, const Vector3 & across, const Vector3 & on) {
      const Vector3 unit = AddScaled({ 0, 0, 0 }, 1 / Length(across), across);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        leaf.planes[plane][axis][lane] = static_cast<float>(unit[axis]);
      }
      leaf.planes[plane][3][lane] = static_cast<float>(Dot(unit, Minus(m_Middle, on)));
    };
    set(0, normal, corners[0]);
    for (std::size_t side = 0; side < 3; ++side)
    {
      set(1 + side, Cross(Minus(corners[(side + 1) % 3], corners[side]), normal), corners[side]);
    }
  }
  return leaf;
}

void
TriangleTree::AddLevels()
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Boxes           none;
  none.lower.fill({ infinity, infinity, infinity, infinity, infinity, infinity, infinity, infinity });
  none.upper.fill({ -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity, -infinity });
  std::vector<Box> boxes;
  for (const Leaf & leaf : m_Leaves)
  {
    Box & box = boxes.emplace_back();
    for (const std::uint32_t triangle : leaf.triangles)
    {
      for (std::size_t corner = 0; corner < 3 && triangle != kNoTriangle; ++corner)
      {
        box.Add(Minus(m_Corners[triangle][corner], m_Middle));
      }
    }
  }
  do
  {
    std::vector<Box> above((boxes.size() + kLanes - 1) / kLanes);
    m_Levels.emplace_back(above.size(), none);
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      Boxes & eight = m_Levels.back()[i / kLanes];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        eight.lower[axis][i % kLanes] = static_cast<float>(boxes[i].lower[axis]);
        eight.upper[axis][i % kLanes] = static_cast<float>(boxes[i].upper[axis]);
      }
      above[i / kLanes].Add(boxes[i].lower);
      above[i / kLanes].Add(boxes[i].upper);
    }
    boxes = std::move(above);
  } while (boxes.size() > 1);
}

Vector3
TriangleTree::Normal(std::uint32_t triangle) const
{
  const auto & corners = m_Corners[triangle];
  return Cross(Minus(corners[1], corners[0]), Minus(corners[2], corners[0]));
}

} // namespace voxelcore
