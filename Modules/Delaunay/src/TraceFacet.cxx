#include "CellTracer.h"

#include "Pencil.h"

#include "voxelcore/Predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{

// What single precision may be off by in window coordinates (0 to 63), with room to spare.
constexpr float scanMargin = 1e-3F;

// The smallest value / height met so far, and whether later candidates tie with it.
template <typename TNumber>
struct Best
{
  TNumber      value = 0;
  std::int64_t height = 0; // 0: none yet
};

// What a scan has to visit: the part of a ball beyond the plane of the pencil's circle, as a box in window coordinates.
struct CapBox
{
  std::array<float, 3> low{};
  std::array<float, 3> high{};
};

// The cap reaches as far as its ball where the ball's outermost point lies beyond the plane, else as far as the circle.
template <typename TNumber>
CapBox
BoundCap(const Pencil<TNumber> & pencil, const SpacingWeights & weights, double from, double radius)
{
  CapBox       box;
  const double circle = std::sqrt(pencil.circle2);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto   w = static_cast<double>(weights.weight[axis]);
    const double normal = pencil.along[axis] * w;
    const double across = circle * std::sqrt(std::max(0.0, 1.0 - normal * normal)) / w;
    const double centre = pencil.middle[axis] + from * pencil.along[axis];
    const double low = from - radius * normal > 0.0 ? centre - radius / w : pencil.middle[axis] - across;
    const double high = from + radius * normal > 0.0 ? centre + radius / w : pencil.middle[axis] + across;
    box.low[axis] = static_cast<float>(std::clamp(low - scanMargin, 0.0, 63.0));
    box.high[axis] = static_cast<float>(std::clamp(high + scanMargin, 0.0, 63.0));
  }
  return box;
}

// Offers every boundary vertex in the ball (and a few at its rim) that lies on the far side of the pencil's circle; keeps
// in `apexes` those with the least parameter. Single precision finds them, exact integers decide.
template <typename TNumber>
void
ScanBall(const LatticeWindow &         window,
         const Pencil<TNumber> &       pencil,
         const SpacingWeights &        weights,
         const std::array<double, 3> & centre,
         const CapBox &                box,
         double                        radius2,
         Best<TNumber> &               best,
         std::vector<LatticePoint> &   apexes)
{
  const std::array<float, 3> w{ static_cast<float>(weights.weight[0]),
                                static_cast<float>(weights.weight[1]),
                                static_cast<float>(weights.weight[2]) };
  const auto                 cx = static_cast<float>(centre[0]);
  const auto                 cy = static_cast<float>(centre[1]);
  const auto                 cz = static_cast<float>(centre[2]);
  // Window coordinates are off by up to 4e-6 in single precision: grown by more than that, no vertex is missed.
  const double grown = std::sqrt(radius2) + 1e-5 * static_cast<double>(w[0] + w[1] + w[2]);
  const float  grown2 = static_cast<float>(grown * grown) * 1.0001F;
  // Truncation rounds towards 0, and all these are positive: less than 1 added first rounds up.
  constexpr float     up = 1.0F - scanMargin;
  const auto          zFirst = static_cast<std::int32_t>(box.low[2] + up);
  const auto          zLast = static_cast<std::int32_t>(box.high[2]);
  const auto          xFirst = static_cast<std::int32_t>(box.low[0] + up);
  const auto          xLast = static_cast<std::int32_t>(box.high[0]);
  const std::uint64_t columns = (~std::uint64_t{ 0 } << xFirst) & (~std::uint64_t{ 0 } >> (63 - xLast));
  for (std::int32_t z = zFirst; z <= zLast; ++z)
  {
    const float dz = w[2] * (static_cast<float>(z) - cz);
    const float left = grown2 - dz * dz;
    if (left < 0.0F)
    {
      continue;
    }
    const float           reachY = std::sqrt(left) / w[1];
    const auto            yFirst = static_cast<std::int32_t>(std::max(cy - reachY, box.low[1]) + up);
    const auto            yLast = static_cast<std::int32_t>(std::min(cy + reachY, box.high[1]));
    const std::uint64_t * rows = window.vertex.data() + LatticeWindow::Row(0, z);
    for (std::int32_t y = yFirst; y <= yLast; ++y)
    {
      // The ball is empty but for its rim, so most rows end here.
      std::uint64_t bits = rows[y] & columns;
      if (bits == 0)
      {
        continue;
      }
      const float dy = w[1] * (static_cast<float>(y) - cy);
      const float rest = left - dy * dy;
      for (; bits != 0; bits &= bits - 1)
      {
        const std::int32_t x = std::countr_zero(bits);
        const float        dx = w[0] * (static_cast<float>(x) - cx);
        if (dx * dx > rest)
        {
          continue;
        }
        const LatticePoint q{ x, y, z };
        const std::int64_t height = pencil.Height(q);
        if (height <= 0)
        {
          continue;
        }
        const TNumber value = pencil.Value(q);
        const TNumber difference = best.height == 0 ? TNumber{ -1 } : value * best.height - best.value * height;
        if (difference < 0)
        {
          best = { value, height };
          apexes.clear();
        }
        if (difference <= 0)
        {
          apexes.push_back(q);
        }
      }
    }
  }
}

} // namespace

std::size_t
CellTracer::BrickOf(const std::array<double, 3> & centre) const
{
  // Within one tracer any choice is right as long as a cell is made once. Between two, rounding must not let both claim
  // a centre on the border of their bricks: what is near one that is not yet this tracer's waits for it, or for the one
  // who joins. Bricks of a tracer follow each other, so that the first and the last tell for all between.
  constexpr double margin = 1e-6;
  const auto       shifted = [&](double shift) {
    const auto voxel = [&](std::size_t axis, std::int32_t origin) {
      return origin + static_cast<std::int32_t>(std::floor(centre[axis] + shift));
    };
    return m_Input.grid.At(voxel(0, m_Window.origin.x), voxel(1, m_Window.origin.y), voxel(2, m_Window.origin.z));
  };
  const auto isOwn = [&](std::size_t brick) {
    return brick == m_Brick || (brick >= m_First && brick < m_Last && m_Done[brick - m_First]);
  };
  const std::size_t low = shifted(-margin);
  const std::size_t high = shifted(margin);
  return isOwn(high) ? low : high;
}

template <typename TNumber>
void
CellTracer::TraceFacet(Pending pending)
{
  const auto polygon = m_Result.FacetPoints(pending.facet);
  // The polygon runs counter-clockwise seen from outside its first cell; look to that side, or inwards from a square.
  const std::uint32_t   near = m_Result.facetCells[pending.facet][0];
  const bool            inwards = near == kOpen;
  const Pencil<TNumber> pencil(Local(polygon[inwards ? 2 : 0]),
                               Local(polygon[1]),
                               Local(polygon[inwards ? 0 : 2]),
                               m_Input.weights);
  const auto &          weights = m_Input.weights;

  if (pending.from == -std::numeric_limits<double>::infinity())
  {
    // The near cell's own sphere is where the search begins: any of its points behind the facet gives it.
    for (const std::uint32_t corner : m_Result.tetrahedra[near])
    {
      const LatticePoint q = Local(corner);
      const std::int64_t height = pencil.Height(q);
      if (height != 0)
      {
        pending.from = pencil.scale * static_cast<double>(pencil.Value(q)) / static_cast<double>(height);
        break;
      }
    }
  }

  const double smallest = static_cast<double>(std::min({ weights.weight[0], weights.weight[1], weights.weight[2] }));
  const double furthest = std::sqrt(std::max(0.0, m_Limit * m_Limit - pencil.circle2));
  double       step = 1.25 * smallest;
  for (double at = pending.from;;)
  {
    if (at >= furthest)
    {
      m_Deep.push_back(pending.facet);
      return;
    }
    const double          next = std::min(at + step, furthest);
    const double          radius2 = pencil.circle2 + next * next;
    const double          radius = std::sqrt(radius2);
    std::array<double, 3> centre{};
    bool                  fits = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      centre[axis] = pencil.middle[axis] + next * pencil.along[axis];
      const double reach = radius / static_cast<double>(weights.weight[axis]);
      fits = fits && centre[axis] - reach >= 0.0 && centre[axis] + reach <= 63.0;
    }
    if (!fits && radius <= m_Limit)
    {
      const std::size_t brick = BrickOf(centre);
      if (brick == m_Brick)
      {
        // The step led out of the box of the shape, while the centre of the empty ball it started from lies in it.
        step *= 0.5;
        continue;
      }
      pending.from = at;
      Defer(brick, pending);
      return;
    }
    if (radius <= m_Limit)
    {
      Best<TNumber> best;
      m_Apexes.clear();
      ScanBall(m_Window, pencil, weights, centre, BoundCap(pencil, weights, next, radius), radius2, best, m_Apexes);
      const double found =
        best.height == 0 ? HUGE_VAL : pencil.scale * static_cast<double>(best.value) / static_cast<double>(best.height);
      // A candidate at the rim of the ball may have peers beyond it: look further before believing it.
      if (found < next - 1e-6 * smallest)
      {
        std::array<double, 3> middle{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          middle[axis] = pencil.middle[axis] + found * pencil.along[axis];
        }
        const std::size_t brick = BrickOf(middle);
        if (brick < m_First || brick >= m_Last)
        {
          return; // someone else's cell
        }
        if (brick != m_Brick && !m_Done[brick - m_First])
        {
          pending.from = std::max(at, found - 0.5 * smallest);
          Defer(brick, pending);
          return;
        }
        CreateCell(polygon, inwards);
        return;
      }
    }
    at = next;
    step *= 2.0;
  }
}

void
CellTracer::CreateCell(std::span<const std::uint32_t> facet, bool inwards)
{
  LatticePoint low = m_Apexes[0];
  LatticePoint high = low;
  const auto   include = [&](const LatticePoint & p) {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  };
  for (const LatticePoint & p : m_Apexes)
  {
    include(p);
  }
  for (const std::uint32_t index : facet)
  {
    include(Local(index));
  }
  if (high.x - low.x <= 1 && high.y - low.y <= 1 && high.z - low.z <= 1)
  {
    return; // the cell of a single voxel, which its brick makes from the table
  }
  const auto cell = static_cast<std::uint32_t>(m_Result.CellCount());
  const auto indexOf = [&](const LatticePoint & p) { return m_Window.IndexOf(p.x, p.y, p.z); };
  m_Result.tetrahedra.push_back({ facet[0], facet[1], facet[2], indexOf(m_Apexes[0]) });
  if (facet.size() == 3 && m_Apexes.size() == 1)
  {
    // A tetrahedron: seen from outside it, the facet runs the other way.
    const std::uint32_t apex = m_Result.tetrahedra.back()[3];
    const std::uint32_t a = facet[inwards ? 1 : 0];
    const std::uint32_t b = facet[inwards ? 0 : 1];
    const std::uint32_t c = facet[2];
    AddFacet(cell, std::array{ a, c, b });
    AddFacet(cell, std::array{ a, b, apex });
    AddFacet(cell, std::array{ b, c, apex });
    AddFacet(cell, std::array{ c, a, apex });
    return;
  }
  m_Points.assign(m_Apexes.begin(), m_Apexes.end());
  for (const std::uint32_t index : facet)
  {
    m_Points.push_back(Local(index));
  }
  std::sort(m_Points.begin(), m_Points.end(), [](const LatticePoint & a, const LatticePoint & b) {
    return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  m_Indices.clear();
  for (const LatticePoint & p : m_Points)
  {
    m_Indices.push_back(indexOf(p));
  }
  const HullMemo::Polygons polygons = m_Hulls.Get(m_Points);
  for (std::size_t at = 0; at < polygons.size(); at += polygons[at] + 1U)
  {
    m_Polygon.clear();
    for (const std::uint16_t corner : polygons.subspan(at + 1, polygons[at]))
    {
      m_Polygon.push_back(m_Indices[corner]);
    }
    AddFacet(cell, m_Polygon);
  }
}

template void
CellTracer::TraceFacet<std::int64_t>(Pending pending);
template void
CellTracer::TraceFacet<__int128>(Pending pending);

} // namespace voxelcore
