#pragma once
// What the helper program (Modules/Scans/ItkReader/itk) says of a scan, as lines of text that come before the voxels.
// Both sides are built from this header.

#include "voxelcore/ItkReader/ForeignFormats.h"
#include "voxelcore/Labels/StoredVoxels.h"
#include "voxelcore/Lattice/Vectors.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace voxelcore
{

struct ItkScan
{
  std::string                 format; ///< as LabelMap::format
  std::string                 storedType;
  PixelType                   type = PixelType::UInt8;
  std::array<std::int64_t, 3> size{};
  std::uint64_t               components = 1; ///< values a voxel
  std::uint64_t               volumes = 1;
  bool                        separate = false; ///< one component is sent, by its number; else all, interleaved
  std::array<Vector3, 3>      axes{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }; ///< in LPS
  Vector3                     spacing{ 0, 0, 0 };                                ///< mm; 0: the file does not say
  Vector3                     origin{ 0, 0, 0 };                                 ///< LPS mm
  double                      slope = 1;
  double                      intercept = 0;
  std::vector<Segment>        segments; ///< with them, components are layers
  std::vector<std::string>    notes;
  std::vector<std::string>    warnings;

  std::vector<std::filesystem::path> files; ///< that the scan consists of
};

/** Lines "key words", the last one empty. Numbers come back bit by bit. */
std::string
ItkScanText(const ItkScan & scan);

/** \throws InputError when a line is none; it names `path` */
ItkScan
ParseItkScan(const std::filesystem::path & path, std::string_view text);

/** The helper's word for a format. */
const char *
ItkFormatName(ItkFormat format);

} // namespace voxelcore
