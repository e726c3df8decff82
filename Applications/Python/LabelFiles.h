#pragma once
// What the Python module made of a label as files, and cores read back.

#include "LabelWork.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

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

/** What is in a .vtp file of `voxelcore core` or `voxelcore skeleton`, label by label. */
struct ResultsRead
{
  std::vector<std::shared_ptr<CoreOfLabel>>     cores;
  std::vector<std::shared_ptr<SkeletonOfLabel>> skeletons; ///< without the surfaces they were made of
};

/** \throws InputError */
ResultsRead
ReadResults(const std::filesystem::path & path);

/** The names of a scan's labels by value, whether they are in the file or beside it. \throws InputError */
std::map<std::int64_t, std::string>
NamesOfLabels(const std::filesystem::path & path);

} // namespace voxelcore
