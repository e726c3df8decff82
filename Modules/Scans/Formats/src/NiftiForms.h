#pragma once
// Where a NIfTI file says its voxels lie: two statements that may contradict each other, and the rule to choose.

#include "voxelcore/Formats/ScanFile.h"

#include <array>
#include <cstdint>

namespace voxelcore
{

/** The description of a NIfTI file that VoxelCore writes with lengths in voxels: the format has no such unit. */
inline constexpr std::string_view kNiftiInVoxels = "VoxelCore: lengths in voxels";

/** The header fields that place the voxels; lengths in the file's unit, in RAS. */
struct NiftiPlacement
{
  std::array<double, 4>                pixdim{}; ///< qfac, then the voxel's sides
  int                                  qformCode = 0;
  int                                  sformCode = 0;
  std::array<double, 3>                quaternion{}; ///< b, c, d
  std::array<double, 3>                qoffset{};
  std::array<std::array<double, 4>, 3> srow{};
  double                               millimetres = 1; ///< in the unit of length
};

/** Sets the geometry (LPS mm) by the form that options.niftiForm and, for "auto", ITK's rule choose: the sform when it
 *  is orthonormal and either its code is 1 (scanner) or there is no qform; else the qform; with neither the axes are
 *  LPS and the origin 0. Notes and warnings go into the scan. \throws InputError */
void
PlaceNifti(const NiftiPlacement & placement, const ReadOptions & options, ScanFile & scan);

} // namespace voxelcore
