#pragma once
// Words and numbers in the metadata of Zarr arrays; each function throws InputError for what makes no sense.

#include "ZarrArray.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxelcore
{

inline constexpr std::size_t kMostZarrAxes = 8;

[[noreturn]] void
RefuseMetadata(const std::filesystem::path & folder, const std::string & what);
[[noreturn]] void
RefuseCodec(const std::filesystem::path & folder, const std::string & name);

/** A store holds all that is read of it: what is of a folder lies in it or below once links are followed. The folder
 *  that the user names may be a link itself. \throws InputError */
void
RequireInStore(const std::filesystem::path & folder, const std::filesystem::path & part);

/** A member of an object, one that is a text, and one that is a list of sides. */
const nlohmann::json &
Member(const std::filesystem::path & folder, const nlohmann::json & json, const char * key);
std::string
Word(const std::filesystem::path & folder, const nlohmann::json & json, const char * key);
std::vector<std::uint64_t>
Sides(const std::filesystem::path & folder, const nlohmann::json & json, const char * key);

/** "u2" of version 2 ("<u2" without its byte order), "uint16" of version 3. */
PixelType
ZarrTypeOf(const std::filesystem::path & folder, const std::string & name);

/** By the name that either version gives it. */
ZarrCodec
ZarrCodecOf(const std::filesystem::path & folder, std::string name);

/** What stands for chunks that are not there; null: nothing does. */
void
SetFill(const nlohmann::json & value, ZarrArray & array);

} // namespace voxelcore
