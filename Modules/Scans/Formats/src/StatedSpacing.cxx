#include "voxelcore/Formats/StatedSpacing.h"

#include "voxelcore/Base/TextFields.h"

namespace voxelcore
{

Vector3
SpacingInVoxels(ScanFile & scan)
{
  scan.warnings.push_back(
    "no voxel size in the file: all lengths are in voxels. Give the true size with --spacing "
    "X,Y,Z.");
  scan.geometry.unit = SpatialUnit::Voxels;
  return { 1, 1, 1 };
}

Vector3
CompleteSpacing(const StatedSpacing & stated, const ReadOptions & options, ScanFile & scan)
{
  if (options.spacing)
  {
    return { 1, 1, 1 }; // SetGeometry takes theirs
  }
  const auto & mm = stated.mm;
  if (!stated.note.empty())
  {
    scan.notes.push_back(stated.note);
  }
  if (!mm[0] || !mm[1])
  {
    return SpacingInVoxels(scan);
  }
  scan.notes.push_back(Text("the voxel size is from ", stated.source));
  if (!mm[2])
  {
    scan.warnings.push_back(Text("the file gives the size of a pixel (",
                                 Number(*mm[0]),
                                 " x ",
                                 Number(*mm[1]),
                                 " mm) but not the distance between slices; ",
                                 Number(*mm[0]),
                                 " mm is assumed. Give --spacing X,Y,Z."));
  }
  return { *mm[0], *mm[1], mm[2].value_or(*mm[0]) };
}

} // namespace voxelcore
