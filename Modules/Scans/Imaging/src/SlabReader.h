#pragma once
// The rows of a scan, a few MB at a time: a thread of its own reads and unpacks the next slab while the last one is
// worked on.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Formats/ScanFile.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace voxelcore
{

/** Rows that follow each other. */
struct RowSpan
{
  std::uint64_t firstRow = 0; ///< y + size[1] * z
  std::size_t   rowCount = 0;
};

/** Turns the byte order of values round; `count` bytes of them. */
void
SwapValues(std::byte * bytes, std::size_t count, PixelType type);

struct Slab
{
  std::vector<std::byte> bytes;    ///< of all spans, whole rows in this machine's byte order; room behind them
  std::size_t            used = 0; ///< how many of them count
  std::vector<RowSpan>   spans;
};

class SlabReader
{
public:
  /** Rows y, z of `part`; what lies between is skipped, which costs nothing where data are stored plain. Of long rows
   *  only what lies in the part is read, if that is little. The scan must
   *  outlive the object, and its stream is not to be touched meanwhile. */
  SlabReader(ScanFile & scan, const CropRange & part);
  SlabReader(const SlabReader &) = delete;
  SlabReader &
  operator=(const SlabReader &) = delete;
  ~SlabReader();

  /** The next slab, good until the next call; null at the end. \throws what reading throws */
  const Slab *
  Next();

  /** After the last slab: goes on to the end of the volume, so that checksums are checked. \throws Cancelled, and what
   *  reading throws */
  void
  Finish(const ProgressCallback & progress);

  std::size_t
  RowBytes() const
  {
    return m_RowBytes;
  }

  /** How much of the part has been given out, 0 to 1. */
  double
  Fraction() const
  {
    return static_cast<double>(m_Given) / static_cast<double>(m_PartRows);
  }

private:
  bool
  Fill(Slab & slab);
  void
  ReadRows(Slab & slab, std::size_t count);
  /** What lies beside the part along x is passed over, and not defined in the slab. */
  void
  ReadPartOfRows(Slab & slab, std::size_t count);
  /** Goes on to a row; false when `goOn` says so on the way. */
  template <typename GoOn>
  bool
  SkipTo(std::uint64_t row, const GoOn & goOn);
  bool
  IsStopped();
  void
  Run();

  ScanFile &    m_Scan;
  std::uint64_t m_SizeY;
  std::uint64_t m_Rows;   ///< of the whole scan
  std::uint64_t m_FirstY; ///< of the part
  std::uint64_t m_EndY;
  std::uint64_t m_EndZ;
  std::uint64_t m_PartRows;
  std::size_t   m_RowBytes;
  std::size_t   m_PartStart; ///< of each row, in bytes
  std::size_t   m_PartBytes;
  std::uint64_t m_At = 0; ///< the row where the stream stands
  std::uint64_t m_Next;   ///< the row to be read next
  std::uint64_t m_Given = 0;

  // What the two threads share, under m_Mutex: slabs go round between them.
  static constexpr std::size_t kSlabs = 3;
  std::array<Slab, kSlabs>     m_Slabs;
  std::size_t                  m_Filled = 0; ///< number of slabs filled so far; number n lies in m_Slabs[n % kSlabs]
  std::size_t                  m_Taken = 0;  ///< number of slabs given out so far
  bool                         m_Ended = false;
  bool                         m_Stop = false;
  std::exception_ptr           m_Error;
  std::mutex                   m_Mutex;
  std::condition_variable      m_Changed;
  std::thread                  m_Thread; ///< none for a small scan
};

} // namespace voxelcore
