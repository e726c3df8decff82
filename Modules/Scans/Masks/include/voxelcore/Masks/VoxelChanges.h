#pragma once
// Voxels of a scan to put in or take out, one by one: what a person, or an earlier run, decided.

#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** `length` voxels along the first axis, from `first` on, in indices of the scan, 0 or more. */
struct VoxelRun
{
  bool                        isAdded = false; ///< else taken out
  std::array<std::int32_t, 3> first{ 0, 0, 0 };
  std::int32_t                length = 1;

  bool
  operator==(const VoxelRun &) const = default;
};

/** In this order; a later run takes precedence. */
using VoxelChanges = std::vector<VoxelRun>;

/** Runs between blanks or ends of lines: +12,30,7 puts a voxel in, -12,30,7x4 takes four out. What follows # on a line
 *  is a remark. \throws UsageError naming the word that is no run */
VoxelChanges
ParseVoxelChanges(const std::string & text);

/** Of a text file. \throws InputError, naming the file, where it cannot be read or holds anything else */
VoxelChanges
ReadVoxelChanges(const std::filesystem::path & path);

/** The same as words on one line. */
std::string
VoxelChangesText(const VoxelChanges & changes);

/** What makes `after` of `before`, row by row. */
VoxelChanges
ChangesBetween(const VoxelShape & before, const VoxelShape & after);

struct ChangedShape
{
  VoxelShape    shape;
  std::uint64_t voxelsAdded = 0;
  std::uint64_t voxelsRemoved = 0;
};

/** The shape with its voxels changed, in its tight box. */
ChangedShape
ChangeVoxels(const VoxelShape & shape, const VoxelChanges & changes);

} // namespace voxelcore
