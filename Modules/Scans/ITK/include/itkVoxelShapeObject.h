#ifndef itkVoxelShapeObject_h
#define itkVoxelShapeObject_h

#include "itkVoxelLatticeObject.h"

#include "voxelcore/Imaging/LabelVolume.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class VoxelShapeObject
 * \brief The voxel shapes of an image's labels: packed bits of each label's bounding box.
 *
 * Labels are sorted by value. The shapes are never changed in place, so grafting shares them.
 * \sa LabelImageToVoxelShapeFilter, VoxelCoreFilter
 * \ingroup VoxelCore
 */
class VoxelShapeObject : public VoxelLatticeObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VoxelShapeObject);

  using Self = VoxelShapeObject;
  using Superclass = VoxelLatticeObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using LabelType = std::int64_t;
  using LabelShapeType = voxelcore::LabelShape;
  using LabelContainer = std::vector<LabelShapeType>;

  itkNewMacro(Self);
  itkTypeMacro(VoxelShapeObject, VoxelLatticeObject);

  /** Takes shapes, in lattice coordinates, in any order.
   *  \throws ExceptionObject when two have the same value, or a box reaches beyond the size of the geometry. */
  void
  SetLabels(LabelContainer labels);

  /** Sorted by value; empty when nothing was set or the data were released. */
  const LabelContainer &
  GetLabels() const
  {
    return *m_Labels;
  }

  /** \throws ExceptionObject when a label's box reaches beyond the size of the geometry, which was set after it. */
  void
  RequireWithinGeometry() const;

  bool
  HasLabel(LabelType value) const;

  /** \throws ExceptionObject when there is no such label. */
  const LabelShapeType &
  GetLabel(LabelType value) const;

  /** Releases the shapes; the geometry stays. */
  void
  Initialize() override;

  /** Takes over geometry and shapes, which both objects share from then on.
   *  \throws ExceptionObject when it is no VoxelShapeObject. */
  void
  Graft(const DataObject * data) override;

protected:
  VoxelShapeObject();
  ~VoxelShapeObject() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  void
  RequireWithinGeometry(const LabelContainer & labels) const;

  std::shared_ptr<const LabelContainer> m_Labels; ///< never null
};

} // namespace itk

#endif
