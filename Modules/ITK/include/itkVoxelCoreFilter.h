#ifndef itkVoxelCoreFilter_h
#define itkVoxelCoreFilter_h

#include "itkMedialComplexSource.h"
#include "itkVoxelShapeObject.h"

#include "voxelcore/DelaunayCells.h"

namespace itk
{

/** \class VoxelCoreFilter
 * \brief The voxel core of each label of a VoxelShapeObject.
 *
 * Method: Y. Yan, D. Letscher, T. Ju, "Voxel Cores: Efficient, robust, and provably good approximation of 3D medial
 * axes", ACM Transactions on Graphics 37(4), 2018. Spacings may differ: they become integer weights in which every
 * decision is exact. The result is the same, bit for bit, for every engine and number of threads. It has the bits and
 * the certificate of `voxelcore core`.
 *
 * As many threads work as the multi-threader may have, and not more than the number of work units. Progress and abort
 * are forwarded. An ExceptionObject says what was wrong in one line: also when the topology of a core is not its
 * shape's, which no known input causes.
 * \sa LabelImageToVoxelShapeFilter, LambdaPruningFilter
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
  EngineType m_Engine{ EngineType::Auto };
};

} // namespace itk

#endif
