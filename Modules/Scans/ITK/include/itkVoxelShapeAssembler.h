#ifndef itkVoxelShapeAssembler_h
#define itkVoxelShapeAssembler_h
// The part of LabelImageToVoxelShapeFilter that does not depend on the pixel type.

#include "voxelcore/Labels/LabelAssembler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace itk
{

/** \class VoxelShapeAssembler
 * \brief From rows of pixels in memory to packed voxel shapes, in one pass, by the rules of voxelcore::ReadLabelVolume.
 *
 * What VoxelCore throws arrives as ExceptionObject with the same line as description. Voxels in it are counted from the
 * first of the image's largest region.
 * \ingroup VoxelCore
 */
class VoxelShapeAssembler
{
public:
  /** Checks sizes (1 to 2^30), spacing, origin and direction. \throws ExceptionObject when the direction is off a right
   *  angle, or an axis off length 1, by more than 1e-4 and `orthonormalize` is false; then the nearest orthonormal one
   *  is returned otherwise. */
  static voxelcore::ImageGeometry
  CheckGeometry(const voxelcore::ImageGeometry & geometry, bool orthonormalize);

  /** \throws ExceptionObject when they contradict each other. */
  VoxelShapeAssembler(const voxelcore::ImageGeometry & geometry,
                      voxelcore::LabelAssembler::Pixel pixel,
                      const voxelcore::LabelChoice &   choice);
  VoxelShapeAssembler(const VoxelShapeAssembler &) = delete;
  VoxelShapeAssembler &
  operator=(const VoxelShapeAssembler &) = delete;
  ~VoxelShapeAssembler();

  /** How many rows to give at a time so that the memory they take meanwhile stays near a few MB. */
  std::size_t
  RowsAtATime() const;

  /** `rowCount` whole rows, from row `firstRow` (y + size[1] * z) on; in order.
   *  \throws ExceptionObject naming the first value that is no label, and its voxel. */
  void
  AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount);

  /** The shapes, their voxels hanging together as `connectivity` says: "6", "26" or "joined". Adds to `warnings` which
   *  have pieces that "joined" would join. \throws ExceptionObject when a label asked for, or anything but background,
   *  is missing, and where 26 is refused. */
  std::vector<voxelcore::LabelShape>
  TakeShapes(const std::string & connectivity, std::vector<std::string> & warnings);

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace itk

#endif
