#pragma once
// Whether a body looks hollow: dried roots and stems are tubes in a scan, and the core of a tube follows its wall.
//
// How it is found. The shape is looked at as it is, and with holes of up to 4 and up to 8 voxels in its walls stopped:
// dilated by balls of that diameter (times the smallest spacing). In each slice across each of the three voxel axes the
// background that does not reach the slice's border is a hole (SliceHoles.h). Holes of all slices that touch over faces
// make a lumen. A lumen counts where at least three quarters of its surface, in faces of voxels, are wall: the inside
// of a tube that is longer than wide, open or closed at its ends, however it runs; not the eye of a ring (about half
// wall). What the dilation took is shared out between lumens and outside; lumens count where at least a fifth was left
// before and four fifths of their surface are wall now: gaps between neighbours are no lumens. Voxels of other labels
// in them are taken off: a vessel's wall around its blood is not hollow. The body looks hollow when the lumens come to
// at least a tenth of its own volume, at one of the three sizes of holes; the one with most counts. A lumen
// that reaches all six sides of the body's box is the channel of a labyrinth and does not count; nor do lumens that are
// open anywhere and come to 79 % of the background of that box. All is decided by counts of voxels and faces. Boxes of
// more than 2^24 voxels are looked at in voxels twice (four times, ...) as long.
// Foams whose rooms are closed are told of, too; nothing is changed.
// Not seen: tubes with lumens of less than three voxels (of those looked at), or with larger holes in their walls.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace voxelcore
{

struct HollowBody
{
  std::uint64_t voxels = 0; ///< background in lumens
  double        share = 0;  ///< of the body's own voxels; may be over 1
  int           holes = 0;  ///< voxels: the size of holes that was stopped, 0, 4 or 8
};

/** Nothing where the body does not look hollow. `weight`: the lattice's (SpacingWeights.h). `others`: other labels
 *  of the scan, which fill the lumens they lie in. */
std::optional<HollowBody>
FindHollowBody(const VoxelShape &                  shape,
               const std::array<std::int64_t, 3> & weight,
               std::span<const VoxelShape * const> others = {});

/** What a user is told of a label, without the label: one sentence that says what to do. */
std::string
HollowText(const HollowBody & body);

} // namespace voxelcore
