#pragma once
// From rows of stored values to one packed shape a label, in one pass, whatever the number of labels.

#include "voxelcore/Labels/LabelMap.h"
#include "voxelcore/Labels/LabelNaming.h"
#include "voxelcore/Shape/VoxelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <vector>

namespace voxelcore
{

/** Rows come slab by slab; runs of equal values are found, sorted by label, and packed at the end of a slab as runs or
 *  bits, whichever is smaller. So the memory beyond the shapes themselves stays near one slab. */
class LabelCollector
{
public:
  /** Only voxels within `part` get into shapes. \throws UsageError when options contradict each other. The scan must
   *  outlive the object. */
  LabelCollector(const StoredVoxels & scan, const LabelChoice & choice, const CropRange & part);

  /** `rowCount` whole rows from row `firstRow` (y + size[1] * z) on, in this machine's byte order. Rows come in order;
   *  those beside the part may be left out unless NeedsAllRows().
   *  \throws InputError naming the first value that is no label, and its voxel. */
  void
  AddRows(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount);

  /** To be called every few MB of rows and at the end: packs what came.
   *  \throws InputError when the shapes would take memory out of all proportion. */
  void
  FinishSlab();

  /** True for a segmentation in layers: values that no segment names get numbers in the order they turn up, which must
   *  not depend on the part. */
  bool
  NeedsAllRows() const
  {
    return m_Tables.size() > 1;
  }

  /** The shapes that were asked for, sorted by value. \throws InputError when one of them, or anything but background,
   *  is missing. */
  std::vector<LabelShape>
  TakeShapes();

  /** Values below 0, taken as background because labels were named. */
  std::vector<double>
  PassedOver() const
  {
    std::vector<double> values(m_PassedOver.begin(), m_PassedOver.end());
    values.resize(values.size() + (m_PassesNan ? 1 : 0), std::numeric_limits<double>::quiet_NaN());
    return values;
  }

  const LabelNaming &
  Naming() const
  {
    return m_Naming;
  }

private:
  static constexpr std::int32_t kUnseen = -2; ///< not classified yet
  static constexpr std::int32_t kBackground = -1;

  struct Run
  {
    std::int32_t x, end, y, z;
  };

  /** A shape within one slab. */
  struct Piece
  {
    VoxelBox                   box;
    std::vector<Run>           runs;
    std::vector<std::uint64_t> bits; ///< of the box, packed by rows; when there are no runs
  };

  /** A value found in the scan. */
  struct Found
  {
    LabelNaming::Label label;
    std::int32_t       target = -1;  ///< which shape its voxels go into; -1: not asked for
    bool               isIn = false; ///< there are voxels of it in the part
  };

  struct Target
  {
    LabelNaming::Label          label;
    bool                        touched = false; ///< in this slab
    std::vector<Run>            runs;            ///< of this slab
    std::array<std::int32_t, 3> lower{ INT32_MAX, INT32_MAX, INT32_MAX };
    std::array<std::int32_t, 3> upper{ -1, -1, -1 }; ///< inclusive
    std::uint64_t               bytes = 0;           ///< that its final shape takes as far as is known
    std::vector<Piece>          pieces;
  };

  struct Table ///< of one layer: stored bits -> index in m_Found, or kBackground
  {
    std::vector<std::int32_t>                       dense; ///< 8 and 16 bits
    std::unordered_map<std::uint64_t, std::int32_t> sparse;
    std::uint64_t                                   lastBits = 0;
    std::int32_t                                    last = kUnseen;
  };

  template <typename U>
  void
  AddRowsOf(const std::byte * rows, std::uint64_t firstRow, std::size_t rowCount);
  template <typename U>
  void
  ScanRow(const U * row, std::size_t layer, std::int32_t y, std::int32_t z);
  template <typename T>
  void
  ThresholdRow(const std::byte * row, std::int32_t y, std::int32_t z);
  template <typename U>
  std::int32_t
  Lookup(U bits, std::size_t layer, std::int32_t x, std::int32_t y, std::int32_t z);
  std::int32_t
  Classify(std::uint64_t bits, std::size_t layer, std::int32_t x, std::int32_t y, std::int32_t z);
  bool
  IsPassedOver(std::uint64_t bits);
  std::int64_t
  WholeNumber(std::uint64_t bits, std::int32_t x, std::int32_t y, std::int32_t z) const;
  double
  Value(std::uint64_t bits) const;
  [[noreturn]] void
  RefuseValue(double value, const char * what, std::int32_t x, std::int32_t y, std::int32_t z) const;
  std::int32_t
  NewTarget(const LabelNaming::Label & label);
  void
  Emit(Target & target, std::int32_t x, std::int32_t end, std::int32_t y, std::int32_t z);

  const StoredVoxels &                     m_Scan;
  CropRange                                m_Part;
  bool                                     m_IsPart; ///< not the whole scan
  LabelNaming                              m_Naming;
  bool                                     m_Binary;
  std::optional<std::pair<double, double>> m_Threshold;
  bool                                     m_MayBeMissing;
  bool                                     m_ZeroIsBackground;
  std::vector<Table>                       m_Tables;
  std::set<double>                         m_PassedOver; ///< values below 0
  bool                                     m_PassesNan = false;
  std::vector<Found>                       m_Found;
  std::vector<Target>                      m_Targets;
  std::vector<std::int32_t>                m_Touched;
  std::uint64_t                            m_Bytes = 0; ///< that all final shapes take as far as is known
  std::vector<std::byte>                   m_Layer;     ///< one row of one layer
};

} // namespace voxelcore
