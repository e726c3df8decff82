#pragma once
// Two engines, one answer: what --cross-check does to a label.

#include "voxelcore/Delaunay/DelaunayCells.h"

#include <string>

namespace voxelcore
{

/** The first difference between two answers of engines on the same points, in words; empty when they agree bit for bit
 *  in all that is canonical. (Which four points of a cell fix its sphere is not: Cospherical sets are compared through
 *  the facets.) */
std::string
FirstDifference(const DelaunayCells & lattice, const DelaunayCells & tetgen);

/** As ComputeDelaunayCells(), by both engines; gives what `engine` found.
 *  \throws CertificateError that names the label and the first difference. */
DelaunayCells
CrossCheckedCells(const VoxelShape &                shape,
                  const std::vector<LatticePoint> & points,
                  const SpacingWeights &            weights,
                  Engine                            engine,
                  const std::string &               labelText,
                  const ProgressCallback &          progress);

} // namespace voxelcore
