#include "LatticeEngine.h"

#include "CellTracer.h"
#include "DeepCells.h"
#include "SharedProgress.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/FreeMemory.h"
#include "voxelcore/Base/StagePlan.h"

#include <omp.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <exception>
#include <functional>

namespace voxelcore
{

namespace
{

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

// Two threads each take the bricks of a range from its ends until they meet.
Tracing
TraceSideBySide(const TracingInput & input, std::size_t threads, const ProgressCallback & progress)
{
  const std::vector<std::size_t> cuts = CutEvenly(input.load, threads);
  std::deque<BrickQueue>         queues;
  for (std::size_t part = 0; part < threads; part += 2)
  {
    queues.emplace_back(cuts[part], cuts[std::min(part + 2, threads)]);
  }
  std::vector<Tracing>            parts(threads);
  std::vector<std::exception_ptr> failures(threads);
  SharedProgress                  shared(progress);
#pragma omp parallel for schedule(static, 1) num_threads(static_cast <int>(threads))
  for (std::size_t part = 0; part < threads; ++part)
  {
    try
    {
      parts[part] = CellTracer(input, queues[part / 2], part % 2 == 1).Trace(std::ref(shared));
    }
    catch (...)
    {
      failures[part] = std::current_exception();
      shared.Stop();
    }
  }
  // A thread that fails stops the others, which then look cancelled: what failed is said.
  bool isCancelled = false;
  for (const std::exception_ptr & failure : failures)
  {
    try
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    }
    catch (const Cancelled &)
    {
      isCancelled = true;
    }
  }
  if (isCancelled)
  {
    throw Cancelled();
  }
  BrickQueue all(0, input.grid.Size());
  return CellTracer(input, all, false).Continue(JoinTracings(std::move(parts), input.points.size()), progress);
}

} // namespace

std::vector<std::uint32_t>
BrickLoad(const TracingBricks & grid, const std::vector<LatticePoint> & points)
{
  std::vector<std::uint32_t> load(grid.Size(), 0);
  for (const LatticePoint & p : points)
  {
    const LatticePoint at{ p.x - grid.lower.x, p.y - grid.lower.y, p.z - grid.lower.z };
    const std::size_t  own = grid.At(p.x, p.y, p.z);
    ++load[own];
    // On a lower side of its brick a point belongs to the neighbours there as well.
    static_assert(std::has_single_bit(static_cast<unsigned>(LatticeWindow::brick)));
    constexpr std::int32_t within = LatticeWindow::brick - 1;
    const bool             sides[3] = { (at.x & within) == 0, (at.y & within) == 0, (at.z & within) == 0 };
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
             const ProgressCallback &          progress,
             Facets                            facets)
{
  const VertexRows                 rows(shape, points);
  const TracingBricks              grid(shape.Box());
  const std::vector<std::uint32_t> load = BrickLoad(grid, points);
  const TracingInput               input{ shape, points, weights, rows, grid, load, facets };

  constexpr std::size_t worthAThread = 20000; // points
  const std::size_t     threads =
    std::clamp<std::size_t>(points.size() / worthAThread, 1, static_cast<std::size_t>(omp_get_max_threads()));
  // How many deep points there will be only tracing tells. Most of the time goes into tracing, unless a part is very
  // thick.
  StagePlan              plan(progress, { 0.7, 0.3 });
  const ProgressCallback tracingPart = plan.Next();
  Tracing                tracing;
  if (threads == 1)
  {
    BrickQueue bricks(0, grid.Size());
    tracing = CellTracer(input, bricks, false).Trace(tracingPart);
  }
  else
  {
    tracing = TraceSideBySide(input, threads, tracingPart);
  }
  constexpr std::size_t large = 100000; // points
  if (points.size() > large)
  {
    GiveBackFreeMemory();
  }
  // Whatever tracing left, for whichever reason, is completed from the facets it left open.
  tracing.deep.insert(tracing.deep.end(), tracing.open.begin(), tracing.open.end());
  tracing.open.clear();
  if (!tracing.deep.empty())
  {
    tracing = AddDeepCells(std::move(tracing), points, weights, plan.Next());
    if (points.size() > large)
    {
      GiveBackFreeMemory();
    }
  }
  return std::move(tracing.cells);
}

} // namespace voxelcore
