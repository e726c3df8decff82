#pragma once
// What is said of bodies at the border of their scan.

#include "voxelcore/CoreReport.h"

#include <string>
#include <vector>

namespace voxelcore
{

/** Where the border cuts bodies whose skeletons run on to it, and how many ends lie in it. */
void
TellBorderCuts(const CoreReport & report, std::vector<std::string> & notes);

/** Which labels of a finished core, made into skeletons, lie at the border: there they end as the core does. */
void
TellClosedBorder(const CoreReport & report, std::vector<std::string> & notes);

} // namespace voxelcore
