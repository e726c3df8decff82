#pragma once
// What edits of shapes did, of several labels and in words.

#include "voxelcore/Masks/ShapeEdits.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** Adds what was done to one label. */
void
AddEdits(const EditRecord & record, EditRecord & sum);

/** The sum over all labels in words. */
std::vector<std::string>
EditsInWords(const EditRecord & sum, const ShapeEditOptions & options);

} // namespace voxelcore
