#pragma once
// Polydata written as .vtp with appended data in zlib's streams, as VTK's writer makes it.

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace voxelcore
{

struct VtpCells
{
  std::vector<std::int64_t> offsets; ///< ends
  std::vector<std::int64_t> points;
};

using VtpValues = std::variant<std::vector<std::int64_t>, std::vector<double>>;

struct VtpContent
{
  std::vector<std::pair<std::string, std::string>> texts; ///< field data
  std::vector<double>                              positions;
  std::vector<std::pair<std::string, VtpValues>>   pointArrays;
  VtpCells                                         cells[3]; ///< verts, lines, polys
  std::vector<std::pair<std::string, VtpValues>>   cellArrays;
};

/** \throws OutputError */
void
WriteVtp(const std::filesystem::path & path, VtpContent content);

} // namespace voxelcore
