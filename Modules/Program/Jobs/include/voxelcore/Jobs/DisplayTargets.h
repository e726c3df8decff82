#pragma once
// Where a job's results go for looking at.

#include <cstddef>
#include <filesystem>
#include <optional>

namespace voxelcore
{

struct DisplayTargets
{
  std::optional<std::filesystem::path> scene; ///< .mrml, with its data in STEM_Data/ beside it, or .mrb
  std::optional<std::filesystem::path> html;  ///< .html
  std::size_t                          htmlTriangles = 500000;
};

/** \throws UsageError, which says why, where this build makes no pages (`--html`) */
void
RequirePages();

} // namespace voxelcore
