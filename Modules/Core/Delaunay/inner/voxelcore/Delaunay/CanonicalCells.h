#pragma once
// What an engine hands over: cells and facets in any numbering, to be put into canonical form.

#include "voxelcore/Delaunay/DelaunayCells.h"

namespace voxelcore
{

/** A cell with the centre of its sphere. */
struct CentredCell
{
  std::array<double, 3> centre;      ///< lattice coordinates, rounded
  float                 denominator; ///< of the exact coordinates, at most
  std::uint32_t         cell;
};

/** The same of four affinely independent corners: each coordinate the exact rational rounded once. */
CentredCell
CentreOfCorners(const std::array<LatticePoint, 4> & corners, const SpacingWeights & weights);

/** Cells by exact centre.
 *  \throws CertificateError when two cells have the same centre (they were not merged). */
std::vector<std::uint32_t>
SortByCentre(const DelaunayCells & cells, const std::vector<LatticePoint> & points, const SpacingWeights & weights);

/** Of what an engine made: numbers cells by exact centre, orders facets and polygons as DelaunayCells promises, and
 *  fills in the centres as asked. Expects tetrahedra, facetCells (any order of the two; kOutside second),
 *  facetOffsets and facetPoints with every polygon counter-clockwise seen from outside facetCells[.][0]. Facets with
 *  kOutside on both sides are left out.
 *  \throws CertificateError when two cells have the same centre (they were not merged). */
DelaunayCells
MakeCanonical(DelaunayCells                     cells,
              const std::vector<LatticePoint> & points,
              const SpacingWeights &            weights,
              Facets                            facets = Facets::All);

} // namespace voxelcore
