#pragma once
// What is said of roots in the report.

#include "voxelcore/Roots/RootsJob.h"

#include <optional>
#include <string>

namespace voxelcore
{

/** The report's member about roots, as JSON. `volume`: of the voxels, mm^3; `edits`: as JSON. */
std::string
RootsJson(const RootModel &                    model,
          const std::optional<RootsTopology> & topology,
          double                               volume,
          const std::string &                  edits);

} // namespace voxelcore
