#pragma once
// zlib streams. They are packed here: zlib's choices, and so its bytes, differ between its versions and makers.

#include <cstddef>
#include <string>
#include <string_view>

namespace voxelcore
{

/** What a byte of a zlib stream becomes at most. */
constexpr std::size_t kMostInflated = 1032;

/** A stream (RFC 1950, RFC 1951) that unpacks to `bytes`, which are fewer than 2^31: the same on every machine. Longer
 *  than they are by a thousandth and 16 at most. */
std::string
Deflate(std::string_view bytes);

/** Whether a stream is sound and becomes exactly `size` bytes, which then stand at `to`. */
bool
Inflate(std::string_view packed, char * to, std::size_t size);

} // namespace voxelcore
