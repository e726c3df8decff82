#include "CellTracer.h"

#include "VoxelSides.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{
// Up to 14.9 a ball about a point of the brick fits the window; beyond about 7 voxels looking for a cell costs more
// than DeepTracer takes for it.
constexpr double      largestRadius = 7.0;
constexpr std::size_t facetsAhead = 16; // from the one that is put into the front to one whose place is fetched
constexpr double      unknown = -std::numeric_limits<double>::infinity();
} // namespace

CellTracer::CellTracer(const TracingInput & input, BrickQueue & bricks, bool fromEnd)
  : m_Input(input)
  , m_Bricks(bricks)
  , m_FromEnd(fromEnd)
  , m_First(bricks.First())
  , m_Last(bricks.Last())
  , m_Weights(input.weights)
  , m_Front(input.points.size())
  , m_Pending(m_Last - m_First)
  , m_Done(m_Last - m_First, 0)
{
  // Room for the usual number of cells and facets a vertex, so that arrays need not move: what is not touched costs
  // nothing. Those of the first range take in the others' at the end.
  const std::size_t room = m_First == 0 && !fromEnd ? input.grid.Size() : m_Last - m_First;
  const auto        share = static_cast<std::size_t>(3.0 * static_cast<double>(input.points.size()) *
                                              static_cast<double>(room) / static_cast<double>(input.grid.Size()));
  m_Result.tetrahedra.reserve(share / 2);
  m_Result.facetCells.reserve(share * 3 / 2);
  m_Result.facetOffsets.reserve(share * 3 / 2);
  m_Result.facetPoints.reserve(share * 5);
  const auto & w = input.weights.weight;
  m_Wide = std::max({ w[0], w[1], w[2] }) > 1;
  m_Limit = LargestRadius(input.weights);
}

double
CellTracer::LargestRadius(const SpacingWeights & weights)
{
  return largestRadius * static_cast<double>(*std::min_element(weights.weight.begin(), weights.weight.end()));
}

Tracing
CellTracer::Trace(const ProgressCallback & progress)
{
  for (std::size_t brick = m_Bricks.Take(m_FromEnd); brick != BrickQueue::none; brick = m_Bricks.Take(m_FromEnd))
  {
    const bool seed = m_Input.load[brick] != 0;
    if (seed || !m_Pending[brick - m_First].empty())
    {
      ReportProgress(progress, "delaunay", m_Bricks.ShareTaken());
      ProcessBrick(brick, seed);
    }
    m_Done[brick - m_First] = 1;
  }
  ProcessPending(progress);
  return Finish();
}

Tracing
CellTracer::Continue(Tracing tracing, const ProgressCallback & progress)
{
  m_Result = std::move(tracing.cells);
  m_Deep = std::move(tracing.deep);
  std::fill(m_Done.begin(), m_Done.end(), std::uint8_t{ 1 });
  m_Front.Clear(tracing.open.size() + m_Deep.size() + tracing.unmet.size());
  for (const auto * list : { &tracing.open, &m_Deep, &tracing.unmet })
  {
    const auto keyOf = [&](std::size_t i) { return KeyOf(m_Result.FacetPoints((*list)[i])); };
    for (std::size_t i = 0; i < list->size(); ++i)
    {
      m_Front.FetchFar(keyOf(std::min(i + facetsAhead, list->size() - 1)));
      m_Front.InsertFar(keyOf(i), (*list)[i]);
    }
  }
  for (const std::uint32_t facet : tracing.open)
  {
    const LatticePoint & p = m_Input.points[m_Result.FacetPoints(facet)[0]];
    // A boundary square has no near cell to begin at, but its smallest sphere is empty.
    const double from = m_Result.facetCells[facet][0] == kOpen ? 0.0 : unknown;
    Defer(m_Input.grid.At(p.x, p.y, p.z), { facet, from });
  }
  ProcessPending(progress);
  return Finish();
}

void
CellTracer::ProcessPending(const ProgressCallback & progress)
{
  while (!m_Revisit.empty())
  {
    const std::size_t brick = m_Revisit.back();
    m_Revisit.pop_back();
    if (!m_Pending[brick - m_First].empty())
    {
      ReportProgress(progress, "delaunay", 1.0);
      ProcessBrick(brick, false);
    }
  }
}

Tracing
CellTracer::Finish()
{
  Tracing           tracing;
  std::vector<bool> isDeep(m_Result.FacetCount(), false);
  for (const std::uint32_t facet : m_Deep)
  {
    isDeep[facet] = true;
    if (IsOpen(facet))
    {
      tracing.deep.push_back(facet);
    }
  }
  m_Front.ForEach([&](std::uint32_t facet) {
    if (!isDeep[facet])
    {
      (IsOpen(facet) ? tracing.open : tracing.unmet).push_back(facet);
    }
  });
  tracing.cells = std::move(m_Result);
  return tracing;
}

void
CellTracer::Defer(std::size_t brick, const Pending & pending)
{
  if (brick < m_First || brick >= m_Last)
  {
    return; // stays open for whoever has that brick
  }
  if (m_Done[brick - m_First] && m_Pending[brick - m_First].empty())
  {
    m_Revisit.push_back(brick);
  }
  m_Pending[brick - m_First].push_back(pending);
}

void
CellTracer::ProcessBrick(std::size_t brick, bool seed)
{
  m_Brick = brick;
  m_Front.StartBrick(seed ? m_Input.load[brick] : 0);
  m_Window.Fill(m_Input.shape, m_Input.rows, m_Input.grid.Corner(brick));
  if (seed)
  {
    FindVoxelCells();
    SeedVoxelCells();
    Drain();
  }
  // Facets handed over by other bricks come last: most have met their other side by now.
  while (!m_Pending[brick - m_First].empty())
  {
    m_Stack.swap(m_Pending[brick - m_First]);
    Drain();
  }
}

void
CellTracer::Drain()
{
  while (!m_Stack.empty())
  {
    const Pending pending = m_Stack.back();
    m_Stack.pop_back();
    if (IsOpen(pending.facet))
    {
      m_Wide ? TraceFacet<__int128>(pending) : TraceFacet<std::int64_t>(pending);
    }
    NoteVoxelSide(pending.facet);
  }
}

std::uint32_t
CellTracer::NewFacet(std::uint32_t first, std::uint32_t second, std::span<const std::uint32_t> polygon)
{
  const std::uint32_t facet = NextFacet(polygon.size());
  if (facet < m_Result.FacetCount())
  {
    m_FreeSquares.pop_back();
    m_Result.facetCells[facet] = { first, second };
    std::copy_n(polygon.begin(),
                4,
                m_Result.facetPoints.begin() + static_cast<std::ptrdiff_t>(m_Result.facetOffsets[facet]));
    return facet;
  }
  m_Result.facetCells.push_back({ first, second });
  for (const std::uint32_t point : polygon) // three or four: cheaper than a copy of unknown length
  {
    m_Result.facetPoints.push_back(point);
  }
  m_Result.facetOffsets.push_back(m_Result.facetPoints.size());
  return facet;
}

std::uint32_t
CellTracer::NewCell(const std::array<std::uint32_t, 4> & tetrahedron)
{
  const auto cell = static_cast<std::uint32_t>(m_Result.CellCount());
  m_Result.tetrahedra.push_back(tetrahedron);
  if (m_Input.facets == Facets::Inside)
  {
    m_Result.voxelSides.push_back(0);
  }
  return cell;
}

void
CellTracer::AddVoxelSide(std::uint32_t cell, std::size_t axis, std::span<const std::uint32_t> square)
{
  if (m_Input.facets == Facets::Inside)
  {
    m_Result.voxelSides[cell] |= VoxelSide(axis, m_Input.weights);
    return;
  }
  NewFacet(cell, kOutside, square);
}

void
CellTracer::NoteVoxelSide(std::uint32_t facet)
{
  auto & sides = m_Result.facetCells[facet];
  if (m_Input.facets == Facets::All || sides[1] != kOutside || sides[0] >= kOpen)
  {
    return;
  }
  const auto square = m_Result.FacetPoints(facet);
  m_Result.voxelSides[sides[0]] |=
    VoxelSide(AxisAcross(m_Input.points[square[0]], m_Input.points[square[2]]), m_Input.weights);
  sides[0] = kOutside;
  m_FreeSquares.push_back(facet);
}

void
CellTracer::AddFacet(std::uint32_t cell, std::span<const std::uint32_t> polygon)
{
  const std::uint32_t met = m_Front.TakeOrInsert(KeyOf(polygon), NextFacet(polygon.size()));
  if (met != FacetTable::none)
  {
    Close(met, cell);
    return;
  }
  // A boundary square that is not in the table belongs to a voxel whose brick has not been seeded.
  if (IsBoundarySquare(polygon))
  {
    NewFacet(cell, kOutside, polygon);
    return;
  }
  const std::uint32_t facet = NewFacet(cell, kOpen, polygon);
  m_Stack.push_back({ facet, unknown });
}

bool
CellTracer::IsBoundarySquare(std::span<const std::uint32_t> polygon) const
{
  if (polygon.size() != 4)
  {
    return false;
  }
  const LatticePoint & a = m_Input.points[polygon[0]];
  const LatticePoint & b = m_Input.points[polygon[1]];
  const LatticePoint & c = m_Input.points[polygon[2]];
  const LatticePoint   u{ b.x - a.x, b.y - a.y, b.z - a.z };
  const LatticePoint   v{ c.x - b.x, c.y - b.y, c.z - b.z };
  if (std::abs(u.x) + std::abs(u.y) + std::abs(u.z) != 1 || std::abs(v.x) + std::abs(v.y) + std::abs(v.z) != 1)
  {
    return false;
  }
  // The voxel on the outer side: the square's least corner, one step back where the normal points down.
  const LatticePoint normal{ u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x };
  const LatticePoint least{ std::min(a.x, c.x), std::min(a.y, c.y), std::min(a.z, c.z) };
  return !m_Input.shape.Contains(least.x + std::min(normal.x, 0),
                                 least.y + std::min(normal.y, 0),
                                 least.z + std::min(normal.z, 0));
}

} // namespace voxelcore
