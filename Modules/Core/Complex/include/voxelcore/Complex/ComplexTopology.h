#pragma once
// Topology numbers of a cell complex, from its cells alone.

#include "voxelcore/Complex/CellComplex.h"
#include "voxelcore/Lattice/TopologyNumbers.h"

namespace voxelcore
{

/** Euler number = vertices - edges + faces; b0 by union-find; b2 = dimension of the kernel of the boundary map of the
 *  faces over GF(2), after collapsing free faces and uniting faces across edges that have exactly two; b1 = b0 + b2 -
 *  euler. For a complex that lies in 3-space (no torsion) these are its Betti numbers over any field. */
TopologyNumbers
ComputeComplexTopology(const CellComplex & complex);

} // namespace voxelcore
