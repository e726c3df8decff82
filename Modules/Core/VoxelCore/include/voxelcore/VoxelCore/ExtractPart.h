#pragma once
// A part of a core as a complex of its own.

#include "voxelcore/Complex/SimplePairCollapse.h"
#include "voxelcore/VoxelCore/MedialComplex.h"

#include <vector>

namespace voxelcore
{

/** Per element of a part its index in what it is a part of. */
struct PartElements
{
  std::vector<ElementIndex> vertices;
  std::vector<ElementIndex> edges;
  std::vector<ElementIndex> faces;
};

/** Turns the indices of a part of `part` into those in what `part` is a part of. */
void
NameInWhole(const PartElements & part, PartElements & ofPart);

/** The live elements with their geometry and measures, in the order they have in `core`; `elements` receives their
 *  indices there. */
MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live, PartElements & elements);
MedialComplex
ExtractPart(const MedialComplex & core, const LiveElements & live);

/** The same of a core that is used up, in its place; see KeepLive(). */
MedialComplex
KeepPart(MedialComplex && core, const LiveElements & live);

} // namespace voxelcore
