#ifndef itkVoxelCoreFilter_h
#define itkVoxelCoreFilter_h

#include "itkMedialComplexSource.h"
#include "itkVoxelShapeObject.h"

#include "voxelcore/Delaunay/DelaunayCells.h"
#include "voxelcore/VoxelCore/TolerancePruning.h"

namespace itk
{

/** \class VoxelCoreFilter
 * \brief The medial surface of each label of a VoxelShapeObject: what `voxelcore core` gives.
 *
 * Method: Y. Yan, D. Letscher, T. Ju, "Voxel Cores: Efficient, robust, and provably good approximation of 3D medial
 * axes", ACM Transactions on Graphics 37(4), 2018. Spacings may differ: they become integer weights in which every
 * decision is exact. The result is the same, bit for bit, for every engine and number of threads. It has the bits and
 * the certificate of `voxelcore core`: pruned at tolerance 1.2diag and refined from the labels, unless it is told
 * otherwise. LambdaPruningFilter prunes whole cores: turn WholeCore on for it.
 *
 * As many threads work as the multi-threader may have, and not more than the number of work units. Progress and abort
 * are forwarded. An ExceptionObject says what was wrong in one line: also when the topology of a core is not its
 * shape's, which no known input causes.
 * \sa LabelImageToVoxelShapeFilter, LambdaPruningFilter
 * \ingroup VoxelCore
 */
class VoxelCoreFilter : public MedialComplexSource
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(VoxelCoreFilter);

  using Self = VoxelCoreFilter;
  using Superclass = MedialComplexSource;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using EngineType = voxelcore::Engine;
  using InputType = VoxelShapeObject;

  itkNewMacro(Self);
  itkTypeMacro(VoxelCoreFilter, MedialComplexSource);

  using Superclass::SetInput;
  void
  SetInput(const InputType * shapes);
  const InputType *
  GetInput() const;

  /** Auto (the best there is) unless set. */
  itkSetEnumMacro(Engine, EngineType);
  itkGetConstMacro(Engine, EngineType);

  /** Off unless set. On: the whole voxel core, neither pruned nor refined. */
  itkSetMacro(WholeCore, bool);
  itkGetConstMacro(WholeCore, bool);
  itkBooleanMacro(WholeCore);

  /** How far the boundary may lie from the balls that remain, with its unit, such as "1.2diag", which it is unless set.
   *  \throws ExceptionObject when it is no such length. */
  void
  SetTolerance(const std::string & text);
  const std::string &
  GetTolerance() const
  {
    return m_Tolerance.text;
  }

  /** On unless set: what is left above tolerance 0 is refined from the labels. Off: the exact core of the voxels. */
  itkSetMacro(Refine, bool);
  itkGetConstMacro(Refine, bool);
  itkBooleanMacro(Refine);

protected:
  VoxelCoreFilter();
  ~VoxelCoreFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;
  void
  VerifyPreconditions() ITKv5_CONST override;
  void
  GenerateData() override;

private:
  EngineType           m_Engine{ EngineType::Auto };
  voxelcore::Tolerance m_Tolerance;
  bool                 m_WholeCore{ false };
  bool                 m_Refine{ true };
};

} // namespace itk

#endif
