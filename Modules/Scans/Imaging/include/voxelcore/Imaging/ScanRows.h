#pragma once
// The rows of a scan as numbers, where they are asked for. Asking in order reads the file once. Going back reads it
// anew, which costs little where the data are stored plain.

#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Labels/StoredVoxels.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace voxelcore
{

/** Whether ReadLabelVolume() knows the format, by the name alone: a volume, a folder or a pattern of slices. */
bool
IsScanFormat(const std::filesystem::path & path);

class ScanRows
{
public:
  /** Of the options, those about geometry, volume and component count.
   *  \throws InputError, UsageError as ReadLabelVolume() does for a header */
  ScanRows(const std::filesystem::path & path, const ReadOptions & options);
  ScanRows(const ScanRows &) = delete;
  ScanRows &
  operator=(const ScanRows &) = delete;
  ~ScanRows();

  const ImageGeometry &
  Geometry() const;

  /** Of the values given out: as they are stored; Float64 where a slope scales them; Int64, the numbers of labels, of a
   *  segmentation in layers. */
  PixelType
  Type() const;

  /** The segments that the file names, with the values that the rows have for them (layer 0). */
  std::vector<Segment>
  Segments() const;

  const std::vector<std::string> &
  Notes() const;
  /** Each behind the scan's name. */
  std::vector<std::string>
  Warnings() const;

  /** Reads `rowCount` rows from row `firstRow` (j + size[1] * k) on, about a MB at a time; `take` gets one after the
   *  other, in this machine's byte order. With the last row the end of the data is checked.
   *  \throws InputError when data are damaged or missing, or two segments overlap; what `take` throws */
  using RowFunction = std::function<void(const std::byte * row, std::uint64_t number)>;
  void
  Read(std::uint64_t firstRow, std::uint64_t rowCount, const RowFunction & take);

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace voxelcore
