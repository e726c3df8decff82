#pragma once
// Base64 (RFC 4648).

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace voxelcore
{

std::string
ToBase64(std::span<const std::uint8_t> bytes);

/** At most `most` of the bytes that a run of base64 stands for; blanks between its groups of four letters do not count.
 *  `text` then begins behind the last group that was taken. Fewer bytes: the run ended, with `=` or with what is no
 *  base64. */
std::string
FromBase64(std::string_view & text, std::uint64_t most);

} // namespace voxelcore
