#include "voxelcore/VoxelCore/VoxelCore.h"

#include "CoreFaces.h"
#include "Measures.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Shape/BoundaryVertices.h"

namespace voxelcore
{

MedialComplex
BuildVoxelCore(const VoxelShape &        shape,
               std::vector<LatticePoint> points,
               DelaunayCells             cells,
               const SpacingWeights &    weights,
               CoreUse                   use)
{
  constexpr std::size_t most = std::size_t{ 1 } << 31;
  if (points.size() >= most)
  {
    throw InputError("the shape has more than 2^31 boundary vertices; crop or split it");
  }
  MedialComplex core;
  core.cells.vertexCount = cells.CellCount();
  MeasuredCells measured = MeasureCells(shape, std::move(points), weights, cells);
  if (cells.FacetCount() >= most)
  {
    throw InputError("the core has more than 2^31 edges; crop or split the shape");
  }
  // Facets are sorted by their cells, so the edges come out in canonical order.
  core.cells.edges = std::move(cells.facetCells);
  core.positions = std::move(cells.centres);
  core.radius = std::move(measured.sphere);
  core.edgeLambda = std::move(measured.facet);
  core.vertexLambda = std::move(measured.cell);
  WriteFaces(std::move(measured.polygons), std::move(measured.sortedPoints), weights, use, core);
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
