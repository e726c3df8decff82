#include "ScanRows.h"

#include "SlabReader.h"

namespace voxelcore
{

ScanRows::ScanRows(const std::filesystem::path & path, const ReadOptions & options)
  : m_Path(path)
  , m_Options(options)
  , m_Scan(OpenScan(path, options))
  , m_RowBytes(static_cast<std::size_t>(m_Scan.geometry.size[0]) * m_Scan.interleaved * PixelBytes(m_Scan.type))
  , m_Rows(static_cast<std::uint64_t>(m_Scan.geometry.size[1] * m_Scan.geometry.size[2]))
{}

void
ScanRows::Read(std::uint64_t firstRow, std::size_t rowCount, std::byte * to)
{
  if (firstRow < m_At || !m_Scan.voxels)
  {
    m_Scan = OpenScan(m_Path, m_Options);
    m_At = 0;
  }
  m_Scan.voxels->Skip((firstRow - m_At) * m_RowBytes);
  m_Scan.voxels->Read(to, rowCount * m_RowBytes);
  m_At = firstRow + rowCount;
  if (m_Scan.swapBytes)
  {
    SwapValues(to, rowCount * m_RowBytes, m_Scan.type);
  }
  if (m_At == m_Rows)
  {
    if (!m_Scan.moreVolumes)
    {
      m_Scan.voxels->Finish();
    }
    m_Scan.voxels.reset(); // closes the file
  }
}

} // namespace voxelcore
