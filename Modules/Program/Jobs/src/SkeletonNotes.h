#pragma once
// What is said of skeletons once they are made.

#include "voxelcore/Report/CoreReport.h"

#include <filesystem>
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

/** Which labels of a scan have loops that carry little of their skeleton's length, as in no ring and no mesh: they may
 *  be trees. */
void
TellShortLoops(const CoreReport & report, std::vector<std::string> & notes);

/** By which rule the voxels of a finished core's shape hang together, where that may have decided its pieces. */
void
TellConnectivity(const std::filesystem::path & input, const CoreReport & report, std::vector<std::string> & notes);

} // namespace voxelcore
