#pragma once
// BMP slices: grey values of 1, 8 or 24 bits that are not packed, as programs of micro-CT scanners write them.

#include "voxelcore/Formats/ByteStream.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace voxelcore
{

/** The size of a grey slice of a byte a value. */
struct GreyPage
{
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/** \throws InputError when the file is damaged, packed, or a colour picture. */
GreyPage
InspectBmp(const std::filesystem::path & path);

/** The grey values of the slice, a byte each, from the upper row down. \throws InputError as above */
std::unique_ptr<ByteStream>
OpenBmpPage(const std::filesystem::path & path);

} // namespace voxelcore
