#include "CellTracer.h"

#include "VoxelCells.h"

#include "voxelcore/CountBits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace voxelcore
{

namespace
{
constexpr std::int32_t halo = LatticeWindow::halo;
constexpr std::int32_t brickWidth = LatticeWindow::brick;
// Up to 14.9 a ball about a point of the brick fits the window; beyond about 7 voxels looking for a cell costs more
// than DeepTracer takes for it.
constexpr double largestRadius = 7.0;
constexpr double unknown = -std::numeric_limits<double>::infinity();
} // namespace

CellTracer::CellTracer(const TracingInput & input, BrickQueue & bricks, bool fromEnd)
  : m_Input(input)
  , m_Bricks(bricks)
  , m_FromEnd(fromEnd)
  , m_First(bricks.First())
  , m_Last(bricks.Last())
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
    for (const std::uint32_t facet : *list)
    {
      m_Front.InsertFar(KeyOf(m_Result.FacetPoints(facet)), facet);
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
  }
}

std::uint8_t
CellTracer::CornerMask(std::int32_t x, std::int32_t y, std::int32_t z) const
{
  const auto pair = [&](std::int32_t row, std::int32_t layer) {
    return static_cast<unsigned>(m_Window.vertex[LatticeWindow::Row(row, layer)] >> x) & 3U;
  };
  return static_cast<std::uint8_t>(pair(y, z) | (pair(y + 1, z) << 2) | (pair(y, z + 1) << 4) |
                                   (pair(y + 1, z + 1) << 6));
}

// Marks the brick's voxels that have a cell of their own and numbers those cells ahead.
void
CellTracer::FindVoxelCells()
{
  const auto & table = VoxelCells();
  auto         next = static_cast<std::uint32_t>(m_Result.CellCount());
  for (std::int32_t z = 0; z < brickWidth; ++z)
  {
    for (std::int32_t y = 0; y < brickWidth; ++y)
    {
      const auto          row = static_cast<std::size_t>(z * brickWidth + y);
      const std::size_t   corner = LatticeWindow::Row(y + halo, z + halo);
      const std::size_t   layer = corner + LatticeWindow::width;
      const std::uint64_t touched =
        m_Window.vertex[corner] | m_Window.vertex[corner + 1] | m_Window.vertex[layer] | m_Window.vertex[layer + 1];
      std::uint32_t candidates =
        static_cast<std::uint32_t>((m_Window.voxel[corner] & (touched | (touched >> 1))) >> halo);
      std::uint32_t found = 0;
      for (; candidates != 0; candidates &= candidates - 1)
      {
        const int x = std::countr_zero(candidates);
        if (table[CornerMask(x + halo, y + halo, z + halo)].spansSpace)
        {
          found |= std::uint32_t{ 1 } << x;
        }
      }
      m_VoxelBits[row] = found;
      m_VoxelFirst[row] = next;
      next += CountBits(found);
    }
  }
}

void
CellTracer::SeedVoxelCells()
{
  constexpr std::array<std::array<std::int32_t, 3>, 6> beyondStep{
    { { -1, 0, 0 }, { 1, 0, 0 }, { 0, -1, 0 }, { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } }
  };
  const auto & table = VoxelCells();
  for (std::int32_t z = halo; z < halo + brickWidth; ++z)
  {
    for (std::int32_t y = halo; y < halo + brickWidth; ++y)
    {
      const auto row = static_cast<std::size_t>((z - halo) * brickWidth + y - halo);
      for (std::uint32_t bits = m_VoxelBits[row]; bits != 0; bits &= bits - 1)
      {
        const std::int32_t           x = halo + std::countr_zero(bits);
        const unsigned               mask = CornerMask(x, y, z);
        const VoxelCell &            shape = table[mask];
        std::array<std::uint32_t, 8> index{};
        for (unsigned c = 0; c < 8; ++c)
        {
          if ((mask >> c) & 1U)
          {
            index[c] = m_Window.IndexOf(x + static_cast<int>(c & 1U),
                                        y + static_cast<int>((c >> 1) & 1U),
                                        z + static_cast<int>(c >> 2));
          }
        }
        const auto   cell = static_cast<std::uint32_t>(m_Result.CellCount());
        const auto & t = shape.tetrahedron;
        m_Result.tetrahedra.push_back({ index[t[0]], index[t[1]], index[t[2]], index[t[3]] });
        for (std::size_t facet = 0; facet < shape.facets.size(); ++facet)
        {
          m_Polygon.clear();
          for (const std::uint8_t corner : shape.facets[facet])
          {
            m_Polygon.push_back(index[corner]);
          }
          const std::uint8_t side = shape.sides[facet];
          if (side == 6)
          {
            AddFacet(cell, m_Polygon);
            continue;
          }
          const std::int32_t bx = x + beyondStep[side][0];
          const std::int32_t by = y + beyondStep[side][1];
          const std::int32_t bz = z + beyondStep[side][2];
          if (((m_Window.voxel[LatticeWindow::Row(by, bz)] >> bx) & 1U) == 0)
          {
            NewFacet(cell, kOutside, m_Polygon);
            continue;
          }
          const std::int32_t rx = bx - halo;
          const std::int32_t ry = by - halo;
          const std::int32_t rz = bz - halo;
          const auto         inBrick = [](std::int32_t r) { return r >= 0 && r < brickWidth; };
          if (inBrick(rx) && inBrick(ry) && inBrick(rz))
          {
            const auto beyondRow = static_cast<std::size_t>(rz * brickWidth + ry);
            if ((m_VoxelBits[beyondRow] >> rx) & 1U)
            {
              // Both voxels have a cell: they share this facet, and the first of the two makes it.
              if (side % 2 == 1)
              {
                const std::uint32_t below = (std::uint32_t{ 1 } << rx) - 1;
                NewFacet(cell,
                         m_VoxelFirst[beyondRow] +
                           static_cast<std::uint32_t>(CountBits(m_VoxelBits[beyondRow] & below)),
                         m_Polygon);
              }
              continue;
            }
          }
          AddFacet(cell, m_Polygon);
        }
      }
      // Inside voxels that meet the boundary in one square only: their square starts a trace.
      for (std::uint32_t rest =
             static_cast<std::uint32_t>(m_Window.voxel[LatticeWindow::Row(y, z)] >> halo) & ~m_VoxelBits[row];
           rest != 0;
           rest &= rest - 1)
      {
        const std::int32_t x = halo + std::countr_zero(rest);
        const unsigned     mask = CornerMask(x, y, z);
        if (CountBits(mask) == 4)
        {
          SeedSquare(x, y, z, mask);
        }
      }
    }
  }
}

void
CellTracer::SeedSquare(std::int32_t x, std::int32_t y, std::int32_t z, unsigned mask)
{
  const auto side = static_cast<std::size_t>(
    std::find(voxelSideMasks.begin(), voxelSideMasks.end(), static_cast<std::uint8_t>(mask)) - voxelSideMasks.begin());
  if (side == voxelSideMasks.size())
  {
    return;
  }
  const std::array<std::int32_t, 3> step{ side / 2 == 0 ? 1 : 0, side / 2 == 1 ? 1 : 0, side / 2 == 2 ? 1 : 0 };
  const std::int32_t                sign = side % 2 == 0 ? -1 : 1;
  const std::size_t                 beyond = LatticeWindow::Row(y + sign * step[1], z + sign * step[2]);
  if ((m_Window.voxel[beyond] >> (x + sign * step[0])) & 1U)
  {
    return; // not on the boundary: the voxel beyond is in
  }
  // The whole voxel's cell lists its sides counter-clockwise from outside.
  const VoxelCell & cube = VoxelCells()[255];
  m_Polygon.clear();
  for (std::size_t facet = 0; facet < cube.facets.size(); ++facet)
  {
    if (cube.sides[facet] == side)
    {
      for (const std::uint8_t c : cube.facets[facet])
      {
        m_Polygon.push_back(m_Window.IndexOf(x + (c & 1), y + ((c >> 1) & 1), z + (c >> 2)));
      }
    }
  }
  if (m_Front.TakeOrInsert(KeyOf(m_Polygon), NextFacet()) != FacetTable::none)
  {
    return; // a cell found earlier has this square, and knows that it is on the boundary
  }
  const std::uint32_t facet = NewFacet(kOpen, kOutside, m_Polygon);
  m_Stack.push_back({ facet, 0.0 }); // the square's smallest sphere is empty
}

std::uint32_t
CellTracer::NewFacet(std::uint32_t first, std::uint32_t second, std::span<const std::uint32_t> polygon)
{
  const std::uint32_t facet = NextFacet();
  m_Result.facetCells.push_back({ first, second });
  for (const std::uint32_t point : polygon) // three or four: cheaper than a copy of unknown length
  {
    m_Result.facetPoints.push_back(point);
  }
  m_Result.facetOffsets.push_back(m_Result.facetPoints.size());
  return facet;
}

void
CellTracer::AddFacet(std::uint32_t cell, std::span<const std::uint32_t> polygon)
{
  const std::uint32_t met = m_Front.TakeOrInsert(KeyOf(polygon), NextFacet());
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
