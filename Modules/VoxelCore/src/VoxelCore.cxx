#include "voxelcore/VoxelCore.h"

#include "CoreFaces.h"
#include "Measures.h"

#include "voxelcore/BoundaryVertices.h"
#include "voxelcore/Error.h"

namespace voxelcore
{

namespace
{

// Takes the facets on the boundary out, and their measures: those that stay are dual to the core's edges.
void
KeepInnerFacets(DelaunayCells & cells, std::vector<double> & measures)
{
  std::size_t   kept = 0;
  std::uint64_t end = 0;
  for (std::size_t facet = 0; facet < cells.FacetCount(); ++facet)
  {
    if (cells.facetCells[facet][1] == kOutside)
    {
      continue;
    }
    for (std::uint64_t from = cells.facetOffsets[facet]; from < cells.facetOffsets[facet + 1]; ++from)
    {
      cells.facetPoints[end++] = cells.facetPoints[from];
    }
    cells.facetCells[kept] = cells.facetCells[facet];
    measures[kept] = measures[facet];
    cells.facetOffsets[++kept] = end;
  }
  cells.facetCells.resize(kept);
  cells.facetCells.shrink_to_fit();
  measures.resize(kept);
  measures.shrink_to_fit();
  // These stay while faces are collected, where a core needs the most memory.
  cells.facetOffsets.resize(kept + 1);
  cells.facetOffsets.shrink_to_fit();
  cells.facetPoints.resize(end);
  cells.facetPoints.shrink_to_fit();
}

} // namespace

MedialComplex
BuildVoxelCore(const VoxelShape &                shape,
               const std::vector<LatticePoint> & points,
               DelaunayCells                     cells,
               const SpacingWeights &            weights)
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
    std::vector<std::array<std::uint32_t, 4>>().swap(cells.tetrahedra);
    KeepInnerFacets(cells, measures.facet);
    for (std::vector<double> * values : { &measures.sphere, &measures.cell, &measures.facet })
    {
      for (double & value : *values)
      {
        value = ToMillimetres(value, weights);
      }
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
  WriteFaces(std::move(cells), sortedPoints, weights, core);
  return core;
}

MedialComplex
ComputeVoxelCore(const VoxelShape &       shape,
                 const SpacingWeights &   weights,
                 Engine                   engine,
                 const ProgressCallback & progress)
{
  const std::vector<LatticePoint> points = BoundaryVertices(shape);
  return BuildVoxelCore(shape, points, ComputeDelaunayCells(shape, points, weights, engine, progress), weights);
}

} // namespace voxelcore
