#pragma once
// The constants of skeletons and pages in CostModel, fitted as those of cores are.

#include <filesystem>
#include <vector>

namespace voxelcore::performance
{

/** Measures, fits, prints the constants as they stand in CostModel.cxx, and how far these and the ones compiled in
 *  miss. */
void
FitSkeletonsAndPages(const std::filesystem::path &              folder,
                     double                                     limit,
                     int                                        rounds,
                     const std::vector<std::filesystem::path> & scans,
                     bool                                       busy);

} // namespace voxelcore::performance
