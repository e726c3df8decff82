#pragma once
// A part of a scan.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace voxelcore
{

/** Voxels first <= index < end along i, j and k. An end of 0 means the scan's. */
struct CropRange
{
  std::array<std::int32_t, 3> first{ 0, 0, 0 };
  std::array<std::int32_t, 3> end{ 0, 0, 0 };

  bool
  operator==(const CropRange &) const = default;
};

/** "i0:i1,j0:j1,k0:k1": voxels i0 to i1 - 1 and so on, counted from 0; either side of a colon may be left out.
 *  \throws UsageError for anything else, for a negative index and for an empty range. */
CropRange
ParseCrop(std::string_view text);

/** As a user writes it. */
std::string
CropText(const CropRange & crop);

/** The crop of a scan of this size with its ends filled in; the whole scan where there is none. `scan` names the scan
 *  in errors. \throws InputError when the crop reaches beyond the scan; UsageError when it is empty. */
CropRange
ResolveCrop(const std::optional<CropRange> &    crop,
            const std::array<std::int64_t, 3> & size,
            const std::filesystem::path &       scan);

} // namespace voxelcore
