#ifndef itkLocalThicknessImageFilter_h
#define itkLocalThicknessImageFilter_h

#include "itkImage.h"
#include "itkImageSource.h"
#include "itkVoxelShapeObject.h"

#include "voxelcore/VoxelCore/TolerancePruning.h"

#include <string>

namespace itk
{

/** \class LocalThicknessImageFilter
 * \brief The local thickness at each voxel of the labels of a VoxelShapeObject: what `voxelcore thickness` gives.
 *
 * At each voxel the diameter of the largest ball within its label that holds the voxel's centre (Hildebrand,
 * Rueegsegger 1997), in mm or, where the lengths of the input are voxels, in these; 0 outside. Each label is measured
 * by itself. Spacings may differ. The image has the grid of the image that the shapes were made of. The same bits for
 * every number of threads.
 *
 * With Refine on, as it is unless set, the balls are those of the smooth shape that the voxels stand for, pruned at
 * Tolerance; off, the largest ones that truly lie in the voxels.
 *
 * As many threads work as the multi-threader may have, and not more than the number of work units. Progress and abort
 * are forwarded. An ExceptionObject says what was wrong in one line.
 * \sa LabelImageToVoxelShapeFilter, VoxelCoreFilter
 * \ingroup VoxelCore
 */
class LocalThicknessImageFilter : public ImageSource<Image<float, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LocalThicknessImageFilter);

  using Self = LocalThicknessImageFilter;
  using Superclass = ImageSource<Image<float, 3>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using InputType = VoxelShapeObject;

  itkNewMacro(Self);
  itkTypeMacro(LocalThicknessImageFilter, ImageSource);

  using Superclass::SetInput;
  void
  SetInput(const InputType * shapes);
  const InputType *
  GetInput() const;

  /** What lies within so much of the balls that remain counts as noise: "1.2diag" unless set.
   *  \throws ExceptionObject when it is no such length. */
  void
  SetTolerance(const std::string & text);
  const std::string &
  GetTolerance() const
  {
    return m_Tolerance.text;
  }

  itkSetMacro(Refine, bool);
  itkGetConstMacro(Refine, bool);
  itkBooleanMacro(Refine);

protected:
  LocalThicknessImageFilter();
  ~LocalThicknessImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;
  void
  GenerateOutputInformation() override;
  void
  EnlargeOutputRequestedRegion(DataObject * output) override;
  void
  GenerateData() override;

private:
  voxelcore::Tolerance m_Tolerance;
  bool                 m_Refine{ true };
};

} // namespace itk

#endif
