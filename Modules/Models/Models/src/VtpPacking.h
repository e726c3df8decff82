#pragma once
// Arrays in the appended data of VTK's XML files, packed as by vtkZLibDataCompressor, with headers of 64 bits.

#include "Deflate.h"

#include <string>
#include <string_view>

namespace voxelcore
{

/** The file's attribute that says so. */
constexpr std::string_view kCompressor = "vtkZLibDataCompressor";

/** A packed array: its head, which is the number of blocks, their size, that of a smaller last one or 0, and the length
 *  of each stream; then the streams. Blocks are packed side by side; the bytes do not tell in how many threads. */
std::string
PackVtpArray(std::string_view bytes);

} // namespace voxelcore
