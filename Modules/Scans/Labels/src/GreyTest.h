#pragma once
// Looks at rows of a scan as they come by, and tells a grey scan from labels.
//
// What tells them apart is how often neighbours are equal. A label is a body: most of its voxels lie beside one of its
// own. A grey value is spread over the scan, and noise sets it apart from its neighbours. So for each value other than
// 0 the share of its neighbours (both not 0, along i and j) that have it is taken, and of these shares the median: a
// few values that fill large parts, as clipped ones do, do not move it. In atlases of 30 to 700 labels it is 0.56 to
// 0.99, in grey scans of 8 bits and more 0 to 0.18. A scan is grey when it has at least 24 values and
// - the median is below 0.3, and less than 0.6 of all neighbours are equal (the two most frequent values left out), or
// - the median is below 0.6, less than 0.65 of all are equal, and those that differ do so by less than a quarter of
// what
//   voxels anywhere do: a smooth ramp.
// Bodies of single voxels have no neighbours of their own and do not count.

#include "voxelcore/Labels/GreyScan.h"
#include "voxelcore/Labels/StoredVoxels.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace voxelcore
{

class GreyTest
{
public:
  static constexpr std::size_t kMostDistinct = 1U << 16; ///< values that are told apart

  /** Of the scan only what lies in `part` is looked at. The scan must outlive the object. */
  GreyTest(const StoredVoxels & scan, const CropRange & part);

  /** Whole rows in this machine's byte order, in order; see LabelCollector::AddRows(). */
  void
  AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount);

  /** Whether so much more was seen since it last said so that LooksGrey() is worth asking. */
  bool
  IsTimeToLook();

  /** By what was seen so far; two million voxels at most. */
  bool
  LooksGrey() const;

  /** After all rows. */
  GreyScan
  Describe() const;

private:
  struct Neighbours
  {
    struct OfValue
    {
      std::uint64_t voxels = 0;
      std::uint64_t pairs = 0; ///< with a neighbour that is not 0, counted from the first of the two
      std::uint64_t equal = 0;
    };
    std::unordered_map<double, OfValue> values;
    std::vector<double>                 differences; ///< of neighbours that are neither 0 nor equal
  };

  Neighbours
  CountNeighbours() const;
  bool
  HasFewValues() const;
  std::size_t
  ValueCount() const;
  double
  Value(std::size_t index) const;

  const StoredVoxels &       m_Scan;
  CropRange                  m_Part;
  std::size_t                m_Width; ///< values taken of a row
  std::uint64_t              m_OneIn; ///< rows, of which one is taken and the next with it
  std::uint64_t              m_LastTaken;
  std::uint64_t              m_NextLook;
  std::uint64_t              m_NotZero = 0;
  std::vector<std::byte>     m_Stored; ///< values of the rows taken, one after the other, as the scan stores them
  std::vector<std::uint64_t> m_Rows;   ///< their numbers
};

/** \throws GreyScanError with one line that says what to do. */
[[noreturn]] void
RefuseGrey(const StoredVoxels & scan, const GreyTest & test);

} // namespace voxelcore
