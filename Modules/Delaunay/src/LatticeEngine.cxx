#include "LatticeEngine.h"

#include "CellTracer.h"
#include "DeepCells.h"


#include <omp.h>


#include <algorithm>
#include <atomic>
#include <exception>

namespace voxelcore
{

namespace
{

// Removes facets that were joined to others (open on both sides).
void
DropJoined(DelaunayCells & cells)
{
  std::size_t   kept = 0;
  std::uint64_t end = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    const auto polygon = cells.FacetPoints(facet);
    if (cells.facetCells[facet][0] == kOpen && cells.facetCells[facet][1] == kOpen)
    {
      continue;
    }
    std::copy(polygon.begin(), polygon.end(), cells.facetPoints.begin() + static_cast<std::ptrdiff_t>(end));
    end += polygon.size();
    cells.facetCells[kept] = cells.facetCells[facet];
    cells.facetOffsets[++kept] = end;
  }
  cells.facetCells.resize(kept);
  cells.facetOffsets.resize(kept + 1);
  cells.facetPoints.resize(end);
}

// Ranges of bricks with about the same number of points each: range i is cuts[i] to cuts[i + 1] - 1.
std::vector<std::size_t>
CutEvenly(const std::vector<std::uint32_t> & load, std::size_t ranges)
{
  std::uint64_t total = 0;
  for (const std::uint32_t points : load)
  {
    total += points;
  }
  std::vector<std::size_t> cuts{ 0 };
  std::uint64_t            sum = 0;
  for (std::size_t brick = 0; brick < load.size() && cuts.size() < ranges; ++brick)
  {
    sum += load[brick];
    if (sum * ranges >= total * cuts.size())
    {
      cuts.push_back(brick + 1);
    }
  }
  cuts.resize(ranges + 1, load.size());
  return cuts;
}

} // namespace

std::vector<std::uint32_t>
BrickLoad(const BrickGrid & grid, const std::vector<LatticePoint> & points)
{
  std::vector<std::uint32_t> load(grid.Size(), 0);
  for (const LatticePoint & p : points)
  {
    const std::size_t own = grid.At(p.x, p.y, p.z);
    ++load[own];
    // On a lower side of its brick a point belongs to the neighbours there as well.
    const bool sides[3] = { (p.x - grid.lower.x) % LatticeWindow::brick == 0,
                            (p.y - grid.lower.y) % LatticeWindow::brick == 0,
                            (p.z - grid.lower.z) % LatticeWindow::brick == 0 };
    if (sides[0] || sides[1] || sides[2])
    {
      for (std::int32_t corner = 1; corner < 8; ++corner)
      {
        const std::size_t other = grid.At(p.x - (sides[0] ? corner & 1 : 0),
                                          p.y - (sides[1] ? (corner >> 1) & 1 : 0),
                                          p.z - (sides[2] ? corner >> 2 : 0));
        load[other] += other != own ? 1 : 0;
      }
    }
  }
  return load;
}

DelaunayCells
LatticeCells(const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress)
{
  const VertexRows                 rows(shape, points);
  const BrickGrid                  grid(shape.Box());
  const std::vector<std::uint32_t> load = BrickLoad(grid, points);
  const TracingInput               input{ shape, points, weights, rows, grid, load };

  constexpr std::size_t worthAThread = 20000; // points
  const std::size_t     threads =
    std::clamp<std::size_t>(points.size() / worthAThread, 1, static_cast<std::size_t>(omp_get_max_threads()));
  Tracing tracing;
  if (threads == 1)
  {
    tracing = CellTracer(input, 0, grid.Size()).Trace(progress);
  }
  else
  {
    const std::vector<std::size_t>  cuts = CutEvenly(load, threads);
    std::vector<Tracing>            parts(threads);
    std::vector<std::exception_ptr> failures(threads);
    std::atomic<bool>               stop = false;
    // Only the first thread reports; the others see its answer.
    const ProgressCallback watch = [&](std::string_view stage, double fraction) {
      if (omp_get_thread_num() == 0 && progress && !progress(stage, fraction))
      {
        stop = true;
      }
      return !stop;
    };
#pragma omp parallel for schedule(static, 1) num_threads(static_cast <int>(threads))
    for (std::size_t part = 0; part < threads; ++part)
    {
      try
      {
        parts[part] = CellTracer(input, cuts[part], cuts[part + 1]).Trace(watch);
      }
      catch (...)
      {
        failures[part] = std::current_exception();
        stop = true;
      }
    }
    for (const std::exception_ptr & failure : failures)
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    }
    tracing = CellTracer(input, 0, grid.Size()).Continue(JoinTracings(std::move(parts)), progress);
  }
  // Whatever tracing left, for whichever reason, is completed from the facets it left open.
  tracing.deep.insert(tracing.deep.end(), tracing.open.begin(), tracing.open.end());
  tracing.open.clear();
  AddDeepCells(tracing, points, weights, progress);
  DropJoined(tracing.cells);
  return std::move(tracing.cells);
}

} // namespace voxelcore
