#include "CentreBuckets.h"

#include "voxelcore/Base/EightLanes.h"
#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace voxelcore
{

namespace
{

CircumSphere
SphereOf(const DelaunayCells &             cells,
         std::uint32_t                     cell,
         const std::vector<LatticePoint> & points,
         const SpacingWeights &            weights)
{
  const auto & t = cells.tetrahedra[cell];
  return MakeCircumSphere(points[t[0]], points[t[1]], points[t[2]], points[t[3]], weights);
}

using Integers3 = std::array<std::int64_t, 3>;

Integers3
CrossOf(const Integers3 & a, const Integers3 & b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

constexpr std::int32_t kWidest = 63;        // so that sums of products below stay under 2^29 w^2,
constexpr std::int32_t kFarthest = 1 << 20; // and denominators times places under 2^62

// The centre of a small cell not far from the origin: where numerator and denominator of a coordinate are doubles,
// their quotient is rounded once. False where they are not.
bool
CentreInDoubles(const std::array<LatticePoint, 4> & corners, const SpacingWeights & weights, CentredCell & entry)
{
  constexpr std::int64_t   heaviest = 1024; // so that sums stay under 2^49
  std::array<Integers3, 3> side{};
  Integers3                square{};
  const Integers3          base{ corners[0].x, corners[0].y, corners[0].z };
  for (std::size_t i = 0; i < 3; ++i)
  {
    side[i] = { corners[i + 1].x - base[0], corners[i + 1].y - base[1], corners[i + 1].z - base[2] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::int64_t w = weights.weight[axis];
      if (std::abs(side[i][axis]) > kWidest || w > heaviest || std::abs(base[axis]) > kFarthest)
      {
        return false;
      }
      square[i] += w * w * side[i][axis] * side[i][axis];
    }
  }
  const std::array<Integers3, 3> minors{ CrossOf(side[1], side[2]),
                                         CrossOf(side[2], side[0]),
                                         CrossOf(side[0], side[1]) };
  const std::int64_t det = side[0][0] * minors[0][0] + side[0][1] * minors[0][1] + side[0][2] * minors[0][2];
  std::int64_t       greatest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int64_t w = weights.weight[axis];
    greatest = std::max(greatest, w);
    const std::int64_t n = square[0] * minors[0][axis] + square[1] * minors[1][axis] + square[2] * minors[2][axis];
    const std::int64_t q = 2 * w * w * std::abs(det);
    const std::int64_t p = base[axis] * q + (det < 0 ? -n : n);
    if (det == 0 || std::abs(p) > (std::int64_t{ 1 } << 53) || q > (std::int64_t{ 1 } << 53))
    {
      return false;
    }
    entry.centre[axis] = static_cast<double>(p) / static_cast<double>(q);
  }
  entry.denominator = 1.000001F * static_cast<float>(2 * std::abs(det) * greatest * greatest);
  return true;
}

// The corners of cells side by side.
constexpr std::size_t kBatch = 32;
struct CornerLanes
{
  alignas(32) std::array<std::array<std::array<std::int32_t, kBatch>, 3>, 4> corner;
};

// The centres of small cells not far from the origin, where weights are 1, eight at a time: sums of products are
// integers of 32 bits, and numerators and denominators are doubles. A bit of the result is set for each cell that is
// another.
VOXELCORE_EIGHT_LANES std::uint32_t
                      SetCentres(const CornerLanes & lanes, CentredCell * to)
{
  using EightDoubles = double __attribute__((vector_size(64)));
  std::uint32_t others = 0;
  for (std::size_t first = 0; first < kBatch; first += 8)
  {
    const auto at = [&](std::size_t corner, std::size_t axis, EightIntegers & value) {
      std::memcpy(&value, lanes.corner[corner][axis].data() + first, sizeof(value));
    };
    EightIntegers base[3];
    EightIntegers side[3][3];
    EightIntegers square[3];
    EightIntegers isOther{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      at(0, axis, base[axis]);
      isOther |= (base[axis] > kFarthest) | (base[axis] < -kFarthest);
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        at(i + 1, axis, side[i][axis]);
        side[i][axis] -= base[axis];
        isOther |= (side[i][axis] > kWidest) | (side[i][axis] < -kWidest);
      }
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      square[i] = EightIntegers{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        side[i][axis] &= ~isOther; // of a large cell, sums of products would overflow
        square[i] += side[i][axis] * side[i][axis];
      }
    }
    EightIntegers det{};
    EightIntegers n[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::size_t   j = (axis + 1) % 3;
      const std::size_t   k = (axis + 2) % 3;
      const EightIntegers minor = side[1][j] * side[2][k] - side[1][k] * side[2][j];
      det += side[0][axis] * minor;
      n[axis] = square[0] * minor + square[1] * (side[2][j] * side[0][k] - side[2][k] * side[0][j]) +
                square[2] * (side[0][j] * side[1][k] - side[0][k] * side[1][j]);
    }
    isOther |= det == 0;
    const EightDoubles q = __builtin_convertvector(2 * (det < 0 ? -det : det), EightDoubles);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const EightDoubles p = __builtin_convertvector(base[axis], EightDoubles) * q +
                             __builtin_convertvector(det < 0 ? -n[axis] : n[axis], EightDoubles);
      const EightDoubles centre = p / q;
      for (std::size_t lane = 0; lane < 8; ++lane)
      {
        to[first + lane].centre[axis] = centre[lane];
      }
    }
    for (std::size_t lane = 0; lane < 8; ++lane)
    {
      to[first + lane].denominator = 1.000001F * static_cast<float>(q[lane]);
    }
    others |= LanesOf(isOther) << first;
  }
  return others;
}

} // namespace

CentredCell
CentreOfCorners(const std::array<LatticePoint, 4> & corners, const SpacingWeights & weights)
{
  CentredCell entry{ {}, 2.0F, 0 };
  // Half of all cells lie in one voxel each, whatever its sides: their spheres have its middle.
  const auto [lowX, highX] = std::minmax({ corners[0].x, corners[1].x, corners[2].x, corners[3].x });
  const auto [lowY, highY] = std::minmax({ corners[0].y, corners[1].y, corners[2].y, corners[3].y });
  const auto [lowZ, highZ] = std::minmax({ corners[0].z, corners[1].z, corners[2].z, corners[3].z });
  if (highX - lowX <= 1 && highY - lowY <= 1 && highZ - lowZ <= 1)
  {
    entry.centre = { lowX + 0.5, lowY + 0.5, lowZ + 0.5 };
    return entry;
  }
  if (CentreInDoubles(corners, weights, entry))
  {
    return entry;
  }
  const auto         greatest = static_cast<double>(*std::max_element(weights.weight.begin(), weights.weight.end()));
  const CircumSphere sphere = MakeCircumSphere(corners[0], corners[1], corners[2], corners[3], weights);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    entry.centre[axis] = CentreCoordinate(sphere, axis, weights);
  }
  entry.denominator = 1.000001F * static_cast<float>(2.0 * static_cast<double>(sphere.det) * greatest * greatest);
  return entry;
}

void
CentresOf(const DelaunayCells &             cells,
          std::span<const std::uint32_t>    list,
          const std::vector<LatticePoint> & points,
          const SpacingWeights &            weights,
          CentredCell *                     to)
{
  const bool areOnes = *std::max_element(weights.weight.begin(), weights.weight.end()) == 1;
  const auto cornersAt = [&](std::size_t i) -> const auto &
  {
    return cells.tetrahedra[list[std::min(i, list.size() - 1)]];
  };
  CornerLanes lanes;
  for (std::size_t first = 0; first < list.size(); first += kBatch)
  {
    std::array<CentredCell, kBatch> made;
    for (std::size_t lane = 0; lane < kBatch; ++lane)
    {
      // Step by step: the cell, its corners.
      __builtin_prefetch(&cornersAt(first + 2 * kBatch + lane));
      for (const std::uint32_t corner : cornersAt(first + kBatch + lane))
      {
        __builtin_prefetch(&points[corner]);
      }
      const auto & corners = cornersAt(first + lane);
      for (std::size_t corner = 0; corner < 4; ++corner)
      {
        const LatticePoint & p = points[corners[corner]];
        lanes.corner[corner][0][lane] = p.x;
        lanes.corner[corner][1][lane] = p.y;
        lanes.corner[corner][2][lane] = p.z;
      }
    }
    const std::uint32_t others = areOnes ? SetCentres(lanes, made.data()) : ~std::uint32_t{ 0 };
    for (std::size_t lane = 0; lane < std::min(kBatch, list.size() - first); ++lane)
    {
      if ((others >> lane & 1U) != 0)
      {
        const auto & t = cornersAt(first + lane);
        made[lane] = CentreOfCorners({ points[t[0]], points[t[1]], points[t[2]], points[t[3]] }, weights);
      }
      made[lane].cell = list[first + lane];
      to[first + lane] = made[lane];
    }
  }
}

int
CentreOrder::CompareExactly(const CentredCell & a, const CentredCell & b, std::size_t axis) const
{
  return CompareCentreCoordinates(SphereOf(m_Cells, a.cell, m_Points, m_Weights),
                                  SphereOf(m_Cells, b.cell, m_Points, m_Weights),
                                  axis,
                                  m_Weights);
}

CentreBuckets::CentreBuckets(const DelaunayCells &             cells,
                             const std::vector<LatticePoint> & points,
                             const SpacingWeights &            weights,
                             std::size_t                       count)
  : m_Cells(cells)
  , m_Points(points)
  , m_Weights(weights)
{
  if (points.empty())
  {
    return;
  }
  const auto isLeft = [](const LatticePoint & a, const LatticePoint & b) { return a.x < b.x; };
  const auto isBefore = [](const LatticePoint & a, const LatticePoint & b) { return a.y < b.y; };
  const auto [lowX, highX] = std::minmax_element(points.begin(), points.end(), isLeft);
  const auto [lowY, highY] = std::minmax_element(points.begin(), points.end(), isBefore);
  // A slab more before the first: what rounds to its whole x may lie below.
  m_LowX = lowX->x - 1.0;
  m_LowY = lowY->y;
  m_Slabs = static_cast<std::size_t>(highX->x - m_LowX) + 1;
  const double length = static_cast<double>(highY->y) - m_LowY;
  const auto   steps = static_cast<std::size_t>(2.0 * length) + 1;
  m_Rows = std::clamp<std::size_t>(count / (4 * m_Slabs), 1, steps);
  m_ScaleY = length > 0.0 ? static_cast<double>(m_Rows) / length : 0.0;
  m_Parts = std::clamp<std::size_t>(m_Rows / 4, 1, 64);
  m_PerSlab = 2 * (m_Rows + m_Parts);
}

// Where an exact centre that rounds to x lies: -1 below, 0 at it, 1 above. x is whole or half.
int
CentreBuckets::SideOf(const CentredCell & entry, double x) const
{
  // As fractions that round to the same number: the other one's denominator is 2.
  if (2.0 * static_cast<double>(entry.denominator) * std::abs(x) < 0x1p51)
  {
    return 0;
  }
  // Four points around a sphere whose centre has this x.
  const auto         below = static_cast<std::int32_t>(std::ceil(x)) - 1;
  const auto         above = static_cast<std::int32_t>(std::floor(x)) + 1;
  const CircumSphere at =
    MakeCircumSphere({ below, 0, 0 }, { above, 0, 0 }, { below, 1, 0 }, { below, 0, 1 }, m_Weights);
  return CompareCentreCoordinates(SphereOf(m_Cells, entry.cell, m_Points, m_Weights), at, 0, m_Weights);
}

std::uint32_t
CentreBuckets::Of(const CentredCell & entry) const
{
  const double x = entry.centre[0];
  // As std::floor, which is a call where it is compiled for all processors.
  const auto   truncated = static_cast<double>(static_cast<std::int64_t>(x));
  const double whole = truncated > x ? truncated - 1.0 : truncated;
  const double half = whole + 0.5;
  if (whole < m_LowX || whole - m_LowX >= static_cast<double>(m_Slabs))
  {
    return static_cast<std::uint32_t>(whole < m_LowX ? 0 : Count() - 1); // no cell of the shape
  }
  const std::size_t slab = m_PerSlab * static_cast<std::size_t>(whole - m_LowX);
  if (x == whole || x == half)
  {
    // Rows hold one x exactly; what lies beside it, by less than a double can tell, belongs beside them.
    const std::size_t rows = slab + (x == half ? m_Rows + m_Parts : 0);
    const int         side = SideOf(entry, x);
    const auto        row = static_cast<std::size_t>(std::max((entry.centre[1] - m_LowY) * m_ScaleY, 0.0));
    return static_cast<std::uint32_t>(side < 0   ? rows - 1
                                      : side > 0 ? rows + m_Rows
                                                 : rows + std::min(row, m_Rows - 1));
  }
  const double      within = 2.0 * (x < half ? x - whole : x - half) * static_cast<double>(m_Parts);
  const std::size_t parts = slab + (x < half ? m_Rows : 2 * m_Rows + m_Parts);
  return static_cast<std::uint32_t>(parts + std::min(static_cast<std::size_t>(within), m_Parts - 1));
}

} // namespace voxelcore
