#pragma once
// What is said where pruning leaves no surface.

#include "voxelcore/Report/CoreReport.h"

#include <cstdint>
#include <string>
#include <vector>

namespace voxelcore
{

/** Names labels of whose faces pruning has left none: a note where they are merely thin, a warning where the threshold
 *  is far beyond the largest radius, as of a mistaken unit. `facesBefore`: of each label of the report, before
 *  pruning. */
void
TellFacelessLabels(const CoreReport &                 report,
                   const std::vector<std::uint64_t> & facesBefore,
                   std::vector<std::string> &         notes,
                   std::vector<std::string> &         warnings);

} // namespace voxelcore
