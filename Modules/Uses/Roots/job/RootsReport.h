#pragma once
// What is said of roots in the report.

#include "voxelcore/Roots/RootsJob.h"

#include <optional>
#include <string>

namespace voxelcore
{

/** The part of the report that is about roots; goes before the last brace of the core's. `volume`: of the voxels,
 *  mm^3; `edits`: as JSON. */
std::string
RootsJson(const RootModel &                    model,
          const std::optional<RootsTopology> & topology,
          double                               volume,
          const std::string &                  edits);

} // namespace voxelcore
