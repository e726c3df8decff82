#ifndef itkMedialComplexObject_h
#define itkMedialComplexObject_h

#include "itkVoxelLatticeObject.h"

#include "voxelcore/Certified/CertifiedCore.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace itk
{

/** \class MedialComplexObject
 * \brief The certified voxel cores of an image's labels, whole or pruned.
 *
 * As in files, vertices are in LPS mm, polygons are oriented for LPS, and radii and measures are in mm. Cores are never
 * changed in place, so grafting, and pruning at 0, share them.
 * \sa VoxelCoreFilter, LambdaPruningFilter
 * \ingroup VoxelCore
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

  /** One label's core, and what it was certified against. */
  struct Part
  {
    voxelcore::CoreOrigin                           origin; ///< label, name, shape and whole core
    std::shared_ptr<const voxelcore::CertifiedCore> core;   ///< never null
  };
  using PartContainer = std::vector<Part>;

  itkNewMacro(Self);
  itkTypeMacro(MedialComplexObject, VoxelLatticeObject);

  /** Takes parts in any order. \throws ExceptionObject when two have the same label or one has no core. */
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
  /** The label's core as a part of a MedialModel. */
  const voxelcore::PlacedCore &
  GetCore(LabelType label) const
  {
    return this->GetPart(label).core->core;
  }

  /** What MedialModel::refined has to be in a file of these cores: "labels" where they are refined. */
  std::string
  GetRefined() const;

  /** What MedialModel::provenance has to be in a file of these cores, so that `voxelcore verify`, `prune`, `skeleton`
   *  and `render` take it. `keepEdges` as in the ModelOptions it is written with. */
  std::string
  GetProvenance(bool keepEdges = false) const;

  /** Releases the cores; the geometry stays. */
  void
  Initialize() override;

  /** Takes over geometry and cores, which both objects share from then on.
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
