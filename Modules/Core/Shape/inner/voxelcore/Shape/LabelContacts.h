#pragma once
// Where labels of a scan touch, counted in their voxels alone.

#include "voxelcore/Lattice/ImageGeometry.h"
#include "voxelcore/Shape/LabelShape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelcore
{

/** A place where two labels touch. Voxels of the two that share a face, an edge or a corner are a touching pair; pairs
 *  whose voxels hang together over faces, edges and corners are one place. */
struct LabelContact
{
  std::array<std::size_t, 2>               labels{};    ///< positions in the list of labels, the smaller first
  std::vector<std::array<std::int32_t, 3>> voxels;      ///< of both labels, in voxel indices, in scan order
  std::uint64_t                            faces = 0;   ///< that two voxels share
  double                                   areaMm2 = 0; ///< of these faces; 0 where only edges and corners touch
  Vector3 centre{ 0, 0, 0 };                            ///< LPS mm, the mean of the middles between touching voxels
};

/** Labels that share no voxel, slice by slice. */
class LabelSlices
{
public:
  static constexpr std::uint32_t kNoLabel = 0xFFFFFFFFU;

  explicit LabelSlices(const std::vector<LabelShape> & labels);

  /** Holds all labels. */
  const VoxelBox &
  Box() const
  {
    return m_Box;
  }

  /** The label's position in the list, or kNoLabel, of each voxel of the slice with index z in the scan, of the box,
   *  x fastest. Outside the box all are kNoLabel. */
  void
  Read(std::int32_t z, std::vector<std::uint32_t> & slice) const;

private:
  const std::vector<LabelShape> * m_Labels;
  VoxelBox                        m_Box;
};

/** The contacts of all pairs of labels that share no voxel, by pair, then by their first voxel in scan order (z, then
 *  y, then x fastest). */
std::vector<LabelContact>
FindLabelContacts(const std::vector<LabelShape> & labels, const ImageGeometry & geometry);

/** Their voxels as one shape. */
VoxelShape
UnionOfLabels(const std::vector<LabelShape> & labels);

/** A voxel that several labels hold becomes the first one's; labels of which nothing is left go. */
std::vector<LabelShape>
WithoutSharedVoxels(std::vector<LabelShape> labels);

/** The voxels of each label that are in `shape`; labels of which nothing is left go. */
std::vector<LabelShape>
LabelsWithin(std::vector<LabelShape> labels, const VoxelShape & shape);

} // namespace voxelcore
