#pragma once
// Writing a volume as a multi-page TIFF.

#include "ScanFile.h"

#include <span>

namespace voxelcore
{

/** One page a slice, deflate when `compress`, BigTIFF when 4 GB may not do. \throws OutputError */
void
WriteTiff(const std::filesystem::path &       path,
          const std::array<std::int64_t, 3> & size,
          PixelType                           type,
          std::span<const std::byte>          voxels,
          bool                                compress);

} // namespace voxelcore
