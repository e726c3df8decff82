#include "LatticeEngine.h"

#include "CellTracer.h"
#include "DeepCells.h"

#include <omp.h>


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

} // namespace

DelaunayCells
LatticeCells(const VoxelShape &                shape,
             const std::vector<LatticePoint> & points,
             const SpacingWeights &            weights,
             const ProgressCallback &          progress)
{
  const VertexRows   rows(shape, points);
  const BrickGrid    grid(shape.Box());
  const TracingInput input{ shape, points, weights, rows, grid };
  const std::size_t  threads = static_cast<std::size_t>(omp_get_max_threads());
  Tracing            tracing;
  if (threads == 1)
  {
    CellTracer tracer(input, 0, grid.Size());
    tracing = tracer.Trace(progress);
  }
  else
  {
    std::vector<Tracing> parts(threads);
#pragma omp parallel for schedule(static, 1)
    for (std::size_t part = 0; part < threads; ++part)
    {
      CellTracer tracer(input, grid.Size() * part / threads, grid.Size() * (part + 1) / threads);
      parts[part] = tracer.Trace({});
    }
    CellTracer tracer(input, 0, grid.Size());
    tracing = tracer.Continue(JoinTracings(std::move(parts)), progress);
  }
  if (!tracing.open.empty())
  {
    throw CertificateError("tracing the Delaunay cells did not close; please report this input");
  }
  AddDeepCells(tracing, points, weights, progress);
  DropJoined(tracing.cells);
  return std::move(tracing.cells);
}

} // namespace voxelcore
