#ifndef itkVoxelLatticeObject_h
#define itkVoxelLatticeObject_h
// What the data objects of VoxelCore have in common: a place in the patient.

#include "itkDataObject.h"
#include "itkIndex.h"
#include "itkPoint.h"

#include "voxelcore/Lattice/ImageGeometry.h"

namespace itk
{

/** \class VoxelLatticeObject
 * \brief Data on the lattice of an image's voxels.
 *
 * Lattice coordinates are in voxels and start at the corner of the first voxel of the image's largest region, whatever
 * index that voxel has: `continuous index = StartIndex + lattice - 1/2`. Geometry().origin is the physical point of
 * that first voxel's centre, as a writer of files would store it.
 *
 * Geometry and start index are the information of the object, known before the data are: they stay when the data are
 * released, and setting them to what they are does not modify the object.
 * \ingroup VoxelCore
 */
class VoxelLatticeObject : public DataObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VoxelLatticeObject);

  using Self = VoxelLatticeObject;
  using Superclass = DataObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using IndexType = Index<3>;
  using PointType = Point<double, 3>;

  itkTypeMacro(VoxelLatticeObject, DataObject);

  /** Size, spacing (mm), origin (LPS mm, centre of the first voxel) and direction. */
  void
  SetGeometry(const voxelcore::ImageGeometry & geometry);
  const voxelcore::ImageGeometry &
  GetGeometry() const
  {
    return m_Geometry;
  }

  /** The index the first voxel has in the image. */
  void
  SetStartIndex(const IndexType & index);
  const IndexType &
  GetStartIndex() const
  {
    return m_StartIndex;
  }

  /** LPS mm of a place in lattice coordinates. */
  PointType
  TransformLatticeToPhysicalPoint(const voxelcore::Vector3 & lattice) const;

  /** Takes over geometry and start index of another VoxelLatticeObject, of whichever kind; of nothing else. */
  void
  CopyInformation(const DataObject * data) override;

protected:
  VoxelLatticeObject() = default;
  ~VoxelLatticeObject() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  voxelcore::ImageGeometry m_Geometry;
  IndexType                m_StartIndex{ { 0, 0, 0 } };
};

} // namespace itk

#endif
