#include "voxelcore/VoxelCore.h"

#include "CoreFaces.h"
#include "Measures.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Error.h"
#include "voxelcore/ParallelTasks.h"

namespace voxelcore
{

MedialComplex
BuildVoxelCore(const VoxelShape &        shape,
               std::vector<LatticePoint> points,
               DelaunayCells             cells,
               const SpacingWeights &    weights)
{
  constexpr std::size_t most = std::size_t{ 1 } << 31;
  if (points.size() >= most)
  {
    throw InputError("the shape has more than 2^31 boundary vertices; crop or split it");
  }
  MedialComplex core;
  core.cells.vertexCount = cells.CellCount();
  std::vector<LatticePoint> sortedPoints;
  {
    CellMeasures measures = MeasureCells(shape, points, weights, cells, sortedPoints);
    std::vector<LatticePoint>().swap(points);
    for (std::vector<double> * values : { &measures.sphere, &measures.cell, &measures.facet })
    {
      RunInParts(values->size() > 10000, values->size(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
        {
          (*values)[i] = ToMillimetres((*values)[i], weights);
        }
      });
    }
    core.radius = std::move(measures.sphere);
    core.vertexLambda = std::move(measures.cell);
    core.edgeLambda = std::move(measures.facet);
  }
  if (cells.FacetCount() >= most)
  {
    throw InputError("the core has more than 2^31 edges; crop or split the shape");
  }
  // Facets are sorted by their cells, so the edges come out in canonical order.
  core.cells.edges = std::move(cells.facetCells);
  core.positions = std::move(cells.centres);
  WriteFaces(std::move(cells), std::move(sortedPoints), weights, core);
  return core;
}

MedialComplex
ComputeVoxelCore(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 Engine                   engine,
                 const ProgressCallback & progress)
{
  std::vector<LatticePoint> points = BoundaryVertices(shape);
  DelaunayCells             cells = ComputeDelaunayCells(shape, points, weights, engine, progress);
  return BuildVoxelCore(shape, std::move(points), std::move(cells), weights);
}

} // namespace voxelcore
