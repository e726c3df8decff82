#pragma once
// The blocks of compressed arrays in VTK's XML files.

#include <cstdint>
#include <string>
#include <string_view>

namespace voxelcore
{

/** How many bytes one byte becomes at most. \throws UnfitFile for a compressor that is not known */
std::uint64_t
MostGain(const std::string & compressor);

/** Whether `packed` becomes exactly `size` bytes at `to`. \throws UnfitFile as MostGain */
bool
UnpackBlock(const std::string & compressor, std::string_view packed, char * to, std::uint64_t size);

} // namespace voxelcore
