#pragma once
// What bare voxels are, where a user says it.

#include "voxelcore/Labels/StoredVoxels.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace voxelcore
{

struct RawLayout
{
  std::array<std::int64_t, 3> size{}; ///< i fastest
  PixelType                   type = PixelType::UInt8;
  bool                        isBig = false; ///< big endian

  bool
  operator==(const RawLayout &) const = default;
};

/** "512,512,300,uint16" or "512,512,300,uint16,big". \throws UsageError */
RawLayout
ParseRawLayout(std::string_view text);

/** As a user writes it. */
std::string
RawLayoutText(const RawLayout & layout);

} // namespace voxelcore
