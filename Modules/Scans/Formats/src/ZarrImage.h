#pragma once
// OME-Zarr: which array of a store is meant, and where its voxels lie. https://ngff.openmicroscopy.org

#include "ZarrArray.h"
#include "voxelcore/Formats/ReadOptions.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace voxelcore
{

/** One resolution of an image. Lists are in the array's order of axes. */
struct ZarrImage
{
  ZarrArray                           array;
  std::string                         version;    ///< of OME-Zarr; empty: an array without an image's metadata
  std::size_t                         levels = 1; ///< there are
  std::array<std::size_t, 3>          spatial{};  ///< the array's axes that are k, j, i
  std::optional<std::size_t>          time;
  std::optional<std::size_t>          channel;
  std::vector<double>                 scale; ///< along each axis, in its unit
  std::vector<double>                 translation;
  std::vector<std::string>            units;            ///< of each axis; empty where none is named
  std::array<Vector3, 3>              axes{};           ///< directions of k, j, i in LPS
  bool                                isPlaced = false; ///< the file says how its axes lie in the patient
  std::map<std::int64_t, ListedLabel> labels{};         ///< names and colours
};

/** Of a store, an image in it, its folder `labels`, one of its labels, or one array. options.level chooses the
 *  resolution.
 *  \throws InputError when it is damaged, holds several images, or nothing in space; UsageError for a level that is not
 *  there */
ZarrImage
ReadZarrImage(const std::filesystem::path & path, const ReadOptions & options);

} // namespace voxelcore
