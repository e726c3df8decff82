#pragma once
// The rows of a scan where they are asked for. Whoever asks in order reads the file once; whoever goes back reads it anew,
// which costs little where the data are stored plain.

#include "ScanFile.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace voxelcore
{

class ScanRows
{
public:
  /** \throws InputError, UsageError as ReadLabelVolume() does for a header */
  ScanRows(const std::filesystem::path & path, const ReadOptions & options);

  const ScanFile &
  Scan() const
  {
    return m_Scan;
  }

  /** Bytes of a row along i, with all values a voxel has. */
  std::size_t
  RowBytes() const
  {
    return m_RowBytes;
  }

  /** `rowCount` rows from row `firstRow` (j + size[1] * k) on, as they are stored, in this machine's byte order. With the
   *  last row the end of the data is checked. \throws InputError when they are damaged or missing */
  void
  Read(std::uint64_t firstRow, std::size_t rowCount, std::byte * to);

private:
  std::filesystem::path m_Path;
  ReadOptions           m_Options;
  ScanFile              m_Scan;
  std::size_t           m_RowBytes;
  std::uint64_t         m_Rows;   ///< of the whole scan
  std::uint64_t         m_At = 0; ///< the row where the stream stands
};

} // namespace voxelcore
