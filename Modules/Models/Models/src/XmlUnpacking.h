#pragma once
// The blocks of compressed arrays in VTK's XML files.

#include <cstdint>
#include <string>

namespace voxelcore
{

/** How many bytes one byte becomes at most. \throws UnfitFile for a compressor that is not known */
std::uint64_t
MostGain(const std::string & compressor);

/** Whether `packed` bytes become exactly `size` bytes at `to`. \throws UnfitFile as MostGain */
bool
Unpack(const std::string &   compressor,
       const unsigned char * from,
       std::uint64_t         packed,
       unsigned char *       to,
       std::uint64_t         size);

} // namespace voxelcore
