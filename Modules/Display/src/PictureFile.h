#pragma once
// From pixels drawn to a picture.

#include "voxelcore/RenderPicture.h"

namespace voxelcore
{

/** A picture of `width` x `height` pixels, each the mean of `part` x `part` drawn ones, which are three bytes each,
 *  rows from the bottom. \throws OutputError when all are of one colour. */
Picture
MeanPicture(const unsigned char * drawn, int width, int height, int part);

} // namespace voxelcore
