#pragma once
// JPEG pictures as slices, grey ones alone: what is written so is no longer quite what it was, so that a threshold
// must say what is shape.

#include "BmpFile.h"

#include <filesystem>
#include <memory>

namespace voxelcore
{

/** \throws InputError when it is damaged, or this build reads none */
GreyPage
InspectJpeg(const std::filesystem::path & path);

/** Its values, a byte each, row by row. \throws InputError, also where it turns out to be coloured */
std::unique_ptr<ByteStream>
OpenJpegPage(const std::filesystem::path & path);

} // namespace voxelcore
