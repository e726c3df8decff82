#ifndef itkLambdaPruningFilter_h
#define itkLambdaPruningFilter_h

#include "itkMedialComplexSource.h"

#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <string>

namespace itk
{

/** \class LambdaPruningFilter
 * \brief Prunes voxel cores to their lambda-subset without changing their topology.
 *
 * Lambda is given as on the command line: "1.5mm", "2.5vox" (times the smallest spacing, compared exactly), "2.5%" (of
 * the longest side of each shape's bounding box); a bare number is mm. All of the surface stays whose nearest boundary
 * points lie at least 2 lambda apart. "0" passes the cores on as they are, shared. Changing lambda does not run the
 * filters upstream again. Cores that are pruned already may be pruned further: that gives what pruning at once would.
 *
 * Progress and abort are forwarded; an ExceptionObject says what was wrong in one line: also when the topology of a
 * core is not, or no longer, its shape's.
 * \sa VoxelCoreFilter
 * \ingroup VoxelCore
 */
class LambdaPruningFilter : public MedialComplexSource
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LambdaPruningFilter);

  using Self = LambdaPruningFilter;
  using Superclass = MedialComplexSource;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;
  using InputType = MedialComplexObject;

  itkNewMacro(Self);
  itkTypeMacro(LambdaPruningFilter, MedialComplexSource);

  using Superclass::SetInput;
  void
  SetInput(const InputType * cores);
  const InputType *
  GetInput() const;

  /** "1.5vox" unless set. \throws ExceptionObject when the text is no length of this kind; lambda stays as it was. */
  virtual void
  SetLambda(const std::string & text);
  /** In mm. \throws ExceptionObject when it is negative or not finite. */
  void
  SetLambda(double millimetres);
  const std::string &
  GetLambda() const
  {
    return m_Lambda.text;
  }

protected:
  LambdaPruningFilter();
  ~LambdaPruningFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;
  void
  GenerateData() override;

private:
  voxelcore::Lambda m_Lambda;
};

} // namespace itk

#endif
