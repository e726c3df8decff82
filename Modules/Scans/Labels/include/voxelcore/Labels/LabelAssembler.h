#pragma once
// From rows of stored values to packed voxel shapes, in one pass.

#include "voxelcore/Labels/LabelChoice.h"
#include "voxelcore/Labels/LabelMap.h"
#include "voxelcore/Labels/StoredVoxels.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace voxelcore
{

/** Values are whole numbers from 0, the background, up, or the scan is refused. Nothing is rounded, clipped or
 *  reinterpreted; a slope that is itself rounded, such as 1/255 in a NIfTI file, is allowed for. Besides the shapes it
 *  takes a few MB, whatever the scan's size.
 *
 *  With choice.refuseGrey a grey scan is told from labels: once it looks grey, or a value is no label, it makes no more
 *  shapes, and TakeShapes() throws what is true of the whole scan. */
class LabelAssembler
{
public:
  /** A scalar pixel. */
  struct Pixel
  {
    std::size_t bytes; ///< 1, 2, 4 or 8; a floating-point number has 4 or 8
    bool        isSigned;
    bool        isReal;

    template <typename T>
    static constexpr Pixel
    Of()
    {
      static_assert(std::is_arithmetic_v<T> && sizeof(T) <= 8, "labels are single numbers");
      return { sizeof(T), std::is_signed_v<T>, std::is_floating_point_v<T> };
    }
  };

  /** \throws UsageError when the choice contradicts itself; InputError when the crop reaches beyond the scan. */
  LabelAssembler(StoredVoxels scan, const LabelChoice & choice);
  /** For an image in another library's memory, which `name` stands for in errors. */
  LabelAssembler(const std::string & name, const ImageGeometry & geometry, Pixel pixel, const LabelChoice & choice);
  LabelAssembler(const LabelAssembler &) = delete;
  LabelAssembler &
  operator=(const LabelAssembler &) = delete;
  ~LabelAssembler();

  /** The part of the scan that is looked at. */
  const CropRange &
  Part() const;

  /** Whether rows beside the part are wanted, too: in a segmentation in layers the numbers that labels get must not
   *  depend on the crop. */
  bool
  NeedsAllRows() const;

  /** How many rows make a few MB, for those who gather rows and report progress. */
  std::size_t
  RowsAtATime() const;

  /** `rowCount` whole rows along i, from row `firstRow` (j + size[1] * k) on; in order, in this machine's byte order.
   *  \throws InputError naming the first value that is no label, and its voxel. */
  void
  AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount);

  /** True when segments had to be numbered anew: layers use a value more than once. */
  bool
  IsRenumbered() const;

  /** Whole numbers below 0 that were found, if labels were named: they count as background. */
  std::vector<double>
  PassedOver() const;

  /** The shapes, by value. \throws InputError when a label asked for, or anything but background, is missing;
   *  GreyScanError */
  std::vector<LabelShape>
  TakeShapes();

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace voxelcore
