#ifndef itkMedialComplexObject_h
#define itkMedialComplexObject_h

#include "itkVoxelLatticeObject.h"

#include "voxelcore/CoreProvenance.h"
#include "voxelcore/MedialComplex.h"
#include "voxelcore/TopologyNumbers.h"
#include "voxelcore/VoxelShape.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace itk
{

/** \class MedialComplexObject
 * \brief The voxel cores of an image's labels, whole or pruned.
 *
 * Vertices are in lattice coordinates (TransformLatticeToPhysicalPoint makes LPS mm of them; voxelcore::ToPhysical moves
 * a whole complex and orients its polygons for LPS); radii and measures are in mm. Complexes are never changed in place,
 * so grafting, and pruning at 0, share them.
 * \sa VoxelCoreFilter, LambdaPruningFilter
 */
class MedialComplexObject : public VoxelLatticeObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(MedialComplexObject);

  using Self = MedialComplexObject;
  using Superclass = VoxelLatticeObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using LabelType = std::int64_t;

  /** One label's core. The filters of VoxelCore let none out whose two topologies differ: that is its certificate. */
  struct Part
  {
    LabelType                                       label = 0;
    std::string                                     name;
    voxelcore::VoxelBox                             box;              ///< of the shape, in lattice coordinates
    double                                          lambda = 0;       ///< mm, the threshold it is pruned to
    std::string                                     lambdaText = "0"; ///< the same as it was given
    voxelcore::TopologyNumbers                      shapeTopology;    ///< counted in the voxels
    voxelcore::TopologyNumbers                      complexTopology;  ///< counted, independently, in the complex
    std::shared_ptr<const voxelcore::MedialComplex> complex;          ///< never null
    voxelcore::CoreOrigin                           origin;           ///< the shape and the whole core, for files
  };
  using PartContainer = std::vector<Part>;

  itkNewMacro(Self);
  itkTypeMacro(MedialComplexObject, VoxelLatticeObject);

  /** Takes parts in any order. \throws ExceptionObject when two have the same label or one has no complex. */
  void
  SetParts(PartContainer parts);

  /** Sorted by label; empty when nothing was set or the data were released. */
  const PartContainer &
  GetParts() const
  {
    return *m_Parts;
  }

  bool
  HasLabel(LabelType label) const;

  /** \throws ExceptionObject when there is no such label. */
  const Part &
  GetPart(LabelType label) const;
  const voxelcore::MedialComplex &
  GetComplex(LabelType label) const
  {
    return *this->GetPart(label).complex;
  }

  /** What MedialModel::provenance has to be in a file of these cores, so that `voxelcore verify`, `prune`, `skeleton` and
   *  `render` take it. `keepEdges` as in the ModelOptions it is written with. */
  std::string
  GetProvenance(bool keepEdges = false) const;

  /** Releases the complexes; the geometry stays. */
  void
  Initialize() override;

  /** Takes over geometry and complexes, which both objects share from then on.
   *  \throws ExceptionObject when it is no MedialComplexObject. */
  void
  Graft(const DataObject * data) override;

protected:
  MedialComplexObject();
  ~MedialComplexObject() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  std::shared_ptr<const PartContainer> m_Parts; ///< never null
};

} // namespace itk

#endif
