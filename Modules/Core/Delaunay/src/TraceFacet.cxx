#include "CellTracer.h"

#include "CapScan.h"

#include "voxelcore/Lattice/Predicates.h"

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
  CapMaker(const Pencil<TNumber> & pencil, const MetricWeights & weights)
    : m_Pencil(pencil)
    , m_Weights(weights)
  {
    const double circle = std::sqrt(pencil.circle2);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      m_Normal[axis] = pencil.along[axis] * weights.single[axis];
      m_Across[axis] = circle * std::sqrt(std::max(0.0, 1.0 - m_Normal[axis] * m_Normal[axis])) * weights.inverse[axis];
      m_Cap.weight[axis] = static_cast<float>(weights.single[axis]);
      m_Cap.normal[axis] = static_cast<float>(pencil.normal[axis]);
    }
    // Of a plane along the lattice, what lies in it need not be looked at.
    const std::array<double, 3> place{ static_cast<double>(pencil.a.x),
                                       static_cast<double>(pencil.a.y),
                                       static_cast<double>(pencil.a.z) };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (pencil.normal[(axis + 1) % 3] == 0 && pencil.normal[(axis + 2) % 3] == 0)
      {
        (pencil.normal[axis] > 0 ? m_From : m_To)[axis] = place[axis] + (pencil.normal[axis] > 0 ? 1.0 : -1.0);
      }
    }
    m_Cap.circle2 = static_cast<float>(pencil.circle2);
    m_Blur = 1e-5 * (weights.single[0] + weights.single[1] + weights.single[2]);
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
      const double reach = radius * m_Weights.inverse[axis];
      const double middle = m_Pencil.middle[axis];
      const double reachesFrom = from - radius * m_Normal[axis] > 0.0 ? centre[axis] - reach : middle - m_Across[axis];
      const double reachesTo = from + radius * m_Normal[axis] > 0.0 ? centre[axis] + reach : middle + m_Across[axis];
      const double low = std::max(reachesFrom, m_From[axis]);
      const double high = std::min(reachesTo, m_To[axis]);
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
    const double grown = radius + m_Blur;
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
  const MetricWeights &       m_Weights;
  double                      m_Blur = 0;
  std::array<double, 3>       m_Normal{}; // of length 1
  std::array<double, 3>       m_Across{}; // half the width of the circle
  std::array<double, 3>       m_From{ 0.0, 0.0, 0.0 };
  std::array<double, 3>       m_To{ 63.0, 63.0, 63.0 };
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
    const LatticePoint q = caps.At(found.place[i]);
    const std::int64_t height = pencil.Height(q);
    const TNumber      value = pencil.Value(q);
    const TNumber      difference = best.height == 0 ? TNumber{ -1 } : value * best.height - best.value * height;
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
  constexpr double begin = LatticeWindow::halo + margin;
  constexpr double end = LatticeWindow::halo + LatticeWindow::brick - margin;
  if (std::min({ centre[0], centre[1], centre[2] }) >= begin && std::max({ centre[0], centre[1], centre[2] }) < end)
  {
    return m_Brick; // most are
  }
  const auto shifted = [&](double shift) {
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
                               m_Weights);

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
  m_Front.Fetch(KeyOf(polygon)); // to be taken out when its cell is found
  const double smallest = m_Weights.least;
  const double furthest = std::sqrt(m_Limit * m_Limit - pencil.circle2);
  double       step = 1.5 * smallest;
  CapMaker     caps(pencil, m_Weights);
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
      const double reach = radius * m_Weights.inverse[axis];
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
  const auto          indexOf = [&](const LatticePoint & p) { return m_Window.IndexOf(p.x, p.y, p.z); };
  const std::uint32_t cell = NewCell({ facet[0], facet[1], facet[2], indexOf(m_Apexes[0]) });
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
    // Whether a facet is met nobody can foretell: all places are on their way before the first is asked.
    for (std::size_t i = 1; i < facets.size(); ++i)
    {
      m_Front.Fetch(KeyOf(facets[i]));
    }
    for (const auto & own : facets)
    {
      AddFacet(cell, own);
    }
    return;
  }
  m_Members.clear();
  const auto insert = [&](const LatticePoint & p, std::uint32_t index) {
    // Few, and nearly in order.
    const std::uint64_t member = std::uint64_t{ HullMemo::Pack(p) } << 32 | index;
    m_Members.push_back(member);
    std::size_t at = m_Members.size() - 1;
    for (; at > 0 && m_Members[at - 1] > member; --at)
    {
      m_Members[at] = m_Members[at - 1];
    }
    m_Members[at] = member;
  };
  for (const LatticePoint & p : m_Apexes)
  {
    insert(p, indexOf(p));
  }
  for (const std::uint32_t index : facet)
  {
    insert(Local(index), index);
  }
  m_Packed.clear();
  for (const std::uint64_t member : m_Members)
  {
    m_Packed.push_back(static_cast<std::uint32_t>(member >> 32));
  }
  const HullMemo::Polygons polygons = m_Hulls.Get(m_Packed);
  for (std::size_t at = 0; at < polygons.size(); at += polygons[at] + 1U)
  {
    m_Polygon.clear();
    for (const std::uint16_t corner : polygons.subspan(at + 1, polygons[at]))
    {
      m_Polygon.push_back(static_cast<std::uint32_t>(m_Members[corner]));
    }
    AddFacet(cell, m_Polygon);
  }
}

template void
CellTracer::TraceFacet<std::int64_t>(Pending pending);
template void
CellTracer::TraceFacet<__int128>(Pending pending);

} // namespace voxelcore
