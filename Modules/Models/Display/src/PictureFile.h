#pragma once
// From pixels drawn to a picture.

#include "voxelcore/Display/RenderPicture.h"

namespace voxelcore
{

/** A picture without pixels set. */
Picture
BlankPicture(int width, int height);

/** Sets `width` x `height` pixels of a picture, from (left, bottom) on, counted from its lower left: each is the mean
 *  of `part` x `part` drawn ones, which are three bytes each, rows from the bottom. */
void
SetMeans(Picture & picture, const unsigned char * drawn, int left, int bottom, int width, int height, int part);

/** \throws OutputError when all pixels are of one colour. */
void
RequireDrawn(const Picture & picture);

} // namespace voxelcore
