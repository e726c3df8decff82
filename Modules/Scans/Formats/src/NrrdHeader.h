#pragma once
// The text header of an NRRD file as fields and keys, before anything is made of them.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct NrrdHeader
{
  std::map<std::string, std::string> fields;         ///< by name in lower case without blanks: "spacedirections"
  std::map<std::string, std::string> keys;           ///< "key:=value" pairs
  std::vector<std::string>           dataFiles;      ///< the lines after "data file: LIST"
  std::uint64_t                      dataOffset = 0; ///< just behind the blank line that ends the header
  bool                               ended = false;  ///< there was such a line

  /** The field's text, empty when absent. */
  std::string_view
  Field(std::string_view name) const;
};

/** \throws InputError when it is no NRRD header. */
NrrdHeader
ReadNrrdHeader(const std::filesystem::path & path);

/** "(1,0,0) none (0,0,2.5)": a vector each, nothing for none. \throws InputError naming `field`. */
std::vector<std::optional<std::vector<double>>>
ParseNrrdVectors(const std::filesystem::path & path, std::string_view field, std::string_view text);

/** "\"mm\" \"mm\" \"um\"": quoted words. */
std::vector<std::string>
ParseNrrdQuoted(std::string_view text);

} // namespace voxelcore
