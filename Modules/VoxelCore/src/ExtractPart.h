#pragma once
// A part of a core as a complex of its own.

#include "voxelcore/MedialComplex.h"
#include "voxelcore/SimplePairCollapse.h"

namespace voxelcore
{

/** The live elements with their geometry and measures, in the order they have in `core`. */
MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live);

} // namespace voxelcore
