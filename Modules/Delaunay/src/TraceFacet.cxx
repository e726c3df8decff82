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

// The smallest value / height met so far, and whether later candidates tie with it.
template <typename TNumber>
struct Best
{
  TNumber      value = 0;
  std::int64_t height = 0; // 0: none yet
};

// Offers every boundary vertex in the ball (grown by a rounding margin) that lies on the far side of the pencil's
// circle; keeps in `apexes` those with the least parameter.
template <typename TNumber>
void
ScanBall(const LatticeWindow &         window,
         const Pencil<TNumber> &       pencil,
         const SpacingWeights &        weights,
         const std::array<double, 3> & centre,
         double                        radius2,
         Best<TNumber> &               best,
         std::vector<LatticePoint> &   apexes)
{
  const std::array<double, 3> w{ static_cast<double>(weights.weight[0]),
                                 static_cast<double>(weights.weight[1]),
                                 static_cast<double>(weights.weight[2]) };
  const double                grown2 = radius2 * (1.0 + 1e-9);
  const double                inverse2 = 1.0 / (w[0] * w[0]);
  const double                reachZ = std::sqrt(grown2) / w[2];
  const auto                  bound = [](double value) { return std::clamp(value, 0.0, 63.0); };
  const auto                  zFirst = static_cast<std::int32_t>(std::ceil(bound(centre[2] - reachZ)));
  const auto                  zLast = static_cast<std::int32_t>(bound(centre[2] + reachZ));
  for (std::int32_t z = zFirst; z <= zLast; ++z)
  {
    const double dz = w[2] * (z - centre[2]);
    const double left = grown2 - dz * dz;
    if (left < 0.0)
    {
      continue;
    }
    const double reachY = std::sqrt(left) / w[1];
    const auto   yFirst = static_cast<std::int32_t>(std::ceil(bound(centre[1] - reachY)));
    const auto   yLast = static_cast<std::int32_t>(bound(centre[1] + reachY));
    for (std::int32_t y = yFirst; y <= yLast; ++y)
    {
      const std::uint64_t row = window.vertex[LatticeWindow::Row(y, z)];
      if (row == 0)
      {
        continue;
      }
      const double dy = w[1] * (y - centre[1]);
      const double rest = left - dy * dy;
      if (rest < 0.0)
      {
        continue;
      }
      // The row's vertices from the centre outwards, to either side, as long as they lie in the ball.
      const double        rest2 = rest * inverse2;
      const auto          middle = static_cast<std::int32_t>(bound(centre[0]));
      const std::uint64_t upper = row & (~std::uint64_t{ 1 } << middle);
      const std::uint64_t lower = row & ~(~std::uint64_t{ 1 } << middle);
      const auto          offer = [&](std::int32_t x) {
        const double dx = x - centre[0];
        if (dx * dx > rest2)
        {
          return false;
        }
        const LatticePoint q{ x, y, z };
        const std::int64_t height = pencil.Height(q);
        if (height > 0)
        {
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
        return true;
      };
      for (std::uint64_t bits = upper; bits != 0 && offer(std::countr_zero(bits)); bits &= bits - 1)
      {}
      for (std::uint64_t bits = lower; bits != 0 && offer(63 - std::countl_zero(bits));
           bits &= ~(std::uint64_t{ 1 } << (63 - std::countl_zero(bits))))
      {}
    }
  }
}

} // namespace

std::size_t
CellTracer::BrickOf(const std::array<double, 3> & centre) const
{
  // Within one tracer any choice is right as long as a cell is made once. Between two, rounding must not let both (or
  // neither, for ever) claim a centre on the border of their ranges: what is near it is left to the one who joins.
  constexpr double margin = 1e-6;
  std::size_t      brick = 0;
  for (int side = 0; side < 2; ++side)
  {
    const double shift = side == 0 ? -margin : margin;
    const auto   voxel = [&](std::size_t axis, std::int32_t origin) {
      return origin + static_cast<std::int32_t>(std::floor(centre[axis] + shift));
    };
    const std::size_t own =
      m_Input.grid.At(voxel(0, m_Window.origin.x), voxel(1, m_Window.origin.y), voxel(2, m_Window.origin.z));
    if (side == 1 && (own >= m_First && own < m_Last) != (brick >= m_First && brick < m_Last))
    {
      return FacetTable::none;
    }
    brick = own;
  }
  return brick;
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
  double       step = 0.75 * smallest;
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
      ScanBall(m_Window, pencil, weights, centre, radius2, best, m_Apexes);
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
          return; // someone else's cell; none is beyond every range
        }
        if (brick != m_Brick && !m_Done[brick - m_First])
        {
          pending.from = std::max(at, found - 0.5 * smallest);
          Defer(brick, pending);
          return;
        }
        CreateCell(polygon);
        return;
      }
    }
    at = next;
    step *= 2.0;
  }
}

void
CellTracer::CreateCell(std::span<const std::uint32_t> facet)
{
  m_Points.clear();
  for (const std::uint32_t index : facet)
  {
    m_Points.push_back(Local(index));
  }
  m_Points.insert(m_Points.end(), m_Apexes.begin(), m_Apexes.end());
  std::sort(m_Points.begin(), m_Points.end(), [](const LatticePoint & a, const LatticePoint & b) {
    return a.z != b.z ? a.z < b.z : a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  LatticePoint low = m_Points[0];
  LatticePoint high = m_Points[0];
  for (const LatticePoint & p : m_Points)
  {
    low = { std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z) };
    high = { std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z) };
  }
  if (high.x - low.x <= 1 && high.y - low.y <= 1 && high.z - low.z <= 1)
  {
    return; // the cell of a single voxel, which its brick makes from the table
  }
  m_Indices.clear();
  for (const LatticePoint & p : m_Points)
  {
    m_Indices.push_back(m_Window.IndexOf(p.x, p.y, p.z));
  }
  const auto  cell = static_cast<std::uint32_t>(m_Result.CellCount());
  std::size_t fourth = 3;
  while (Orientation(m_Points[0], m_Points[1], m_Points[2], m_Points[fourth]) == 0)
  {
    ++fourth;
  }
  m_Result.tetrahedra.push_back({ m_Indices[0], m_Indices[1], m_Indices[2], m_Indices[fourth] });
  const HullFacets & hull = m_Hulls.Get(m_Points);
  for (std::size_t i = 0; i < hull.Count(); ++i)
  {
    m_Polygon.clear();
    for (const std::uint16_t corner : hull.Polygon(i))
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
