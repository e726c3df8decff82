#pragma once
// Parts of a core that the steps of a boundary raise and that the smooth surface knows nothing of.

#include "CorePart.h"
#include "FootPoints.h"

namespace voxelcore
{

/** Faces below this measure in mm may be fringe. */
double
WidestFringe(const Vector3 & spacing);

/** A part of a core without faces below the threshold whose foot points meet wherever they start from: between its two
 *  boundary vertices the estimated surface is so flat that it has one nearest point alone. Only simple pairs go.
 *  \throws CertificateError where a face has no two nearest boundary vertices. */
CorePart
RemoveFringe(const RefinementInput & input, const FootPointFinder & finder, CorePart part);

} // namespace voxelcore
