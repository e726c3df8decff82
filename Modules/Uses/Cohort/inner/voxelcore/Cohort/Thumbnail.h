#pragma once
// A small picture of a medial surface, painted by ourselves: needs no window, no graphics card, and equal models give
// equal bytes.

#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Report/CoreReport.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace voxelcore
{

class TemporaryRegistry;

/** Red, green and blue, row by row from the top. */
struct Thumbnail
{
  int                       width = 0;
  int                       height = 0;
  std::vector<std::uint8_t> rgb;
};

/** A parallel projection of all parts, from the patient's left front and above, that fills the picture: faces lit from
 *  the viewer's side and coloured by label, edges on no face and isolated vertices as lines and points. */
Thumbnail
PaintModel(const MedialModel & model, int size);

/** \throws OutputError */
void
WriteThumbnail(const std::filesystem::path & path, const Thumbnail & picture);

/** Paints the first medial surface of a report of `voxelcore core` beside it: "X_thumbnail.png" for "X_medial.vtp". A
 *  model that is not written as .vtp gets none. \throws InputError, OutputError */
void
PaintCase(const CoreReport & report, TemporaryRegistry * temporaries = nullptr);

} // namespace voxelcore
