#pragma once
// What the Python module made of a label as files, and cores read back.

#include "LabelWork.h"

#include <filesystem>

namespace voxelcore
{

/** Asks `progress` once more before the file gets its name. \throws OutputError, UsageError, Cancelled */
void
Save(const CoreOfLabel &           core,
     const std::filesystem::path & path,
     const ModelOptions &          options,
     bool                          force,
     const ProgressCallback &      progress);

void
Save(const SkeletonOfLabel &       skeleton,
     const std::filesystem::path & path,
     const std::string &           also,
     bool                          force,
     const ProgressCallback &      progress);

/** As `--also swc` writes it. Asks `progress` once more, too. \throws OutputError, Cancelled */
void
SaveSwc(const SkeletonOfLabel &       skeleton,
        const std::filesystem::path & path,
        bool                          force,
        const ProgressCallback &      progress);

/** What `voxelcore core` wrote, when it holds one label. \throws InputError */
std::shared_ptr<CoreOfLabel>
ReadCore(const std::filesystem::path & path);

} // namespace voxelcore
