#pragma once
// Small sheets that hang on others by rods or points, or on rods alone.

#include "SheetPieces.h"
#include "ShortRods.h"

#include "voxelcore/VoxelCore/MedialComplex.h"

#include <cstdint>
#include <vector>

namespace voxelcore
{

/** Gives the faces of a piece that shares no edge with another, and is not the largest of all that hangs together, to
 *  the piece it hangs on, where it stands out of that by less than `sliver`, or by less than it is thick, as
 *  MedialSheets.h says. `pieceOfFace` has numbers as SheetPieces::PieceOfFaces() gives them. */
void
JoinLooseFlakes(const MedialComplex &        core,
                const SheetPieces &          pieces,
                double                       sliver,
                std::vector<std::uint32_t> & pieceOfFace);

/** Gives kNoPiece to the faces of a piece that shares no edge with another, and that stands out of the ends of the rods
 *  that end at it, all but short ones, by less than `sliver`, or by less than it is thick. */
void
DropFlakesOfRods(const MedialComplex &        core,
                 const SheetPieces &          pieces,
                 const ShortRods &            shortRods,
                 double                       sliver,
                 std::vector<std::uint32_t> & pieceOfFace);

} // namespace voxelcore
