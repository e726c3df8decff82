#pragma once
// Planes in space, as DICOM states them one by one, put together to a volume.

#include "ItkScan.h"

#include <gdcmDataSet.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace voxelcore::itkreader
{

/** What a frame or a slice says of its place. */
struct DicomPlane
{
  std::optional<Vector3> position;    ///< of the centre of its first pixel, LPS mm
  std::optional<Vector3> alongRow;    ///< direction of i
  std::optional<Vector3> alongColumn; ///< direction of j
  std::optional<double>  spacingI;    ///< mm between columns
  std::optional<double>  spacingJ;    ///< mm between rows
  std::optional<double>  thickness;
  std::optional<double>  distance; ///< Spacing Between Slices
};

/** The fields of a slice, or of a frame's functional groups: those stated replace what `plane` has. */
void
TakePlaneFields(const gdcm::DataSet & set, DicomPlane & plane);

/** A volume of planes. */
struct PlaneStack
{
  std::vector<std::vector<std::size_t>> slices; ///< the planes that lie at k = 0, 1, ...; none where one is missing
};

/** Puts planes in the order of their places, along the normal of i and j, and the geometry into `scan` (size[2], axes,
 *  spacing, origin). `mayMiss` is for segmentations, whose empty frames may be left out.
 *  \throws InputError when they have no place, other directions or pixel sizes, lie off a line (by more than 1 % of a
 *  voxel), or are not equally far apart; and where one is missing that may not */
PlaneStack
StackPlanes(const std::filesystem::path & path, const std::vector<DicomPlane> & planes, bool mayMiss, ItkScan & scan);

} // namespace voxelcore::itkreader
