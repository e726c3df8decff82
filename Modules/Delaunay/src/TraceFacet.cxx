#include "CellTracer.h"

#include "CapScan.h"
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

// The caps that the growing balls of a pencil cut off beyond the plane of its circle.
template <typename TNumber>
class CapMaker
{
public:
  CapMaker(const Pencil<TNumber> & pencil, const SpacingWeights & weights)
    : m_Pencil(pencil)
  {
    const double circle = std::sqrt(pencil.circle2);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Weight[axis] = static_cast<double>(weights.weight[axis]);
      m_Normal[axis] = pencil.along[axis] * m_Weight[axis];
      m_Across[axis] = circle * std::sqrt(std::max(0.0, 1.0 - m_Normal[axis] * m_Normal[axis])) / m_Weight[axis];
      m_Cap.weight[axis] = static_cast<float>(weights.weight[axis]);
      m_Cap.normal[axis] = static_cast<float>(pencil.normal[axis]);
    }
    m_Cap.circle2 = static_cast<float>(pencil.circle2);
  }

  // The cap of the ball at a distance from the circle, and the corner of its box; false where it holds no lattice
  // point. It reaches as far as its ball where the ball's outermost point lies beyond the plane, else as far as the
  // circle.
  bool
  Make(const LatticeWindow & window, double from, double radius, const std::array<double, 3> & centre)
  {
    std::array<std::int32_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double reach = radius / m_Weight[axis];
      const double middle = m_Pencil.middle[axis];
      const double low = from - radius * m_Normal[axis] > 0.0 ? centre[axis] - reach : middle - m_Across[axis];
      const double high = from + radius * m_Normal[axis] > 0.0 ? centre[axis] + reach : middle + m_Across[axis];
      // Truncation rounds towards 0, and all these are positive: less than 1 added first rounds up.
      m_Corner[axis] = static_cast<std::int32_t>(std::clamp(low - margin, 0.0, 63.0) + (1.0 - margin));
      size[axis] = static_cast<std::int32_t>(std::clamp(high + margin, 0.0, 63.0)) - m_Corner[axis] + 1;
      m_Cap.centre[axis] = static_cast<float>(centre[axis] - m_Corner[axis]);
      m_Cap.middle[axis] = static_cast<float>(middle - m_Corner[axis]);
    }
    m_Cap.rows = window.vertex.data() + LatticeWindow::Row(m_Corner[1], m_Corner[2]);
    m_Cap.firstColumn = static_cast<unsigned>(m_Corner[0]);
    m_Cap.rowCount = size[1];
    m_Cap.layerCount = size[2];
    // Coordinates from the corner are off by up to 2e-6 in single precision: grown by more than that, no vertex is
    // missed.
    const double grown = radius + 1e-5 * (m_Weight[0] + m_Weight[1] + m_Weight[2]);
    m_Cap.radius2 = static_cast<float>(grown * grown) * 1.0001F;
    m_Cap.cornerHeight = static_cast<float>(m_Pencil.Height({ m_Corner[0], m_Corner[1], m_Corner[2] }));
    return size[0] > 0 && size[1] > 0 && size[2] > 0;
  }

  const Cap &
  Get() const
  {
    return m_Cap;
  }
  LatticePoint
  At(std::uint16_t place) const
  {
    return { m_Corner[0] + (place & 15), m_Corner[1] + ((place >> 4) & 15), m_Corner[2] + (place >> 8) };
  }

private:
  static constexpr double margin = 1e-3;

  const Pencil<TNumber> &     m_Pencil;
  std::array<double, 3>       m_Weight{};
  std::array<double, 3>       m_Normal{}; // of length 1
  std::array<double, 3>       m_Across{}; // half the width of the circle
  std::array<std::int32_t, 3> m_Corner{};
  Cap                         m_Cap;
};

// The vertices beyond the circle with the least parameter, by exact integers. \returns value and height of the best.
template <typename TNumber>
Best<TNumber>
Decide(const Pencil<TNumber> &     pencil,
       const CapMaker<TNumber> &   caps,
       const CapVertices &         found,
       std::vector<LatticePoint> & apexes)
{
  Best<TNumber> best;
  apexes.clear();
  for (std::size_t i = 0; i < found.count; ++i)
  {
    if (found.low[i] > found.least)
    {
      continue;
    }
    const LatticePoint q = caps.At(found.place[i]);
    const std::int64_t height = pencil.Height(q);
    if (height <= 0)
    {
      continue; // all are, if nothing bounds them
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
  return best;
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

  const bool isFirstLook = pending.from == -std::numeric_limits<double>::infinity();
  if (isFirstLook)
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
    // In a brick still to come the facet will probably have met its other side before anyone looks.
    const std::size_t brick = BrickOf(pencil.middle);
    if (brick != m_Brick && brick >= m_First && brick < m_Last && !m_Done[brick - m_First])
    {
      Defer(brick, pending);
      return;
    }
  }

  if (pencil.circle2 > m_Limit * m_Limit)
  {
    m_Deep.push_back(pending.facet);
    return;
  }
  const double smallest = static_cast<double>(std::min({ weights.weight[0], weights.weight[1], weights.weight[2] }));
  const double furthest = std::sqrt(m_Limit * m_Limit - pencil.circle2);
  double       step = 1.5 * smallest;
  CapMaker     caps(pencil, weights);
  for (double at = pending.from;;)
  {
    if (at >= furthest)
    {
      m_Deep.push_back(pending.facet);
      return;
    }
    // Two looks cost more than one at all that is left, where that is not much.
    const double          next = at + step + 2.0 * smallest < furthest ? at + step : furthest;
    const double          radius = next == furthest ? m_Limit : std::sqrt(pencil.circle2 + next * next);
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
      m_Found.count = 0;
      if (caps.Make(m_Window, next, radius, centre))
      {
        ScanCap(caps.Get(), m_Found);
      }
      const Best<TNumber> best = Decide(pencil, caps, m_Found, m_Apexes);
      const double        found =
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
    const std::uint32_t                               apex = m_Result.tetrahedra.back()[3];
    const std::uint32_t                               a = facet[inwards ? 1 : 0];
    const std::uint32_t                               b = facet[inwards ? 0 : 1];
    const std::uint32_t                               c = facet[2];
    const std::array<std::array<std::uint32_t, 3>, 4> facets{
      { { a, c, b }, { a, b, apex }, { b, c, apex }, { c, a, apex } }
    };
    for (const auto & own : facets)
    {
      AddFacet(cell, own);
    }
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
