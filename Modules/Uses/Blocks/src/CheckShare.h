#pragma once
// Whether the cells of one block fit together.

#include "voxelcore/Blocks/HaloBlocks.h"

namespace voxelcore
{

/** \throws CertificateError that says what is wrong at a place, in lattice coordinates. */
[[noreturn]] void
Misfit(const LatticePoint & place, const std::string & what);

/** Each side of each facet of a cell must be met once the other way round, by another facet of the same cell, and all
 *  points of a cell must lie on its sphere. \throws CertificateError */
void
CheckCells(const BlockShare & share);

} // namespace voxelcore
