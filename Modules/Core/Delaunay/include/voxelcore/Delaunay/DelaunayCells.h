#pragma once
// The merged Delaunay cells inside a voxel shape: the one question every engine answers, in one form.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Lattice/LatticePoint.h"
#include "voxelcore/Lattice/SpacingWeights.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace voxelcore
{

/** Stands for "beyond the boundary" where a cell is expected. */
inline constexpr std::uint32_t kOutside = 0xFFFFFFFFU;

/** The Delaunay tessellation of the boundary vertices inside the shape. A cell is the convex hull of a maximal set of
 *  cospherical boundary vertices with an empty sphere (so cells are unique, whatever tetrahedra an engine made).
 *  By Theorem 3.1 of the paper the boundary squares of the shape are facets, so cells lie wholly inside or outside.
 *
 *  Canonical: cells by their exact centre (x, then y, then z); facets by (cells[0], cells[1]), then by points;
 *  polygons start at their smallest point index and run counter-clockwise seen from outside cells[0].
 *  Up to 2^32 - 2 cells and facets. */
struct DelaunayCells
{
  /** Lattice coordinates of each cell's centre, each coordinate the exact rational rounded once. None where facets on
   *  the boundary were left out: BuildVoxelCore() finds them when there is more room. */
  std::vector<std::array<double, 3>> centres;
  /** Four affinely independent points of each cell: they fix its sphere. Any four; not canonical. */
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  /** The two cells of each facet, smaller index first; kOutside second for a facet on the boundary. */
  std::vector<std::array<std::uint32_t, 2>> facetCells;
  std::vector<std::uint64_t>                facetOffsets{ 0 }; ///< facets + 1 entries into facetPoints
  std::vector<std::uint32_t>                facetPoints;       ///< indices of boundary vertices, cyclic
  /** Empty where facets on the boundary are there. Where they were left out, the axes of those that a cell had: per
   *  cell bit 0, 1, 2 for x, y, z; or bit 0 for all of them, where weights are alike. */
  std::vector<std::uint8_t> voxelSides;

  std::size_t
  CellCount() const
  {
    return tetrahedra.size();
  }
  std::size_t
  FacetCount() const
  {
    return facetCells.size();
  }
  std::span<const std::uint32_t>
  FacetPoints(std::size_t facet) const
  {
    return { facetPoints.data() + facetOffsets[facet], facetPoints.data() + facetOffsets[facet + 1] };
  }
};

/** Which facets are asked for. */
enum class Facets
{
  All,
  Inside ///< those between two cells, and no centres; of the others DelaunayCells::voxelSides is left
};

/** The Delaunay engines a build can have. */
enum class Engine
{
  Auto,    ///< the best one: lattice
  Lattice, ///< made for voxel shapes; parallel
  TetGen   ///< TetGen 1.5: exact, sequential, AGPL-3
};

/** Whether this build has the engine (Auto: any). */
bool
HasEngine(Engine engine);

/** The cells inside `shape`, whose boundary vertices, as BoundaryVertices() gives them, are `points`.
 *  \throws InputError when the numbers would leave the exact range (72 w^2 N^5 >= 2^127), or exceed the engine's
 *  \throws Error when this build lacks the engine; Cancelled when the callback says so. */
DelaunayCells
ComputeDelaunayCells(const VoxelShape &                shape,
                     const std::vector<LatticePoint> & points,
                     const SpacingWeights &            weights,
                     Engine                            engine,
                     const ProgressCallback &          progress = {},
                     Facets                            facets = Facets::All);

/** Takes the facets on the boundary out, and those that no cell has; fills in voxelSides. The others keep their order.
 *  \throws CertificateError where one is no side of a voxel */
void
LeaveOutBoundary(const std::vector<LatticePoint> & points, const SpacingWeights & weights, DelaunayCells & cells);

} // namespace voxelcore
