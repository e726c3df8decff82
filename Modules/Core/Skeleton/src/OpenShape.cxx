#include "voxelcore/Skeleton/OpenShape.h"

#include "voxelcore/Base/ParallelTasks.h"
#include "voxelcore/Lattice/Vectors.h"
#include "voxelcore/Shape/ShapeBits.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore
{

namespace
{

// Where a way leaves the shape is found to 2^-20 of its length, a millionth of the voxel that points move by at most.
constexpr int kHalvings = 20;

// Of the voxels' sides; spacings are approximated by whole numbers where radii are computed.
constexpr double kSlack = 1e-5;

/** Whole numbers from the nearest to `place` outwards, while visit(n) is true. */
template <typename TVisit>
void
Outward(double place, const TVisit & visit)
{
  auto below = static_cast<std::int32_t>(std::floor(place));
  auto above = below + 1;
  while (visit(place - below <= above - place ? below-- : above++))
  {}
}

/** A row of lattice corners, in indices of the scan. */
class CornerRow
{
public:
  CornerRow(const VoxelShape & shape, std::int32_t y, std::int32_t z)
    : m_First(shape.Box().lower[0])
    , m_Size(shape.Box().size[0])
  {
    const std::int32_t ownY = y - shape.Box().lower[1];
    const std::int32_t ownZ = z - shape.Box().lower[2];
    m_Rows = { shape.RowAnywhere(ownY - 1, ownZ - 1),
               shape.RowAnywhere(ownY, ownZ - 1),
               shape.RowAnywhere(ownY - 1, ownZ),
               shape.RowAnywhere(ownY, ownZ) };
  }

  /** The first boundary vertex from `from` to `to`. */
  std::optional<std::int32_t>
  FirstMixed(std::int32_t from, std::int32_t to) const
  {
    const std::int32_t last = std::min(to - m_First, m_Size);
    for (std::int32_t x = std::max(from - m_First, 0); x <= last; x = (x | 63) + 1)
    {
      if (const std::uint64_t bits = MixedCorners(m_Rows, static_cast<std::size_t>(x) / 64) >> (x % 64); bits != 0)
      {
        x += std::countr_zero(bits);
        return x <= last ? std::optional(m_First + x) : std::nullopt;
      }
    }
    return std::nullopt;
  }

  /** The first from `from` down to `to`. */
  std::optional<std::int32_t>
  LastMixed(std::int32_t from, std::int32_t to) const
  {
    const std::int32_t last = std::max(to - m_First, 0);
    for (std::int32_t x = std::min(from - m_First, m_Size); x >= last; x = (x & ~63) - 1)
    {
      if (const std::uint64_t bits = MixedCorners(m_Rows, static_cast<std::size_t>(x) / 64) << (63 - x % 64); bits != 0)
      {
        x -= std::countl_zero(bits);
        return x >= last ? std::optional(m_First + x) : std::nullopt;
      }
    }
    return std::nullopt;
  }

private:
  std::array<ConstShapeRow, 4> m_Rows;
  std::int32_t                 m_First;
  std::int32_t                 m_Size;
};

} // namespace

bool
OpenShape::Holds(const Vector3 & place) const
{
  return ContainsInside(*m_Shape, PhysicalToLattice(*m_Geometry, place));
}

bool
OpenShape::HoldsSegment(const Vector3 & a, const Vector3 & b) const
{
  const Vector3 from = PhysicalToLattice(*m_Geometry, a);
  const Vector3 way = Minus(PhysicalToLattice(*m_Geometry, b), from);
  // Between the planes of the grid it crosses, a segment lies in one voxel, or between the same ones.
  std::vector<double> cuts{ 0, 1 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = std::min(from[axis], from[axis] + way[axis]);
    const double high = std::max(from[axis], from[axis] + way[axis]);
    // NOLINTNEXTLINE(clang-analyzer-security.FloatLoopCounter,cert-flp30-c): whole numbers
    for (double plane = std::ceil(low); plane <= high; plane += 1)
    {
      if (way[axis] != 0)
      {
        cuts.push_back(std::clamp((plane - from[axis]) / way[axis], 0.0, 1.0));
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i < cuts.size(); ++i)
  {
    const bool holds = ContainsInside(*m_Shape, AddScaled(from, cuts[i], way)) &&
                       (i == 0 || ContainsInside(*m_Shape, AddScaled(from, 0.5 * (cuts[i - 1] + cuts[i]), way)));
    if (!holds)
    {
      return false;
    }
  }
  return true;
}

Vector3
OpenShape::Towards(const Vector3 & from, const Vector3 & to) const
{
  if (Holds(to))
  {
    return to;
  }
  double in = 0;
  double out = 1;
  for (int halving = 0; halving < kHalvings; ++halving)
  {
    const double middle = 0.5 * (in + out);
    (Holds(AddScaled(from, middle, Minus(to, from))) ? in : out) = middle;
  }
  return in > 0 ? AddScaled(from, in, Minus(to, from)) : from;
}

double
OpenShape::DistanceToBoundary(const Vector3 & place, double least, double most) const
{
  // First where it is near: a search takes as long as the cube of how far it looks.
  for (double reach = std::max(2 * least, 2 * VoxelDiagonal()); reach < most; reach *= 2)
  {
    if (const double found = DistanceWithin(place, least, reach); found < reach)
    {
      return found;
    }
  }
  return DistanceWithin(place, least, most);
}

double
OpenShape::DistanceWithin(const Vector3 & place, double least, double most) const
{
  const Vector3   at = PhysicalToLattice(*m_Geometry, place);
  const Vector3 & spacing = m_Geometry->spacing;
  const double    slack = kSlack * *std::max_element(spacing.begin(), spacing.end());
  const double    least2 = std::max(0.0, least - slack) * std::max(0.0, least - slack);
  double          nearest2 = (most + slack) * (most + slack);
  const auto      first = [&](std::size_t axis, double reach) {
    return static_cast<std::int32_t>(std::ceil(at[axis] - reach / spacing[axis]));
  };
  const auto last = [&](std::size_t axis, double reach) {
    return static_cast<std::int32_t>(std::floor(at[axis] + reach / spacing[axis]));
  };
  const auto squared = [&](std::size_t axis, std::int32_t corner) {
    const double way = (corner - at[axis]) * spacing[axis];
    return way * way;
  };
  bool isFound = false;
  // Rows near the place come first: what is found there leaves few of the others to look at.
  Outward(at[2], [&](std::int32_t z) {
    const double layer2 = squared(2, z);
    Outward(at[1], [&](std::int32_t y) {
      const double row2 = layer2 + squared(1, y);
      if (row2 > nearest2)
      {
        return false;
      }
      // No boundary vertex lies in the ball of the least distance.
      const double    inner = std::sqrt(std::max(0.0, least2 - row2));
      const double    outer = std::sqrt(nearest2 - row2);
      const auto      middle = static_cast<std::int32_t>(std::floor(at[0]));
      const CornerRow corners(*m_Shape, y, z);
      const auto      look = [&](std::optional<std::int32_t> x) {
        if (x && row2 + squared(0, *x) <= nearest2)
        {
          nearest2 = row2 + squared(0, *x);
          isFound = true;
        }
      };
      look(corners.LastMixed(inner > 0 ? first(0, inner) - 1 : middle, first(0, outer)));
      look(corners.FirstMixed(inner > 0 ? last(0, inner) + 1 : middle + 1, last(0, outer)));
      return true;
    });
    return layer2 <= nearest2;
  });
  return isFound ? std::clamp(std::sqrt(nearest2), least, most) : most;
}

void
MeasureBallsAnew(SkeletonGraph & graph, const std::vector<Vector3> & before, double ends, const OpenShape & shape)
{
  const std::vector<std::uint8_t> isEnd = TipFlags(graph);
  RunEach(graph.positions.size(), [&](std::size_t point) {
    const double moved = Distance(graph.positions[point], before[point]) + (isEnd[point] != 0 ? ends : 0);
    if (moved > 0)
    {
      double & radius = graph.radius[point];
      radius = shape.DistanceToBoundary(graph.positions[point], std::max(0.0, radius - moved), radius + moved);
    }
  });
}

} // namespace voxelcore
