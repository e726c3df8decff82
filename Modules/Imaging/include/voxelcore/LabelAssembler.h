#pragma once
// From rows of pixels in memory to packed voxel shapes, in one pass, by the rules of ReadLabelVolume().

#include "voxelcore/LabelVolume.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace voxelcore
{

/** For images that lie in another library's memory. Besides the shapes it takes a few MB, whatever the image's size. */
class LabelAssembler
{
public:
  /** A scalar pixel. */
  struct Pixel
  {
    std::size_t bytes; ///< 1, 2, 4 or 8; a floating-point number has 4 or 8
    bool        isSigned;
    bool        isReal;
  };

  /** Checks sizes (1 to 2^30), spacing (mm), origin and direction; `name` stands for the image in errors.
   *  \throws InputError also when the direction is off a right angle, or an axis off length 1, by more than 1e-4 and
   *  `orthonormalize` is false; when it is true the nearest orthonormal one is returned. */
  static ImageGeometry
  CheckGeometry(const std::string & name, const ImageGeometry & geometry, bool orthonormalize);

  /** Of the options, labels, binary, threshold and refuseGrey count. \throws UsageError when they contradict each other. */
  LabelAssembler(const std::string & name, const ImageGeometry & geometry, Pixel pixel, const ReadOptions & options);
  LabelAssembler(const LabelAssembler &) = delete;
  LabelAssembler &
  operator=(const LabelAssembler &) = delete;
  ~LabelAssembler();

  /** How many rows to give at a time so that the memory they take meanwhile stays near a few MB. */
  std::size_t
  RowsAtATime() const;

  /** `rowCount` whole rows along i, from row `firstRow` (j + size[1] * k) on; in order, in this machine's byte order.
   *  \throws InputError naming the first value that is no label, and its voxel. */
  void
  AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount);

  /** The shapes, by value. \throws InputError when a label asked for, or anything but background, is missing;
   *  GreyScanError */
  std::vector<LabelShape>
  TakeShapes();

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace voxelcore
