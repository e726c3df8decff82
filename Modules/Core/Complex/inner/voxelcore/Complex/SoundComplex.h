#pragma once
// Whether arrays are a complex.

#include "voxelcore/Complex/CellComplex.h"

namespace voxelcore
{

/** Whether arrays that come from outside are those of a complex, with its corners: counts agree, every index is of an
 *  element that is there, edges are in order and each once, a face's corners differ, and its edges join them. */
bool
IsComplex(const CellComplex & cells);

} // namespace voxelcore
