#pragma once
// Scans written byte by byte, so that these tests do not rest on the code they test.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace voxelcore::testing
{

/** Voxels of a small scan, x fastest. */
struct TestScan
{
  std::array<std::size_t, 3> size{ 0, 0, 0 };
  std::array<double, 3>      spacing{ 1, 1, 1 };
  std::vector<std::uint8_t>  voxels;

  explicit TestScan(const std::array<std::size_t, 3> & gridSize)
    : size(gridSize)
    , voxels(gridSize[0] * gridSize[1] * gridSize[2])
  {}
  std::uint8_t &
  At(std::size_t x, std::size_t y, std::size_t z)
  {
    return voxels[(z * size[1] + y) * size[0] + x];
  }
  /** Fills first <= index <= last. */
  void
  Fill(const std::array<std::size_t, 3> & first, const std::array<std::size_t, 3> & last, std::uint8_t value);
};

/** As raw uint8 NRRD in LPS. */
void
WriteNrrd(const std::filesystem::path & path, const TestScan & scan);

/** A raw NRRD of any type from its header's lines (type, dimension, sizes, ...) and its bytes. */
void
WriteNrrd(const std::filesystem::path & path, const std::string & header, const std::string & bytes);

/** Three blocks that touch: labels 1, 2 and 9, in 14 x 12 x 10 voxels of 1 x 1 x 2 mm. */
TestScan
ThreeBlocks();

/** A part of a NIfTI-1 file of bytes; empty when there is no such file. */
TestScan
CropNifti(const std::filesystem::path &      path,
          const std::array<std::size_t, 3> & first,
          const std::array<std::size_t, 3> & size);

} // namespace voxelcore::testing
