#pragma once
// What is said where noise seems to have made loops, cavities and pieces.

#include "voxelcore/CoreReport.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** Names labels of whose topology much is less than three voxels wide, with the numbers and the options that mend
 *  them, in one line. */
void
TellNoisyLabels(const CoreReport & report, std::vector<std::string> & warnings);

} // namespace voxelcore
