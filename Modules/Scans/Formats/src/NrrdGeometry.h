#pragma once
// Where an NRRD file says its voxels lie.

#include "NrrdHeader.h"
#include "voxelcore/Formats/ScanFile.h"

#include <array>
#include <cstddef>
#include <string>

namespace voxelcore
{

/** Which axes of the file are i, j, k, and what the others are. */
struct NrrdAxes
{
  std::array<std::size_t, 3> spatial{};
  std::uint64_t              before = 1; ///< values a voxel, on axes faster than i
  std::uint64_t              after = 1;  ///< volumes, on axes slower than k
  std::string                kindBefore; ///< of the axis with more than one value
  std::string                kindAfter;
};

/** Sets scan.geometry from the space directions, or without them from spacings. \throws InputError */
void
PlaceNrrd(const NrrdHeader &                                      header,
          const std::vector<std::optional<std::vector<double>>> & directions,
          const NrrdAxes &                                        axes,
          std::size_t                                             dimension,
          const ReadOptions &                                     options,
          ScanFile &                                              scan);

} // namespace voxelcore
