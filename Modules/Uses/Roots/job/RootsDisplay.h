#pragma once
// What `voxelcore roots` writes for looking at.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Jobs/OutputTransaction.h"
#include "voxelcore/Roots/RootFiles.h"
#include "voxelcore/Roots/RootsJob.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore
{

/** Whether this build draws roots: it has module Display and the library for pages. */
bool
DrawsRoots();

/** roots.png, the roots inside their surface, upright, in the colours of their levels; and roots.html, the same in
 *  three dimensions. Throws std::logic_error unless DrawsRoots(). \throws OutputError, Cancelled */
void
DrawRoots(const RootModel &        model,
          const VoxelShape &       shape,
          const ImageGeometry &    geometry,
          const RootsOptions &     options,
          OutputTransaction &      transaction,
          const ProgressCallback & progress);

/** Charts of length by depth and by diameter, as HTML. */
std::string
RootsFigures(const RootModel & model);

/** What was cut and filled, from the side and as a table, as HTML. */
std::string
RootsChanges(const RootModel & model, const RootsTopology & topology);

/** The summary: a page of its own that needs nothing but roots.png beside it; `prefix`: of its name, where there is
 *  one. */
std::string
RootsPage(const RootsResult &                result,
          double                             volume,
          const std::vector<std::string> &   remarks,
          const std::optional<std::string> & prefix);

} // namespace voxelcore
