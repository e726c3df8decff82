#include "DeepTracer.h"

#include "PointPredicates.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/SpentMemory.h"

#include <algorithm>
#include <cmath>

namespace voxelcore
{

namespace
{

constexpr double      kStepsPerDoubling = 4.0; // of the queue
constexpr std::size_t kSteps = 84;             // up to 2^20 times the least radius
constexpr double      kFirstLook = 4.0;        // times the radius before it
constexpr std::size_t kWorthRebuilding = 500;  // facets
constexpr std::size_t kWallsAhead = 16;        // from the one that is put into the front to one whose place is fetched

// Out of the region that a facet looks into, and the longer the larger the facet.
GrowingBallTree::Direction
AwayFrom(const std::vector<std::uint32_t> & polygon,
         const std::vector<LatticePoint> &  points,
         const SpacingWeights &             weights)
{
  std::array<std::array<float, 3>, 2> side{};
  for (std::size_t i = 0; i < 2; ++i)
  {
    const LatticePoint & from = points[polygon[0]];
    const LatticePoint & to = points[polygon[i + 1]];
    side[i] = { static_cast<float>((to.x - from.x) * weights.weight[0]),
                static_cast<float>((to.y - from.y) * weights.weight[1]),
                static_cast<float>((to.z - from.z) * weights.weight[2]) };
  }
  GrowingBallTree::Direction away;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    away.to[i] = side[0][k] * side[1][j] - side[0][j] * side[1][k];
  }
  return away;
}

} // namespace

DeepTracer::DeepTracer(const DeepInput & input, std::size_t slab)
  : m_Input(input)
  , m_Slab(slab)
  , m_WallCount(static_cast<std::uint32_t>(input.tracing.deep.size()))
  , m_Small(FitsSmallIntegers(input.points, input.weights))
  , m_BeyondWall(m_WallCount, kOpen)
  , m_Queue(kSteps)
{}

// Counter-clockwise seen from the side where the cell is not known.
void
DeepTracer::CopyPolygon(std::uint32_t facet)
{
  const DelaunayCells & cells = facet < m_WallCount ? m_Input.tracing.cells : m_Cells;
  const std::uint32_t   own = facet < m_WallCount ? m_Input.tracing.deep[facet] : facet - m_WallCount;
  const auto            polygon = cells.FacetPoints(own);
  m_Polygon.clear();
  for (const std::uint32_t p : polygon) // three or four: cheaper than a copy of unknown length
  {
    m_Polygon.push_back(p);
  }
  if (cells.facetCells[own][0] == kOpen)
  {
    std::reverse(m_Polygon.begin(), m_Polygon.end());
  }
}

bool
DeepTracer::TouchesSlab(std::span<const std::uint32_t> polygon) const
{
  return m_Input.slabs.cuts.empty() || std::any_of(polygon.begin(), polygon.end(), [&](std::uint32_t p) {
           return m_Input.slabs.Of(m_Input.points[p]) == m_Slab;
         });
}

Tracing
DeepTracer::Trace(const ProgressCallback & progress)
{
  m_OnWallsOfOthers = MarkedPoints(m_Input.points.size());
  for (std::uint32_t wall = 0; wall < m_WallCount; ++wall)
  {
    const auto polygon = m_Input.tracing.cells.FacetPoints(m_Input.tracing.deep[wall]);
    if (TouchesSlab(polygon))
    {
      m_OwnWalls.push_back(wall);
    }
    else
    {
      m_OnWallsOfOthers.Mark(polygon);
    }
  }
  m_Queue[0] = m_OwnWalls;
  // Room for the usual number, so that arrays need not move: what is not touched costs nothing.
  m_Cells.tetrahedra.reserve(m_OwnWalls.size());
  m_Cells.facetCells.reserve(2 * m_OwnWalls.size());
  m_Cells.facetOffsets.reserve(2 * m_OwnWalls.size());
  m_Cells.facetPoints.reserve(7 * m_OwnWalls.size());
  m_Front.Clear(m_OwnWalls.size());
  const auto keyOf = [&](std::size_t i) {
    return KeyOf(m_Input.tracing.cells.FacetPoints(m_Input.tracing.deep[m_OwnWalls[i]]));
  };
  for (std::size_t i = 0; i < m_OwnWalls.size(); ++i)
  {
    m_Front.Fetch(keyOf(std::min(i + kWallsAhead, m_OwnWalls.size() - 1)));
    m_Front.Insert(keyOf(i), m_OwnWalls[i]);
  }
  const double all = 2.0 * static_cast<double>(m_OwnWalls.size() + 1);
  RebuildTree();
  for (std::size_t count = 0; m_Step < kSteps; ++count)
  {
    if (m_Queue[m_Step].empty())
    {
      m_Queue[m_Step] = {};
      ++m_Step;
      continue;
    }
    if ((count & 0x3FFFU) == 0)
    {
      ReportProgress(progress, "delaunay", std::min(1.0, static_cast<double>(count) / all));
    }
    if (2 * m_Front.Size() < m_FrontThen && m_FrontThen > kWorthRebuilding)
    {
      RebuildTree();
    }
    const std::uint32_t facet = m_Queue[m_Step].back();
    m_Queue[m_Step].pop_back();
    if (IsOpen(facet))
    {
      TraceFacet(facet, m_Input.radius * std::exp2(static_cast<double>(m_Step + 1) / kStepsPerDoubling));
    }
  }
  m_Tree = GrowingBallTree();
  return TakeOwn();
}

// Whatever cell is missing has its points on facets of which one side is missing, so no others need be looked at.
void
DeepTracer::RebuildTree()
{
  m_FrontThen = m_Front.Size();
  m_InTree = m_OnWallsOfOthers;
  VisitFront([&] { m_InTree.Mark(m_Polygon); });
  std::vector<GrowingBallTree::Direction> directions(m_InTree.Count());
  VisitFront([&] {
    const GrowingBallTree::Direction away = AwayFrom(m_Polygon, m_Input.points, m_Input.weights);
    for (const std::uint32_t p : m_Polygon)
    {
      auto & to = directions[m_InTree.NumberOf(p)].to;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        to[axis] += away.to[axis];
      }
    }
  });
  std::vector<std::uint32_t>              chosen;
  std::vector<GrowingBallTree::Direction> outwards;
  chosen.reserve(directions.size());
  outwards.reserve(directions.size());
  m_PlaceInTree.resize(directions.size());
  for (const std::uint32_t p : m_Input.ordered)
  {
    if (m_InTree.IsMarked(p))
    {
      const std::size_t number = m_InTree.NumberOf(p);
      m_PlaceInTree[number] = static_cast<std::uint32_t>(chosen.size());
      chosen.push_back(p);
      outwards.push_back(directions[number]);
    }
  }
  m_Tree.Build(m_Input.points, chosen, outwards, m_Input.weights);
}

// Copies the polygon of each facet of the front and calls visit().
template <typename TVisit>
void
DeepTracer::VisitFront(TVisit visit)
{
  const auto visitOpen = [&](std::uint32_t facet) {
    if (IsOpen(facet))
    {
      CopyPolygon(facet);
      visit();
    }
  };
  std::for_each(m_OwnWalls.begin(), m_OwnWalls.end(), visitOpen);
  const auto end = static_cast<std::uint32_t>(m_WallCount + m_Cells.FacetCount());
  for (std::uint32_t facet = m_WallCount; facet < end; ++facet)
  {
    visitOpen(facet);
  }
}

// Keeps those apexes whose sphere holds no other.
template <typename TNumber>
void
DeepTracer::Decide()
{
  const auto & at = m_Input.points;
  std::size_t  kept = 0;
  for (std::size_t i = 0; i < m_Apexes.size(); ++i)
  {
    const std::uint32_t apex = m_Apexes[i];
    const TNumber       side =
      kept == 0 ? TNumber{ 1 }
                      : InSphere<TNumber>({ at[m_Polygon[0]], at[m_Polygon[1]], at[m_Polygon[2]], at[m_Apexes[0]] },
                                    at[apex],
                                    m_Input.weights);
    kept = side > 0 ? 0 : kept;
    if (side >= 0)
    {
      m_Apexes[kept++] = apex;
    }
  }
  m_Apexes.resize(kept);
}

void
DeepTracer::TraceFacet(std::uint32_t facet, double radius)
{
  CopyPolygon(facet);
  const auto &                 at = m_Input.points;
  const FacetSpheres           spheres(at[m_Polygon[0]], at[m_Polygon[1]], at[m_Polygon[2]], m_Input.weights);
  std::array<std::uint32_t, 3> near{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    near[i] = m_PlaceInTree[m_InTree.NumberOf(m_Polygon[i])];
  }
  m_Front.Fetch(KeyOf(m_Polygon)); // to be taken out when its cell is found
  m_Tree.Find(spheres, kFirstLook * radius, near, m_Apexes);
  if (m_Apexes.empty())
  {
    throw CertificateError("the deep Delaunay cells do not close; please report this input");
  }
  if (m_Apexes.size() > 1)
  {
    m_Small ? Decide<std::int64_t>() : Decide<__int128>();
  }
  const std::uint32_t apex = m_Apexes[0];
  const double        found = std::sqrt(spheres.SquaredRadius(at[apex]));
  const double        steps = std::log2(found / m_Input.radius) * kStepsPerDoubling;
  const std::size_t   step = static_cast<std::size_t>(std::clamp(steps, 0.0, kSteps - 1.0));
  const auto          cell = static_cast<std::uint32_t>(m_Cells.CellCount());
  const std::uint32_t a = m_Polygon[0];
  const std::uint32_t b = m_Polygon[1];
  const std::uint32_t c = m_Polygon[2];
  m_Cells.tetrahedra.push_back({ a, b, c, apex });
  if (!m_Input.slabs.cuts.empty())
  {
    const auto isLesser = [&](std::uint32_t p) { return m_Input.slabs.Of(at[p]) < m_Slab; };
    m_IsOwn.push_back(std::none_of(m_Polygon.begin(), m_Polygon.end(), isLesser) &&
                      std::none_of(m_Apexes.begin(), m_Apexes.end(), isLesser));
  }
  if (m_Polygon.size() == 3 && m_Apexes.size() == 1)
  {
    // The facet runs counter-clockwise seen from its far side, which is within this cell.
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
      AddFacet(cell, own, step);
    }
    return;
  }
  m_Members.assign(m_Polygon.begin(), m_Polygon.end());
  m_Members.insert(m_Members.end(), m_Apexes.begin(), m_Apexes.end());
  std::sort(m_Members.begin(), m_Members.end()); // so by z, y, x
  m_Places.clear();
  LatticePoint low = at[a];
  LatticePoint high = low;
  for (const std::uint32_t p : m_Members)
  {
    m_Places.push_back(at[p]);
    low = { std::min(low.x, at[p].x), std::min(low.y, at[p].y), std::min(low.z, at[p].z) };
    high = { std::max(high.x, at[p].x), std::max(high.y, at[p].y), std::max(high.z, at[p].z) };
  }
  const auto add = [&](const auto & corners) {
    m_Facet.clear();
    for (const auto corner : corners)
    {
      m_Facet.push_back(m_Members[corner]);
    }
    AddFacet(cell, m_Facet, step);
  };
  if (std::max({ high.x - low.x, high.y - low.y, high.z - low.z }) < 64)
  {
    m_Packed.clear();
    for (const LatticePoint & p : m_Places)
    {
      m_Packed.push_back(HullMemo::Pack({ p.x - low.x, p.y - low.y, p.z - low.z }));
    }
    const HullMemo::Polygons polygons = m_Hulls.Get(m_Packed);
    for (std::size_t i = 0; i < polygons.size(); i += polygons[i] + 1U)
    {
      add(polygons.subspan(i + 1, polygons[i]));
    }
    return;
  }
  const HullFacets hull = ComputeHull(m_Places);
  for (std::size_t i = 0; i < hull.Count(); ++i)
  {
    add(hull.Polygon(i));
  }
}

void
DeepTracer::AddFacet(std::uint32_t cell, std::span<const std::uint32_t> polygon, std::size_t step)
{
  const auto          facet = static_cast<std::uint32_t>(m_WallCount + m_Cells.FacetCount());
  const std::uint32_t met = m_Front.TakeOrInsert(KeyOf(polygon), facet);
  if (met != FacetTable::none)
  {
    (met < m_WallCount ? m_BeyondWall[met] : m_Cells.facetCells[met - m_WallCount][1]) = cell;
    return;
  }
  m_Cells.facetCells.push_back({ cell, kOpen });
  for (const std::uint32_t p : polygon)
  {
    m_Cells.facetPoints.push_back(p);
  }
  m_Cells.facetOffsets.push_back(m_Cells.facetPoints.size());
  if (TouchesSlab(polygon))
  {
    m_Queue[step].push_back(facet);
    m_Step = std::min(m_Step, step);
  }
}

// Arrays are thinned out where they are: a copy of them would be the most that is there at a time.
Tracing
DeepTracer::TakeOwn()
{
  Tracing         own;
  DelaunayCells & cells = own.cells;
  cells = std::move(m_Cells);
  if (m_Input.slabs.cuts.empty())
  {
    return own;
  }
  std::vector<std::uint32_t> number(cells.CellCount(), kOpen);
  std::uint32_t              cellCount = 0;
  for (std::size_t cell = 0; cell < number.size(); ++cell)
  {
    if (m_IsOwn[cell] != 0)
    {
      number[cell] = cellCount;
      cells.tetrahedra[cellCount++] = cells.tetrahedra[cell];
    }
  }
  const auto numberOf = [&](std::uint32_t cell) { return cell == kOpen ? kOpen : number[cell]; };
  for (std::uint32_t & cell : m_BeyondWall)
  {
    cell = numberOf(cell);
  }
  std::uint32_t facetCount = 0;
  std::size_t   pointCount = 0;
  std::size_t   begin = 0;
  for (std::size_t facet = 0; facet < cells.facetCells.size(); ++facet)
  {
    const std::uint32_t one = numberOf(cells.facetCells[facet][0]);
    const std::uint32_t other = numberOf(cells.facetCells[facet][1]);
    const std::size_t   end = cells.facetOffsets[facet + 1];
    if (one != kOpen || other != kOpen)
    {
      std::uint32_t * const polygon = cells.facetPoints.data() + pointCount;
      if (pointCount != begin)
      {
        std::copy(cells.facetPoints.data() + begin, cells.facetPoints.data() + end, polygon);
      }
      pointCount += end - begin;
      if (one == kOpen) // seen from the other side
      {
        std::reverse(polygon, cells.facetPoints.data() + pointCount);
      }
      if (one == kOpen || other == kOpen)
      {
        own.deep.push_back(facetCount);
      }
      cells.facetCells[facetCount++] = { one == kOpen ? other : one, one == kOpen ? one : other };
      cells.facetOffsets[facetCount] = pointCount;
    }
    begin = end;
  }
  CutShort(cells.tetrahedra, cellCount);
  CutShort(cells.facetCells, facetCount);
  CutShort(cells.facetOffsets, facetCount + std::size_t{ 1 });
  CutShort(cells.facetPoints, pointCount);
  return own;
}

} // namespace voxelcore
