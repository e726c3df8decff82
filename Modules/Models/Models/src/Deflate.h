#pragma once
// zlib streams (RFC 1950).

#include <cstddef>
#include <string>
#include <string_view>

namespace voxelcore
{

/** What a byte of a zlib stream becomes at most. */
constexpr std::size_t kMostInflated = 1032;

/** A stream that unpacks to `bytes`, by zlib at hand: another version of it may choose other bytes. */
std::string
Deflate(std::string_view bytes);

/** Whether a stream is sound and becomes exactly `size` bytes, which then stand at `to`. */
bool
Inflate(std::string_view packed, char * to, std::size_t size);

} // namespace voxelcore
